//! An integrator that shares nothing with the program: Gragg's extrapolated midpoint rule of
//! order 16, on right-hand sides that are plain loops.

use volary::dynamics::{Accuracy, Dynamics};
use volary::math::Vector;
use volary::simulation::Simulation;
use volary::world::{AnyWorld, Document, Override, World, shipped};

/// Columns of the table of extrapolation.
const COLUMNS: usize = 8;

/// One step, its error known from the last two columns.
fn gragg(
    f: &mut impl FnMut(f64, &[f64], &mut [f64]),
    t: f64,
    y: &[f64],
    h: f64,
) -> (Vec<f64>, f64) {
    let n = y.len();
    let mut table: Vec<Vec<f64>> = Vec::new();
    let mut slope = vec![0.0; n];
    let mut first = vec![0.0; n];
    f(t, y, &mut first);
    let mut error = f64::INFINITY;
    for j in 0..COLUMNS {
        let parts = 2 * (j + 1);
        let s = h / parts as f64;
        let mut before = y.to_vec();
        let mut now: Vec<f64> = (0..n).map(|k| y[k] + s * first[k]).collect();
        for m in 1..parts {
            f(t + m as f64 * s, &now, &mut slope);
            for k in 0..n {
                let after = before[k] + 2.0 * s * slope[k];
                before[k] = now[k];
                now[k] = after;
            }
        }
        f(t + h, &now, &mut slope);
        let mut entry: Vec<f64> = (0..n)
            .map(|k| 0.5 * (now[k] + before[k] + s * slope[k]))
            .collect();
        // Neville's scheme in 1/parts².
        for (column, row) in table.iter_mut().enumerate() {
            let ratio = (parts as f64 / (2.0 * (j - column) as f64)).powi(2);
            let old = std::mem::replace(row, entry.clone());
            entry = (0..n)
                .map(|k| entry[k] + (entry[k] - old[k]) / (ratio - 1.0))
                .collect();
        }
        if j + 1 == COLUMNS {
            let last = &table[j - 1];
            error = (0..n)
                .map(|k| (entry[k] - last[k]).abs())
                .fold(0.0, f64::max);
        }
        table.push(entry);
    }
    (table.pop().expect("some columns"), error)
}

/// Goes on to a time, with errors of about `tolerance` in each step, as a share of the largest
/// entry.
pub fn integrate(
    f: &mut impl FnMut(f64, &[f64], &mut [f64]),
    [begin, end]: [f64; 2],
    mut y: Vec<f64>,
    tolerance: f64,
) -> Vec<f64> {
    let (mut t, mut h) = (begin, 1e-3);
    while t < end {
        let last = h >= end - t;
        let step = if last { end - t } else { h };
        let (after, error) = gragg(f, t, &y, step);
        let error = error / y.iter().map(|y| y.abs()).fold(1.0, f64::max);
        if error <= tolerance {
            y = after;
            t = if last { end } else { t + step };
        }
        let factor = (0.8 * (tolerance / error).powf(1.0 / 15.0)).clamp(0.2, 3.0);
        h = if error <= tolerance {
            h.max(step * factor)
        } else {
            step * factor.min(0.8)
        };
        h = h.min(0.5);
        assert!(h > 1e-9, "the reference gets stuck at {t}");
    }
    y
}

/// As [`integrate`], where the slope depends on links, which `links` tells of a state: they
/// are held until they are others, and that time is found by halving.
pub fn integrate_linked(
    f: &mut impl FnMut(&[bool], &[f64], &mut [f64]),
    links: impl Fn(&[f64]) -> Vec<bool>,
    end: f64,
    mut y: Vec<f64>,
    tolerance: f64,
) -> (Vec<f64>, usize) {
    let (mut t, mut changes) = (0.0, 0);
    let mut held = links(&y);
    while t < end {
        let h = f64::min(0.02, end - t);
        let mut go = |h: f64| {
            integrate(
                &mut |_, y, out| f(&held, y, out),
                [0.0, h],
                y.clone(),
                tolerance,
            )
        };
        let after = go(h);
        if links(&after) == held {
            y = after;
            t = if end - t <= 0.02 { end } else { t + h };
            continue;
        }
        let (mut low, mut high) = (0.0, h);
        while high - low > 1e-15 {
            let middle = 0.5 * (low + high);
            match links(&go(middle)) == held {
                true => low = middle,
                false => high = middle,
            }
        }
        y = go(high);
        t += high;
        held = links(&y);
        changes += 1;
    }
    (y, changes)
}

/// A shipped world of the plane, with some fields set.
pub fn shipped_world(name: &str, sets: &[&str]) -> World<2> {
    let text = shipped::get(name).unwrap_or_else(|| panic!("{name} is not shipped"));
    let sets = sets
        .iter()
        .map(|set| set.parse::<Override>().expect("a path and a value"));
    match Document::new(name, text).with(sets).world(name) {
        Ok(AnyWorld::Plane(world)) => world,
        Ok(_) => panic!("{name} is not in the plane"),
        Err(report) => panic!("{report}"),
    }
}

/// Points of a world, to some accuracy.
pub fn points<const D: usize>(world: World<D>, relative: f64) -> Simulation<D>
where
    volary::shape::In<D>: volary::dynamics::Engine<D>,
{
    let dynamics = Dynamics::Points(Accuracy { relative });
    Simulation::with_dynamics(world, Vec::new(), dynamics).expect("a world of points")
}

/// Takes a simulation to a time.
pub fn run_to<const D: usize>(simulation: &mut Simulation<D>, time: f64) {
    while simulation.snapshot().time < time - 1e-9 {
        simulation.step().expect("a finite state");
    }
}

/// The coordinates of all positions, then of all velocities.
pub fn flat<const D: usize>(positions: &[Vector<D>], velocities: &[Vector<D>]) -> Vec<f64> {
    let vectors = positions.iter().chain(velocities);
    vectors.flat_map(|v| v.as_slice().to_vec()).collect()
}

/// The largest differences of positions and of velocities, each as a share of the largest.
pub fn difference(a: &[f64], b: &[f64]) -> f64 {
    let half = a.len() / 2;
    let share = |a: &[f64], b: &[f64]| {
        let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        apart.fold(0.0, f64::max) / b.iter().map(|b| b.abs()).fold(0.0, f64::max)
    };
    f64::max(share(&a[..half], &b[..half]), share(&a[half..], &b[half..]))
}

/// What a simulation differs by from a reference.
pub fn difference_from<const D: usize>(simulation: &Simulation<D>, reference: &[f64]) -> f64 {
    let state = simulation.snapshot();
    difference(&flat(state.positions, state.velocities), reference)
}
