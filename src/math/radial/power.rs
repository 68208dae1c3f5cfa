//! Negative powers whose exponents are known beforehand, on lanes.

use pulp::Simd;

use crate::math::radial::lanes::{InversePower, inverse_root};

/// x^(−β) for normal x up to 2^1000.
pub(super) trait Power: Copy + Send + Sync + 'static {
    fn of<S: Simd>(&self, simd: S, x: S::f64s) -> S::f64s;
}

/// What can be done with any power.
pub(super) trait WithPower {
    type Output;

    fn with<P: Power>(self, power: P) -> Self::Output;
}

/// The largest exponent that there are powers of.
const LARGEST_EXPONENT: f64 = 4.0;

/// Does something with the power −β, 0 < β ≤ 4; nothing beyond.
pub(super) fn with_power<V: WithPower>(exponent: f64, visitor: V) -> Option<V::Output> {
    if exponent <= 0.0 || exponent > LARGEST_EXPONENT {
        return None;
    }
    let quarters = 4.0 * exponent;
    if quarters.fract() != 0.0 {
        return Some(match exponent < 1.0 {
            true => visitor.with(InversePower::<21>::new(exponent)),
            false => visitor.with(InversePower::<28>::new(exponent)),
        });
    }
    let quarters = quarters as u32;
    let (whole, rest) = (quarters / 4, quarters % 4);
    Some(match (whole, rest) {
        (1, 0) => visitor.with(Root::<1>),
        (0, 2) => visitor.with(Root::<2>),
        (0, 1) => visitor.with(Root::<4>),
        (whole, 0) => visitor.with(Repeated(Root::<1>, whole)),
        (_, 2) => visitor.with(Repeated(Root::<2>, quarters / 2)),
        (0, odd) => visitor.with(Repeated(Root::<4>, odd)),
        (whole, odd) => visitor.with((Repeated(Root::<4>, odd), Repeated(Root::<1>, whole))),
    })
}

/// x^(−1/R), R = 1, 2 or 4.
#[derive(Clone, Copy)]
struct Root<const R: u32>;

impl<const R: u32> Power for Root<R> {
    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, x: S::f64s) -> S::f64s {
        inverse_root::<S, R>(simd, x)
    }
}

/// A power, multiplied by itself to make this many factors.
#[derive(Clone, Copy)]
struct Repeated<P>(P, u32);

impl<P: Power> Power for Repeated<P> {
    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, x: S::f64s) -> S::f64s {
        let factor = self.0.of(simd, x);
        (1..self.1).fold(factor, |product, _| simd.mul_f64s(product, factor))
    }
}

impl<const N: usize> Power for InversePower<N> {
    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, x: S::f64s) -> S::f64s {
        InversePower::of(self, simd, x)
    }
}

/// The product of two powers.
impl<P: Power, Q: Power> Power for (P, Q) {
    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, x: S::f64s) -> S::f64s {
        simd.mul_f64s(self.0.of(simd, x), self.1.of(simd, x))
    }
}
