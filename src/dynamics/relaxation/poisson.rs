//! Tails of the Poisson distribution.

/// The tails P(X > k) of a Poisson variable X, for all k.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tails {
    /// Number of the first tail that differs from 1 by more than rounding.
    first: usize,
    /// The tails from there on, and their sums Σ_{j ≥ k}; beyond, all are 0.
    tails: Vec<f64>,
    sums: Vec<f64>,
}

/// Probabilities below this share of the largest one are left out.
const LEAST: f64 = 1e-19;

impl Tails {
    /// The tails for a mean ≥ 0, finite.
    pub(super) fn new(mean: f64) -> Self {
        // From the mode outwards, where nothing underflows; only then made to add up to one.
        let mode = mean.floor();
        let mut below = Vec::new();
        let (mut k, mut weight) = (mode, 1.0);
        while k > 0.0 && weight > LEAST {
            weight *= k / mean;
            k -= 1.0;
            below.push(weight);
        }
        let first = k as usize;
        let mut weights: Vec<f64> = below.into_iter().rev().collect();
        weights.push(1.0);
        let (mut k, mut weight) = (mode, 1.0);
        while weight > LEAST {
            k += 1.0;
            weight *= mean / k;
            weights.push(weight);
        }
        let total: f64 = weights.iter().sum();
        let (mut tail, mut sum) = (0.0, 0.0);
        let mut tails = vec![0.0; weights.len()];
        let mut sums = tails.clone();
        for (k, weight) in weights.iter().enumerate().rev() {
            tails[k] = tail;
            sum += tail;
            sums[k] = sum;
            tail += weight / total;
        }
        Self { first, tails, sums }
    }

    /// How many tails there are that are not 0.
    pub(super) fn len(&self) -> usize {
        self.first + self.tails.len() - 1
    }

    /// P(X > k).
    pub(super) fn tail(&self, k: usize) -> f64 {
        match k.checked_sub(self.first) {
            None => 1.0,
            Some(k) => self.tails.get(k).copied().unwrap_or(0.0),
        }
    }

    /// Σ_{j ≥ k} P(X > j), the mean of what X is above k.
    pub(super) fn sum_from(&self, k: usize) -> f64 {
        match k.checked_sub(self.first) {
            None => (self.first - k) as f64 + self.sums[0],
            Some(k) => self.sums.get(k).copied().unwrap_or(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_of_a_small_mean_are_those_of_the_series() {
        let tails = Tails::new(1.5);
        let (mut weight, mut tail) = ((-1.5f64).exp(), 1.0);
        for k in 0..20 {
            tail -= weight;
            assert!((tails.tail(k) - tail).abs() < 1e-15, "{k}");
            weight *= 1.5 / (k + 1) as f64;
        }
        assert_eq!(tails.tail(100), 0.0);
        assert_eq!(Tails::new(0.0).tail(0), 0.0);
    }

    #[test]
    fn tails_add_up_to_the_mean() {
        for mean in [0.0, 0.3, 1.0, 7.0, 316.0, 12_345.6, 1e6] {
            let tails = Tails::new(mean);
            assert!(
                (tails.sum_from(0) - mean).abs() < 1e-9 * mean.max(1.0),
                "{mean}"
            );
            let k = mean as usize + 2;
            let rest: f64 = (k..=tails.len()).map(|k| tails.tail(k)).sum();
            assert!((tails.sum_from(k) - rest).abs() < 1e-12 * mean.max(1.0));
            // A Poisson variable is about as often above its mean as below.
            if mean > 1e5 {
                assert!((tails.tail(mean as usize) - 0.5).abs() < 0.01);
            }
        }
    }
}
