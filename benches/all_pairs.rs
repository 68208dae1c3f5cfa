//! Laws of all pairs against the plain double loop.
//!
//! `cargo bench --bench all_pairs` prints tables. All ways to sum are timed in turns within
//! one run, and ratios are medians of the rounds' ratios.

mod common;

use std::hint::black_box;

use common::{median, pool, ratio, seconds};
use serde_json::json;
use volary::law::{Flock, State, build};
use volary::math::{Influence, Vector};
use volary::shape::{Geometry, In};
use volary::sum::{Cloud, Point, direct};

/// Rounds in which all ways take their turns.
const ROUNDS: usize = 9;

/// Agents of the plain double loop, whose time for a pair is the same for any number.
const PLAIN: usize = 1_000;

/// A flock on a jittered grid.
struct Agents<const D: usize> {
    positions: Vec<Vector<D>>,
    velocities: Vec<Vector<D>>,
}

impl<const D: usize> Agents<D> {
    fn new(count: usize) -> Self {
        let side = (count as f64).powf(1.0 / D as f64).ceil() as usize;
        let jitter = |k: usize| 0.5 * ((k as f64 * 0.618_033_988_749_894_9) % 1.0);
        let vector = |k: usize, cell: bool| {
            Vector::from_fn(|axis, _| {
                let index = k / side.pow(axis as u32) % side;
                f64::from(u8::from(cell)) * index as f64 + jitter(3 * k + axis)
            })
        };
        Self {
            positions: (0..count).map(|k| vector(k, true)).collect(),
            velocities: (0..count).map(|k| vector(k, false)).collect(),
        }
    }

    fn cloud(&self) -> Cloud<D> {
        let mut cloud = Cloud::default();
        let agents = self.positions.iter().zip(&self.velocities).enumerate();
        cloud.refill(agents.map(|(number, (&position, &carried))| Point {
            number,
            position,
            carried,
        }));
        cloud
    }

    /// The sums as laws took them before: one agent after the other, one kernel after the
    /// other.
    fn plain(&self, kernel: &Influence) -> Vec<Vector<D>> {
        let agents = || self.positions.iter().zip(&self.velocities);
        agents()
            .map(|(position, velocity)| {
                let (mut sum, mut drive) = (0.0, Vector::zeros());
                for (other, carried) in agents() {
                    let weight = kernel.value((other - position).norm_squared());
                    sum += weight;
                    drive += (carried - velocity) * weight;
                }
                drive / sum
            })
            .collect()
    }
}

/// Nanoseconds for each ordered pair.
fn for_each_pair(count: usize, work: impl FnOnce()) -> f64 {
    seconds(work) * 1e9 / (count * count) as f64
}

/// A flock of one law, Motsch and Tadmor's with this exponent.
fn flock<const D: usize>(count: usize, exponent: f64) -> Flock<D>
where
    In<D>: Geometry<D>,
{
    let positions = &Agents::<D>::new(count).positions;
    let rows: Vec<_> = positions.iter().map(|x| x.as_slice().to_vec()).collect();
    let spec = json!({
        "dimension": D,
        "time": { "step": 0.01, "end": 1 },
        "agents": [{ "radius": 0.01, "positions": { "explicit": rows } }],
        "laws": [{ "alignment": {
            "kernel": { "cucker_smale": { "strength": 1, "length": 1, "exponent": exponent } },
            "normalisation": "motsch_tadmor",
            "summation": "direct"
        } }]
    });
    Flock::new(build(&common::world::<D>(spec)))
}

/// Times the law through the flock: nanoseconds for each ordered pair.
fn law<const D: usize>(flock: &mut Flock<D>, agents: &Agents<D>) -> f64 {
    let count = agents.positions.len();
    let (groups, masses) = (vec![0; count], vec![1.0; count]);
    let state = State {
        time: 0.0,
        positions: &agents.positions,
        velocities: &agents.velocities,
        headings: &agents.velocities,
        groups: &groups,
        masses: &masses,
        rotations: &[],
        obstacles: &[],
    };
    let mut out = vec![Vector::zeros(); count];
    for_each_pair(count, || flock.accelerations(&state, &mut out))
}

fn compare<const D: usize>(count: usize, exponent: f64)
where
    In<D>: Geometry<D>,
{
    let kernel = Influence::CuckerSmale {
        strength: 1.0,
        length: 1.0,
        exponent,
    };
    let agents = Agents::<D>::new(count);
    let few = Agents::<D>::new(PLAIN);
    let cloud = agents.cloud();
    let mut flock = flock(count, exponent);
    let direct = direct(&kernel).expect("the kernel is known");
    let mut sums = Vec::new();
    let pools = [pool(1), pool(2)];
    let mut times: [Vec<f64>; 4] = Default::default();
    for _ in 0..ROUNDS {
        let plain = for_each_pair(PLAIN, || {
            black_box(few.plain(&kernel));
        });
        let bare = pools[0].install(|| for_each_pair(count, || direct.mutual(&cloud, &mut sums)));
        let by_threads = [0, 1].map(|k: usize| pools[k].install(|| law(&mut flock, &agents)));
        times[0].push(plain);
        times[1].push(bare);
        times[2].push(by_threads[0]);
        times[3].push(by_threads[1]);
    }
    let [plain, bare, one, two] = &times;
    println!(
        "| {D} | {count} | {exponent} | {:.2} | {:.3} | {:.3} | {:.3} | {:.1} | {:.2} |",
        median(plain.clone()),
        median(bare.clone()),
        median(one.clone()),
        median(two.clone()),
        ratio(plain, one),
        ratio(one, two),
    );
}

fn main() {
    println!("\nNanoseconds for each ordered pair, medians of {ROUNDS} rounds\n");
    println!(
        "| dimension | agents | β | plain loop | bare sum | law | law, 2 threads | plain / law \
         | law / 2 threads |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for exponent in [0.5, 0.25, 1.0, 0.3] {
        compare::<2>(10_000, exponent);
        compare::<3>(10_000, exponent);
    }
    for count in [300, 1_000, 3_000, 30_000] {
        compare::<2>(count, 0.5);
    }
}
