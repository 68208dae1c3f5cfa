//! Worlds and measures that several tests share.

#![allow(dead_code, reason = "each test file uses some of it")]

use volary::law::{Flock, State};
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

/// A crowd that sums over all pairs in every way, among many obstacles that move.
pub fn multitude(dimension: usize) -> WorldSpec {
    let alignment = |more: serde_json::Value| {
        let mut law = serde_json::json!({
            "kernel": { "cucker_smale": { "strength": 1, "exponent": 0.5 } },
            // So slow that it is summed, not relaxed.
            "normalisation": "mean_field"
        });
        let more = more.as_object().unwrap().clone();
        law.as_object_mut().unwrap().extend(more);
        serde_json::json!({ "alignment": law })
    };
    let obstacles: Vec<_> = (0..40)
        .map(|k| {
            let mut position = vec![6.0; dimension];
            (position[0], position[1]) = (-2.0, 1.5 * f64::from(k));
            serde_json::json!({
                "shape": { "ball": { "radius": 0.3 } }, "position": position,
                "motion": { "oscillation": { "amplitude": vec![1.0; dimension], "period": 1 } }
            })
        })
        .collect();
    let sight = serde_json::json!({ "agents": 0.5, "obstacles": 0 });
    spec(serde_json::json!({
        "dimension": dimension,
        "time": { "step": 0.01, "end": 0.3 },
        "record": { "every": 0.05, "accelerations": true, "beta_agents": true },
        "agents": [{
            "count": 80, "radius": 0.3,
            "positions": { "box": { "min": vec![0.0; dimension], "max": vec![8.0; dimension] } },
            "velocities": { "uniform": {
                "min": vec![-3.0; dimension], "max": vec![2.0; dimension]
            } }
        }],
        "obstacles": obstacles,
        "laws": [
            { "alpha_interaction": { "spacing": 0.5, "range": 1.5, "damping": 0.5 } },
            { "obstacle_avoidance": { "range": 1.5, "standoff": 0.5, "gain": 0.2 } },
            alignment(serde_json::json!({ "summation": "direct" })),
            alignment(serde_json::json!({ "summation": { "fast": {} } })),
            alignment(serde_json::json!({ "masking": { "radius": 0.3 } })),
            alignment(serde_json::json!({
                "masking": { "radius": 0.3 }, "range": 2, "line_of_sight": sight
            }))
        ]
    }))
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

/// A closed room with all that a world can hold: bodies of several shapes that are steered in
/// several ways, senses of every kind, laws in scopes, obstacles that move in every way but
/// away, and everything on record. The bodies never come to rest.
pub fn circus(dimension: usize) -> WorldSpec {
    let vector = |x: f64, y: f64, rest: f64| {
        let mut vector = vec![rest; dimension];
        (vector[0], vector[1]) = (x, y);
        vector
    };
    let in_box = |x: f64, y: f64, half: f64| {
        serde_json::json!({ "box": {
            "min": vector(x - half, y - half, -half), "max": vector(x + half, y + half, half)
        } })
    };
    let rate = match dimension {
        2 => serde_json::json!(0.7),
        _ => serde_json::json!([0.2, 0.1, 0.7]),
    };
    spec(serde_json::json!({
        "dimension": dimension,
        "time": { "step": 0.01, "end": 2.5 },
        "seed": 3,
        "physics": { "restitution": 0.9, "friction": 0.2 },
        "record": {
            "every": 0.1, "accelerations": true, "beta_agents": true, "edges": true,
            "net": true, "links": true
        },
        "agents": [
            {
                "name": "rods", "count": 4, "density": 1.5,
                "shape": { "capsule": { "half_length": 0.5, "radius": 0.2 } },
                "heading": { "torque": { "gain": 30, "limit": 4 } },
                "positions": in_box(-4.0, -4.0, 1.8),
                "velocities": { "rotating": { "rate": rate } },
                "sensing": {
                    "radius": 4, "field_of_view": { "angle": 2.4 }, "delay": 0.05,
                    "noise": { "position": 0.05, "velocity": 0.1 }, "dropout": 0.2
                }
            },
            {
                "name": "disks", "count": 6, "radius": 0.3, "restitution": 1, "force_limit": 30,
                "positions": in_box(4.0, 4.0, 1.8),
                "velocities": { "ball": { "radius": 3 } },
                "sensing": { "blocked_by": { "obstacles": true, "bodies": true } }
            },
            {
                "name": "boxes", "count": 3, "top_speed": 4, "force_rate_limit": 500,
                "shape": { "cuboid": { "half_extents": vector(0.4, 0.25, 0.3) } },
                "heading": { "velocity": { "turn_rate": 3 } },
                "positions": in_box(4.0, -4.0, 1.8),
                "velocities": { "outward": { "speed": 2 } },
                "sensing": { "cone": { "angle": 2.5, "smooth": true } }
            }
        ],
        "obstacles": [
            { "shape": { "room": { "half_extents": vector(7.0, 7.0, 7.0) } } },
            {
                "name": "wheel", "restitution": 0.5,
                "shape": { "compound": { "parts": [
                    { "shape": { "capsule": {
                        "from": vector(-1.5, 0.0, 0.0), "to": vector(1.5, 0.0, 0.0), "radius": 0.2
                    } } },
                    { "shape": { "cuboid": { "half_extents": vector(0.2, 1.5, 0.3) } } }
                ] } },
                "motion": { "rotation": { "rate": rate } }
            },
            {
                "name": "pendulum", "shape": { "ball": { "radius": 0.7 } },
                "position": vector(-4.0, 4.0, 0.0),
                "motion": { "oscillation": { "amplitude": vector(1.5, 1.0, 0.5), "period": 3.1 } }
            },
            {
                "name": "shuttle",
                "shape": { "segment": {
                    "from": vector(-1.0, 0.0, 0.0), "to": vector(1.0, 0.5, 0.0)
                } },
                "motion": { "waypoints": {
                    "points": [vector(0.0, 5.0, 0.0), vector(0.0, 3.0, 0.0)],
                    "period": 4, "dwell": 0.5, "easing": "smooth"
                } }
            }
        ],
        "laws": [
            { "alpha_interaction": { "spacing": 2, "range": 3, "damping": 0 } },
            { "obstacle_avoidance": {
                "range": 0.8, "standoff": 0.7, "gain": 2, "gamma": { "spacing": 0.5, "direction": vector(1.0, 0.0, 0.0) }
            } },
            { "scope": { "agents": ["disks", "boxes"], "neighbours": ["rods"], "laws": [
                { "heading_consensus": { "range": 5, "gain": 0.5 } }
            ] } },
            { "scope": { "agents": ["rods"], "laws": [
                { "navigation": {
                    "destination": vector(0.0, 0.0, 0.0), "feedback": "linear", "steer": "mean",
                    "position_gain": 0.6, "velocity_gain": 0
                } }
            ] } },
            { "scope": { "agents": ["disks", "boxes"], "laws": [
                { "navigation": {
                    "destination": vector(0.0, 0.0, 0.0), "feedback": "linear",
                    "position_gain": 0.8, "velocity_gain": 0
                } }
            ] } }
        ]
    }))
}

/// A small world with every law that aligns, attracts, repels, draws, drags or steers, and
/// every part that they have; it is stiff, so that some of it relaxes.
pub fn parade(dimension: usize) -> WorldSpec {
    let vector = |x: f64, y: f64, rest: f64| {
        let mut vector = vec![rest; dimension];
        (vector[0], vector[1]) = (x, y);
        vector
    };
    let cucker_smale = serde_json::json!({ "cucker_smale": { "exponent": 0.4, "length": 2 } });
    let beat = serde_json::json!({ "sine": { "mean": 0.5, "amplitude": 0.4, "period": 0.7 } });
    spec(serde_json::json!({
        "dimension": dimension,
        "time": { "step": 0.01, "end": 1 },
        "seed": 5,
        "physics": { "restitution": 0.5, "gravity": vector(0.1, -0.2, 0.05) },
        "record": {
            "every": 0.1, "accelerations": true, "links": true, "laws": true, "blocked": true,
            "active_at": 0.05
        },
        "agents": [
            {
                "name": "red", "count": 4, "radius": 0.2, "mass": [1, 2, 0.5, 1.5], "top_speed": 6,
                "positions": { "ball": { "center": vector(0.0, 0.0, 0.0), "radius": 3 } },
                "velocities": { "ball": { "radius": 2 } },
                "sensing": { "cone": { "angle": 2.5, "smooth": true }, "delay": 0.02 }
            },
            {
                "name": "blue", "count": 3, "radius": 0.2, "mass": 0.7, "force_limit": 300,
                "positions": { "ball": { "center": vector(6.0, 0.0, 0.0), "radius": 2 } },
                "velocities": { "ball": { "radius": 2 } }
            }
        ],
        "obstacles": [
            { "shape": { "ball": { "radius": 0.4 } }, "position": vector(3.0, 0.0, 0.0) }
        ],
        "laws": [
            { "alignment": {
                "kernel": cucker_smale, "normalisation": "motsch_tadmor", "epsilon": 0.01,
                "gain": { "bounded": { "bound": [1, 2, 3, 1, 2, 3, 4], "scale": 0.3 } },
                "orientation": { "angle": 1.5, "speed": 0.5, "length": 0.3 },
                "masking": { "radius": 0.5 },
                "line_of_sight": { "agents": 0.5, "obstacles": 0 }
            } },
            { "alignment": {
                "kernel": { "exponential": { "length": 3 } }, "normalisation": "mean_field",
                "graph": { "random": { "arcs": 15 } }, "gain": { "open_loop": beat },
                "acts_as": "force", "range": 9, "relaxation": "never"
            } },
            { "pair_potential": { "potential": { "bond": { "stiffness": 0.1, "length": 2 } } } },
            { "pair_potential": {
                "potential": { "logarithmic": { "attraction": 0.2, "repulsion": 0.5 } },
                "share": "mean", "acts_as": "force"
            } },
            { "pair_potential": {
                "potential": { "gaussian": { "height": 2, "decay": 1 } }, "range": 4
            } },
            { "cucker_dong": { "squared_distance": 0.01, "strength": 0.1 } },
            { "park_bonding": { "velocity_gain": 0.5, "position_gain": 0.3, "radius": 1.5 } },
            { "first_order_flow": { "rate": 0.5, "potential": { "gazi_passino": {
                "attraction": 0.1, "repulsion": 1, "squared_length": 2
            } } } },
            { "friction": { "coefficient": [0.1, 0.2, 0.1, 0, 0.1, 0.3, 0.1], "exponent": 0.5 } },
            { "friction_compensation": { "coefficient": 0.1, "acts_as": "force" } },
            { "self_propulsion": { "propulsion": 0.5, "drag": 0.2 } },
            { "steering": { "acceleration": vec![beat.clone(); dimension] } },
            { "scope": { "agents": ["red"], "laws": [
                { "line_pattern": { "direction": vector(1.0, 1.0, 0.0), "strength": 0.5 } },
                { "tracking": { "target": { "lissajous": {
                    "center": vector(1.0, 1.0, 0.0), "amplitudes": vector(2.0, 1.0, 1.0),
                    "angular_velocities": vector(1.0, 2.0, 3.0)
                } } } }
            ] } },
            { "scope": { "agents": ["blue"], "neighbours": ["red"], "laws": [
                { "ball_pattern": { "radius": 2 } },
                { "flatness": {
                    "trajectories": { "mill_ring": {
                        "center": vector(6.0, 0.0, 0.0), "radius": [1, 1.2, 1.4],
                        "angular_velocity": 0.5
                    } },
                    "position_gain": 1, "velocity_gain": 2
                } }
            ] } }
        ]
    }))
}

/// A state of a world's agents.
pub fn state<'a, const D: usize>(
    world: &'a World<D>,
    time: f64,
    positions: &'a [Vector<D>],
    velocities: &'a [Vector<D>],
    headings: &'a [Vector<D>],
) -> State<'a, D> {
    State {
        time,
        positions,
        velocities,
        headings,
        groups: &world.agents.group,
        masses: &world.agents.mass,
        rotations: &world.agents.rotations,
        obstacles: &world.obstacles,
    }
}

