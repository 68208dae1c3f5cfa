//! Energies that never rise.

use super::{Bound, Judging, Side};

/// An energy that must never rise, at each of some times.
#[derive(Debug, Clone)]
pub struct Falling<'a> {
    /// What it is, as a formula.
    pub name: &'a str,
    /// The times.
    pub times: Vec<f64>,
    /// The values.
    pub values: Vec<f64>,
    /// What each value may be off.
    pub slack: Vec<f64>,
    /// Its rate of change along the motion, by velocities and accelerations.
    pub rates: Vec<f64>,
    /// What each rate may be off.
    pub rate_slack: Vec<f64>,
}

impl Judging {
    /// The conclusion that an energy never rises along the run: its rate of change is nowhere
    /// above 0, and no value exceeds the least one before it.
    ///
    /// Both matter. Rates are those of the laws in the states seen, and say nothing of whether
    /// the run is a motion of these laws; values at the times seen say nothing of what happens
    /// in between. A run of one state has not been seen to go anywhere.
    pub fn never_rises(&mut self, falling: Falling<'_>) {
        let Falling {
            name,
            times,
            values,
            slack,
            rates,
            rate_slack,
        } = falling;
        if times.len() < 2 {
            return;
        }
        let (mut least, mut bounds, mut allowed) = (0, Vec::new(), Vec::new());
        for k in 0..values.len() {
            bounds.push(values[least]);
            allowed.push(slack[k] + slack[least]);
            if values[k] < values[least] {
                least = k;
            }
        }
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let fallen = most - values[least];
        self.measure(format!("{name} at the start"), values[0]);
        self.measure(format!("{name} at the end"), values[values.len() - 1]);
        self.bound(Bound {
            name,
            times: times.clone(),
            values,
            bounds,
            slack: allowed,
            side: Side::Below,
            scale: fallen,
        });
        let steepest = rates.iter().map(|rate| rate.abs()).fold(0.0, f64::max);
        self.bound(Bound {
            name: &format!("d/dt {name}"),
            bounds: vec![0.0; times.len()],
            times,
            values: rates,
            slack: rate_slack,
            side: Side::Below,
            scale: steepest,
        });
    }
}

/// What sums of powers may be off by rounding, by the sizes of their terms at each of some times:
/// 1e-9 of these, and 1e-12 of the largest of all, since where agents rest the forces of which
/// these terms are made cancel.
pub(super) fn rounding(sizes: &[f64]) -> Vec<f64> {
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let each = sizes.iter().map(|size| 1e-9 * size + 1e-12 * largest);
    each.collect()
}
