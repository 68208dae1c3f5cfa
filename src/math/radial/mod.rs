//! Functions of the squared distance, of many distances at once.
//!
//! [`Influence`](crate::math::Influence) and [`Potential`](crate::math::Potential) hold the
//! formulas for one distance. Here are the same for the lanes of a processor's vector
//! registers: to a few units in the last place the same values, and to the bit the same on
//! every processor, however many lanes it has.

mod influence;
mod lanes;
mod potential;
mod power;
mod repulsion;
#[cfg(test)]
mod tests;

pub(crate) use lanes::exp;
pub use repulsion::Repulsion;

use pulp::{Arch, Scalar128b, Simd, WithSimd, bytemuck::cast};

/// A function of the squared distance, on the lanes of vector registers.
///
/// Squared distances go from 0 to [`LARGEST_SQUARE`].
pub trait Radial: Copy + Send + Sync + 'static {
    /// What lanes are to be multiplied by: a constant factor of all values, which sums take
    /// out of their loops.
    fn scale(&self) -> f64 {
        1.0
    }

    /// The values at some squared distances, over the [scale](Radial::scale).
    fn lanes<S: Simd>(&self, simd: S, squared: S::f64s) -> S::f64s;

    /// The value at one squared distance: the bits of a lane's, times the scale. Slower than
    /// the same by `Influence` or `Potential`.
    fn value(&self, squared: f64) -> f64 {
        let simd = Scalar128b;
        let lanes: [f64; 2] = cast(self.lanes(simd, simd.splat_f64s(squared)));
        lanes[0] * self.scale()
    }
}

/// The largest squared distance, and the largest or least square of a length that a function
/// may have: 2^1000 or 2^−1000. Squares beyond are worked out one by one.
pub const LARGEST_SQUARE: f64 = f64::from_bits((1023 + 1000) << 52);

/// What can be done with any radial function: compiled for each, so that nothing is decided
/// in its loops.
pub trait WithRadial {
    /// What comes of it.
    type Output;

    /// Does it with one.
    fn with<K: Radial>(self, radial: K) -> Self::Output;
}

/// Does what it is given with the widest registers that the processor has.
#[inline]
pub fn vectorized<Op: WithSimd>(op: Op) -> Op::Output {
    match Arch::new() {
        // As many lanes as others have, for what takes numbers apart needs whole ones.
        Arch::Scalar => op.with_simd(Scalar128b),
        arch => arch.dispatch(op),
    }
}

/// 1/√x for normal x up to [`LARGEST_SQUARE`], to one unit in the last place.
#[inline(always)]
pub(crate) fn inverse_square_root<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    lanes::inverse_root::<S, 2>(simd, x)
}

/// Whether a square, of a length or of what is added to one, is within what lanes take.
fn is_tame(square: f64) -> bool {
    (1.0 / LARGEST_SQUARE..=LARGEST_SQUARE).contains(&square)
}
