//! Quantities that must never rise.

use super::{Bound, Judging, Side};

impl Judging {
    /// The conclusion that a quantity at each time is at most the least that it has been before,
    /// each value being off by no more than its slack. Margins are shares of the first value.
    pub fn never_rises(&mut self, name: &str, times: &[f64], values: &[f64], slack: &[f64]) {
        let mut least = f64::INFINITY;
        let bounds = values.iter().zip(slack).map(|(value, slack)| {
            let bound = least.min(*value + slack);
            std::mem::replace(&mut least, bound)
        });
        let bounds: Vec<f64> = bounds.collect();
        // Nothing was before the first one.
        let kept = usize::from(values.len() > 1);
        self.bound(Bound {
            name,
            times: times[kept..].to_vec(),
            values: values[kept..].to_vec(),
            bounds: bounds[kept..].to_vec(),
            slack: slack[kept..].to_vec(),
            side: Side::Below,
            scale: values.first().map_or(0.0, |first| first.abs()),
        });
    }
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
    }
}
