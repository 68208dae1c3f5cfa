//! Influence kernels on lanes.

use pulp::Simd;

use crate::math::Influence;
use crate::math::radial::lanes::exp;
use crate::math::radial::power::{Power, WithPower, with_power};
use crate::math::radial::{Radial, WithRadial, is_tame};

impl Influence {
    /// Does something with the kernel as a [`Radial`] function; nothing where it has none: a
    /// function of one's own, the bump, exponents above 4, and lengths whose square is beyond
    /// [`LARGEST_SQUARE`](crate::math::LARGEST_SQUARE).
    pub fn with_radial<V: WithRadial>(&self, visitor: V) -> Option<V::Output> {
        match *self {
            Self::Constant(strength) => Some(visitor.with(Constant(strength))),
            Self::CuckerSmale {
                strength, exponent, ..
            } if exponent == 0.0 => Some(visitor.with(Constant(strength))),
            Self::CuckerSmale {
                strength,
                length,
                exponent,
            } if is_tame(length * length) => {
                let visitor = CuckerSmaleWith {
                    strength,
                    squared_length: length * length,
                    visitor,
                };
                with_power(exponent, visitor)
            }
            Self::Exponential { strength, length } if is_tame(length * length) => {
                Some(visitor.with(Exponential { strength, length }))
            }
            _ => None,
        }
    }
}

/// The same at any distance.
#[derive(Clone, Copy)]
struct Constant(f64);

impl Radial for Constant {
    fn scale(&self) -> f64 {
        self.0
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, _squared: S::f64s) -> S::f64s {
        simd.splat_f64s(1.0)
    }
}

/// K/(σ² + r²)^β.
#[derive(Clone, Copy)]
struct CuckerSmale<P> {
    strength: f64,
    squared_length: f64,
    power: P,
}

impl<P: Power> Radial for CuckerSmale<P> {
    fn scale(&self) -> f64 {
        self.strength
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s {
        let shift = simd.splat_f64s(self.squared_length);
        self.power.of(simd, simd.add_f64s(squared, shift))
    }
}

/// Makes a kernel of a power.
struct CuckerSmaleWith<V> {
    strength: f64,
    squared_length: f64,
    visitor: V,
}

impl<V: WithRadial> WithPower for CuckerSmaleWith<V> {
    type Output = V::Output;

    fn with<P: Power>(self, power: P) -> V::Output {
        self.visitor.with(CuckerSmale {
            strength: self.strength,
            squared_length: self.squared_length,
            power,
        })
    }
}

/// K exp(−r/ℓ).
#[derive(Clone, Copy)]
struct Exponential {
    strength: f64,
    length: f64,
}

impl Radial for Exponential {
    fn scale(&self) -> f64 {
        self.strength
    }

    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s {
        let distance = simd.sqrt_f64s(squared);
        let rate = simd.splat_f64s(-1.0 / self.length);
        exp(simd, simd.mul_f64s(distance, rate))
    }
}