/// The accelerations that a world's laws give in some state, in the order of the world.
pub fn accelerations<const D: usize>(
    world: &World<D>,
    time: f64,
    positions: &[Vector<D>],
    velocities: &[Vector<D>],
) -> Vec<Vector<D>> {
    let mut out = vec![Vector::zeros(); positions.len()];
    let headings = headings(velocities);
    let state = state(world, time, positions, velocities, &headings);
    Flock::of_world(world, Vec::new()).accelerations(&state, &mut out);
    out
}

/// The least value of a convex function along a segment, by ternary search.
pub fn least<const D: usize>(
    from: &Vector<D>,
    to: &Vector<D>,
    value: impl Fn(&Vector<D>) -> f64,
) -> f64 {
    let at = |t: f64| value(&(from + (to - from) * t));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..90 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a) < at(b) { high = b } else { low = a }
    }
    at(low).min(at(high)).min(at(0.0)).min(at(1.0))
}

/// Numbers for test scenes (a linear congruential generator).
pub struct Dice(pub u64);

impl Dice {
    /// Uniform in an interval.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Between two numbers above 0, with even chances for each magnitude.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.between(0.0, 1.0))
    }

    /// A unit vector.
    pub fn direction<const D: usize>(&mut self) -> Vector<D> {
        loop {
            let at: Vector<D> = self.vector(-1.0, 1.0);
            if (0.1..1.0).contains(&at.norm()) {
                return at.normalize();
            }
        }
    }

    /// Uniform in a box.
    pub fn vector<const D: usize>(&mut self, low: f64, high: f64) -> Vector<D> {
        Vector::from_fn(|_, _| self.between(low, high))
    }

    /// Several of them.
    pub fn vectors<const D: usize>(&mut self, n: usize, low: f64, high: f64) -> Vec<Vector<D>> {
        (0..n).map(|_| self.vector(low, high)).collect()
    }
}
