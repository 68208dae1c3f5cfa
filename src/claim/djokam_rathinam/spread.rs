//! Diameters of sets, and how fast they change.

use crate::claim::{Bound, Judging, Run, Side};
use crate::math::Vector;
use crate::metric::Observation;

/// A diameter: the two that are farthest apart, and how far.
#[derive(Clone, Copy)]
pub(super) struct Spread {
    pub pair: [usize; 2],
    pub length: f64,
    /// d/dt of the length, of this pair; 0 where the length is.
    pub rate: f64,
}

/// The diameter of some points that change at these rates. By Lemma 7 its derivative is that
/// of a pair that spans it.
pub(super) fn spread<const D: usize>(points: &[Vector<D>], rates: &[Vector<D>]) -> Spread {
    let mut best = ([0, 0], 0.0);
    for (i, x) in points.iter().enumerate() {
        for (j, y) in points.iter().enumerate().skip(i + 1) {
            let squared = (x - y).norm_squared();
            if squared > best.1 {
                best = ([i, j], squared);
            }
        }
    }
    let ([p, q], squared) = best;
    let length = squared.sqrt();
    let rate = match length > 0.0 {
        true => (points[p] - points[q]).dot(&(rates[p] - rates[q])) / length,
        false => 0.0,
    };
    Spread {
        pair: [p, q],
        length,
        rate,
    }
}

/// d_V and its derivative.
pub(super) fn velocity_spread<const D: usize>(seen: &Observation<D>) -> Spread {
    spread(&seen.velocities, &seen.accelerations)
}

/// d_X and its derivative.
pub(super) fn position_spread<const D: usize>(seen: &Observation<D>) -> Spread {
    spread(&seen.positions, &seen.velocities)
}

/// The largest speed.
pub(super) fn largest_speed<const D: usize>(seen: &Observation<D>) -> f64 {
    seen.velocities.iter().map(Vector::norm).fold(0.0, f64::max)
}

/// The conclusion that a quantity grows from one observation to the next by no more than these
/// rates allow: by the larger of the rates at either end, and what they differ by, times the
/// time between.
pub(super) fn grows_at_most<const D: usize>(
    judging: &mut Judging,
    run: &Run<'_, D>,
    name: &str,
    values: &[f64],
    rates: &[f64],
    slack: impl Fn(&Observation<D>) -> f64,
) {
    let times = run.times();
    let allowed = (1..times.len()).map(|k| {
        let (before, now) = (rates[k - 1], rates[k]);
        let rate = before.max(now) + (now - before).abs();
        values[k - 1] + (times[k] - times[k - 1]) * rate.max(0.0)
    });
    let bounds: Vec<f64> = allowed.collect();
    let slacks = run.observations.windows(2);
    judging.bound(Bound {
        name,
        times: times.get(1..).unwrap_or_default().to_vec(),
        values: values.get(1..).unwrap_or_default().to_vec(),
        bounds,
        slack: slacks
            .map(|pair| slack(&pair[0]) + slack(&pair[1]))
            .collect(),
        side: Side::Below,
        scale: 0.0,
    });
}
