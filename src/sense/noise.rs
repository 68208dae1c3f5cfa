//! Random numbers of links: errors of what is perceived, and links that are lost.
//!
//! Every number is a hash of what it is for: the world's seed, the step, who perceives,
//! who is perceived, and which number of that link it is. So it depends on no other draw,
//! whoever else is there and on however many threads. The hash is a chain of the
//! finalizers of SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable
//! pseudorandom number generators", 2014), one for each part of the key.

use crate::math::{Vector, normal_quantile};

/// The random numbers of one link in one step.
#[derive(Debug, Clone, Copy)]
pub struct LinkDraws(u64);

impl LinkDraws {
    /// Those of agent `i` perceiving agent `j` (indices of the world) in a step.
    pub fn new(seed: u64, step: u64, i: usize, j: usize) -> Self {
        let parts = [seed, step, i as u64, j as u64];
        Self(parts.into_iter().fold(0, mix))
    }

    /// Whether the link is lost, where a share `probability` of all links is.
    pub fn is_lost(&self, probability: f64) -> bool {
        self.unit(0) < probability
    }

    /// The error of the way to the other agent: normal, with this standard deviation in
    /// each coordinate.
    pub fn offset_error<const D: usize>(&self, deviation: f64) -> Vector<D> {
        Vector::from_fn(|k, _| deviation * normal_quantile(self.unit(1 + k as u64)))
    }

    /// The error of the other agent's velocity, likewise.
    pub fn velocity_error<const D: usize>(&self, deviation: f64) -> Vector<D> {
        Vector::from_fn(|k, _| deviation * normal_quantile(self.unit(9 + k as u64)))
    }

    /// A number uniform in (0, 1), with 52 random bits: never an end, and as finely spaced
    /// at both.
    fn unit(&self, number: u64) -> f64 {
        ((mix(self.0, number) >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64)
    }
}

/// A hash so far and the next part of the key, well mixed.
fn mix(hash: u64, part: u64) -> u64 {
    let mut z = (hash ^ part).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_pinned() {
        // Whoever changes these changes every world with noise.
        let draws = LinkDraws::new(1, 2, 3, 4);
        assert_eq!(
            [draws.unit(0), draws.unit(1)],
            [0.40633139146067065, 0.11064932604680566]
        );
    }

    /// Mean, variance and excess kurtosis.
    fn moments(values: &[f64]) -> [f64; 3] {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let power = |k| values.iter().map(|x| (x - mean).powi(k)).sum::<f64>() / n;
        [mean, power(2), power(4) / (power(2) * power(2)) - 3.0]
    }

    #[test]
    fn errors_are_normal_and_independent_along_every_part_of_the_key() {
        let keys: [fn(u64) -> LinkDraws; 4] = [
            |k| LinkDraws::new(k, 5, 0, 1),
            |k| LinkDraws::new(7, k, 0, 1),
            |k| LinkDraws::new(7, 5, k as usize, 1),
            |k| LinkDraws::new(7, 5, 0, k as usize),
        ];
        let n = 40_000u64;
        for key in keys {
            let errors: Vec<Vector<3>> = (0..n).map(|k| key(k).offset_error(2.0)).collect();
            let others: Vec<Vector<3>> = (0..n).map(|k| key(k).velocity_error(2.0)).collect();
            let x: Vec<f64> = errors.iter().map(|e| e[0]).collect();
            let [mean, variance, excess] = moments(&x);
            // Five standard errors: 2/√n, 4√(2/n), √(24/n).
            assert!(mean.abs() < 0.05, "{mean}");
            assert!((variance - 4.0).abs() < 0.15, "{variance}");
            assert!(excess.abs() < 0.13, "{excess}");
            let product = |f: &dyn Fn(usize) -> f64| (1..x.len()).map(f).sum::<f64>() / n as f64;
            for correlation in [
                product(&|k| x[k] * x[k - 1]),
                product(&|k| x[k] * errors[k][1]),
                product(&|k| errors[k][1] * errors[k][2]),
                product(&|k| x[k] * others[k][0]),
            ] {
                assert!(correlation.abs() < 0.1, "{correlation}");
            }
        }
    }

    #[test]
    fn links_are_lost_at_their_rate() {
        for rate in [0.0, 0.1, 0.75, 1.0] {
            let lost = (0..20_000)
                .filter(|&k| LinkDraws::new(3, k, 8, 9).is_lost(rate))
                .count();
            assert!((lost as f64 / 20_000.0 - rate).abs() <= 0.02 * rate * (1.0 - rate) * 8.0);
        }
    }
}
