//! What sensing costs: the whole step with each sense against the plain one.
//!
//! `cargo bench --bench sensing` prints a table. All are timed in turns within one run, and
//! the ratio is the median of the rounds' ratios.

mod common;

use common::{median, pool, ratio, seconds};
use serde_json::{Value, json};
use volary::dynamics::{Bodies, Engine};
use volary::law::Flock;
use volary::shape::In;
use volary::world::World;

/// Rounds in which all senses take their turns.
const ROUNDS: usize = 9;

/// Agents of each flock.
const AGENTS: usize = 1_000;

/// An α-lattice in flight, with obstacles amid it.
fn world<const D: usize>(sensing: &Value, scoped: bool) -> World<D>
where
    In<D>: Engine<D>,
{
    let side = 7.0 * (AGENTS as f64 * if D == 2 { 0.95 } else { 0.85 }).powf(1.0 / D as f64);
    let obstacles: Vec<_> = (0..6)
        .map(|k| {
            let at = vec![side * (0.1 + 0.15 * f64::from(k)); D];
            json!({ "shape": { "ball": { "radius": 3 } }, "position": at })
        })
        .collect();
    let mut velocity = vec![0.0; D];
    velocity[0] = 1.0;
    let mut laws = json!([
        { "alpha_interaction": { "spacing": 7, "range": 8.4, "damping": 1 } },
        { "navigation": { "velocity": velocity, "velocity_gain": 2 } }
    ]);
    if scoped {
        laws = json!([{ "scope": { "agents": ["flock"], "neighbours": ["flock"], "laws": laws } }]);
    }
    let spec = json!({
        "dimension": D,
        "time": { "step": 0.01, "end": 1 },
        "agents": [{
            "name": "flock", "count": AGENTS, "radius": 0.5,
            "positions": { "box": {
                "min": vec![0.0; D], "max": vec![side; D], "separation": 4.5
            } },
            "velocities": { "common": velocity },
            "sensing": sensing
        }],
        "obstacles": obstacles,
        "laws": laws
    });
    common::world(spec)
}

fn compare<const D: usize>()
where
    In<D>: Engine<D>,
{
    let senses = [
        ("plain", Value::Null, false),
        ("scope of all", Value::Null, true),
        ("radius", json!({ "radius": 8 }), false),
        (
            "field of view",
            json!({ "field_of_view": { "angle": 2 } }),
            false,
        ),
        (
            "smooth cone",
            json!({ "cone": { "angle": 2, "smooth": true } }),
            false,
        ),
        (
            "blocked by obstacles",
            json!({ "blocked_by": { "obstacles": true } }),
            false,
        ),
        (
            "blocked by bodies",
            json!({ "blocked_by": { "bodies": true } }),
            false,
        ),
        (
            "noise",
            json!({ "noise": { "position": 0.01, "velocity": 0.01 } }),
            false,
        ),
        ("delay of 10 steps", json!({ "delay": 0.1 }), false),
        ("dropout", json!({ "dropout": 0.1 }), false),
        (
            "all of them",
            json!({
                "radius": 8, "field_of_view": { "angle": 2 },
                "cone": { "angle": 2, "smooth": true },
                "blocked_by": { "obstacles": true, "bodies": true },
                "noise": { "position": 0.01, "velocity": 0.01 }, "delay": 0.1, "dropout": 0.1
            }),
            false,
        ),
    ];
    let mut runs: Vec<_> = senses
        .iter()
        .map(|(_, sensing, scoped)| {
            let world = world::<D>(sensing, *scoped);
            let mut flock = Flock::of_world(&world, Vec::new());
            let bodies = Bodies::new(&world, &mut flock).expect("a finite start");
            (flock, bodies)
        })
        .collect();
    let steps = 100;
    let mut times = vec![Vec::new(); runs.len()];
    for _ in 0..ROUNDS {
        for ((flock, bodies), times) in runs.iter_mut().zip(&mut times) {
            times.push(seconds(|| {
                (0..steps).for_each(|_| bodies.step(flock).expect("a finite state"));
            }));
        }
    }
    for ((name, ..), of_one) in senses.iter().zip(&times) {
        let ratio = ratio(of_one, &times[0]);
        let micro = median(of_one.clone()) / (steps * AGENTS) as f64 * 1e6;
        println!("| {D} | {name} | {micro:.3} | {ratio:.2} |");
    }
}

fn main() {
    println!("one thread; µs per agent and whole step, medians of {ROUNDS} rounds\n");
    println!("| dimension | sensing | whole step | over plain |");
    println!("|---|---|---|---|");
    pool(1).install(|| {
        compare::<2>();
        compare::<3>();
    });
}
