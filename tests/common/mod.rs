//! Worlds and measures that several tests share.

#![allow(dead_code, reason = "each test file uses some of it")]

use volary::math::{Vector, axis, direction};
use volary::shape::{Geometry, In};
use volary::world::World;
use volary::world::spec::WorldSpec;

/// Positions and velocities.
pub type Flow<const D: usize> = (Vec<Vector<D>>, Vec<Vector<D>>);

/// A world from JSON that is known to be sound.
pub fn spec(json: serde_json::Value) -> WorldSpec {
    serde_json::from_value(json).expect("the test's world is well formed")
}

/// A part of a world from JSON that is known to be sound.
pub fn from_json<T: serde::de::DeserializeOwned>(json: serde_json::Value) -> T {
    serde_json::from_value(json).expect("the test's JSON is well formed")
}

/// A resolved world.
pub fn world<const D: usize>(spec: WorldSpec) -> World<D>
where
    In<D>: Geometry<D>,
{
    World::new("test", spec).expect("the test's world is sound")
}

/// A small smooth flock of Olfati-Saber's that meets one obstacle and touches nothing.
pub fn flock_world(dimension: usize) -> WorldSpec {
    let vector = |x: f64, rest: f64| {
        let mut vector = vec![rest; dimension];
        vector[0] = x;
        vector
    };
    spec(serde_json::json!({
        "dimension": dimension,
        "time": { "step": 0.01, "end": 2.0 },
        "record": { "every": 0.4 },
        "seed": 5,
        "agents": [{
            "count": 20,
            "radius": 0.02,
            "mass": 1.7,
            "positions": { "box": {
                "min": vector(0.0, 0.0), "max": vector(9.0, 9.0), "separation": 1.4
            } },
            "velocities": { "uniform": { "min": vector(-0.5, -0.5), "max": vector(0.5, 0.5) } }
        }],
        "obstacles": [{ "shape": { "ball": { "radius": 1.5 } }, "position": vector(13.0, 5.0) }],
        "laws": [
            { "alpha_interaction": { "spacing": 2.5, "range": 3.5, "damping": 0.6 } },
            { "obstacle_avoidance": {
                "range": 4.0, "standoff": 3.0, "gain": 1.5, "damping": 0.3,
                "gamma": { "spacing": 1.0, "offset": 0.7 }
            } },
            { "navigation": { "velocity": vector(2.0, 0.0), "velocity_gain": 1.5 } }
        ]
    }))
}

/// The directions of some velocities, that of the first axis for those at rest.
pub fn headings<const D: usize>(velocities: &[Vector<D>]) -> Vec<Vector<D>> {
    let heading = |velocity: &Vector<D>| match direction(velocity) {
        along if along.norm_squared() > 0.0 => along,
        _ => axis(0),
    };
    velocities.iter().map(heading).collect()
}

/// The order with which errors fall with the step, by least squares on the logarithms.
pub fn order(steps: &[f64], errors: &[f64]) -> f64 {
    let n = steps.len() as f64;
    let x: Vec<f64> = steps.iter().map(|step| step.ln()).collect();
    let y: Vec<f64> = errors.iter().map(|error| error.ln()).collect();
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let sxy: f64 = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my)).sum();
    let sxx: f64 = x.iter().map(|x| (x - mx) * (x - mx)).sum();
    sxy / sxx
}
