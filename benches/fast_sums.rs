//! Fast sums over all pairs against direct ones.
//!
//! `cargo bench --bench fast_sums` prints tables, on one thread and on two. Both ways are timed in
//! turns within one run, and the ratio is the median of the rounds' ratios. Errors are those of
//! some sums against plain loops, as the documentation of `volary::sum::fast` measures them.

mod common;

use common::{median, pool, ratio, seconds};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use volary::math::{Influence, Potential, Vector};
use volary::sum::fast::{FastSums, Kernel};
use volary::sum::{Cloud, Point, Sums, direct};

/// Rounds in turns.
const ROUNDS: usize = 3;

/// Agents whose sums are looked at.
const LOOKED_AT: usize = 50;

/// Agents in a box of some side, with velocities.
fn flock<const D: usize>(count: usize, side: f64) -> [Vec<Vector<D>>; 2] {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut draw = || (random.next_u64() >> 11) as f64 * 0.5f64.powi(53);
    let mut vectors = |size: f64| {
        (0..count)
            .map(|_| Vector::from_fn(|_, _| draw() * size))
            .collect()
    };
    [vectors(side), vectors(1.0)]
}

/// Prints a row of times, and returns that of the fast sums.
fn compare<const D: usize>(name: &str, kernel: &Kernel, count: usize, side: f64) -> f64 {
    let [positions, velocities] = flock::<D>(count, side);
    let carried = match kernel {
        Kernel::Influence(_) => &velocities,
        Kernel::Force(_) => &positions,
    };
    let mut fast = FastSums::new(kernel.clone(), 1e-6).expect("a smooth kernel");
    let mut sums = Vec::new();
    assert!(fast.run(&positions, carried, &mut sums), "nodes do");
    // Direct sums of more than so many are those of so many, times the square of the ratio.
    let part = count.min(20_000);
    let mut cloud = Cloud::default();
    cloud.refill((0..part).map(|number| Point {
        number,
        position: positions[number],
        carried: carried[number],
    }));
    let scale = (count as f64 / part as f64).powi(2);
    let (mut slow, mut quick) = (Vec::new(), Vec::new());
    let direct = match kernel {
        Kernel::Influence(influence) => direct(influence),
        Kernel::Force(potential) => direct(potential),
    };
    let direct = direct.expect("a known kernel");
    for _ in 0..ROUNDS {
        slow.push(scale * seconds(|| direct.mutual(&cloud, &mut sums)));
        quick.push(seconds(|| {
            fast.run(&positions, carried, &mut sums);
        }));
    }
    let ratio = ratio(&slow, &quick);
    let (slow, quick) = (median(slow), median(quick));
    let error = error(kernel, &positions, carried, &sums);
    println!(
        "| {name} | {D} | {count} | {side:.0} | {slow:.3} | {quick:.3} | {ratio:.1} | {error:.0e} |"
    );
    quick
}

/// The largest error of some sums, over what they would be if no terms cancelled.
fn error<const D: usize>(
    kernel: &Kernel,
    positions: &[Vector<D>],
    carried: &[Vector<D>],
    sums: &[Sums<D>],
) -> f64 {
    let middle = carried.iter().sum::<Vector<D>>() / carried.len() as f64;
    let spread = |k: usize| (carried[k] - middle).norm();
    let of = |i: usize| {
        let (mut drive, mut size) = (Vector::zeros(), 0.0);
        for (j, position) in positions.iter().enumerate() {
            let squared = (position - positions[i]).norm_squared();
            let value = match kernel {
                Kernel::Influence(influence) => influence.value(squared),
                Kernel::Force(potential) => potential.force_over_distance(squared),
            };
            drive += (carried[j] - carried[i]) * value;
            size += match kernel {
                Kernel::Influence(_) => value * (spread(i) + spread(j)),
                Kernel::Force(_) => value * squared.sqrt(),
            };
        }
        (sums[i].drive - drive).norm() / size
    };
    let some = (0..LOOKED_AT).map(|k| of(k * positions.len() / LOOKED_AT));
    some.fold(0.0, f64::max)
}

/// The most memory that was ever held, in GiB, where the system tells.
fn memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0 / 1024.0)
}

fn series<const D: usize>(name: &str, kernel: &Kernel, side: impl Fn(usize) -> f64) {
    let counts = [10_000, 30_000, 100_000, 1_000_000];
    let times = counts.map(|count| compare::<D>(name, kernel, count, side(count)));
    let exponent = (times[3] / times[0]).log10() / 2.0;
    let memory = memory().map_or("unknown".to_owned(), |gib| format!("{gib:.2} GiB"));
    println!("\n{name}, {D}-D: time grows from 10,000 to 1,000,000 like N^{exponent:.2};");
    println!("memory so far at most {memory}.\n");
}

fn head(threads: usize) {
    println!("On {threads} thread(s):\n");
    println!(
        "| kernel | dimension | agents | side | direct, s | fast, s | direct / fast | error |"
    );
    println!("|---|---|---|---|---|---|---|---|");
}

fn main() {
    let influence = Kernel::Influence(Influence::CuckerSmale {
        strength: 1.0,
        length: 1.0,
        exponent: 0.5,
    });
    let gaussian = Kernel::Force(Potential::Gaussian {
        height: 1.0,
        decay: 1.0,
    });
    pool(1).install(|| {
        head(1);
        // A length of the kernel apart, so that the box grows.
        series::<2>("Cucker-Smale", &influence, |count| (count as f64).sqrt());
        series::<3>("Cucker-Smale", &influence, |count| (count as f64).cbrt());
        head(1);
        for count in [10_000, 100_000] {
            compare::<2>("Gaussian", &gaussian, count, (count as f64).sqrt());
            compare::<3>("Gaussian", &gaussian, count, (count as f64).cbrt());
        }
        // Around where `auto` begins, agents a third of a length and three lengths apart.
        for apart in [1.0 / 3.0, 1.0, 3.0] {
            let count = FastSums::<2>::CROSSOVER;
            let side = apart * (count as f64).sqrt();
            compare::<2>("Cucker-Smale", &influence, count, side);
            let count = FastSums::<3>::CROSSOVER;
            let side = apart * (count as f64).cbrt();
            compare::<3>("Cucker-Smale", &influence, count, side);
        }
        println!();
    });
    pool(2).install(|| {
        head(2);
        compare::<2>("Cucker-Smale", &influence, 100_000, 100_000f64.sqrt());
        compare::<3>("Cucker-Smale", &influence, 100_000, 100_000f64.cbrt());
    });
}
