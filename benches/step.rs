//! The whole step of a flock of bodies against the engine's bare step of the same bodies,
//! and what laws and sensing cost alone.
//!
//! `cargo bench --bench step` prints tables; with numbers of agents behind a `--`, of those flocks
//! only. All that is compared is timed in turns within one
//! run, and ratios are the medians of the rounds' ratios: absolute times drift from machine to
//! machine and from minute to minute, ratios much less.

mod common;

use common::{median, pool, ratio, seconds};
use serde_json::json;
use volary::dynamics::{Bodies, Drive, Engine};
use volary::law::{Flock, build};
use volary::math::Vector;
use volary::shape::In;
use volary::world::World;

/// Rounds of what is compared, in turns.
const ROUNDS: usize = 31;

/// Agent-steps of one round.
const AGENT_STEPS: usize = 50_000;

/// The range of the lattice: up to six neighbours each in the plane, fourteen in space.
const LATTICE: f64 = 8.4;

/// An α-lattice in flight among obstacles.
fn world<const D: usize>(agents: usize, range: f64) -> World<D>
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
            { "alpha_interaction": { "spacing": 7, "range": range, "damping": 1 } },
            { "obstacle_avoidance": {
                "range": 4.2, "standoff": 3, "gain": 10, "damping": 0.1,
                "gamma": { "spacing": 2 }
            } },
            { "navigation": { "velocity": velocity, "velocity_gain": 2 } }
        ]
    });
    common::world(spec)
}

/// Rounds for so many agents, and the steps of each.
fn rounds_and_steps(agents: usize) -> (usize, usize) {
    let steps = (AGENT_STEPS / agents).max(1);
    (ROUNDS.min(40 * AGENT_STEPS / (steps * agents)), steps)
}

/// A flock that has flown for a while, and its bodies.
fn flown<const D: usize>(world: &World<D>) -> (Flock<D>, Bodies<D>)
where
    In<D>: Engine<D>,
{
    let mut flock = Flock::new(build(world));
    let mut bodies = Bodies::new(world, &mut flock).expect("a finite start");
    for _ in 0..(1_000_000 / world.agents.len()).clamp(10, 1_000) {
        bodies.step(&mut flock).expect("a finite state");
    }
    (flock, bodies)
}

/// Prints a line of the table; gives the whole step's time for one agent.
fn compare<const D: usize>(agents: usize) -> f64
where
    In<D>: Engine<D>,
{
    let world = world::<D>(agents, LATTICE);
    let (mut flock, mut bodies) = flown(&world);
    let mut engine = <In<D> as Engine<D>>::physics(&world);
    let still = Drive {
        forces: &[],
        steering: &[],
        lasting: &[],
        obstacles: &world.obstacles,
    };
    let (rounds, steps) = rounds_and_steps(agents);
    (0..steps.max(10)).for_each(|_| engine.step(still));
    let (mut whole, mut bare, mut laws) = (Vec::new(), Vec::new(), Vec::new());
    let mut out = vec![Vector::zeros(); agents];
    for _ in 0..rounds {
        whole.push(seconds(|| {
            (0..steps).for_each(|_| bodies.step(&mut flock).expect("a finite state"));
        }));
        // Forces of nothing: the engine's step alone.
        bare.push(seconds(|| (0..steps).for_each(|_| engine.step(still))));
        laws.push(seconds(|| {
            (0..steps).for_each(|_| flock.accelerations(&bodies.state(), &mut out));
        }));
    }
    let ratio = ratio(&whole, &bare);
    let micro = |times: Vec<f64>| median(times) / (steps * agents) as f64 * 1e6;
    let whole = micro(whole);
    println!(
        "| {D} | {agents} | {:.3} | {:.3} | {whole:.3} | {ratio:.2} |",
        micro(bare),
        micro(laws),
    );
    whole
}

/// Prints what the laws of a dense flock cost in flight, on one thread and on two. The flock
/// flies on between the rounds, so that lists of neighbours age as they do in a run.
fn laws_alone<const D: usize>(range: f64)
where
    In<D>: Engine<D>,
{
    let agents = 10_000;
    let world = world::<D>(agents, range);
    let (mut flock, mut bodies) = flown(&world);
    let neighbours = flock.links(&bodies.state()).len() as f64 / agents as f64;
    let pools = [1, 2].map(pool);
    let mut times = [Vec::new(), Vec::new()];
    let mut out = vec![Vector::zeros(); agents];
    for _ in 0..5 * ROUNDS {
        pools[1].install(|| bodies.step(&mut flock).expect("a finite state"));
        let state = bodies.state();
        for (pool, times) in pools.iter().zip(&mut times) {
            let five = || (0..5).for_each(|_| flock.accelerations(&state, &mut out));
            times.push(pool.install(|| seconds(five)) / 5.0);
        }
    }
    let scaling = ratio(&times[0], &times[1]);
    let [one, two] = times.map(|times| median(times) / agents as f64 * 1e6);
    println!("| {D} | {neighbours:.1} | {one:.3} | {two:.3} | {scaling:.2} |");
}

fn main() {
    let asked = std::env::args().filter_map(|argument| argument.parse().ok());
    let mut sizes: Vec<usize> = asked.collect();
    if sizes.is_empty() {
        sizes = vec![100, 1_000, 10_000, 100_000];
    }
    for threads in [1, 2] {
        println!("\n{threads} thread(s); µs per agent and step, medians\n");
        println!("| dimension | agents | bare engine | laws alone | whole step | whole / bare |");
        println!("|---|---|---|---|---|---|");
        let times: Vec<[f64; 2]> = pool(threads).install(|| {
            let both = |&agents: &usize| [compare::<2>(agents), compare::<3>(agents)];
            sizes.iter().map(both).collect()
        });
        println!();
        for (times, sizes) in times.windows(2).zip(sizes.windows(2)) {
            let exponent = |k: usize| {
                let more = (sizes[1] as f64 / sizes[0] as f64).ln();
                1.0 + (times[1][k] / times[0][k]).ln() / more
            };
            println!(
                "From {} to {} agents the step's time grows as N to the {:.2} (2-D), {:.2} (3-D).",
                sizes[0],
                sizes[1],
                exponent(0),
                exponent(1),
            );
        }
    }
    println!("\nLaws and sensing alone, 10,000 agents; µs per agent and step\n");
    println!("| dimension | neighbours | one thread | two threads | ratio |");
    println!("|---|---|---|---|---|");
    laws_alone::<2>(15.6);
    laws_alone::<3>(11.0);
}
