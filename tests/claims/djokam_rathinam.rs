//! The claims of Djokam & Rathinam.

use crate::runs::{
    Seen, bodies, doctored, holds, plane, point_states, points, seen, shipped, unmet, violated,
};
use volary::claim::{Run, claims};
use volary::dynamics::Engine;
use volary::math::Vector;
use volary::metric::Observation;
use volary::shape::In;
use volary::world::{AnyWorld, World};

#[test]
fn accelerations_keep_their_bound() {
    let world = plane("djokam-rathinam/fast-0.1", &["time.end=2"]);
    let run = points(&world);
    let finding = holds("djokam-rathinam/acceleration-bound", &run);
    // The law comes near its bound: at the start it stands at 0.97 of it.
    assert!(
        finding.margin.is_some_and(|margin| margin < 0.2),
        "{finding:?}"
    );

    let tighter = plane(
        "djokam-rathinam/fast-0.1",
        &["laws[0].alignment.gain.bounded.bound=5"],
    );
    let run = Run {
        world: &tighter,
        ..run
    };
    violated("djokam-rathinam/acceleration-bound", &run);

    let unbounded = plane(
        "djokam-rathinam/fast-0.1",
        &["time.end=1", "laws[0].alignment.gain=10"],
    );
    unmet("djokam-rathinam/acceleration-bound", &points(&unbounded));
}

/// A shipped world in space, with some fields set otherwise.
fn space(name: &str, set: &[&str]) -> World<3> {
    match shipped(name, set) {
        AnyWorld::Space(world) => world,
        AnyWorld::Plane(_) => panic!("{name} is flat"),
    }
}

/// Friction whose speeds do not fall, a run of its world.
fn restless<const D: usize>(world: &World<D>) -> Run<'_, D>
where
    In<D>: Engine<D>,
{
    doctored(world, |_, state| {
        state.2.clone_from(&world.agents.velocities)
    })
}

#[test]
fn friction_brings_agents_to_rest() {
    let world = plane("djokam-rathinam/friction", &["record.every=1"]);
    let run = points(&world);
    holds("djokam-rathinam/friction-rest", &run);
    holds("djokam-rathinam/friction-power", &run);
    let decay = holds("djokam-rathinam/friction-decay-printed", &run);
    holds("djokam-rathinam/friction-decay-corrected", &run);
    // The bound is exact at the start, and the fastest agent is slowed by the others as well.
    assert_eq!(decay.closest, Some(0.0));
    let doctored = restless(&world);
    violated("djokam-rathinam/friction-rest", &doctored);
    violated("djokam-rathinam/friction-decay-printed", &doctored);
    violated("djokam-rathinam/friction-decay-corrected", &doctored);
    let at_once = |k: usize, state: &mut Seen<2>| {
        if k == 50 {
            state.2[0] *= 1.5;
        }
    };
    let broken = self::doctored(&world, at_once);
    violated("djokam-rathinam/friction-power", &broken);

    let frictionless = [
        "time.end=1",
        "laws[1].friction.coefficient=[0.1,0.1,0,0.1,0.1,0.1,0.1]",
    ];
    let frictionless = plane("djokam-rathinam/friction", &frictionless);
    unmet("djokam-rathinam/friction-rest", &points(&frictionless));
}

#[test]
fn linear_friction_has_a_bound_of_its_own() {
    let world = space("djokam-rathinam/friction-linear", &["record.every=0.5"]);
    let run = points(&world);
    holds("djokam-rathinam/friction-rest", &run);
    holds("djokam-rathinam/friction-power", &run);
    holds("djokam-rathinam/friction-decay-corrected", &run);
    unmet("djokam-rathinam/friction-decay-printed", &run);
    let broken = restless(&world);
    violated("djokam-rathinam/friction-decay-corrected", &broken);
}

