//! Dense starts, where links come and go all the time: all runs end, in bounded work.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::json;
use volary::dynamics::{Accuracy, Dynamics};
use volary::law::Law;
use volary::math::Vector;
use volary::sense::Scene;
use volary::simulation::Simulation;
use volary::world::World;

use crate::common::{spec, world};

/// Counts how often laws are asked, and asks for nothing.
struct Count(Arc<AtomicUsize>);

impl Law<2> for Count {
    fn name(&self) -> &str {
        "count"
    }

    fn prepare(&mut self, _: &Scene<'_, 2>) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    fn accelerate(&self, _: &Scene<'_, 2>, _: usize, _: &mut [Vector<2>]) {}
}

/// Numbers from 0 to 1 that look random.
fn draws(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn start(seed: u64, count: usize, protocol: &str) -> World<2> {
    let mut draw = draws(seed);
    let side = (count as f64).sqrt() * (1.0 + 4.0 * draw());
    let speed = f64::max(0.0, 4.0 * draw() - 2.0);
    let mut places = Vec::new();
    let mut velocities = Vec::new();
    for _ in 0..count {
        places.push([side * draw(), side * draw()]);
        velocities.push([speed * (draw() - 0.5), speed * (draw() - 0.5)]);
    }
    world(spec(json!({
        "dimension": 2,
        "time": { "step": 0.01, "end": 2 },
        "record": { "every": 2 },
        "agents": [{
            "radius": 1e-5,
            "positions": { "explicit": places }, "velocities": { "explicit": velocities }
        }],
        "laws": [{ "alpha_interaction": {
            "spacing": 7, "range": 8.4, "damping": 3.0 * draw().round() + 1.0, "protocol": protocol
        } }]
    })))
}

/// How often the laws are asked in a run, and how often they jump.
fn work(world: World<2>, relative: f64, steps: usize) -> (usize, u64) {
    let asked = Arc::new(AtomicUsize::new(0));
    let count: Box<dyn Law<2>> = Box::new(Count(Arc::clone(&asked)));
    let dynamics = Dynamics::Points(Accuracy { relative });
    let mut simulation =
        Simulation::with_dynamics(world, vec![count], dynamics).expect("a finite start");
    // What it takes to choose a solver is no matter of jumps.
    asked.store(0, Ordering::Relaxed);
    for _ in 0..steps {
        simulation.step().expect("it ends");
    }
    let jumps = simulation.solver().expect("points have a solver").jumps;
    (asked.load(Ordering::Relaxed), jumps)
}

/// Against laws that fade out, whose start is the same.
fn runs_end(seeds: std::ops::Range<u64>, steps: usize, most: usize) {
    let mut worst: f64 = 0.0;
    for seed in seeds {
        let count = 40 + (seed as usize * 37) % (most - 40);
        let relative = if seed % 2 == 0 { 1e-7 } else { 1e-10 };
        let (faded, none) = work(
            start(seed, count, "smooth_weighted_damping"),
            relative,
            steps,
        );
        assert_eq!(none, 0);
        for protocol in ["nonsmooth", "smooth", "approximate"] {
            let (asked, jumps) = work(start(seed, count, protocol), relative, steps);
            let ratio = asked as f64 / faded as f64;
            worst = worst.max(ratio);
            assert!(
                ratio <= 5.0,
                "{seed}: {count} points, {protocol}: {ratio}, {jumps} jumps"
            );
        }
    }
    println!("at most {worst} times the work");
}

#[test]
fn dense_starts_end() {
    runs_end(0..8, 40, 100);
}

#[test]
#[ignore = "some minutes"]
fn a_thousand_dense_starts_end() {
    runs_end(100..434, 200, 200);
}
