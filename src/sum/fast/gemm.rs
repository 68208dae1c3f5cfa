//! Products of small dense matrices on vector registers.
//!
//! All of the transforms between agents, nodes and frequencies are such products, with a few
//! to a few dozen rows; general libraries for large matrices gain nothing on them.

use pulp::{Arch, Simd, WithSimd};

/// Numbers that a row is padded to a multiple of, so that it fills whole registers.
pub(super) const LANES: usize = 8;

/// The length of a row with its padding.
pub(super) fn padded(length: usize) -> usize {
    length.next_multiple_of(LANES)
}

/// A matrix: its numbers row by row, and how far apart rows begin.
pub(super) type Rows<'a> = (&'a [f64], usize);

/// C = A B, or C += A B where it is to be added. The shape is the number of rows of A and C, of
/// columns of A and rows of B, and of columns of B and C. Rows of C begin as far apart as those
/// of B; that and the number of columns are multiples of [`LANES`].
pub(super) fn multiply(
    arch: Arch,
    shape: [usize; 3],
    left: Rows<'_>,
    right: Rows<'_>,
    out: &mut [f64],
    add: bool,
) {
    arch.dispatch(Product {
        shape,
        left,
        right,
        out,
        add,
    });
}

struct Product<'a> {
    shape: [usize; 3],
    left: Rows<'a>,
    right: Rows<'a>,
    out: &'a mut [f64],
    add: bool,
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [rows, inner, columns] = self.shape;
        let lanes = S::F64_LANES;
        let tile = Tile {
            inner,
            add: self.add,
            left: self.left,
            right: S::as_simd_f64s(self.right.0).0,
            stride: self.right.1 / lanes,
        };
        let out = S::as_mut_simd_f64s(self.out).0;
        let columns = columns / lanes;
        let mut row = 0;
        while row + 4 <= rows {
            let mut column = 0;
            while column + 2 <= columns {
                tile.run::<S, 4, 2>(simd, row, column, out);
                column += 2;
            }
            if column < columns {
                tile.run::<S, 4, 1>(simd, row, column, out);
            }
            row += 4;
        }
        while row < rows {
            let mut column = 0;
            while column + 4 <= columns {
                tile.run::<S, 1, 4>(simd, row, column, out);
                column += 4;
            }
            while column < columns {
                tile.run::<S, 1, 1>(simd, row, column, out);
                column += 1;
            }
            row += 1;
        }
    }
}

/// What the parts of a product share.
struct Tile<'a, V> {
    inner: usize,
    add: bool,
    left: Rows<'a>,
    right: &'a [V],
    stride: usize,
}

impl<V: Copy> Tile<'_, V> {
    /// R rows of V registers of C, each summed over all of A's columns before it is written.
    #[inline(always)]
    fn run<S: Simd<f64s = V>, const R: usize, const C: usize>(
        &self,
        simd: S,
        row: usize,
        column: usize,
        out: &mut [V],
    ) {
        let mut sums = [[simd.splat_f64s(0.0); C]; R];
        let rows: [&[f64]; R] =
            std::array::from_fn(|r| &self.left.0[(row + r) * self.left.1..][..self.inner]);
        for j in 0..self.inner {
            let right = &self.right[j * self.stride + column..][..C];
            for (sums, row) in sums.iter_mut().zip(&rows) {
                let factor = simd.splat_f64s(row[j]);
                for (sum, right) in sums.iter_mut().zip(right) {
                    *sum = simd.mul_add_e_f64s(factor, *right, *sum);
                }
            }
        }
        for (r, sums) in sums.iter().enumerate() {
            let out = &mut out[(row + r) * self.stride + column..][..C];
            for (out, sum) in out.iter_mut().zip(sums) {
                *out = match self.add {
                    true => simd.add_f64s(*out, *sum),
                    false => *sum,
                };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_the_definition() {
        for rows in 1..10 {
            for [inner, columns] in [[1, 8], [3, 16], [11, 24], [21, 40]] {
                let value = |k: usize| ((k * 37 + 11) % 64) as f64 / 8.0 - 4.0;
                let left: Vec<f64> = (0..rows * inner).map(value).collect();
                let right: Vec<f64> = (0..inner * columns).map(|k| value(k + 5)).collect();
                let mut out = vec![1.0; rows * columns];
                for add in [true, false] {
                    let shape = [rows, inner, columns];
                    multiply(
                        Arch::new(),
                        shape,
                        (&left, inner),
                        (&right, columns),
                        &mut out,
                        add,
                    );
                    for row in 0..rows {
                        for column in 0..columns {
                            let terms = (0..inner)
                                .map(|j| left[row * inner + j] * right[j * columns + column]);
                            // Eighths: exact in any order.
                            let sum = terms.sum::<f64>() + f64::from(u8::from(add));
                            assert_eq!(out[row * columns + column], sum);
                        }
                    }
                }
            }
        }
    }
}