#[test]
fn alignment_keeps_no_mill_ring() {
    let world = plane("djokam-rathinam/mill-ring-unsteered", &["time.end=3"]);
    let run = points(&world);
    let left = holds("djokam-rathinam/mill-ring", &run);
    // All come to rest, so they leave it by as much as they were fast, or more.
    assert!(left.margin.is_some_and(|margin| margin > 0.9), "{left:?}");
    holds("djokam-rathinam/mill-ring-sharpened", &run);

    let steered = plane("djokam-rathinam/mill-ring", &["time.end=3"]);
    unmet("djokam-rathinam/mill-ring", &points(&steered));
    let on_the_ring = seen(&world, point_states(&steered));
    violated("djokam-rathinam/mill-ring", &on_the_ring);
    let faster = |k: usize, state: &mut Seen<2>| {
        if k == 5 {
            state.2[3] *= 100.0;
        }
    };
    let doctored = self::doctored(&world, faster);
    violated("djokam-rathinam/mill-ring-sharpened", &doctored);
    let resting = ["time.end=1", "agents[0].velocities={\"common\":[0,0]}"];
    let resting = plane("djokam-rathinam/mill-ring-unsteered", &resting);
    unmet("djokam-rathinam/mill-ring", &points(&resting));
}

#[test]
fn an_agent_that_influences_nobody_keeps_no_mill_ring_either() {
    // Each follows the next one on the ring: most a_ik are 0.
    let ring = [
        "time.end=3",
        "laws[0].alignment.graph={\"ring\":{\"weight\":1}}",
        "laws[0].alignment.self_influence=false",
    ];
    let world = plane("djokam-rathinam/mill-ring-unsteered", &ring);
    let run = points(&world);
    holds("djokam-rathinam/mill-ring", &run);
    holds("djokam-rathinam/mill-ring-sharpened", &run);
}

#[test]
fn rings_in_space_are_found() {
    let only = [
        "time.end=1",
        "physics.gravity=[0,0,0]",
        "laws[1].flatness.velocity_gain=0",
    ];
    let world = space("djokam-rathinam/mill-ring-3d", &only);
    let mut free = world.clone();
    free.spec.laws.truncate(1);
    holds("djokam-rathinam/mill-ring", &points(&free));
    let broken = seen(&free, point_states(&world));
    violated("djokam-rathinam/mill-ring", &broken);
}

/// A run in which an agent's velocity jumps.
fn jerked<const D: usize>(world: &World<D>, share: f64) -> Run<'_, D>
where
    In<D>: Engine<D>,
{
    doctored(world, |k, state| {
        if k == 3 {
            let far = state.2[0] - state.2[1];
            state.2[0] += far / far.norm() * share;
        }
    })
}

#[test]
fn diameters_keep_their_bounds() {
    let world = plane("djokam-rathinam/fast-0.1", &["time.end=1"]);
    let run = points(&world);
    holds("djokam-rathinam/position-diameter", &run);
    let theorem = holds("djokam-rathinam/velocity-diameter", &run);
    let sharper = holds("djokam-rathinam/velocity-diameter-sharpened", &run);
    let weaker = holds("djokam-rathinam/active-set-printed", &run);
    let corollary = holds("djokam-rathinam/active-set-corrected", &run);
    // Each bound is stronger than the next.
    let at_start = |finding: &volary::claim::Finding| finding.curves[0].bounds[0].expect("finite");
    let order = [&sharper, &theorem, &corollary, &weaker].map(at_start);
    assert!(order.is_sorted(), "{order:?}");

    let jerked = jerked(&world, 5.0);
    violated("djokam-rathinam/velocity-diameter", &jerked);
    violated("djokam-rathinam/velocity-diameter-sharpened", &jerked);
    violated("djokam-rathinam/active-set-printed", &jerked);
    violated("djokam-rathinam/active-set-corrected", &jerked);
    let moved = doctored(&world, |k, state| {
        if k == 3 {
            state.1[5] -= Vector::<2>::new(0.0, 5.0);
        }
    });
    violated("djokam-rathinam/position-diameter", &moved);
    let late = plane(
        "djokam-rathinam/fast-0.1",
        &["time.end=1", "agents[0].sensing={\"radius\":100}"],
    );
    unmet("djokam-rathinam/velocity-diameter", &points(&late));
}

