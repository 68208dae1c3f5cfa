//! The claims of Song et al. (2013), and of what they quote.

mod distances;
mod quoted;

use serde_json::json;
use volary::claim::{Exclusion, Finding, Run, claims};
use volary::math::Vector;
use volary::world::World;

use crate::common::{from_json, spec, world};
use crate::runs::{Seen, bodies, doctored, holds, plane, points, unmet, violated};

/// Each claim of Theorem 10, as Theorem 16 has it too.
const OF_BOTH: [&str; 10] = [
    "song-2013/theorem-10-mean-velocity",
    "song-2013/theorem-10-energy-never-rises",
    "song-2013/theorem-10-energy-rate",
    "song-2013/theorem-10-cohesion",
    "song-2013/theorem-10-velocity-consensus",
    "song-2013/theorem-10-collision-avoidance",
    "song-2013/theorem-10-distance-sharpened",
    "song-2013/theorem-10-distance-sharpest",
    "song-2013/remark-13-repulsion",
    "song-2013/remark-13-repulsion-sharpened",
];

fn quantity(finding: &Finding, name: &str) -> f64 {
    let found = finding.quantities.iter().find(|it| it.name == name);
    found.and_then(|it| it.value).expect("it is measured")
}

fn exclusion<const D: usize>(name: &str, run: &Run<'_, D>) -> Option<Exclusion> {
    let claims = claims::<D>();
    let claim = claims.iter().find(|claim| claim.about().name == name);
    claim.expect("there is such a claim").exclusion(run)
}

/// Example 18 for a while.
fn bonded(set: &[&str]) -> World<2> {
    let mut all = vec!["time.end=4", "record.every=0.05"];
    all.extend(set);
    plane("song-2013/example-18", &all)
}

/// Example 19 for a while.
fn attracted(set: &[&str]) -> World<2> {
    let mut all = vec!["time.end=30", "record.every=0.25"];
    all.extend(set);
    plane("song-2013/example-19", &all)
}

/// Masses of their own, which accelerations do not feel, in space.
fn in_space(laws: serde_json::Value, end: f64) -> World<3> {
    world(spec(json!({
        "dimension": 3,
        "time": { "step": 0.01, "end": end },
        "record": { "every": 0.1 },
        "seed": 4,
        "agents": [{
            "count": 4, "radius": 0.02, "mass": [1, 2, 0.5, 3],
            "positions": { "box": { "min": [-1.5, -1.5, -1.5], "max": [1.5, 1.5, 1.5], "separation": 1 } },
            "velocities": { "ball": { "center": [1, 0, 0.5], "radius": 0.7 } }
        }],
        "laws": laws
    })))
}

fn bonded_in_space(end: f64) -> World<3> {
    in_space(
        json!([
            { "alignment": { "kernel": { "cucker_smale": { "exponent": 0.7 } } } },
            { "pair_potential": { "potential": { "bond": { "stiffness": 0.5, "length": 1 } } } },
            { "pair_potential": { "potential": { "gaussian": { "height": 6, "decay": 2 } } } }
        ]),
        end,
    )
}

fn attracted_in_space(end: f64) -> World<3> {
    in_space(
        json!([
            { "alignment": { "kernel": { "cucker_smale": { "exponent": 0.7 } } } },
            { "pair_potential": {
                "potential": { "attraction": { "stiffness": 0.8 } }, "share": "mean"
            } },
            { "pair_potential": { "potential": { "gaussian": { "height": 6, "decay": 2 } } } }
        ]),
        end,
    )
}

/// From some time on, the states of the run as something else.
fn from(time: f64, mut doctor: impl FnMut(&mut Seen<2>)) -> impl FnMut(usize, &mut Seen<2>) {
    move |_, state| {
        if state.0 >= time {
            doctor(state);
        }
    }
}

