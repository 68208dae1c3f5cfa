//! What turns bodies, and what does not.

use std::f64::consts::PI;

use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::{Vector, direction};
use volary::shape::In;
use volary::simulation::Simulation;
use volary::world::spec::Rotation;

use super::common::order;
use super::{flat_capsule, off_center, rod, simulation, step};

#[test]
fn a_blow_off_the_middle_turns_a_rod_and_keeps_the_angular_momentum() {
    let mut run = simulation::<2>(off_center(2));
    let (inertia, area) = flat_capsule(1.0, 0.2);
    let moment = inertia / area * 2.0;
    let momentum = |run: &Simulation<2>| {
        let state = run.snapshot();
        let orbit = |i: usize, mass: f64| {
            let (x, v) = (state.positions[i], state.velocities[i]);
            mass * (x.x * v.y - x.y * v.x)
        };
        orbit(0, 2.0) + orbit(1, 1.5) + moment * state.spins.expect("a rod")[0].z
    };
    let before = momentum(&run);
    while run.ledger().agent_contacts().episodes == 0 {
        assert!(run.snapshot().time < 3.0, "they never touch");
        step(&mut run);
    }
    for _ in 0..20 {
        step(&mut run);
    }
    assert!((momentum(&run) - before).abs() < 0.01 * before.abs());
    let angle =
        |run: &Simulation<2>| match Rotation::of(&run.snapshot().rotations.expect("a rod")[0]) {
            Rotation::Angle(angle) => angle,
            Rotation::Vector(_) => panic!("an angle in the plane"),
        };
    let (spin, begin) = (run.snapshot().spins.expect("a rod")[0].z, angle(&run));
    assert!(spin.abs() > 0.3, "{spin}");
    // Free from now on: the spin stays, and the angle grows by ωh in each step.
    for k in 1..100 {
        step(&mut run);
        assert!((run.snapshot().spins.expect("a rod")[0].z - spin).abs() < 1e-14);
        let expected = begin + f64::from(k) * spin * 0.01;
        let apart = (angle(&run) - expected).rem_euclid(2.0 * PI);
        assert!(apart.min(2.0 * PI - apart) < 1e-12, "step {k}: {apart}");
        let heading = run.snapshot().headings[0];
        let along = Vector::<2>::new(angle(&run).cos(), angle(&run).sin());
        assert!((heading - along).norm() < 1e-12);
    }
}

#[test]
fn fixed_bodies_are_not_turned_by_blows() {
    for dimension in [2, 3] {
        let mut json = off_center(dimension);
        json["agents"][0]["heading"] = json!("fixed");
        json["agents"][0]["rotation"] = match dimension {
            2 => json!(0.3),
            _ => json!([0, 0, 0.3]),
        };
        let turned = match dimension {
            2 => rotations::<2>(json),
            _ => rotations::<3>(json),
        };
        for (before, after) in turned.0.iter().zip(&turned.1) {
            // The engine keeps rotations normal by rounding.
            assert!((before - after).abs() < 1e-14, "{turned:?}");
        }
    }
}

/// All entries of the rotations before and after a run in which something touches.
fn rotations<const D: usize>(json: Value) -> (Vec<f64>, Vec<f64>)
where
    In<D>: Engine<D>,
{
    let mut run = simulation::<D>(json);
    let all = |run: &Simulation<D>| -> Vec<f64> {
        let rotations = run.snapshot().rotations.expect("some are not round");
        rotations
            .iter()
            .flat_map(|it| it.as_slice().to_vec())
            .collect()
    };
    let before = all(&run);
    for _ in 0..run.world().steps() {
        step(&mut run);
    }
    assert!(run.ledger().agent_contacts().episodes > 0);
    (before, all(&run))
}

/// A rod that flies up while it heads to the right, at the end of a time.
fn swing(h: f64, time: f64, gain: f64, damping: f64) -> f64 {
    let mut run = simulation::<2>(json!({
        "dimension": 2, "time": { "step": h, "end": time }, "record": { "every": time },
        "agents": [rod(json!({
            "heading": { "torque": { "gain": gain, "damping": damping } },
            "rotation": 0, "velocities": { "common": [0, 1] }, "mass": 2
        }))]
    }));
    for _ in 0..run.world().steps() {
        step(&mut run);
    }
    let heading = run.snapshot().headings[0];
    heading.y.atan2(heading.x)
}

