//! Bodies that are not round pass through neither each other nor thin walls, however they
//! spin: thousands of shots in lanes side by side.

mod common;

use common::{spec, world};
use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::Vector;
use volary::shape::In;
use volary::simulation::Simulation;

/// Shots of each kind of target, for each shape.
const SHOTS: usize = 180;

/// Body lengths between lanes.
const LANE: f64 = 12.0;

/// A number in [0, 1) for each shot and purpose, by the mixing function of SplitMix64.
fn draw(shot: usize, purpose: u64) -> f64 {
    let mut z = (shot as u64 * 64 + purpose).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

fn between(shot: usize, purpose: u64, low: f64, high: f64) -> f64 {
    low + (high - low) * draw(shot, purpose)
}

/// Shapes about one unit long.
fn shapes(dimension: usize) -> Vec<Value> {
    let cuboid = if dimension == 2 {
        vec![0.45, 0.1]
    } else {
        vec![0.45, 0.1, 0.15]
    };
    let hull = match dimension {
        2 => json!([[0.5, 0.0], [-0.3, 0.3], [-0.4, -0.2], [0.1, -0.25]]),
        _ => json!([
            [0.5, 0.0, 0.0],
            [-0.3, 0.3, 0.1],
            [-0.4, -0.2, 0.2],
            [-0.1, -0.1, -0.3]
        ]),
    };
    vec![
        json!({ "capsule": { "half_length": 0.4, "radius": 0.1 } }),
        json!({ "cuboid": { "half_extents": cuboid } }),
        json!({ "convex": { "points": hull } }),
    ]
}

/// The lane of a shot, across the direction of flight.
fn lane<const D: usize>(shot: usize) -> Vector<D> {
    let mut at = Vector::<D>::zeros();
    match D {
        2 => at[1] = LANE * shot as f64,
        _ => {
            at[1] = LANE * (shot % 16) as f64;
            at[2] = LANE * (shot / 16) as f64;
        }
    }
    at
}

/// One body in each lane, each a group of its own so that each has its own rotation; all
/// fly along the first axis.
fn body<const D: usize>(
    shot: usize,
    shape: &Value,
    x: f64,
    speed: f64,
    spin: Option<f64>,
) -> Value {
    let purpose = if speed < 0.0 { 8 } else { 0 };
    let mut at = lane::<D>(shot);
    at[0] = x;
    // Off the middle, so that bodies set each other spinning, but never past each other.
    at[1] += between(shot, purpose + 1, -0.05, 0.05);
    let mut velocity = vec![0.0; D];
    velocity[0] = speed;
    let turn: Vec<f64> = (0..3)
        .map(|k| between(shot, purpose + 2 + k, -3.0, 3.0))
        .collect();
    let mut group = json!({
        "shape": shape,
        "positions": { "explicit": [at.as_slice()] },
        "velocities": { "common": velocity },
        "rotation": if D == 2 { json!(turn[2]) } else { json!(turn) },
        "heading": "free"
    });
    if spin.is_some() {
        // Turned to its velocity as fast as the engine turns anything.
        group["heading"] = json!({ "velocity": {} });
    }
    group
}

fn fly<const D: usize>(mut world_json: Value, h: f64, time: f64) -> Vec<Vector<D>>
where
    In<D>: Engine<D>,
{
    world_json["dimension"] = json!(D);
    world_json["time"] = json!({ "step": h, "end": time });
    world_json["record"] = json!({ "every": time, "metrics": false });
    let mut simulation = Simulation::<D>::new(world(spec(world_json))).expect("a finite start");
    for _ in 0..simulation.world().steps() {
        simulation.step().expect("a finite state");
    }
    simulation.snapshot().positions.to_vec()
}

fn shots_at_each_other<const D: usize>() -> Vec<String>
where
    In<D>: Engine<D>,
{
    let mut through = Vec::new();
    for (kind, shape) in shapes(D).iter().enumerate() {
        let mut groups = Vec::new();
        for shot in 0..SHOTS {
            let seed = shot + 1000 * kind;
            let speed = between(seed, 20, 1.0, 25.0);
            let gap = 2.0 + between(seed, 21, 0.0, 1.0);
            let spin = (shot % 2 == 1).then_some(1.0);
            groups.push(body::<D>(shot, shape, 0.0, speed, spin));
            groups.push(body::<D>(shot, shape, gap, -speed, spin));
        }
        let last = fly::<D>(json!({ "agents": groups }), 0.01, 0.3);
        for (shot, pair) in last.chunks(2).enumerate() {
            let speed = between(shot + 1000 * kind, 20, 1.0, 25.0);
            if pair[0][0] >= pair[1][0] && speed > 4.0 {
                through.push(format!(
                    "{D}-D {kind} shot {shot} at {speed}: {:?} {:?}",
                    pair[0], pair[1]
                ));
            }
        }
    }
    through
}

fn shots_at_walls<const D: usize>() -> Vec<String>
where
    In<D>: Engine<D>,
{
    let mut through = Vec::new();
    for (kind, shape) in shapes(D).iter().enumerate() {
        let mut groups = Vec::new();
        let mut walls = Vec::new();
        for shot in 0..SHOTS {
            let seed = shot + 1000 * kind;
            let speed = between(seed, 22, 1.0, 50.0);
            let spin = (shot % 2 == 1).then_some(1.0);
            groups.push(body::<D>(shot, shape, 0.0, speed, spin));
            let mut at = lane::<D>(shot);
            at[0] = 2.0 + between(seed, 23, 0.0, 1.0);
            let mut half = vec![5.0; D];
            half[0] = 0.02;
            walls.push(json!({
                "shape": { "cuboid": { "half_extents": half } }, "position": at.as_slice()
            }));
        }
        let last = fly::<D>(json!({ "agents": groups, "obstacles": walls }), 0.01, 0.3);
        for (shot, position) in last.iter().enumerate() {
            let seed = shot + 1000 * kind;
            let wall = 2.0 + between(seed, 23, 0.0, 1.0);
            if position[0] >= wall {
                through.push(format!("{D}-D {kind} wall {shot}: {position:?}"));
            }
        }
    }
    through
}

#[test]
fn bodies_do_not_pass_through_each_other() {
    let mut through = shots_at_each_other::<2>();
    through.extend(shots_at_each_other::<3>());
    assert!(
        through.is_empty(),
        "{} through:\n{}",
        through.len(),
        through.join("\n")
    );
}

#[test]
fn bodies_do_not_pass_through_walls() {
    let mut through = shots_at_walls::<2>();
    through.extend(shots_at_walls::<3>());
    assert!(
        through.is_empty(),
        "{} through:\n{}",
        through.len(),
        through.join("\n")
    );
}
