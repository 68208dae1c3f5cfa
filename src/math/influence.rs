//! Influence as a function of distance.

use std::fmt;
use std::sync::Arc;

use crate::math::Bump;

/// The influence φ(r) that an agent at the distance r has on another: the kernel of Cucker
/// and Smale, and others. Its values are the same on every platform, but for those of a
/// function of one's own.
#[derive(Clone)]
pub enum Influence {
    /// The same at any distance.
    Constant(f64),
    /// K/(σ² + r²)^β: Djokam & Rathinam, below (1.1), where σ is called a.
    CuckerSmale {
        /// K ≥ 0.
        strength: f64,
        /// σ > 0, the distance up to which the influence hardly falls.
        length: f64,
        /// β ≥ 0, half the power with which it falls far away.
        exponent: f64,
    },
    /// K ρ(r/R), which is 0 from the distance R on; ρ is the [`Bump`].
    Bump {
        /// K ≥ 0.
        strength: f64,
        /// R > 0.
        range: f64,
        /// ρ.
        bump: Bump,
    },
    /// K exp(−r/ℓ).
    Exponential {
        /// K ≥ 0.
        strength: f64,
        /// ℓ > 0.
        length: f64,
    },
    /// A function of one's own, of the *squared* distance r² ≥ 0; its values must be ≥ 0,
    /// and the same for the same distance.
    Own(Arc<dyn Fn(f64) -> f64 + Send + Sync>),
}

impl Influence {
    /// A function of one's own, of the squared distance.
    pub fn own(function: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::Own(Arc::new(function))
    }

    /// The influence at a squared distance r² ≥ 0.
    pub fn value(&self, squared: f64) -> f64 {
        match self {
            Self::Constant(strength) => *strength,
            Self::CuckerSmale {
                strength,
                length,
                exponent,
            } => strength * inverse_power(length * length + squared, *exponent),
            Self::Bump {
                strength,
                range,
                bump,
            } => strength * bump.value(squared.sqrt() / range),
            Self::Exponential { strength, length } => {
                strength * libm::exp(-squared.sqrt() / length)
            }
            Self::Own(function) => function(squared),
        }
    }

    /// The largest influence at any distance; infinite for a function of one's own, of
    /// which nothing is known.
    pub fn largest(&self) -> f64 {
        match self {
            Self::Own(_) => f64::INFINITY,
            falling => falling.value(0.0),
        }
    }

    /// The distance from which on there is no influence; infinite where it never ends.
    pub fn reach(&self) -> f64 {
        match self {
            Self::Bump { range, .. } => *range,
            _ => f64::INFINITY,
        }
    }
}

impl Default for Influence {
    /// 1 at any distance.
    fn default() -> Self {
        Self::Constant(1.0)
    }
}

impl fmt::Debug for Influence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(strength) => write!(f, "{strength}"),
            Self::CuckerSmale {
                strength,
                length,
                exponent,
            } => write!(f, "{strength}/({length}² + r²)^{exponent}"),
            Self::Bump {
                strength,
                range,
                bump,
            } => write!(f, "{strength}·ρ(r/{range}), {bump:?}"),
            Self::Exponential { strength, length } => write!(f, "{strength}·exp(−r/{length})"),
            Self::Own(_) => f.write_str("Own(…)"),
        }
    }
}

/// x^(−β), by roots for the exponents that are met most.
fn inverse_power(x: f64, exponent: f64) -> f64 {
    match exponent {
        0.25 => x.sqrt().sqrt().recip(),
        0.5 => x.sqrt().recip(),
        1.0 => x.recip(),
        _ => libm::pow(x, -exponent),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_are_what_their_formulas_say() {
        let cucker_smale = Influence::CuckerSmale {
            strength: 2.0,
            length: 3.0,
            exponent: 0.4,
        };
        let bump = Influence::Bump {
            strength: 2.0,
            range: 4.0,
            bump: Bump::new(0.5),
        };
        let exponential = Influence::Exponential {
            strength: 2.0,
            length: 3.0,
        };
        for r in [0.0, 0.1, 1.0, 2.9, 30.0] {
            let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-15 * b, "{r}: {a} {b}");
            near(cucker_smale.value(r * r), 2.0 / (9.0 + r * r).powf(0.4));
            near(exponential.value(r * r), 2.0 * (-r / 3.0).exp());
            near(bump.value(r * r), 2.0 * Bump::new(0.5).value(r / 4.0));
            assert_eq!(
                Influence::own(|squared| squared + 1.0).value(r * r),
                r * r + 1.0
            );
            for kernel in [&cucker_smale, &bump, &exponential, &Influence::default()] {
                assert!(kernel.value(r * r) <= kernel.largest());
                assert!(r < kernel.reach() || kernel.value(r * r) == 0.0);
            }
        }
        assert_eq!(cucker_smale.value(f64::INFINITY), 0.0);
        assert_eq!(exponential.value(f64::INFINITY), 0.0);
    }
}
