//! Bodies that are not round pass through neither each other nor thin walls, however they
//! spin: thousands of shots in lanes side by side.

mod common;

use common::{spec, world};
use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::Vector;
use volary::shape::{In, Pose};
use volary::simulation::Simulation;
use volary::world::World;

/// Shots of each kind of target, for each shape.
const SHOTS: usize = 200;

/// Depth from which the way out of each shape leads to the other side of its like: the sum of
/// the radii of the balls inside the two.
const THROUGH: [f64; 3] = [0.2, 0.2, 0.3];

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
fn body<const D: usize>(shot: usize, shape: &Value, x: f64, speed: f64) -> Value {
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
    json!({
        "shape": shape,
        "positions": { "explicit": [at.as_slice()] },
        "velocities": { "common": velocity },
        "rotation": if D == 2 { json!(turn[2]) } else { json!(turn) },
        // Every other one turns to its velocity as fast as the engine turns anything.
        "heading": if shot.is_multiple_of(2) { json!("free") } else { json!({ "velocity": {} }) }
    })
}

/// Flies a world; `watch` sees the poses before and after each step, and who was struck in it.
fn fly<const D: usize>(mut json: Value, mut watch: impl FnMut(&World<D>, [&[Pose<D>]; 2], &[bool]))
where
    In<D>: Engine<D>,
{
    json["dimension"] = json!(D);
    json["time"] = json!({ "step": 0.01, "end": 0.3 });
    json["record"] = json!({ "every": 0.3, "metrics": false });
    let mut simulation = Simulation::<D>::new(world(spec(json))).expect("a finite start");
    let poses = |simulation: &Simulation<D>| -> Vec<Pose<D>> {
        let state = simulation.snapshot();
        let rotations = state.rotations.expect("none is round");
        let both = state.positions.iter().zip(rotations);
        both.map(|(position, rotation)| Pose::from_matrix(*position, *rotation))
            .collect()
    };
    let mut before = poses(&simulation);
    for _ in 0..simulation.world().steps() {
        let velocities = simulation.snapshot().velocities.to_vec();
        simulation.step().expect("a finite state");
        let after = poses(&simulation);
        let now = simulation.snapshot().velocities.iter();
        let struck: Vec<bool> = now.zip(&velocities).map(|(a, b)| a != b).collect();
        watch(simulation.world(), [&before, &after], &struck);
        before = after;
    }
}

/// The pose at a share of the way from one to another.
fn between_poses<const D: usize>(before: &Pose<D>, after: &Pose<D>, share: f64) -> Pose<D> {
    let way = after.translation - before.translation;
    let change = after.rotation() * before.rotation().transpose();
    let turn = Pose::from_matrix(Vector::zeros(), change).turn();
    let part = Pose::<D>::new(Vector::zeros(), turn.map(|x| x * share));
    Pose::from_matrix(
        before.translation + way * share,
        part.rotation() * before.rotation(),
    )
}

/// Shots at each other that passed through. Bodies that meet off their middles may well get
/// round each other, so where they end up says nothing: but on their way from step to step they
/// may never sink into each other by half of what it takes to come out on the other side.
fn shots_at_each_other<const D: usize>() -> (usize, Vec<String>)
where
    In<D>: Engine<D>,
{
    let (mut met, mut through) = (0, Vec::new());
    for (kind, shape) in shapes(D).iter().enumerate() {
        let mut groups = Vec::new();
        for shot in 0..SHOTS {
            let seed = shot + 1000 * kind;
            let speed = between(seed, 20, 1.0, 25.0);
            let gap = 2.0 + between(seed, 21, 0.0, 1.0);
            for (x, speed) in [(0.0, speed), (gap, -speed)] {
                groups.push(body::<D>(shot, shape, x, speed));
            }
        }
        let mut deepest = vec![f64::INFINITY; SHOTS];
        fly::<D>(
            json!({ "agents": groups }),
            |world, [before, after], struck| {
                for (shot, deepest) in deepest.iter_mut().enumerate() {
                    let (a, b) = (2 * shot, 2 * shot + 1);
                    let apart = (before[a].translation - before[b].translation).norm();
                    if apart > 2.5 {
                        continue;
                    }
                    // The way of who was struck is not the one between the ends of the step.
                    let first = if struck[a] || struck[b] { 40 } else { 0 };
                    for k in first..=40 {
                        let share = f64::from(k) / 40.0;
                        let gap = world.solids[a].gap(
                            &between_poses(&before[a], &after[a], share),
                            &world.solids[b],
                            &between_poses(&before[b], &after[b], share),
                        );
                        *deepest = deepest.min(gap);
                    }
                }
            },
        );
        for (shot, gap) in deepest.into_iter().enumerate() {
            met += usize::from(gap < 0.02);
            if gap < -THROUGH[kind] {
                let speed = 2.0 * between(shot + 1000 * kind, 20, 1.0, 25.0);
                through.push(format!(
                    "{D}-D shape {kind} shot {shot} at {speed:.1}: {gap:.3}"
                ));
            }
        }
    }
    (met, through)
}

/// Shots at thin walls that passed through.
fn shots_at_walls<const D: usize>() -> Vec<String>
where
    In<D>: Engine<D>,
{
    let mut through = Vec::new();
    for (kind, shape) in shapes(D).iter().enumerate() {
        let (mut groups, mut walls, mut places) = (Vec::new(), Vec::new(), Vec::new());
        for shot in 0..SHOTS {
            let seed = shot + 1000 * kind;
            let speed = between(seed, 22, 1.0, 50.0);
            groups.push(body::<D>(shot, shape, 0.0, speed));
            let mut at = lane::<D>(shot);
            at[0] = 1.0 + speed * between(seed, 23, 0.05, 0.15);
            places.push(at[0]);
            let mut half = vec![5.0; D];
            half[0] = 0.02;
            walls.push(json!({
                "shape": { "cuboid": { "half_extents": half } }, "position": at.as_slice()
            }));
        }
        let mut last = Vec::new();
        fly::<D>(
            json!({ "agents": groups, "obstacles": walls }),
            |_, [_, after], _| {
                last = after.to_vec();
            },
        );
        for (shot, (pose, wall)) in last.iter().zip(places).enumerate() {
            if pose.translation[0] >= wall {
                through.push(format!("{D}-D shape {kind} shot {shot} at the wall"));
            }
        }
    }
    through
}

#[test]
fn bodies_do_not_pass_through_each_other() {
    let (met, mut through) = shots_at_each_other::<2>();
    let (met_in_space, others) = shots_at_each_other::<3>();
    through.extend(others);
    let met = met + met_in_space;
    assert!(met > 4 * SHOTS, "{met} met at all");
    let list = through.join("\n");
    assert!(
        through.is_empty(),
        "{} of {met} passed:\n{list}",
        through.len()
    );
}

#[test]
fn bodies_do_not_pass_through_walls() {
    let mut through = shots_at_walls::<2>();
    through.extend(shots_at_walls::<3>());
    let list = through.join("\n");
    assert!(through.is_empty(), "{} passed:\n{list}", through.len());
}
