//! Masking by third agents, Djokam & Rathinam, App. B, against the plain triple loop.
//!
//! `cargo bench --bench masking` prints a table. Both give the accelerations of the same state,
//! in turns within one run, and must agree. The triple loop runs on one thread.

mod common;

use common::{median, pool, ratio, seconds, timed};
use serde_json::json;
use volary::law::{Field, Flock};
use volary::math::Vector;
use volary::shape::{Geometry, In};
use volary::world::World;

/// Rounds of both in turns.
const ROUNDS: usize = 3;

/// s0 and k, the defaults of world files, and r, less than half of what agents are apart.
const ONSET: f64 = 1.9;
const STRENGTH: f64 = 3000.0;
const RADIUS: f64 = 0.4;

/// A flock of one density, agents at least 0.7 apart, in a box.
fn world<const D: usize>(agents: usize) -> World<D>
where
    In<D>: Geometry<D>,
{
    let side = 1.3 * (agents as f64).powf(1.0 / D as f64);
    let spec = json!({
        "dimension": D,
        "time": { "step": 0.01, "end": 1 },
        "agents": [{
            "count": agents, "radius": 0.05,
            "positions": { "box": {
                "min": vec![0.0; D], "max": vec![side; D], "separation": 0.7
            } },
            "velocities": { "ball": { "radius": 1 } }
        }],
        "laws": [{ "alignment": {
            "kernel": { "cucker_smale": { "strength": 1, "length": 1, "exponent": 0.5 } },
            "normalisation": "motsch_tadmor",
            "masking": { "radius": RADIUS, "onset": ONSET, "strength": STRENGTH }
        } }]
    });
    common::world(spec)
}

/// The accelerations as the formulas say: for each pair, all third agents.
fn triple_loop<const D: usize>(x: &[Vector<D>], v: &[Vector<D>]) -> Vec<Vector<D>> {
    let cosine = |a: &Vector<D>, b: &Vector<D>| {
        let size = (a.norm_squared() * b.norm_squared() + RADIUS.powi(4)).sqrt();
        a.dot(b) / size
    };
    let row = |i: usize| {
        let (mut sum, mut weights) = (Vector::<D>::zeros(), 1.0);
        for j in (0..x.len()).filter(|&j| j != i) {
            let way = x[j] - x[i];
            let mut heights = 0.0;
            for l in (0..x.len()).filter(|&l| l != i && l != j) {
                let (to, back) = (x[l] - x[i], x[l] - x[j]);
                let above = (cosine(&way, &to) + cosine(&-way, &back) - ONSET).max(0.0);
                heights += STRENGTH * above * above * above;
            }
            let weight = (-heights).exp() / (1.0 + way.norm_squared()).sqrt();
            sum += (v[j] - v[i]) * weight;
            weights += weight;
        }
        sum / weights
    };
    (0..x.len()).map(row).collect()
}

fn compare<const D: usize>(agents: usize)
where
    In<D>: Geometry<D>,
{
    let world = world::<D>(agents);
    let (x, v) = (&world.agents.positions, &world.agents.velocities);
    let mut field = Field::of_world(&world);
    let mut out = vec![Vector::zeros(); agents];
    let (mut plain, mut pruned, mut off) = (Vec::new(), Vec::new(), 0.0);
    for _ in 0..ROUNDS {
        let (flock, state): (&mut Flock<D>, _) = field.at(0.0, x, v);
        // The first is not warm yet.
        flock.accelerations(&state, &mut out);
        pruned.push(seconds(|| flock.accelerations(&state, &mut out)));
        let (all, seconds) = timed(|| triple_loop(x, v));
        plain.push(seconds);
        let most = all.iter().map(Vector::norm).fold(0.0, f64::max);
        let differences = all.iter().zip(&out).map(|(a, b)| (a - b).norm() / most);
        off = differences.fold(off, f64::max);
    }
    assert!(off < 1e-9, "they differ by {off}");
    let ratio = ratio(&plain, &pruned);
    let (plain, pruned) = (median(plain), 1e3 * median(pruned));
    println!("| {D} | {agents} | {plain:.2} | {pruned:.2} | {ratio:.0} | {off:.1e} |");
}

fn main() {
    for threads in [1, 2] {
        pool(threads).install(|| {
            println!("\n{threads} thread(s), medians of {ROUNDS} rounds\n");
            println!("| dimension | agents | triple loop, s | pruned, ms | ratio | difference |");
            println!("|---|---|---|---|---|---|");
            for agents in [300, 1_000] {
                compare::<2>(agents);
                compare::<3>(agents);
            }
        });
    }
}
