//! The repulsion of Cucker and Dong.

use pulp::Simd;

use crate::math::radial::lanes::InversePower;
use crate::math::radial::power::LARGEST_EXPONENT;
use crate::math::radial::{Radial, WithRadial, is_tame};

/// f(s) = K/(s − d0)^θ, a function of the squared distance s, with s − d0 not below a floor:
/// Cucker & Dong, as in Song et al. (2013), (3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repulsion {
    /// K ≥ 0.
    pub strength: f64,
    /// θ > 0.
    pub exponent: f64,
    /// d0 (length²).
    pub squared_distance: f64,
    /// The least s − d0 that f is taken at (length²), > 0.
    pub floor: f64,
}

impl Repulsion {
    /// f at a squared distance.
    pub fn value(self, squared: f64) -> f64 {
        let beyond = (squared - self.squared_distance).max(self.floor);
        self.strength / libm::pow(beyond, self.exponent)
    }

    /// Does something with f as a [`Radial`] function; nothing where it has none: exponents
    /// above 4, and squares beyond [`LARGEST_SQUARE`](crate::math::LARGEST_SQUARE).
    pub fn with_radial<V: WithRadial>(self, visitor: V) -> Option<V::Output> {
        let tame = is_tame(self.floor) && self.squared_distance <= crate::math::LARGEST_SQUARE;
        (tame && self.exponent <= LARGEST_EXPONENT).then(|| {
            visitor.with(OnLanes {
                repulsion: self,
                power: InversePower::new(self.exponent),
            })
        })
    }
}

/// f with its power.
#[derive(Clone, Copy)]
struct OnLanes {
    repulsion: Repulsion,
    power: InversePower<28>,
}

impl Radial for OnLanes {
    fn scale(&self) -> f64 {
        self.repulsion.strength
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s {
        let nearest = simd.splat_f64s(self.repulsion.squared_distance);
        let beyond = simd.sub_f64s(squared, nearest);
        let beyond = simd.max_f64s(beyond, simd.splat_f64s(self.repulsion.floor));
        self.power.of(simd, beyond)
    }
}
