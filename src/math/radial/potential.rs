//! Forces of potentials on lanes.

use pulp::Simd;

use crate::math::Potential;
use crate::math::radial::lanes::{exp, inverse_root};
use crate::math::radial::{Radial, WithRadial, is_tame};

impl Potential {
    /// Does something with the force over the distance, −V'(r)/r, as a [`Radial`] function:
    /// [`Potential::force_over_distance`] on lanes. Nothing where it has none: lengths whose
    /// square is beyond [`LARGEST_SQUARE`](crate::math::LARGEST_SQUARE).
    ///
    /// Where the force grows without bound from near, distances below 1.5e-154, whose squares
    /// are not normal numbers, count as that; 0 is 0.
    pub fn with_radial<V: WithRadial>(&self, visitor: V) -> Option<V::Output> {
        let tame = |square: f64| is_tame(square).then_some(());
        match *self {
            Self::Bond { stiffness, length } => Some(visitor.with(Bond { stiffness, length })),
            Self::Attraction { stiffness } => Some(visitor.with(Attraction { stiffness })),
            Self::Gaussian { height, decay } => {
                tame(decay)?;
                Some(visitor.with(Gaussian {
                    attraction: 0.0,
                    height: 2.0 * height * decay,
                    decay,
                }))
            }
            Self::GaziPassino {
                attraction,
                repulsion,
                squared_length,
            } => {
                tame(squared_length)?;
                Some(visitor.with(Gaussian {
                    attraction,
                    height: repulsion,
                    decay: 1.0 / squared_length,
                }))
            }
            Self::Logarithmic {
                attraction,
                repulsion,
            } => Some(visitor.with(Logarithmic {
                attraction,
                repulsion,
            })),
            Self::Morse {
                attraction,
                attraction_length,
                repulsion,
                repulsion_length,
            } => {
                tame(attraction_length * attraction_length)?;
                tame(repulsion_length * repulsion_length)?;
                Some(visitor.with(Morse {
                    attraction: [attraction / attraction_length, -1.0 / attraction_length],
                    repulsion: [repulsion / repulsion_length, -1.0 / repulsion_length],
                }))
            }
        }
    }
}

/// Square distances, the least normal number where they are less.
#[inline(always)]
fn apart<S: Simd>(simd: S, squared: S::f64s) -> S::f64s {
    simd.max_f64s(squared, simd.splat_f64s(f64::MIN_POSITIVE))
}

/// Values where the squared distance is not 0, and 0 where it is.
#[inline(always)]
fn unless_zero<S: Simd>(simd: S, squared: S::f64s, values: S::f64s) -> S::f64s {
    let zero = simd.splat_f64s(0.0);
    simd.select_f64s(simd.greater_than_f64s(squared, zero), values, zero)
}

/// k_a (η/r − 1).
#[derive(Clone, Copy)]
struct Bond {
    stiffness: f64,
    length: f64,
}

impl Radial for Bond {
    fn scale(&self) -> f64 {
        self.stiffness
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s {
        let inverse = inverse_root::<S, 2>(simd, apart(simd, squared));
        let length = simd.splat_f64s(self.length);
        let values = simd.mul_add_f64s(inverse, length, simd.splat_f64s(-1.0));
        unless_zero(simd, squared, values)
    }
}

/// −k_a.
#[derive(Clone, Copy)]
struct Attraction {
    stiffness: f64,
}

impl Radial for Attraction {
    fn scale(&self) -> f64 {
        self.stiffness
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s {
        unless_zero(simd, squared, simd.splat_f64s(-1.0))
    }
}

/// b exp(−μ r²) − a.
#[derive(Clone, Copy)]
struct Gaussian {
    attraction: f64,
    height: f64,
    decay: f64,
}

impl Radial for Gaussian {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s {
        let x = simd.mul_f64s(squared, simd.splat_f64s(-self.decay));
        let height = simd.splat_f64s(self.height);
        let attraction = simd.splat_f64s(-self.attraction);
        let values = simd.mul_add_f64s(exp(simd, x), height, attraction);
        unless_zero(simd, squared, values)
    }
}

/// 2 (b/r² − a)/r².
#[derive(Clone, Copy)]
struct Logarithmic {
    attraction: f64,
    repulsion: f64,
}

impl Radial for Logarithmic {
    fn scale(&self) -> f64 {
        2.0
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s {
        let inverse = inverse_root::<S, 1>(simd, apart(simd, squared));
        let repulsion = simd.splat_f64s(self.repulsion);
        let attraction = simd.splat_f64s(-self.attraction);
        let difference = simd.mul_add_f64s(inverse, repulsion, attraction);
        unless_zero(simd, squared, simd.mul_f64s(difference, inverse))
    }
}

/// (C_r/l_r exp(−r/l_r) − C_a/l_a exp(−r/l_a))/r; of each the height and the rate, −1/l.
#[derive(Clone, Copy)]
struct Morse {
    attraction: [f64; 2],
    repulsion: [f64; 2],
}

impl Radial for Morse {
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s {
        let apart = apart(simd, squared);
        let inverse = inverse_root::<S, 2>(simd, apart);
        let distance = simd.mul_f64s(apart, inverse);
        let slope = |[height, rate]: [f64; 2]| {
            let decayed = exp(simd, simd.mul_f64s(distance, simd.splat_f64s(rate)));
            simd.mul_f64s(decayed, simd.splat_f64s(height))
        };
        let difference = simd.sub_f64s(slope(self.repulsion), slope(self.attraction));
        unless_zero(simd, squared, simd.mul_f64s(difference, inverse))
    }
}