#[test]
fn a_steering_torque_swings_the_heading_in_as_its_equation_says() {
    let (gain, damping, time) = (9.0, 1.5, 1.6);
    // θ'' = g 2 sin((π/2 − θ)/2) − d θ', by the classical Runge–Kutta method.
    let slope = |[angle, spin]: [f64; 2]| {
        [
            spin,
            gain * 2.0 * ((PI / 2.0 - angle) / 2.0).sin() - damping * spin,
        ]
    };
    let moved = |x: [f64; 2], k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
    let (mut x, h) = ([0.0, 0.0], time / 4000.0);
    for _ in 0..4000 {
        let k1 = slope(x);
        let k2 = slope(moved(x, k1, h / 2.0));
        let k3 = slope(moved(x, k2, h / 2.0));
        let k4 = slope(moved(x, k3, h));
        for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            x = moved(x, k, h * weight / 6.0);
        }
    }
    assert!(x[0] > PI / 2.0, "underdamped, it overshoots");
    let steps = [0.02, 0.01, 0.005, 0.0025];
    let errors: Vec<f64> = steps
        .map(|h| (swing(h, time, gain, damping) - x[0]).abs())
        .to_vec();
    assert!(errors[1] < 0.03, "{errors:?}");
    let order = order(&steps, &errors);
    assert!(
        (0.85..1.3).contains(&order),
        "{errors:?} fall with order {order}"
    );
    // Damped critically, it settles.
    assert!((swing(0.01, 6.0, gain, 6.0) - PI / 2.0).abs() < 1e-4);
}

#[test]
fn a_steering_torque_keeps_its_limit_in_every_step() {
    let limit = 0.5;
    let mut run = simulation::<2>(json!({
        "dimension": 2, "time": { "end": 12 },
        "agents": [rod(json!({
            "heading": { "torque": { "gain": 30, "limit": limit } },
            "rotation": 3, "velocities": { "common": [1, 0] }, "mass": 2
        }))]
    }));
    let (inertia, area) = flat_capsule(1.0, 0.2);
    let moment = inertia / area * 2.0;
    let (mut spin, mut largest) = (0.0, 0.0_f64);
    for _ in 0..1200 {
        step(&mut run);
        let now = run.snapshot().spins.expect("a rod")[0].z;
        largest = largest.max((now - spin).abs() * moment / 0.01);
        spin = now;
    }
    assert!(largest <= limit * (1.0 + 1e-9), "{largest}");
    assert!(
        largest > 0.999 * limit,
        "{largest}: the limit was never needed"
    );
    let heading = run.snapshot().headings[0];
    assert!(heading.x > 0.9, "{heading}: it never turned round");
}

#[test]
fn headings_that_follow_the_velocity_do_so_at_their_rate() {
    for turn_rate in [None, Some(1.5)] {
        let mut run = simulation::<3>(json!({
            "dimension": 3, "time": { "end": 3 },
            "agents": [rod(json!({
                "heading": { "velocity": { "turn_rate": turn_rate } },
                "positions": { "explicit": [[0, 0, 0]] }, "velocities": { "common": [1, 0, 0] }
            }))],
            "laws": [{ "navigation": {
                "velocity": [-1, 1, 0.5], "feedback": "linear", "velocity_gain": 3
            } }]
        }));
        let mut lag = 0.0_f64;
        for _ in 0..300 {
            step(&mut run);
            let state = run.snapshot();
            let fastest = turn_rate.unwrap_or(f64::INFINITY);
            assert!(state.spins.expect("a rod")[0].norm() <= fastest * (1.0 + 1e-12));
            lag = lag.max((state.headings[0] - direction(&state.velocities[0])).norm());
        }
        match turn_rate {
            None => assert!(lag < 1e-3, "{lag}"),
            Some(_) => assert!(lag > 0.1, "{lag}: it could follow"),
        }
        let state = run.snapshot();
        assert!((state.headings[0] - direction(&state.velocities[0])).norm() < 1e-3);
    }
}
