//! The claims of Shi, Wang & Chu.

use crate::runs::{bodies, doctored, finding, holds, plane, points, unmet, violated};
use volary::claim::{Run, Verdict, claims};
use volary::math::Vector;
use volary::world::AnyWorld;

const ENDS: &[&str] = &["time.end=120", "record.every=1"];

#[test]
fn energy_falls_and_velocities_agree_with_damping_and_without() {
    let world = plane("shi-wang-chu/damped", ENDS);
    let run = points(&world);
    let finding = holds("shi-wang-chu/energy-falls", &run);
    assert!(finding.curves.len() == 2, "{finding:?}");
    holds("shi-wang-chu/velocity-agreement", &run);
    holds("shi-wang-chu/damped-rest", &run);
    holds("shi-wang-chu/critical-point-corrected", &run);
    holds("shi-wang-chu/bounded-distances", &run);
    // What friction takes is not that of an ideal flock.
    for name in ["common-velocity", "center-invariance", "rate-corrected"] {
        unmet(&format!("shi-wang-chu/{name}"), &run);
    }

    // Velocities that stay apart, at a place that stays as it is.
    let stuck = doctored(&world, |_, (_, _, v)| {
        v.iter_mut().for_each(|v| *v = Vector::zeros());
        v[0][0] = 1.0;
    });
    violated("shi-wang-chu/velocity-agreement", &stuck);
    violated("shi-wang-chu/damped-rest", &stuck);
    let late = doctored(&world, |k, (_, _, v)| {
        if k == 40 {
            v[3] *= 1e3;
        }
    });
    let finding = violated("shi-wang-chu/energy-falls", &late);
    assert_eq!(finding.closest, Some(40.0));
    let far = doctored(&world, |k, (_, x, _)| {
        if k == 40 {
            x[3][0] += 1e30;
        }
    });
    violated("shi-wang-chu/bounded-distances", &far);
    let pressed = doctored(&world, |_, (_, x, _)| x.iter_mut().for_each(|x| *x *= 0.5));
    violated("shi-wang-chu/critical-point-corrected", &pressed);

    let ideal = plane("shi-wang-chu/ideal", &["time.end=2"]);
    unmet("shi-wang-chu/damped-rest", &points(&ideal));
}

#[test]
fn distances_are_kept_as_far_as_energy_goes() {
    let world = plane("shi-wang-chu/ideal", &["time.end=30", "record.every=0.1"]);
    let run = points(&world);
    holds("shi-wang-chu/no-collision-printed", &run);
    let finding = holds("shi-wang-chu/no-collision-sharpened", &run);
    let nearest = finding.quantities.iter().find(|it| it.name == "r");
    let nearest = nearest.and_then(|it| it.value).expect("there is a bound");
    // As bodies-that-cannot-meet has it, whose bodies are half as large.
    assert!((nearest - 0.147).abs() < 1e-3, "{nearest}");
    let sharpened = claims::<2>();
    let sharpened = sharpened
        .iter()
        .find(|it| it.about().name == "shi-wang-chu/no-collision-sharpened");
    let exclusion = sharpened.and_then(|it| it.exclusion(&run));
    assert_eq!(exclusion.map(|it| it.distance), Some(nearest));

    let near = doctored(&world, |k, (_, x, _)| {
        if k == 50 {
            x[1] = x[0];
            x[1][0] += 0.1;
        }
    });
    holds("shi-wang-chu/no-collision-printed", &near);
    let finding = violated("shi-wang-chu/no-collision-sharpened", &near);
    assert_eq!(finding.closest, Some(5.0));
    let met = doctored(&world, |k, (_, x, _)| {
        if k == 50 {
            x[1] = x[0];
        }
    });
    violated("shi-wang-chu/no-collision-printed", &met);
    let ranged = plane(
        "shi-wang-chu/ideal",
        &["time.end=1", "laws[1].pair_potential.range=5"],
    );
    unmet("shi-wang-chu/no-collision-sharpened", &points(&ranged));
}

