//! Heights over third agents, of eight pairs at a time.

use pulp::{Simd, WithSimd};

use crate::law::alignment::masking::clusters::{Clusters, Eight};
use crate::law::alignment::masking::region::Region;
use crate::math::{LARGEST_SQUARE, Vector, exp, inverse_square_root};

/// Registers that make eight lanes, at most: of two lanes each.
const MOST: usize = 4;

/// The factors of (B.1) for one agent and up to eight others.
///
/// Every number is worked out alike for both of a pair, and the heights of third agents come in
/// the order of the clusters; those that are 0 change nothing. So a pair's factor is the same to
/// the last bit whoever looks, and whatever other pairs there are.
pub(super) struct Factors<'a, const D: usize> {
    pub clusters: &'a Clusters<D>,
    pub start: &'a Vector<D>,
    /// At least one, and at most eight.
    pub ends: &'a [Vector<D>],
    /// T and W.
    pub widths: [f64; 2],
    /// r⁴.
    pub softening: f64,
    /// s0.
    pub onset: f64,
    /// k.
    pub strength: f64,
}

/// One register of pairs.
#[derive(Clone, Copy)]
struct Pairs<S: Simd, const D: usize> {
    ends: [S::f64s; D],
    way: [S::f64s; D],
    back: [S::f64s; D],
    /// Square of the way's length.
    squared: S::f64s,
    /// Σ (s − s0)³.
    sum: S::f64s,
}

impl<const D: usize> WithSimd for Factors<'_, D> {
    type Output = Eight;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Eight {
        let start = splat(simd, &(*self.start).into());
        // Lanes without a pair repeat the first.
        let end = |lane: usize| self.ends.get(lane).unwrap_or(&self.ends[0]);
        let ends: [Eight; D] =
            std::array::from_fn(|axis| std::array::from_fn(|lane| end(lane)[axis]));
        let parts = 8 / S::F64_LANES;
        let mut pairs = [Pairs::new(simd, &start, start); MOST];
        for (part, pairs) in pairs[..parts].iter_mut().enumerate() {
            let mut registers = start;
            for axis in 0..D {
                registers[axis] = S::as_simd_f64s(&ends[axis]).0[part];
            }
            *pairs = Pairs::new(simd, &start, registers);
        }
        let softening = simd.splat_f64s(self.softening);
        let onset = simd.splat_f64s(self.onset);
        let region = Region::new(self.start, self.ends, self.widths);
        for (balls, clusters) in self.clusters.eights() {
            for ball in balls.within(&region) {
                for place in clusters[ball].within(&region) {
                    let third = splat(simd, &clusters[ball].point(place));
                    let offset = difference(simd, &third, &start);
                    let apart = dot(simd, &offset, &offset);
                    for pairs in &mut pairs[..parts] {
                        pairs.meet(simd, (&third, &offset, apart), softening, onset);
                    }
                }
            }
        }
        let mut factors = [0.0; 8];
        let registers = S::as_mut_simd_f64s(&mut factors).0;
        for (factors, pairs) in registers.iter_mut().zip(&pairs) {
            let minus_strength = simd.splat_f64s(-self.strength);
            *factors = exp(simd, simd.mul_f64s(minus_strength, pairs.sum));
        }
        factors
    }
}

impl<S: Simd, const D: usize> Pairs<S, D> {
    #[inline(always)]
    fn new(simd: S, start: &[S::f64s; D], ends: [S::f64s; D]) -> Self {
        let way = difference(simd, &ends, start);
        Self {
            way,
            back: difference(simd, start, &ends),
            squared: dot(simd, &way, &way),
            sum: simd.splat_f64s(0.0),
            ends,
        }
    }

    /// Adds the height of one third agent, given by where it is, the way to it and the square
    /// of its distance from the start.
    #[inline(always)]
    fn meet(
        &mut self,
        simd: S,
        (third, offset, apart): (&[S::f64s; D], &[S::f64s; D], S::f64s),
        softening: S::f64s,
        onset: S::f64s,
    ) {
        let other = difference(simd, third, &self.ends);
        let mine = self.cosine(simd, softening, &self.way, offset, apart);
        let its = self.cosine(
            simd,
            softening,
            &self.back,
            &other,
            dot(simd, &other, &other),
        );
        let above = simd.sub_f64s(simd.add_f64s(mine, its), onset);
        let above = simd.max_f64s(above, simd.splat_f64s(0.0));
        let square = simd.mul_f64s(above, above);
        self.sum = simd.mul_add_f64s(square, above, self.sum);
    }

    /// w, for the way from one of the pair to the other and to the third agent, whose square
    /// of the distance is `apart`.
    #[inline(always)]
    fn cosine(
        &self,
        simd: S,
        softening: S::f64s,
        way: &[S::f64s; D],
        to: &[S::f64s; D],
        apart: S::f64s,
    ) -> S::f64s {
        let size = simd.mul_add_f64s(self.squared, apart, softening);
        simd.mul_f64s(dot(simd, way, to), inverse_root(simd, size))
    }
}

/// The same numbers in all lanes.
#[inline(always)]
fn splat<S: Simd, const D: usize>(simd: S, numbers: &[f64; D]) -> [S::f64s; D] {
    let mut lanes = [simd.splat_f64s(0.0); D];
    for axis in 0..D {
        lanes[axis] = simd.splat_f64s(numbers[axis]);
    }
    lanes
}

/// 1/√x for x ≥ 0; 0 where x is too large, and finite where it is 0.
#[inline(always)]
fn inverse_root<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    let tame = simd.less_than_f64s(x, simd.splat_f64s(LARGEST_SQUARE));
    let root = inverse_square_root(
        simd,
        simd.max_f64s(x, simd.splat_f64s(1.0 / LARGEST_SQUARE)),
    );
    simd.select_f64s(tame, root, simd.splat_f64s(0.0))
}

#[inline(always)]
fn difference<S: Simd, const D: usize>(
    simd: S,
    a: &[S::f64s; D],
    b: &[S::f64s; D],
) -> [S::f64s; D] {
    let mut difference = *a;
    for axis in 0..D {
        difference[axis] = simd.sub_f64s(a[axis], b[axis]);
    }
    difference
}

#[inline(always)]
fn dot<S: Simd, const D: usize>(simd: S, a: &[S::f64s; D], b: &[S::f64s; D]) -> S::f64s {
    let mut sum = simd.mul_f64s(a[0], b[0]);
    for axis in 1..D {
        sum = simd.mul_add_f64s(a[axis], b[axis], sum);
    }
    sum
}