#[test]
fn flocks_with_whims_that_pass() {
    let world = space("djokam-rathinam/flock-steered", &["record.every=0.2"]);
    let run = points(&world);
    holds("djokam-rathinam/flocking-printed", &run);
    holds("djokam-rathinam/flocking-corrected", &run);
    holds("djokam-rathinam/flocking-sharpened", &run);
    holds("djokam-rathinam/flocking-rate-corrected", &run);
    holds("djokam-rathinam/flocking-rate-sharpened", &run);
    holds("djokam-rathinam/gain-infimum", &run);
    holds("djokam-rathinam/velocity-diameter-sharpened", &run);
    holds("djokam-rathinam/position-diameter", &run);
    holds("djokam-rathinam/existence-corrected", &run);

    let strayed = doctored(&world, |_, state| state.2[0][0] += 0.5);
    violated("djokam-rathinam/flocking-corrected", &strayed);
    violated("djokam-rathinam/flocking-sharpened", &strayed);
    let jerked = jerked(&world, 20.0);
    violated("djokam-rathinam/flocking-rate-corrected", &jerked);
    violated("djokam-rathinam/flocking-rate-sharpened", &jerked);
    violated("djokam-rathinam/gain-infimum", &jerked);

    // Where the kernel falls fast, ψ is so small that even N²ψ is a rate.
    let short = [
        "time.end=2",
        "laws[0].alignment.kernel.cucker_smale.exponent=3",
    ];
    let short = space("djokam-rathinam/flock-steered", &short);
    holds("djokam-rathinam/flocking-rate-printed", &points(&short));
}

#[test]
fn by_the_printed_condition_a_pair_would_flock() {
    let world = plane("djokam-rathinam/parting-pair", &["record.every=0.2"]);
    let run = points(&world);
    let printed = violated("djokam-rathinam/flocking-printed", &run);
    let found = |name: &str| {
        let quantity = printed.quantities.iter().find(|it| it.name == name);
        quantity.and_then(|it| it.value).expect("it is measured")
    };
    let psi = (std::f64::consts::FRAC_PI_2 - 0.5f64.sqrt().atan()) / 2f64.sqrt();
    assert!((found("N² ∫ ψ") - 4.0 * psi).abs() < 1e-9);
    unmet("djokam-rathinam/flocking-corrected", &run);
    unmet("djokam-rathinam/flocking-sharpened", &run);
    violated("djokam-rathinam/flocking-rate-printed", &run);
    // Of two agents the sharp rate is the true one.
    let rate = holds("djokam-rathinam/flocking-rate-sharpened", &run);
    assert!(rate.margin.is_some_and(|margin| margin < 1e-9), "{rate:?}");
    // d_V + α N ∫ ψ hardly changes: 2.0265 less 2 ∫ ψ from 1 on is left.
    let last = run.last().velocities[1] - run.last().velocities[0];
    assert!((0.67..0.75).contains(&last.norm()), "{last}");
}

#[test]
fn lemma_8_holds_as_corrected() {
    let world = plane("djokam-rathinam/fast-0.1", &["time.end=1"]);
    let run = points(&world);
    violated("djokam-rathinam/existence-printed", &run);
    holds("djokam-rathinam/existence-corrected", &run);
    let broken = jerked(&world, 200.0);
    violated("djokam-rathinam/existence-corrected", &broken);
    let resting = ["time.end=1", "agents[0].velocities={\"common\":[0,0]}"];
    let resting = plane("djokam-rathinam/fast-0.1", &resting);
    holds("djokam-rathinam/existence-printed", &points(&resting));
}

/// Claims that ask for the same world with smaller ε.
const FAST: [&str; 4] = [
    "djokam-rathinam/leading-order-printed",
    "djokam-rathinam/leading-order-corrected",
    "djokam-rathinam/layer-limit-printed",
    "djokam-rathinam/layer-limit-corrected",
];

/// A run as points, with those of the family that it is of.
fn family(world: &World<2>) -> Run<'_, 2> {
    let mut run = points(world);
    for name in FAST {
        let claims = claims::<2>();
        let claim = claims.iter().find(|it| it.about().name == name);
        let asked = claim.expect("it exists").companions(world);
        let known = run.companions.values().next().cloned();
        let made = || {
            let with = |world: World<2>| {
                let seen = points(&world).observations;
                (world, seen)
            };
            asked.into_iter().map(with).collect()
        };
        let made = known.unwrap_or_else(made);
        run.companions.insert(name, made);
    }
    run
}

