//! What many obstacles cost: finding those that matter, against a look at all of them.
//!
//! `cargo bench --bench obstacles` prints a table. Both take turns within one run, and must find
//! the same.

mod common;

use std::hint::black_box;

use common::{median, ratio};
use serde_json::json;
use volary::math::Vector;
use volary::sense::Surroundings;
use volary::shape::{Geometry, In};
use volary::world::World;

/// Rounds of all in turns.
const ROUNDS: usize = 15;

const AGENTS: usize = 1_000;

/// How far β-agents are looked for, and how long a line of sight is at most.
const RANGE: f64 = 4.2;
const SIGHT: f64 = 8.4;

/// Agents among obstacles of some shapes, about 10 apart.
fn world<const D: usize>(obstacles: usize) -> World<D>
where
    In<D>: Geometry<D>,
{
    let side = (10.0 * (obstacles as f64).powf(1.0 / D as f64)).max(80.0);
    // Spread evenly, without a pattern: multiples of powers of a root, modulo 1.
    let root: f64 = if D == 2 {
        1.324_717_957_244_746
    } else {
        1.220_744_084_605_759_6
    };
    let obstacles: Vec<_> = (1..=obstacles)
        .map(|k| {
            let at = |axis: i32| side * (k as f64 * root.powi(-1 - axis)).fract();
            let shape = match k % 3 {
                0 => json!({ "ball": { "radius": 1.2 } }),
                1 => json!({ "cuboid": { "half_extents": vec![0.9; D] } }),
                _ => json!({ "capsule": {
                    "from": vec![-0.8; D], "to": vec![0.8; D], "radius": 0.4
                } }),
            };
            let at: Vec<f64> = (0..D as i32).map(at).collect();
            json!({ "shape": shape, "position": at })
        })
        .collect();
    let spec = json!({
        "dimension": D,
        "time": { "step": 0.01, "end": 1 },
        "agents": [{
            "count": AGENTS, "radius": 0.1,
            "positions": { "box": { "min": vec![0.0; D], "max": vec![side; D] } },
            "velocities": { "ball": { "radius": 1 } }
        }],
        "obstacles": obstacles
    });
    common::world(spec)
}

/// A number that tells whether the same was found, and µs for each agent.
fn timed(work: impl FnOnce() -> f64) -> (f64, f64) {
    let (found, seconds) = common::timed(|| black_box(work()));
    (found, seconds / AGENTS as f64 * 1e6)
}

fn compare<const D: usize>(count: usize)
where
    In<D>: Geometry<D>,
{
    let world = world::<D>(count);
    let (x, obstacles) = (&world.agents.positions, &world.obstacles);
    let surroundings = Surroundings::new(obstacles);
    let all_betas = || {
        let mut sum = 0.0;
        for at in x {
            for obstacle in obstacles.iter().filter(|it| it.may_reach(at, RANGE)) {
                let near = obstacle.projections(at, RANGE);
                sum += near.map(|(_, beta)| beta.distance).sum::<f64>();
            }
        }
        sum
    };
    let betas = || {
        let of = |at| surroundings.active(obstacles, at, RANGE);
        let distances = x.iter().flat_map(of).map(|beta| beta.projection.distance);
        distances.fold(0.0, |sum, distance| sum + distance)
    };
    let ends: Vec<(&Vector<D>, Vector<D>)> = x
        .iter()
        .zip(&world.agents.velocities)
        .map(|(at, way)| (at, at + way * SIGHT))
        .collect();
    let all_lines = || {
        let blocked = |(from, to): &(&Vector<D>, Vector<D>)| {
            obstacles.iter().filter(|it| it.blocks(from, to)).count()
        };
        ends.iter().map(blocked).sum::<usize>() as f64
    };
    let lines = || {
        let blocked = |(from, to): &(&Vector<D>, Vector<D>)| {
            surroundings.between(obstacles, from, to).count()
        };
        ends.iter().map(blocked).sum::<usize>() as f64
    };
    let mut times: [Vec<f64>; 4] = Default::default();
    for _ in 0..ROUNDS {
        let taken = [
            timed(all_betas),
            timed(betas),
            timed(all_lines),
            timed(lines),
        ];
        assert!((taken[0].0 - taken[1].0).abs() <= 1e-9 * taken[0].0.abs());
        assert_eq!(taken[2].0, taken[3].0, "they find different things");
        for (times, (_, micro)) in times.iter_mut().zip(taken) {
            times.push(micro);
        }
    }
    let ratios = [ratio(&times[0], &times[1]), ratio(&times[2], &times[3])];
    let [a, b, c, d] = times.map(median);
    println!(
        "| {D} | {count} | {a:.3} | {b:.3} | {:.1} | {c:.3} | {d:.3} | {:.1} |",
        ratios[0], ratios[1]
    );
}

fn main() {
    println!("one thread; µs per agent, medians of {ROUNDS} rounds\n");
    println!(
        "| dimension | obstacles | all: β-agents | near | ratio | all: sight | near | ratio |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for count in [5, 10, 20, 40, 100, 1_000] {
        compare::<2>(count);
        compare::<3>(count);
    }
}