#[test]
fn example_18_is_as_theorem_10_says() {
    let world = bonded(&[]);
    let run = points(&world);
    holds("song-2013/theorem-10-mean-velocity", &run);
    let finding = holds("song-2013/theorem-10-energy-never-rises", &run);
    assert!((quantity(&finding, "W(0)") - 131.5835).abs() < 1e-4);
    holds("song-2013/theorem-10-energy-rate", &run);
    let cohesion = holds("song-2013/theorem-10-cohesion", &run);
    assert!(cohesion.margin.is_some_and(|it| it > 0.5 && it < 1.0));
    holds("song-2013/theorem-10-collision-avoidance", &run);
    let kept = holds("song-2013/theorem-10-distance-sharpened", &run);
    let distance = quantity(&kept, "distance that theory keeps");
    assert!((distance - 0.14376).abs() < 1e-5, "{distance}");
    let kept = holds("song-2013/theorem-10-distance-sharpest", &run);
    assert!(quantity(&kept, "distance that theory keeps") > distance);
    assert!(
        run.closest
            .is_some_and(|it| it.distance > 0.78 && it.distance < 1.2)
    );

    violated("song-2013/remark-13-bonding-force-printed", &run);
    holds("song-2013/remark-13-bonding-force-corrected", &run);
    holds("song-2013/remark-13-bonding-force-sharpened", &run);
    let printed = holds("song-2013/remark-13-repulsion", &run).margin;
    let sharpened = holds("song-2013/remark-13-repulsion-sharpened", &run).margin;
    assert!(sharpened < printed);
    holds("song-2013/lemma-9", &run);
}

#[test]
fn example_19_is_as_theorem_16_says() {
    let world = attracted(&[]);
    let run = points(&world);
    holds("song-2013/theorem-16-mean-velocity", &run);
    let finding = holds("song-2013/theorem-16-energy-never-rises", &run);
    assert!((quantity(&finding, "W(0)") - 34.0842).abs() < 1e-4);
    holds("song-2013/theorem-16-energy-rate", &run);
    let printed = holds("song-2013/theorem-16-cohesion", &run).margin;
    let sharpened = holds("song-2013/theorem-16-cohesion-sharpened", &run).margin;
    assert!(sharpened < Some(0.9) && printed < Some(0.9));
    holds("song-2013/theorem-16-collision-avoidance", &run);
    let kept = holds("song-2013/theorem-16-distance-sharpened", &run);
    let distance = quantity(&kept, "distance that theory keeps");
    assert!((distance - 0.29818).abs() < 1e-5, "{distance}");
    let kept = holds("song-2013/theorem-16-distance-sharpest", &run);
    assert!(quantity(&kept, "distance that theory keeps") > distance);
    holds("song-2013/remark-17-attraction-corrected", &run);
    holds("song-2013/remark-17-repulsion", &run);
    holds("song-2013/remark-17-repulsion-sharpened", &run);

    // The flock has moved on.
    let away = doctored(
        &world,
        from(10.0, |(_, x, _)| {
            x.iter_mut().for_each(|x| *x += Vector::<2>::new(90.0, 0.0));
        }),
    );
    violated("song-2013/remark-17-attraction-printed", &away);
    holds("song-2013/remark-17-attraction-corrected", &away);
    let resting = attracted(&["time.end=1"]);
    holds("song-2013/remark-17-attraction-printed", &points(&resting));
}

#[test]
fn flocks_in_space_agree_and_masses_do_not_matter() {
    let world = bonded_in_space(40.0);
    let run = points(&world);
    for name in OF_BOTH {
        holds(name, &run);
    }
    holds("song-2013/theorem-10-velocity-consensus", &run);
    let world = attracted_in_space(40.0);
    let run = points(&world);
    for name in OF_BOTH {
        holds(&of_theorem_16(name), &run);
    }
    holds("song-2013/theorem-16-velocity-consensus", &run);
    holds("song-2013/lemma-9", &run);
}

fn of_theorem_16(name: &str) -> String {
    name.replace("theorem-10", "theorem-16")
        .replace("remark-13", "remark-17")
}