#[test]
fn the_common_velocity_is_that_of_the_mass_or_the_mean() {
    let ends = &["time.end=100", "record.every=1"];
    for name in ["two-minima", "mass-weighted", "compensated"] {
        let world = plane(&format!("shi-wang-chu/{name}"), ends);
        holds("shi-wang-chu/center-invariance", &points(&world));
    }
    let world = plane("shi-wang-chu/two-minima", ends);
    let run = points(&world);
    holds("shi-wang-chu/common-velocity", &run);
    holds("shi-wang-chu/strong-connectivity", &run);
    let drifting = doctored(&world, |_, (t, _, v)| {
        v.iter_mut().for_each(|v| v[0] += 1e-3 * *t * *t);
    });
    violated("shi-wang-chu/center-invariance", &drifting);
    // Off for ever, after they were more so.
    let carried = doctored(&world, |k, (t, _, v)| {
        let off = if *t < 30.0 { 40.0 } else { 20.0 };
        v.iter_mut()
            .for_each(|v| v[0] += if k > 0 { off } else { 0.0 });
    });
    violated("shi-wang-chu/common-velocity", &carried);
    let graph = |rows: &str| {
        let set = format!("laws[0].alignment.graph={{\"matrix\":{rows}}}");
        let three = [
            "agents[0].count=3",
            "agents[0].mass=[0.2,0.5,0.9]",
            "time.end=1",
            &set,
        ];
        plane("shi-wang-chu/two-minima", &three)
    };
    // One that all others hear, and that hears nobody.
    let star = graph("[[0,0,0],[1,0,0],[1,0,0]]");
    unmet("shi-wang-chu/strong-connectivity", &points(&star));
    unmet("shi-wang-chu/center-invariance", &points(&star));
    // Balance is enough to keep the centre, Remark 3; not to agree.
    let apart = graph("[[0,1,0],[1,0,0],[0,0,0]]");
    holds("shi-wang-chu/center-invariance", &points(&apart));
    unmet("shi-wang-chu/common-velocity", &points(&apart));
}

#[test]
fn the_printed_rate_fails_where_masses_differ_and_the_corrected_one_never() {
    let set = &["time.end=20", "record.every=0.2"];
    let world = plane("shi-wang-chu/two-minima", set);
    let run = points(&world);
    violated("shi-wang-chu/rate-printed", &run);
    holds("shi-wang-chu/rate-corrected", &run);

    // Two agents: all of their error is along the one eigenvector.
    let pair = |masses: &str| {
        let masses = format!("agents[0].mass={masses}");
        let two = [
            "agents[0].count=2",
            masses.as_str(),
            "laws[0].alignment.graph={\"complete\":{\"weight\":0.5}}",
            "time.end=10",
        ];
        plane("shi-wang-chu/two-minima", &two)
    };
    let (equal, unequal) = (pair("0.5"), pair("[0.1,0.9]"));
    let (equal, unequal) = (points(&equal), points(&unequal));
    holds("shi-wang-chu/rate-halved", &equal);
    violated("shi-wang-chu/rate-printed", &equal);
    violated("shi-wang-chu/rate-halved", &unequal);
    holds("shi-wang-chu/rate-corrected", &unequal);
    // Far from any force, two agents disagree along the eigenvector: the bound is sharp.
    let finding = holds("shi-wang-chu/rate-corrected", &equal);
    assert!(
        finding.margin.is_some_and(|margin| margin < 1e-6),
        "{finding:?}"
    );

    // Two that are told to disagree in one direction alone, on what is no graph of two.
    let one_way = plane(
        "shi-wang-chu/two-minima",
        &[
            "agents[0].count=2",
            "agents[0].mass=0.5",
            "laws[0].alignment.graph={\"matrix\":[[0,1],[0,0]]}",
            "time.end=1",
        ],
    );
    unmet("shi-wang-chu/rate-corrected", &points(&one_way));
    unmet("shi-wang-chu/rate-halved", &points(&one_way));
    // Equal masses with one agent alone fulfil everything, and there is nothing to fulfil.
    let same = plane(
        "shi-wang-chu/two-minima",
        &["agents[0].mass=0.5", "time.end=2"],
    );
    let still = doctored(&same, |_, (_, _, v)| {
        v.iter_mut().for_each(|v| *v = Vector::zeros());
    });
    holds("shi-wang-chu/rate-printed", &still);
}

