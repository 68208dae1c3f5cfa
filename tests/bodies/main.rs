//! Bodies of every shape: what they weigh, how they turn, what drives them and how they bounce.

#[path = "../common/mod.rs"]
mod common;
mod crowd;
mod limits;
mod mass;
mod surface;
mod turning;

use common::{spec, world};
use serde_json::{Value, json};
use std::f64::consts::PI;
use volary::dynamics::Engine;
use volary::shape::In;
use volary::simulation::Simulation;

fn simulation<const D: usize>(json: Value) -> Simulation<D>
where
    In<D>: Engine<D>,
{
    Simulation::new(world(spec(json))).expect("a finite start")
}

fn step<const D: usize>(simulation: &mut Simulation<D>) {
    simulation.step().expect("a finite state");
}

/// A rod of half length 1 and radius 0.2, with some more fields.
fn rod(more: Value) -> Value {
    let mut group = json!({
        "shape": { "capsule": { "half_length": 1, "radius": 0.2 } },
        "positions": { "explicit": [[0, 0]] }
    });
    for (field, value) in more.as_object().expect("fields") {
        group[field] = value.clone();
    }
    group
}

/// The moment of inertia of a flat capsule at density 1, and its area: a rectangle and two half
/// disks with centroids 4r/(3π) beyond its ends.
fn flat_capsule(half_length: f64, radius: f64) -> (f64, f64) {
    let (l, r) = (half_length, radius);
    let (bar, disk) = (4.0 * l * r, PI * r * r);
    let inertia =
        bar * (l * l + r * r) / 3.0 + disk * (0.5 * r * r + l * l + 2.0 * l * 4.0 * r / (3.0 * PI));
    (inertia, bar + disk)
}

/// A disk that hits a resting rod off its middle.
fn off_center(dimension: usize) -> Value {
    let place = |x: f64, y: f64| {
        let mut at = vec![0.0; dimension];
        (at[0], at[1]) = (x, y);
        at
    };
    json!({
        "dimension": dimension, "time": { "end": 6 },
        "physics": { "restitution": 1 },
        "agents": [
            rod(json!({ "heading": "free", "mass": 2, "positions": { "explicit": [place(0.0, 0.0)] } })),
            { "radius": 0.3, "mass": 1.5, "positions": { "explicit": [place(0.7, 2.0)] },
              "velocities": { "common": place(0.0, -1.0) } }
        ]
    })
}
