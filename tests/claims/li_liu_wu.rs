//! The claims of Li, Liu & Wu.

use serde_json::json;
use volary::claim::Run;
use volary::math::Vector;
use volary::world::{AnyWorld, World};

use crate::common::{from_json, spec, world};
use crate::runs::{bodies, doctored, holds, plane, points, shipped, unmet, violated};

/// What the proof of Theorem 3.1 and the theorem say, but for what is wrong.
const SOUND: [&str; 10] = [
    "li-liu-wu/mean-velocity",
    "li-liu-wu/theorem-3-1-flock",
    "li-liu-wu/theorem-3-1-velocity",
    "li-liu-wu/theorem-3-1-line",
    "li-liu-wu/energy-rate-corrected",
    "li-liu-wu/energy-never-rises",
    "li-liu-wu/bound-8-corrected",
    "li-liu-wu/diameter",
    "li-liu-wu/projected-rate",
    "li-liu-wu/projected-diameter",
];

fn quantity(finding: &volary::claim::Finding, name: &str) -> f64 {
    let found = finding.quantities.iter().find(|it| it.name == name);
    found.and_then(|it| it.value).expect("it is measured")
}

#[test]
fn the_theorem_holds_where_it_applies() {
    let world = plane("li-liu-wu/theorem-3-1", &[]);
    let run = points(&world);
    holds("li-liu-wu/mean-velocity", &run);
    holds("li-liu-wu/theorem-3-1-flock", &run);
    holds("li-liu-wu/theorem-3-1-velocity", &run);
    holds("li-liu-wu/theorem-3-1-line", &run);
    holds("li-liu-wu/energy-never-rises", &run);
    violated("li-liu-wu/energy-rate-printed", &run);
    holds("li-liu-wu/energy-rate-corrected", &run);
    // M* is above 1, so the printed bound is larger than it need be.
    let printed = holds("li-liu-wu/bound-8-printed", &run);
    assert!(quantity(&printed, "M*") > 1.0);
    let corrected = holds("li-liu-wu/bound-8-corrected", &run);
    assert!(corrected.margin < printed.margin);
    holds("li-liu-wu/diameter", &run);
    holds("li-liu-wu/projected-rate", &run);
    holds("li-liu-wu/projected-diameter", &run);
    holds("li-liu-wu/uniform-rate-corrected", &run);
    unmet("li-liu-wu/figures-1-2-line", &run);
}

#[test]
fn it_holds_in_space_and_on_bodies() {
    let AnyWorld::Space(world) = shipped("li-liu-wu/theorem-3-1-3d", &[]) else {
        panic!("it is not flat");
    };
    let run = points(&world);
    for name in SOUND {
        holds(name, &run);
    }
    let run = bodies(&world);
    for name in SOUND {
        holds(name, &run);
    }
}

/// Two agents abreast of a line along the first axis, with these heights and velocities
/// across it.
fn abreast(heights: [f64; 2], velocities: [f64; 2], end: f64) -> World<2> {
    world(spec(json!({
        "dimension": 2,
        "time": { "step": 0.01, "end": end },
        "record": { "every": 0.02 },
        "agents": [{
            "radius": 0.001,
            "positions": { "explicit": [[0, heights[0]], [0.01, heights[1]]] },
            "velocities": { "explicit": [[0, velocities[0]], [0, velocities[1]]] }
        }],
        "laws": [
            { "alignment": {
                "kernel": { "cucker_smale": { "exponent": 0.4 } }, "normalisation": "mean_field"
            } },
            { "line_pattern": { "direction": [1, 0], "strength": 0.7 } }
        ]
    })))
}

#[test]
fn equal_signs_bounds_and_widths_as_printed_fail() {
    // M* = 0.7 · 2 · 0.1² is below 1, and at the start Σ s_i is all of √(N M*/γ).
    let world = abreast([0.1, -0.1], [0.0, 0.0], 1.0);
    let run = points(&world);
    let finding = violated("li-liu-wu/bound-8-printed", &run);
    assert_eq!(finding.closest, Some(0.0));
    let finding = holds("li-liu-wu/bound-8-corrected", &run);
    assert!(finding.margin.is_some_and(|margin| margin < 1e-6));

    // Of two agents d_X is their distance, and (7) an equality.
    holds("li-liu-wu/energy-rate-printed", &run);
    holds("li-liu-wu/energy-rate-corrected", &run);

    // Far from the line, and nowhere apart along it.
    let world = abreast([5.0, -5.0], [1.0, -1.0], 2.0);
    let run = points(&world);
    let finding = violated("li-liu-wu/uniform-rate-printed", &run);
    assert!((quantity(&finding, "d*") - 0.01).abs() < 1e-3);
    holds("li-liu-wu/uniform-rate-corrected", &run);
    // Far apart along it, and near to it: the extent along it is all there is.
    let world = plane(
        "li-liu-wu/theorem-3-1",
        &[
            "time.end=5",
            "agents[0].positions={\"line\":{\"from\":[0,0],\"to\":[20,20]}}",
            "agents[0].velocities={\"ball\":{\"radius\":0.01}}",
        ],
    );
    holds("li-liu-wu/uniform-rate-printed", &points(&world));
}

