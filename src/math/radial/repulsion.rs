//! The repulsion of Cucker and Dong.

use pulp::Simd;

use crate::math::radial::power::{Power, WithPower, with_power};
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
        match is_tame(self.floor) && self.squared_distance <= crate::math::LARGEST_SQUARE {
            true => with_power(self.exponent, Visitor(self, visitor)),
            false => None,
        }
    }
}

/// f with its power.
#[derive(Clone, Copy)]
struct Powered<P>(Repulsion, P);

impl<P: Power> Radial for Powered<P> {
    fn scale(&self) -> f64 {
        self.0.strength
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s {
        let beyond = simd.sub_f64s(squared, simd.splat_f64s(self.0.squared_distance));
        let beyond = simd.max_f64s(beyond, simd.splat_f64s(self.0.floor));
        self.1.of(simd, beyond)
    }
}

struct Visitor<V>(Repulsion, V);

impl<V: WithRadial> WithPower for Visitor<V> {
    type Output = V::Output;

    fn with<P: Power>(self, power: P) -> V::Output {
        self.1.with(Powered(self.0, power))
    }
}
