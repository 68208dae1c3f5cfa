//! Quantities that must never rise.

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
    pub fn falls(&mut self, falling: Falling<'_>) {
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
        self.measure(format!("{name} at the start"), values[0]);
        self.measure(format!("{name} at the end"), values[values.len() - 1]);
        self.never_rises(name, &times, &values, &slack);
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

    /// The conclusion that a quantity at each time is at most the least that it has been before,
    /// each value being off by no more than its slack and 1e-13 of the largest of all, by which sums
    /// are rounded that were of that size. Margins are shares of what it falls by.
    ///
    /// Of one value there is nothing to conclude.
    pub fn never_rises(&mut self, name: &str, times: &[f64], values: &[f64], slack: &[f64]) {
        if values.len() < 2 {
            return;
        }
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let rounded = 1e-13 * most.abs();
        let slack: Vec<f64> = slack.iter().map(|slack| slack + rounded).collect();
        let mut least = f64::INFINITY;
        let bounds = values.iter().zip(&slack).map(|(value, slack)| {
            let bound = least.min(*value + slack);
            std::mem::replace(&mut least, bound)
        });
        let bounds: Vec<f64> = bounds.collect();
        // Nothing was before the first one.
        self.bound(Bound {
            name,
            times: times[1..].to_vec(),
            values: values[1..].to_vec(),
            bounds: bounds[1..].to_vec(),
            slack: slack[1..].to_vec(),
            side: Side::Below,
            scale: most - least,
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

#[cfg(test)]
mod tests {
    use super::super::Verdict;
    use super::*;

    fn judged(values: &[f64], slack: f64) -> (Verdict, Option<f64>) {
        let times: Vec<f64> = (0..values.len()).map(|k| k as f64).collect();
        let mut judging = Judging::default();
        judging.never_rises("E", &times, values, &vec![slack; values.len()]);
        let finding = judging.finding();
        (finding.verdict, finding.closest)
    }

    #[test]
    fn what_rises_by_more_than_its_slack_is_seen() {
        assert_eq!(judged(&[3.0, 2.0, 2.0, 1.0], 0.0).0, Verdict::Holds);
        assert_eq!(judged(&[3.0, 2.0, 2.1, 1.0], 0.06).0, Verdict::Holds);
        let risen = judged(&[3.0, 2.0, 2.5, 1.0], 0.1);
        assert_eq!(risen, (Verdict::Violated, Some(2.0)));
        // A slow rise adds up.
        let slow = judged(&[3.0, 3.08, 3.16, 3.24, 3.32], 0.1);
        assert_eq!(slow, (Verdict::Violated, Some(4.0)));
        // A run of one state has not been seen to go anywhere.
        assert_eq!(judged(&[3.0], 0.1).0, Verdict::Undecided);
    }
}
