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
pub(super) const LARGEST_EXPONENT: f64 = 4.0;

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
    // Each kind is compiled apart, so there are not many of them.
    Some(match quarters {
        1 => visitor.with(Root::<4>),
        2 => visitor.with(Root::<2>),
        4 => visitor.with(Root::<1>),
        _ => visitor.with(Quarters {
            whole: quarters / 4,
            rest: quarters % 4,
        }),
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

/// x^(−whole − rest/4), rest < 4.
#[derive(Clone, Copy)]
struct Quarters {
    whole: u32,
    rest: u32,
}

impl Power for Quarters {
    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, x: S::f64s) -> S::f64s {
        let mut product = simd.splat_f64s(1.0);
        if self.rest == 2 {
            product = inverse_root::<S, 2>(simd, x);
        } else if self.rest > 0 {
            let root = inverse_root::<S, 4>(simd, x);
            for _ in 0..self.rest {
                product = simd.mul_f64s(product, root);
            }
        }
        if self.whole > 0 {
            let inverse = inverse_root::<S, 1>(simd, x);
            for _ in 0..self.whole {
                product = simd.mul_f64s(product, inverse);
            }
        }
        product
    }
}

impl<const N: usize> Power for InversePower<N> {
    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, x: S::f64s) -> S::f64s {
        InversePower::of(self, simd, x)
    }
}
