//! How all benchmarks measure.

#![allow(dead_code, reason = "each benchmark uses some of it")]

use std::time::Instant;

use rayon::{ThreadPool, ThreadPoolBuilder};
use serde_json::Value;
use volary::shape::{Geometry, In};
use volary::world::World;

/// The seconds that some work takes.
pub fn seconds(work: impl FnOnce()) -> f64 {
    timed(work).1
}

/// What some work comes to, and the seconds that it takes.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let begin = Instant::now();
    let done = work();
    (done, begin.elapsed().as_secs_f64())
}

/// The median of some values.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The median of the ratios of each round's times.
pub fn ratio(over: &[f64], under: &[f64]) -> f64 {
    median(over.iter().zip(under).map(|(a, b)| a / b).collect())
}

/// So many threads.
pub fn pool(threads: usize) -> ThreadPool {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads can be made")
}

/// A world from JSON that is known to be sound.
pub fn world<const D: usize>(spec: Value) -> World<D>
where
    In<D>: Geometry<D>,
{
    let spec = serde_json::from_value(spec).expect("the world is well formed");
    World::new("benchmark", spec).expect("the world is sound")
}
