//! From products of cosines and sines to frequencies of both signs, and back.
//!
//! The products of a slab come in blocks, one for each choice of cosine or sine along the first
//! axis and, in space, along the second; each has one row for each frequency along the second
//! axis, of which the first half is with cosines along the last axis and the second half with
//! sines. In the plane there is no second axis.
//!
//! Lines of a slab, one for each frequency along the second axis, are those of frequencies from
//! 0 on, then those of negative ones; each line holds the frequencies along the last axis in
//! the same order, and no padding.

use pulp::{Simd, WithSimd};

use super::gemm::padded;

/// Puts the frequencies of a slab together. Beyond its end, as much as a padded row is
/// overwritten.
pub(super) struct Join<'a, const D: usize> {
    /// Frequencies along an axis that are not negative.
    pub kept: usize,
    pub products: &'a [f64],
    /// Real and imaginary parts.
    pub slab: [&'a mut [f64]; 2],
}

impl<const D: usize> WithSimd for Join<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            kept,
            products,
            slab: [re, im],
        } = self;
        let long = padded(kept);
        let lines = lines::<D>(kept);
        // Registers overlap what comes after them, so all is written in its order.
        for line in 0..2 * lines - 1 {
            let (row, sign) = match line < lines {
                true => (line, 1.0),
                false => (line + 1 - lines, -1.0),
            };
            let blocks = std::array::from_fn(|index| {
                // In the plane there are two of them, and what has no sign.
                let index = if D == 2 { index / 2 } else { index };
                S::as_simd_f64s(&products[(index * lines + row) * 2 * long..][..2 * long]).0
            });
            let sign = simd.splat_f64s(if D == 2 { 0.0 } else { sign });
            let at = line * (2 * kept - 1);
            for (register, first) in (0..long).step_by(S::F64_LANES).enumerate() {
                let [re_even, re_odd, im_even, im_odd] = joined(simd, blocks, sign, register);
                for (out, even, odd) in [(&mut *re, re_even, re_odd), (&mut *im, im_even, im_odd)] {
                    store::<S>(out, at + first, simd.add_f64s(even, odd));
                }
            }
            let middle = at + kept - 1;
            let last = [re[middle], im[middle]];
            for (register, first) in (0..long).step_by(S::F64_LANES).enumerate() {
                let [re_even, re_odd, im_even, im_odd] = joined(simd, blocks, sign, register);
                for (out, even, odd) in [(&mut *re, re_even, re_odd), (&mut *im, im_even, im_odd)] {
                    store::<S>(out, middle + first, simd.sub_f64s(even, odd));
                }
            }
            // Frequency 0 has no other sign.
            [re[middle], im[middle]] = last;
        }
    }
}

/// Lines of a slab that are not of negative frequencies.
fn lines<const D: usize>(kept: usize) -> usize {
    kept.pow(D as u32 - 2)
}

/// Real parts, even and odd in the frequency along the last axis, and imaginary ones. Each sine
/// comes with −i, and with the sign of its frequency.
#[inline(always)]
fn joined<S: Simd>(simd: S, blocks: [&[S::f64s]; 4], sign: S::f64s, j: usize) -> [S::f64s; 4] {
    let [a, b, c, d] = blocks;
    let k = a.len() / 2 + j;
    [
        simd.negate_mul_add_f64s(sign, d[j], a[j]),
        simd.neg_f64s(simd.mul_add_f64s(sign, b[k], c[k])),
        simd.neg_f64s(simd.mul_add_f64s(sign, b[j], c[j])),
        simd.sub_f64s(simd.mul_f64s(sign, d[k]), a[k]),
    ]
}

#[inline(always)]
fn store<S: Simd>(to: &mut [f64], at: usize, value: S::f64s) {
    S::as_mut_simd_f64s(&mut to[at..at + S::F64_LANES]).0[0] = value;
}

#[inline(always)]
fn load<S: Simd>(from: &[f64], at: usize) -> S::f64s {
    S::as_simd_f64s(&from[at..at + S::F64_LANES]).0[0]
}

/// The other way: writes what cosines and sines are to be multiplied by.
pub(super) struct Split<'a, const D: usize> {
    /// Frequencies along an axis that are not negative.
    pub kept: usize,
    /// Real and imaginary parts, as much longer as a padded row is.
    pub slab: [&'a [f64]; 2],
    /// 1 for the frequencies of a padded row that have another sign, 0 for others.
    pub signed: &'a [f64],
    pub products: &'a mut [f64],
}

impl<const D: usize> WithSimd for Split<'_, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            kept,
            slab: [re, im],
            signed,
            products,
        } = self;
        let long = padded(kept);
        let lines = lines::<D>(kept);
        for row in 0..lines {
            let here = row * (2 * kept - 1);
            // Where there is no other line, there is no weight.
            let (opposite, weight) = match row {
                0 => (here, 0.0),
                row => ((lines - 1 + row) * (2 * kept - 1), 1.0),
            };
            let weight = simd.splat_f64s(weight);
            for first in (0..long).step_by(S::F64_LANES) {
                let signed = load::<S>(signed, first);
                let mut sums = [[[weight; 2]; 2]; 2];
                for (sums, from) in sums.iter_mut().zip([re, im]) {
                    let at = [here + first, opposite + first];
                    *sums = over_signs(simd, from, at, kept, [signed, weight]);
                }
                let [
                    [[re_00, re_10], [re_01, re_11]],
                    [[im_00, im_10], [im_01, im_11]],
                ] = sums;
                // Each sine comes with i.
                let plain = [
                    re_00,
                    simd.neg_f64s(im_01),
                    simd.neg_f64s(im_10),
                    simd.neg_f64s(re_11),
                ];
                let turned = [
                    simd.neg_f64s(im_00),
                    simd.neg_f64s(re_01),
                    simd.neg_f64s(re_10),
                    im_11,
                ];
                let blocks = if D == 2 { 1 } else { 2 };
                for kind in 0..2 * blocks {
                    let block = kind / 2;
                    let at = (block * lines + row) * 2 * long + kind % 2 * long + first;
                    store::<S>(products, at, plain[kind]);
                    store::<S>(products, at + blocks * lines * 2 * long, turned[kind]);
                }
            }
        }
    }
}

/// Sum and difference of the lines at two places over signs of the last axis, and of each
/// those over the lines, the second of which has a weight.
#[inline(always)]
fn over_signs<S: Simd>(
    simd: S,
    from: &[f64],
    at: [usize; 2],
    kept: usize,
    [signed, weight]: [S::f64s; 2],
) -> [[S::f64s; 2]; 2] {
    let mut sums = [[weight; 2]; 2];
    for (sums, at) in sums.iter_mut().zip(at) {
        let plus = load::<S>(from, at);
        let minus = load::<S>(from, at + kept - 1);
        sums[0] = simd.mul_add_f64s(signed, minus, plus);
        sums[1] = simd.negate_mul_add_f64s(signed, minus, plus);
    }
    let [here, opposite] = sums;
    let mut over = [[weight; 2]; 2];
    for kind in 0..2 {
        over[kind][0] = simd.mul_add_f64s(weight, opposite[kind], here[kind]);
        over[kind][1] = simd.negate_mul_add_f64s(weight, opposite[kind], here[kind]);
    }
    over
}