#[test]
fn bodies_keep_them_too() {
    let world = bonded_in_space(20.0);
    let run = bodies(&world);
    for name in OF_BOTH {
        holds(name, &run);
    }
    holds("song-2013/remark-13-bonding-force-sharpened", &run);
    let world = attracted_in_space(20.0);
    let run = bodies(&world);
    for name in OF_BOTH {
        holds(&of_theorem_16(name), &run);
    }
    holds("song-2013/theorem-16-cohesion-sharpened", &run);
    holds("song-2013/remark-17-attraction-corrected", &run);
}

#[test]
fn doctored_runs_of_theorem_10_are_found_out() {
    let world = bonded(&["time.end=1"]);
    let faster = doctored(
        &world,
        from(0.5, |(_, _, v)| v[0] += Vector::<2>::new(0.3, 0.0)),
    );
    violated("song-2013/theorem-10-mean-velocity", &faster);
    let faster = doctored(&world, from(0.5, |(_, _, v)| v[0] *= 5.0));
    let finding = violated("song-2013/theorem-10-energy-never-rises", &faster);
    assert!(finding.closest.is_some_and(|time| time >= 0.5));
    // A flock that stands still while its velocities differ has not lost what it must.
    let start = points(&world).start().clone();
    let frozen = doctored(&world, |_, (_, x, v)| {
        x.clone_from(&start.positions);
        v.clone_from(&start.velocities);
    });
    violated("song-2013/theorem-10-energy-rate", &frozen);
    violated("song-2013/theorem-10-velocity-consensus", &frozen);
    let far = doctored(&world, from(0.5, |(_, x, _)| x[0] *= 200.0));
    violated("song-2013/theorem-10-cohesion", &far);
    let met = doctored(&world, from(0.5, |(_, x, _)| x[0] = x[1]));
    let finding = violated("song-2013/theorem-10-collision-avoidance", &met);
    assert!(finding.closest.is_some_and(|time| time >= 0.5));
    let near = doctored(
        &world,
        from(0.5, |(_, x, _)| x[0] = x[1] + Vector::<2>::new(0.1435, 0.0)),
    );
    holds("song-2013/theorem-10-collision-avoidance", &near);
    violated("song-2013/theorem-10-distance-sharpened", &near);
    violated("song-2013/theorem-10-distance-sharpest", &near);

    let run = points(&world);
    let forced = with_forces_of(
        &run,
        &bonded(&[
            "laws[1].pair_potential.potential.bond.stiffness=100",
            "laws[2].pair_potential.potential.gaussian.height=1e9",
            "time.end=0.1",
        ]),
    );
    violated("song-2013/remark-13-bonding-force-corrected", &forced);
    violated("song-2013/remark-13-bonding-force-sharpened", &forced);
    violated("song-2013/remark-13-repulsion", &forced);
    violated("song-2013/remark-13-repulsion-sharpened", &forced);
    let mut off = points(&world);
    off.observations[3].laws.mean_position[0] += 1.0;
    violated("song-2013/lemma-9", &off);
}

/// A run as another world's stronger forces would have moved it, with its own energy.
fn with_forces_of<'w>(run: &Run<'w, 2>, stronger: &World<2>) -> Run<'w, 2> {
    let mut observations = points(stronger).observations;
    for seen in &mut observations {
        seen.laws.energy = run.start().laws.energy;
    }
    Run {
        observations,
        ..run.clone()
    }
}

