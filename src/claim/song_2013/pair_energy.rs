//! What the energy W says of the distance between two agents.
//!
//! In both models W is ½ Σ |v̂_i|² + Σ_{i<j} u(r_ij) with one energy u for every pair. In (12)
//! u(r) = k_a/2 (r − η)² + Ψ(r). In (19) the centre term is, by Lemma 9,
//! k_a/2 Σ |x̂_i|² = k_a/(2N) Σ_{i<j} r_ij², so there u(r) = k_a/(2N) r² + Ψ(r).
//!
//! With Ψ = Q exp(−μ r²), −u'(r)/r falls in r: it is k_a(η/r − 1) or −k_a/N, plus
//! 2Qμ exp(−μ r²). So u falls down to one distance r*, and rises from there on. Every pair but
//! one has at least u* = u(r*), of M = N(N − 1)/2 pairs; hence at all times
//!
//! u(r_ij) ≤ W(0) − (M − 1) u*,
//!
//! and r_ij is at least the one distance below r* where that is an equality. For N ≤ 3 all other
//! pairs can be r* apart at once, so nothing nearer to the truth follows from W(0) alone.

use crate::math::Potential;

/// Halvings of an interval: enough to leave nothing of it.
const HALVINGS: usize = 200;

/// The energy u of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PairEnergy {
    /// What draws the two together.
    pub(super) cohesion: Potential,
    /// Ψ.
    pub(super) repulsion: Potential,
}

impl PairEnergy {
    /// u at a distance.
    pub(super) fn value(&self, distance: f64) -> f64 {
        self.cohesion.value(distance) + self.repulsion.value(distance)
    }

    /// r*, where u is least; 0 where nothing repels, infinite where nothing draws.
    pub(super) fn rest(&self) -> f64 {
        let repels = |r: f64| {
            let force = |of: Potential| of.force_over_distance(r * r);
            force(self.cohesion) + force(self.repulsion) > 0.0
        };
        let mut far = 1.0;
        while repels(far) {
            far *= 2.0;
            if far == f64::INFINITY {
                return far;
            }
        }
        bisected(0.0, far, repels)
    }

    /// The nearest that two agents can be where u is at most `energy`; 0 where any distance will
    /// do.
    pub(super) fn nearest(&self, energy: f64) -> f64 {
        if self.value(0.0) <= energy {
            return 0.0;
        }
        bisected(0.0, self.rest(), |r| self.value(r) > energy)
    }
}

/// Where a condition that is met near `from` ends: a number at which it is still met.
fn bisected(mut from: f64, mut to: f64, met: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        match met(middle) {
            true => from = middle,
            false => to = middle,
        }
    }
    from
}

#[cfg(test)]
mod tests {
    use super::*;

    const REPULSION: Potential = Potential::Gaussian {
        height: 40.0,
        decay: 1.8,
    };

    #[test]
    fn rests_where_the_slope_is_zero() {
        let attraction = Potential::Attraction { stiffness: 0.001 };
        let pair = PairEnergy {
            cohesion: attraction,
            repulsion: REPULSION,
        };
        let rest = (libm::log(2.0 * 40.0 * 1.8 / 0.001) / 1.8).sqrt();
        assert!((pair.rest() - rest).abs() < 1e-12);
        let strong = Potential::Attraction { stiffness: 200.0 };
        let pair = PairEnergy {
            cohesion: strong,
            repulsion: REPULSION,
        };
        assert_eq!((pair.rest(), pair.nearest(30.0)), (0.0, 0.0));
    }

    #[test]
    fn nearest_is_where_the_energy_is_used_up() {
        let bond = Potential::Bond {
            stiffness: 2.0,
            length: 1.5,
        };
        let pair = PairEnergy {
            cohesion: bond,
            repulsion: REPULSION,
        };
        let at = pair.nearest(30.0);
        assert!(at > 0.0 && at < pair.rest());
        assert!((pair.value(at) - 30.0).abs() < 1e-10);
        assert_eq!(pair.nearest(42.3), 0.0);
        let least = pair.value(pair.rest());
        for k in 0..400 {
            assert!(pair.value(0.01 * f64::from(k)) >= least - 1e-12);
        }
    }
}