#[test]
fn the_leading_order_is_off_by_epsilon_from_where_the_layer_ends() {
    let short = ["time.end=3", "record.every=0.05"];
    let world = plane("djokam-rathinam/fast-0.1", &short);
    let mut run = family(&world);
    holds("djokam-rathinam/leading-order-corrected", &run);
    violated("djokam-rathinam/leading-order-printed", &run);
    let limit = holds("djokam-rathinam/layer-limit-corrected", &run);
    for (axis, expected) in [("x", 1.870466), ("y", 1.423655)] {
        let name = format!("v^f(0) of the run, {axis}");
        let found = limit.quantities.iter().find(|it| it.name == name);
        let found = found.and_then(|it| it.value).expect("it is measured");
        assert!((found - expected).abs() < 0.01, "{found} {expected}");
    }
    violated("djokam-rathinam/layer-limit-printed", &run);
    violated("djokam-rathinam/layer-invariant-printed", &run);
    unmet("djokam-rathinam/layer-invariant-corrected", &run);

    // Velocities that are off whatever ε is.
    let off = |seen: &mut Vec<Observation<2>>| {
        let later = seen.iter_mut().skip(1).flat_map(|it| &mut it.velocities);
        later.for_each(|v| v[0] += 0.2);
    };
    off(&mut run.observations);
    let others = run.companions.values_mut().flatten();
    others.for_each(|(_, seen)| off(seen));
    violated("djokam-rathinam/leading-order-corrected", &run);
    violated("djokam-rathinam/layer-limit-corrected", &run);
}

#[test]
fn a_gain_that_does_not_fall_starts_as_printed() {
    let set = [
        "time.end=3",
        "record.every=0.05",
        "laws[0].alignment.gain=10",
    ];
    let world = plane("djokam-rathinam/fast-0.1", &set);
    let run = family(&world);
    holds("djokam-rathinam/leading-order-printed", &run);
    holds("djokam-rathinam/layer-limit-printed", &run);
    holds("djokam-rathinam/layer-invariant-printed", &run);
    holds("djokam-rathinam/layer-invariant-corrected", &run);
}

#[test]
fn velocities_lie_between_those_that_differ_most() {
    let world = plane("djokam-rathinam/fast-0.1", &["time.end=2"]);
    let run = points(&world);
    let same = doctored(&world, |_, (_, _, v)| {
        let first = v[0];
        v.fill(first);
    });
    holds("djokam-rathinam/common-influence", &run);
    holds("djokam-rathinam/common-influence", &bodies(&world));
    unmet("djokam-rathinam/common-influence", &same);
    holds("djokam-rathinam/velocity-hull", &run);
    holds("djokam-rathinam/velocity-hull", &bodies(&world));
    unmet("djokam-rathinam/velocity-hull", &same);
    // Influences of what is seen late are not those of the model.
    let late = plane(
        "djokam-rathinam/fast-0.1",
        &[
            "time.end=0.5",
            "agents[0].sensing={\"delay\":0.1}",
            "laws[0].alignment.relaxation=\"never\"",
            "laws[0].alignment.epsilon=1",
            "laws[0].alignment.gain=1",
        ],
    );
    unmet("djokam-rathinam/common-influence", &bodies(&late));
}

#[test]
fn down_to_epsilon_of_a_ten_thousandth() {
    let world = plane(
        "djokam-rathinam/fast-0.001",
        &["time.end=2", "record.every=0.05"],
    );
    let run = family(&world);
    holds("djokam-rathinam/leading-order-corrected", &run);
    violated("djokam-rathinam/leading-order-printed", &run);
    holds("djokam-rathinam/layer-limit-corrected", &run);
}

#[test]
fn bodies_keep_what_points_do() {
    let world = plane("djokam-rathinam/fast-0.1", &["time.end=2"]);
    let run = bodies(&world);
    holds("djokam-rathinam/acceleration-bound", &run);
    holds("djokam-rathinam/position-diameter", &run);
    holds("djokam-rathinam/velocity-diameter", &run);
    holds("djokam-rathinam/active-set-corrected", &run);
    holds("djokam-rathinam/flocking-rate-sharpened", &run);
    holds("djokam-rathinam/existence-corrected", &run);
    let world = plane("djokam-rathinam/friction", &["record.every=1"]);
    let run = bodies(&world);
    holds("djokam-rathinam/friction-rest", &run);
    holds("djokam-rathinam/friction-decay-printed", &run);
    let world = plane("djokam-rathinam/mill-ring-unsteered", &["time.end=3"]);
    let run = bodies(&world);
    holds("djokam-rathinam/mill-ring", &run);
    holds("djokam-rathinam/mill-ring-sharpened", &run);
    let world = plane("djokam-rathinam/parting-pair", &["record.every=0.2"]);
    violated("djokam-rathinam/flocking-printed", &bodies(&world));
}
