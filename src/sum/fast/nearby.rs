//! Sums over agents one by one, for those too near for nodes.

use pulp::{Simd, WithSimd};

use super::gemm::padded;
use crate::math::{Radial, WithRadial, vectorized};

/// Targets that are worked on at once, for what is loaded of a source serves them all.
const TARGETS: usize = 2;

/// The agents near some leaf, side by side in memory and padded with ones of no weight.
#[derive(Debug, Default)]
pub(super) struct Crowd {
    /// One row for each axis, then one for each channel.
    rows: Vec<Vec<f64>>,
}

impl Crowd {
    /// Nobody, in a space of so many axes, with so many channels.
    pub fn clear(&mut self, rows: usize) {
        self.rows.resize(rows, Vec::new());
        self.rows.iter_mut().for_each(Vec::clear);
    }

    /// Adds some agents by their coordinates and numbers, row by row.
    pub fn extend<'a>(&mut self, rows: impl Iterator<Item = &'a [f64]>) {
        for (row, more) in self.rows.iter_mut().zip(rows) {
            row.extend_from_slice(more);
        }
    }

    /// Fills the last registers: no weights, and places of someone who is there.
    pub fn pad(&mut self, axes: usize) {
        for (index, row) in self.rows.iter_mut().enumerate() {
            let filler = match row.last() {
                Some(last) if index < axes => *last,
                _ => 0.0,
            };
            row.resize(padded(row.len()), filler);
        }
    }
}

/// Adds to the sums of some agents, one slice for each channel, what a crowd tells them.
pub(super) struct Nearby<'a, 'b, const D: usize> {
    pub crowd: &'a Crowd,
    pub targets: [&'a [f64]; D],
    pub along: bool,
    pub wanted: &'a mut [&'b mut [f64]],
}

impl<const D: usize> WithRadial for Nearby<'_, '_, D> {
    type Output = ();

    fn with<K: Radial>(self, radial: K) {
        vectorized(Loops {
            radial,
            nearby: self,
        });
    }
}

struct Loops<'a, 'b, K, const D: usize> {
    radial: K,
    nearby: Nearby<'a, 'b, D>,
}

impl<K: Radial, const D: usize> WithSimd for Loops<'_, '_, K, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match (self.nearby.along, self.nearby.wanted.len()) {
            (true, _) => self.run::<S, 1, D>(simd),
            (false, 1) => self.run::<S, 1, 1>(simd),
            (false, 3) => self.run::<S, 3, 3>(simd),
            (false, 4) => self.run::<S, 4, 4>(simd),
            (false, other) => unreachable!("no law has {other} channels"),
        }
    }
}

impl<K: Radial, const D: usize> Loops<'_, '_, K, D> {
    /// G channels given, W wanted.
    #[inline(always)]
    fn run<S: Simd, const G: usize, const W: usize>(self, simd: S) {
        let Nearby {
            crowd,
            targets,
            along,
            wanted,
        } = self.nearby;
        let places: [&[S::f64s]; D] =
            std::array::from_fn(|axis| S::as_simd_f64s(&crowd.rows[axis]).0);
        let count = places[0].len();
        let places = places.map(|row| &row[..count]);
        let given: [&[S::f64s]; G] =
            std::array::from_fn(|channel| &S::as_simd_f64s(&crowd.rows[D + channel]).0[..count]);
        let scale = self.radial.scale();
        let zero = simd.splat_f64s(0.0);
        let last = targets[0].len();
        for first in (0..last).step_by(TARGETS) {
            // An odd one out is worked out twice.
            let chosen: [usize; TARGETS] = std::array::from_fn(|k| (first + k).min(last - 1));
            let here = chosen.map(|target| targets.map(|axis| simd.splat_f64s(axis[target])));
            let mut sums = [[zero; W]; TARGETS];
            for j in 0..count {
                for (here, sums) in here.iter().zip(&mut sums) {
                    let mut way = [zero; D];
                    let mut squared = zero;
                    for axis in 0..D {
                        way[axis] = simd.sub_f64s(here[axis], places[axis][j]);
                        squared = simd.mul_add_e_f64s(way[axis], way[axis], squared);
                    }
                    let value = self.radial.lanes(simd, squared);
                    if along {
                        let value = simd.mul_f64s(value, given[0][j]);
                        for axis in 0..W {
                            sums[axis] = simd.mul_add_e_f64s(value, way[axis], sums[axis]);
                        }
                    } else {
                        for channel in 0..W {
                            sums[channel] =
                                simd.mul_add_e_f64s(value, given[channel][j], sums[channel]);
                        }
                    }
                }
            }
            for (target, sums) in (first..last).zip(&sums) {
                for (wanted, sum) in wanted.iter_mut().zip(sums) {
                    wanted[target] += scale * simd.reduce_sum_f64s(*sum);
                }
            }
        }
    }
}