#[test]
fn the_integral_must_be_infinite() {
    let world = plane("li-liu-wu/fast-decay", &[]);
    let run = points(&world);
    unmet("li-liu-wu/theorem-3-1-flock", &run);
    // And so it is needed: the pairs part for ever.
    let last = run.last();
    assert!(last.velocities[2].x - last.velocities[0].x > 1.0);

    for set in [
        "laws[0].alignment.kernel={\"constant\":{}}",
        "laws[0].alignment.kernel={\"exponential\":{\"length\":3}}",
        "laws[0].alignment.normalisation=\"motsch_tadmor\"",
        "laws[1].line_pattern.normalised=true",
        "laws[1].line_pattern.strength=0",
        "agents[0].force_limit=9",
    ] {
        let world = plane("li-liu-wu/theorem-3-1", &["time.end=0.2", set]);
        let run = points(&world);
        unmet("li-liu-wu/theorem-3-1-velocity", &run);
        unmet("li-liu-wu/bound-8-corrected", &run);
    }
    let mut slowed = plane("li-liu-wu/theorem-3-1", &["time.end=0.2"]);
    let friction = json!({ "friction": { "coefficient": 0.1 } });
    slowed.spec.laws.push(from_json(friction));
    unmet("li-liu-wu/theorem-3-1-velocity", &points(&slowed));
}

#[test]
fn doctored_runs_are_found_out() {
    let world = plane("li-liu-wu/theorem-3-1", &["time.end=30"]);
    let push = Vector::<2>::new(4.0, 2.0);
    let pushed = doctored(&world, |_, (t, _, v)| {
        if *t > 8.0 {
            v[0] += push;
        }
    });
    violated("li-liu-wu/mean-velocity", &pushed);
    violated("li-liu-wu/energy-never-rises", &pushed);
    violated("li-liu-wu/theorem-3-1-flock", &pushed);
    // Off for ever, after it was more so.
    let twice = |t: f64| if t < 8.0 { 2.0 } else { 1.0 };
    let carried = doctored(&world, |k, (t, _, v)| {
        v[0] += push * if k > 0 { twice(*t) } else { 0.0 };
    });
    violated("li-liu-wu/theorem-3-1-velocity", &carried);
    let aside = doctored(&world, |k, (t, x, _)| {
        let off = if k > 0 { 90.0 * twice(*t) } else { 0.0 };
        x[0] += Vector::<2>::new(off, -off);
    });
    violated("li-liu-wu/theorem-3-1-line", &aside);
    // Off the line, and away along it.
    let off = doctored(&world, |_, (t, x, _)| {
        if *t > 8.0 {
            x[0] += Vector::<2>::new(90.0, -90.0);
        }
    });
    violated("li-liu-wu/bound-8-corrected", &off);
    violated("li-liu-wu/diameter", &off);
    let away = doctored(&world, |_, (t, x, _)| {
        if *t > 8.0 {
            x[0] += Vector::<2>::new(90.0, 90.0);
        }
    });
    violated("li-liu-wu/projected-diameter", &away);
    holds("li-liu-wu/diameter", &away);
    let start = points(&world).start().clone();
    let frozen = doctored(&world, |_, (_, x, v)| {
        x.clone_from(&start.positions);
        v.clone_from(&start.velocities);
    });
    violated("li-liu-wu/energy-rate-corrected", &frozen);
    violated("li-liu-wu/uniform-rate-corrected", &frozen);
    violated("li-liu-wu/projected-rate", &frozen);
}

#[test]
fn figures_show_what_they_show() {
    for name in ["li-liu-wu/figure-1", "li-liu-wu/figure-2"] {
        let world = plane(name, &["record.every=1"]);
        let run = points(&world);
        holds("li-liu-wu/figures-1-2-line", &run);
        unmet("li-liu-wu/theorem-3-1-line", &run);
    }
    let world = plane("li-liu-wu/figure-3", &["record.every=1"]);
    holds("li-liu-wu/figures-3-4-ball", &points(&world));
    stuck(&plane(
        "li-liu-wu/figure-3",
        &["time.end=20", "record.every=1"],
    ));
    stuck(&plane(
        "li-liu-wu/figure-1",
        &["time.end=20", "record.every=1"],
    ));
}

/// Runs that stop where they are far from their pattern show none.
fn stuck(world: &World<2>) {
    let half = points(world).observations[10].clone();
    let run: Run<'_, 2> = doctored(world, |k, (_, x, v)| {
        if k >= 10 {
            x.clone_from(&half.positions);
            v.clone_from(&half.velocities);
        }
    });
    match world.name.ends_with("1") {
        true => violated("li-liu-wu/figures-1-2-line", &run),
        false => violated("li-liu-wu/figures-3-4-ball", &run),
    };
}
