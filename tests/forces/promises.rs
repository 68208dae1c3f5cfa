//! What the laws promise of the motion of bodies.

use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::Vector;
use volary::shape::In;
use volary::simulation::Simulation;

use crate::common::{from_json, world};
use crate::plain_mean;

/// A run to the end, looked at after every step; at the end positions and velocities.
fn run<const D: usize>(
    file: Value,
    mut look: impl FnMut(&[Vector<D>], &[Vector<D>]),
) -> [Vec<Vector<D>>; 2]
where
    In<D>: Engine<D>,
{
    let mut simulation = Simulation::<D>::new(world(from_json(file))).expect("a finite start");
    for _ in 0..simulation.world().steps() {
        simulation.step().expect("a finite state");
        let state = simulation.snapshot();
        look(state.positions, state.velocities);
    }
    let state = simulation.snapshot();
    [state.positions.to_vec(), state.velocities.to_vec()]
}

#[test]
fn friction_stops_agents_as_its_closed_form_says() {
    // v(t) = v0 exp(−ct/m), and with r = 1 v0/(1 + c v0 t).
    for (law, expected) in [
        (
            json!({ "coefficient": 0.8, "acts_as": "force" }),
            3.0 * (-0.4f64 * 2.0).exp(),
        ),
        (
            json!({ "coefficient": 0.8, "exponent": 1 }),
            3.0 / (1.0 + 0.8 * 3.0 * 2.0),
        ),
    ] {
        let [_, v] = run::<2>(
            json!({
                "dimension": 2, "time": { "step": 0.01, "end": 2 },
                "agents": [{
                    "radius": 0.1, "mass": 2, "positions": { "explicit": [[0, 0]] },
                    "velocities": { "common": [0, 3] }
                }],
                "laws": [{ "friction": law }]
            }),
            |_, _| {},
        );
        assert!(
            (v[0][1] - expected).abs() < 1e-4,
            "{law}: {} {expected}",
            v[0][1]
        );
    }
}

#[test]
fn self_propulsion_ends_at_the_cruising_speed() {
    let [_, v] = run::<3>(
        json!({
            "dimension": 3, "time": { "step": 0.01, "end": 10 },
            "agents": [{
                "radius": 0.1, "positions": { "explicit": [[0, 0, 0], [9, 0, 0]] },
                "velocities": { "explicit": [[0.1, 0, 0], [0, 3, 4]] }
            }],
            "laws": [{ "self_propulsion": { "propulsion": 1, "drag": 0.25 } }]
        }),
        |_, _| {},
    );
    assert!(
        (v[0] - Vector::<3>::new(2.0, 0.0, 0.0)).norm() < 1e-6,
        "{}",
        v[0]
    );
    assert!(
        (v[1] - Vector::<3>::new(0.0, 1.2, 1.6)).norm() < 1e-6,
        "{}",
        v[1]
    );
}

#[test]
fn a_first_order_flow_comes_to_rest_where_its_potential_does() {
    // Two agents of Gazi & Passino's end √(c ln(b/a)) apart, about the mean that they keep.
    let [at, v] = run::<2>(
        json!({
            "dimension": 2, "time": { "step": 0.005, "end": 20 },
            "agents": [{ "radius": 0.1, "positions": { "explicit": [[0, 0], [3, 4]] } }],
            "laws": [{ "first_order_flow": { "rate": 50, "potential": { "gazi_passino": {
                "attraction": 1, "repulsion": 8, "squared_length": 2
            } } } }]
        }),
        |_, _| {},
    );
    let apart = (2.0 * 8.0f64.ln()).sqrt();
    assert!(((at[1] - at[0]).norm() - apart).abs() < 1e-6);
    assert!((plain_mean(&at) - Vector::<2>::new(1.5, 2.0)).norm() < 1e-9);
    assert!(v[0].norm() < 1e-6);
}

#[test]
fn cucker_dong_keeps_agents_apart() {
    // Nine agents fly at one another, and at a tenth in their midst; √d0 is 0.5.
    let mut positions = vec![[0.0, 0.0]];
    let mut velocities = vec![[0.0, 0.0]];
    for k in 0..9 {
        let (sin, cos) = (0.7 * f64::from(k)).sin_cos();
        positions.push([3.0 * cos, 3.0 * sin]);
        velocities.push([-cos, -sin]);
    }
    let run = |laws: Value| {
        let mut nearest = f64::INFINITY;
        run::<2>(
            json!({
                "dimension": 2, "time": { "step": 0.002, "end": 6 },
                "agents": [{
                    "radius": 0.001, "positions": { "explicit": &positions },
                    "velocities": { "explicit": &velocities }
                }],
                "laws": laws
            }),
            |at, _| {
                for (i, a) in at.iter().enumerate() {
                    for b in &at[..i] {
                        nearest = nearest.min((a - b).norm_squared());
                    }
                }
            },
        );
        nearest
    };
    assert!(run(json!([])) < 0.25);
    let nearest = run(json!([{ "cucker_dong": { "squared_distance": 0.25, "strength": 0.1 } }]));
    assert!(nearest > 0.25 && nearest < 2.0, "{nearest}");
}

#[test]
fn pattern_forces_bring_the_flock_into_its_pattern() {
    let file = |law: Value| {
        json!({
            "dimension": 3, "time": { "step": 0.02, "end": 60 }, "seed": 4,
            "agents": [{
                "count": 12, "radius": 0.01,
                "positions": { "box": { "min": [-4, -4, -4], "max": [4, 4, 4] } },
                "velocities": { "ball": { "center": [0.3, 0, 0], "radius": 1 } }
            }],
            // Damping about the velocity (0.3, 0, 0).
            "laws": [law, { "navigation": {
                "velocity": [0.3, 0, 0], "feedback": "linear", "velocity_gain": 1
            } }]
        })
    };
    let along = Vector::<3>::new(2.0, -1.0, 2.0) / 3.0;
    let line = json!({ "line_pattern": { "direction": [2, -1, 2] } });
    let [at, _] = run::<3>(file(line), |_, _| {});
    let mean = plain_mean(&at);
    for x in &at {
        let y = x - mean;
        assert!((y - along * y.dot(&along)).norm() < 1e-6, "{y}");
    }
    assert!(at.iter().any(|x| (x - mean).norm() > 1.0));
    let ball = json!({ "ball_pattern": { "radius": 3, "strength": 5 } });
    let [at, _] = run::<3>(file(ball), |_, _| {});
    let mean = plain_mean(&at);
    let worst = at
        .iter()
        .map(|x| ((x - mean).norm() - 3.0).abs())
        .fold(0.0, f64::max);
    assert!(worst < 1e-3, "{worst}");
}
