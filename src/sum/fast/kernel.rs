//! What is summed.

use crate::math::{Influence, Potential, WithRadial};

/// A kernel whose sums over all pairs may be wanted fast.
#[derive(Debug, Clone)]
pub enum Kernel {
    /// Influence by distance: Σ_j φ(r_ij²) and Σ_j φ(r_ij²)(c_j − c_i) are wanted.
    Influence(Influence),
    /// The force of a potential: Σ_j f(r_ij²)(x_j − x_i) is wanted, with f = −V'(r)/r.
    Force(Potential),
}

impl Kernel {
    /// Whether it can be summed fast: a bounded function of the distance that is known, never ends
    /// and has no change of sign. Influences are, but for the bump, for exponents above 4
    /// and for functions of one's own; of the potentials, the Gaussian one.
    pub fn is_smooth(&self) -> bool {
        match self {
            Self::Influence(influence) => influence.with_radial(Known).is_some(),
            Self::Force(potential @ Potential::Gaussian { .. }) => {
                potential.with_radial(Known).is_some()
            }
            Self::Force(_) => false,
        }
    }

    /// Whether it is multiplied by the way between the two.
    pub(super) fn along(&self) -> bool {
        matches!(self, Self::Force(_))
    }

    /// Its value by the square of the distance.
    pub(super) fn value(&self, squared: f64) -> f64 {
        match self {
            Self::Influence(influence) => influence.value(squared),
            // At 0 it is multiplied by nothing; that it is no exception there keeps it smooth.
            Self::Force(potential) => potential.force_over_distance(squared.max(f64::MIN_POSITIVE)),
        }
    }

    /// The most that one agent can count for.
    pub(super) fn peak(&self) -> f64 {
        match self {
            Self::Influence(influence) => influence.value(0.0),
            Self::Force(_) => (-400..400)
                .map(|quarter| libm::exp2(f64::from(quarter) / 4.0))
                .map(|distance| (self.value(distance * distance) * distance).abs())
                .fold(0.0, f64::max),
        }
    }

    /// Does something with it on the lanes of vector registers.
    pub(super) fn with_radial<V: WithRadial>(&self, visitor: V) -> Option<V::Output> {
        match self {
            Self::Influence(influence) => influence.with_radial(visitor),
            Self::Force(potential) => potential.with_radial(visitor),
        }
    }
}

/// Asks no more than whether a function is known.
struct Known;

impl WithRadial for Known {
    type Output = ();

    fn with<K: crate::math::Radial>(self, _radial: K) {}
}