#[test]
fn a_pair_at_its_minimum_is_not_moved_from_it_by_rounding() {
    let set = [
        "agents[0].count=2",
        "agents[0].mass=[1e-3,1e3]",
        "agents[0].positions={\"explicit\":[[0,0],[2.23606797749979,0]]}",
        "agents[0].velocities={\"common\":[30,40]}",
        "laws[0].alignment.graph={\"complete\":{\"weight\":0.3}}",
        "time.end=20",
    ];
    let world = plane("shi-wang-chu/two-minima", &set);
    holds("shi-wang-chu/critical-point-corrected", &points(&world));
}

#[test]
fn two_seeds_end_in_two_minima_and_only_one_of_them_is_the_lowest() {
    let set = &["record.every=1"];
    let world = plane("shi-wang-chu/two-minima", set);
    let run = points(&world);
    holds("shi-wang-chu/critical-point-corrected", &run);
    let worse = violated("shi-wang-chu/global-minimum-printed", &run);
    let other = plane("shi-wang-chu/two-minima", &["record.every=1", "seed=2"]);
    let better = finding("shi-wang-chu/global-minimum-printed", &points(&other));
    assert_eq!(better.verdict, Verdict::Undecided, "{}", better.reason);
    let end = |finding: &volary::claim::Finding| {
        let found = finding.quantities.iter().find(|it| it.name == "V_end");
        found.and_then(|it| it.value).expect("there is an end")
    };
    assert!((end(&worse) - 64.38096).abs() < 1e-4, "{}", end(&worse));
    assert!((end(&better) - 64.35602).abs() < 1e-4, "{}", end(&better));

    // Started from the worse one, nothing leads away from it: the lower one is found all the same.
    let places: Vec<&[f64]> = (run.last().positions.iter())
        .map(|place| place.as_slice())
        .collect();
    let set = [
        format!("agents[0].positions={{\"explicit\":{places:?}}}"),
        // From rest forces would begin too near 0 to be seen to tend there.
        "agents[0].velocities={\"ball\":{\"radius\":0.3}}".to_owned(),
        "record.every=1".to_owned(),
    ];
    let set: Vec<&str> = set.iter().map(String::as_str).collect();
    let there = plane("shi-wang-chu/two-minima", &set);
    violated("shi-wang-chu/global-minimum-printed", &points(&there));

    // Three agents can all have the distance that they like best.
    let three = [
        "agents[0].count=3",
        "agents[0].mass=[0.2,0.5,0.9]",
        "laws[0].alignment.graph={\"complete\":{\"weight\":0.3}}",
        "time.end=150",
        "record.every=1",
    ];
    let three = plane("shi-wang-chu/two-minima", &three);
    holds("shi-wang-chu/global-minimum-printed", &points(&three));
}

#[test]
fn claims_hold_in_space_and_on_bodies() {
    let set = [
        "dimension=3",
        "agents[0].positions={\"ball\":{\"center\":[0,0,0],\"radius\":6,\"separation\":1}}",
        "agents[0].radius=0.02",
        "time.end=80",
        "record.every=1",
    ];
    let AnyWorld::Space(space) = crate::runs::shipped("shi-wang-chu/two-minima", &set) else {
        panic!("the world is in space");
    };
    let run = points(&space);
    all_of_theorem_1(&run);

    let world = plane("shi-wang-chu/two-minima", &["record.every=1"]);
    all_of_theorem_1(&bodies(&world));
}

fn all_of_theorem_1<const D: usize>(run: &Run<'_, D>) {
    for name in [
        "energy-falls",
        "velocity-agreement",
        "common-velocity",
        "center-invariance",
        "no-collision-sharpened",
        "bounded-distances",
        "rate-corrected",
    ] {
        holds(&format!("shi-wang-chu/{name}"), run);
    }
}

#[test]
fn two_unequal_agents_refute_the_rate() {
    let world = plane("shi-wang-chu/unequal-pair", &[]);
    for run in [points(&world), bodies(&world)] {
        violated("shi-wang-chu/rate-halved", &run);
        holds("shi-wang-chu/rate-corrected", &run);
        holds("shi-wang-chu/energy-falls", &run);
        holds("shi-wang-chu/global-minimum-printed", &run);
    }
}