#[test]
fn doctored_runs_of_theorem_16_are_found_out() {
    let world = attracted(&["time.end=5"]);
    let faster = doctored(
        &world,
        from(2.0, |(_, _, v)| v[0] += Vector::<2>::new(0.3, 0.0)),
    );
    violated("song-2013/theorem-16-mean-velocity", &faster);
    let faster = doctored(&world, from(2.0, |(_, _, v)| v[0] *= 5.0));
    violated("song-2013/theorem-16-energy-never-rises", &faster);
    let start = points(&world).start().clone();
    let frozen = doctored(&world, |_, (_, x, v)| {
        x.clone_from(&start.positions);
        v.clone_from(&start.velocities);
    });
    violated("song-2013/theorem-16-energy-rate", &frozen);
    violated("song-2013/theorem-16-velocity-consensus", &frozen);
    // 2√(2W(0)/k_a) = 165, 2√(W(0)/k_a) = 117.
    let wide = doctored(
        &world,
        from(2.0, |(_, x, _)| {
            x[0] += Vector::<2>::new(70.0, 0.0);
            x[1] -= Vector::<2>::new(70.0, 0.0);
        }),
    );
    holds("song-2013/theorem-16-cohesion", &wide);
    violated("song-2013/theorem-16-cohesion-sharpened", &wide);
    let far = doctored(&world, from(2.0, |(_, x, _)| x[0] *= 200.0));
    violated("song-2013/theorem-16-cohesion", &far);
    violated("song-2013/remark-17-attraction-corrected", &far);
    let met = doctored(&world, from(2.0, |(_, x, _)| x[0] = x[1]));
    violated("song-2013/theorem-16-collision-avoidance", &met);
    violated("song-2013/theorem-16-distance-sharpened", &met);
    violated("song-2013/theorem-16-distance-sharpest", &met);

    let run = points(&world);
    let forced = with_forces_of(
        &run,
        &attracted(&[
            "laws[2].pair_potential.potential.gaussian.height=1e10",
            "time.end=0.5",
        ]),
    );
    violated("song-2013/remark-17-repulsion", &forced);
    violated("song-2013/remark-17-repulsion-sharpened", &forced);
}

#[test]
fn other_models_are_none_of_the_theorems_business() {
    let name = "song-2013/theorem-10-collision-avoidance";
    for set in [
        "laws[2].pair_potential.range=5",
        "laws[0].alignment.normalisation=\"motsch_tadmor\"",
        "laws[0].alignment.range=3",
        "laws[0].alignment.kernel.cucker_smale.length=2",
        "laws[0].alignment.kernel.cucker_smale.strength=0",
        "laws[1].pair_potential.potential.bond.stiffness=0",
        "physics.gravity=[0,-1]",
        "agents[0].sensing.radius=5",
        "agents[0].force_limit=3",
        "obstacles=[{\"shape\":{\"ball\":{\"radius\":1}},\"position\":[90,0]}]",
        "laws[2].pair_potential.potential.gaussian.height=100",
    ] {
        let world = bonded(&["time.end=0.05", set]);
        let run = points(&world);
        unmet(name, &run);
        assert_eq!(exclusion(name, &run), None, "{set}");
    }
    let mut slowed = bonded(&["time.end=0.05"]);
    let friction = json!({ "friction": { "coefficient": 0.1 } });
    slowed.spec.laws.push(from_json(friction));
    unmet(name, &points(&slowed));
    // Forces that masses divide are accelerations where masses are 1.
    let force = "laws[1].pair_potential.acts_as=\"force\"";
    holds(name, &points(&bonded(&["time.end=0.05", force])));
    let heavy = bonded(&["time.end=0.05", force, "agents[0].mass=2"]);
    unmet(name, &points(&heavy));
    // (17) is not (8).
    let world = attracted(&["time.end=0.25"]);
    let claims = claims::<2>();
    let claim = claims.iter().find(|claim| claim.about().name == name);
    assert_eq!(claim.and_then(|it| it.judge(&points(&world))), None);
    let park = plane("song-2013/park", &["time.end=0.1"]);
    unmet(
        "song-2013/cucker-dong-distance-corrected",
        &points(&plane(
            "song-2013/cucker-dong",
            &[
                "time.end=0.1",
                "laws[0].alignment.kernel.cucker_smale.exponent=0.6",
            ],
        )),
    );
    assert_eq!(claim.and_then(|it| it.judge(&points(&park))), None);
}
