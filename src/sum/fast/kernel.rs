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
    /// Whether it can be summed fast: a bounded function of the distance that is known, never
    /// ends and has no change of sign, or an attraction in proportion to the distance, or both.
    /// Influences are, but for the bump, for exponents above 4 and for functions of one's own; of
    /// the potentials, the Gaussian one, the attraction and that of Gazi and Passino.
    pub fn is_smooth(&self) -> bool {
        self.parts().is_some()
    }

    /// The function that is bounded, if there is one, and the factor of the way that comes on
    /// top; nothing where it cannot be summed fast.
    pub(super) fn parts(&self) -> Option<(Option<Self>, f64)> {
        let (bounded, factor) = match self {
            Self::Influence(_) | Self::Force(Potential::Gaussian { .. }) => (self.clone(), 0.0),
            Self::Force(Potential::Attraction { stiffness }) => return Some((None, -stiffness)),
            &Self::Force(Potential::GaziPassino {
                attraction,
                repulsion,
                squared_length,
            }) => {
                let bounded = Potential::GaziPassino {
                    attraction: 0.0,
                    repulsion,
                    squared_length,
                };
                (Self::Force(bounded), -attraction)
            }
            Self::Force(_) => return None,
        };
        bounded.with_radial(Known)?;
        Some((Some(bounded), factor))
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

    /// The most that one agent can count for, after the distance at which it does.
    pub(super) fn largest(&self) -> [f64; 2] {
        match self {
            Self::Influence(influence) => [0.0, influence.value(0.0)],
            Self::Force(_) => (-400..400)
                .map(|quarter| libm::exp2(f64::from(quarter) / 4.0))
                .map(|distance| [distance, (self.value(distance * distance) * distance).abs()])
                .fold([0.0; 2], |most, it| if it[1] > most[1] { it } else { most }),
        }
    }

    /// The most that one agent can count for.
    pub(super) fn peak(&self) -> f64 {
        self.largest()[1]
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
