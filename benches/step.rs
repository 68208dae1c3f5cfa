//! The whole step of a flock of bodies against the engine's bare step of the same bodies.
//!
//! `cargo bench --bench step` prints a table. Both are timed in turns within one run, and
//! the ratio is the median of the rounds' ratios: absolute times drift from machine to
//! machine and from minute to minute, ratios much less.

use std::time::Instant;

use serde_json::json;
use volary::dynamics::{Bodies, Drive, Engine};
use volary::law::{Flock, build};
use volary::shape::In;
use volary::world::World;

/// Rounds of whole and bare steps in turns.
const ROUNDS: usize = 11;

/// An α-lattice in flight among obstacles: about six neighbours each in the plane, about
/// fourteen in space.
fn world<const D: usize>(agents: usize) -> World<D>
where
    In<D>: Engine<D>,
{
    // A box in which the lattice is about at its spacing of 7.
    let side = 7.0 * (agents as f64 * if D == 2 { 0.95 } else { 0.85 }).powf(1.0 / D as f64);
    let obstacles: Vec<_> = (0..6)
        .map(|k| {
            let mut at = vec![side * (0.2 + 0.1 * f64::from(k)); D];
            at[0] = side + 40.0 + 30.0 * f64::from(k);
            json!({ "shape": { "ball": { "radius": 8 } }, "position": at })
        })
        .collect();
    let mut velocity = vec![0.0; D];
    velocity[0] = 10.0;
    let spec = json!({
        "dimension": D,
        "time": { "step": 0.01, "end": 1 },
        "agents": [{
            "count": agents, "radius": 0.5,
            "positions": { "box": {
                "min": vec![0.0; D], "max": vec![side; D], "separation": 4.5
            } },
            "velocities": { "common": velocity }
        }],
        "obstacles": obstacles,
        "laws": [
            { "alpha_interaction": { "spacing": 7, "range": 8.4, "damping": 1 } },
            { "obstacle_avoidance": {
                "range": 4.2, "standoff": 3, "gain": 10, "damping": 0.1,
                "gamma": { "spacing": 2 }
            } },
            { "navigation": { "velocity": velocity, "velocity_gain": 2 } }
        ]
    });
    let spec = serde_json::from_value(spec).expect("the world is well formed");
    World::new("benchmark", spec).expect("the world is sound")
}

fn seconds(work: impl FnOnce()) -> f64 {
    let begin = Instant::now();
    work();
    begin.elapsed().as_secs_f64()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn compare<const D: usize>(agents: usize)
where
    In<D>: Engine<D>,
{
    let world = world::<D>(agents);
    let mut flock = Flock::new(build(&world));
    let mut bodies = Bodies::new(&world, &mut flock).expect("a finite start");
    let mut engine = <In<D> as Engine<D>>::physics(&world);
    let still = Drive {
        forces: &[],
        steering: &[],
        obstacles: &world.obstacles,
    };
    let steps = (200_000 / agents).clamp(5, 1_000);
    for _ in 0..steps.min(100) {
        bodies.step(&mut flock).expect("a finite state");
        engine.step(still);
    }
    let (mut whole, mut bare, mut laws) = (Vec::new(), Vec::new(), Vec::new());
    let mut out = vec![volary::math::Vector::zeros(); agents];
    for _ in 0..ROUNDS {
        whole.push(seconds(|| {
            (0..steps).for_each(|_| bodies.step(&mut flock).expect("a finite state"));
        }));
        // Forces of nothing: the engine's step alone.
        bare.push(seconds(|| (0..steps).for_each(|_| engine.step(still))));
        laws.push(seconds(|| {
            for _ in 0..steps {
                flock.accelerations(&bodies.state(), &mut out);
            }
        }));
    }
    let ratio = median(
        whole
            .iter()
            .zip(&bare)
            .map(|(whole, bare)| whole / bare)
            .collect(),
    );
    let micro = |times: Vec<f64>| median(times) / (steps * agents) as f64 * 1e6;
    println!(
        "| {D} | {agents} | {:.3} | {:.3} | {:.3} | {ratio:.2} |",
        micro(bare),
        micro(laws),
        micro(whole)
    );
}

fn main() {
    for threads in [1, 2] {
        println!("\n{threads} thread(s); µs per agent and step, medians of {ROUNDS} rounds\n");
        println!("| dimension | agents | bare engine | laws alone | whole step | whole / bare |");
        println!("|---|---|---|---|---|---|");
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads can be made").install(|| {
            for agents in [100, 1_000, 10_000] {
                compare::<2>(agents);
                compare::<3>(agents);
            }
        });
    }
}
