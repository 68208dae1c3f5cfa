//! Sums over agents one by one, for those too near for nodes.

use pulp::{Simd, WithSimd};

use super::gemm::padded;
use super::kernel::Kernel;
use crate::math::{Radial, WithRadial, vectorized};

/// Targets that are worked on at once, for what is loaded of a source serves them all.
const TARGETS: usize = 4;

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

    /// Some rows from one on, in registers.
    fn registers<S: Simd, const R: usize>(&self, first: usize) -> [&[S::f64s]; R] {
        std::array::from_fn(|row| S::as_simd_f64s(&self.rows[first + row]).0)
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
    pub wanted: &'a mut [&'b mut [f64]],
}

impl<const D: usize> Nearby<'_, '_, D> {
    /// By a kernel that has a function on lanes.
    pub fn run(self, kernel: &Kernel) {
        let known = match kernel {
            Kernel::Influence(influence) => influence.with_radial(Influenced(self)),
            Kernel::Force(potential) => potential.with_radial(Forced(self)),
        };
        debug_assert!(known.is_some(), "{kernel:?}");
    }

    /// For some targets at a time, `tell` adds what all sources of a register, by its place, tell
    /// a target of that square distance in that direction, to its sums.
    #[inline(always)]
    fn meet<S: Simd, const W: usize>(
        self,
        simd: S,
        scale: f64,
        tell: impl Fn(usize, S::f64s, [S::f64s; D], &mut [S::f64s; W]),
    ) {
        let places = self.crowd.registers::<S, D>(0);
        let count = places[0].len();
        let places = places.map(|row| &row[..count]);
        let zero = simd.splat_f64s(0.0);
        let last = self.targets[0].len();
        for first in (0..last).step_by(TARGETS) {
            // Those that are missing from the last few are worked out for nothing.
            let chosen: [usize; TARGETS] = std::array::from_fn(|k| (first + k).min(last - 1));
            let here = chosen.map(|target| self.targets.map(|axis| simd.splat_f64s(axis[target])));
            let mut sums = [[zero; W]; TARGETS];
            for j in 0..count {
                let there = places.map(|row| row[j]);
                for (here, sums) in here.iter().zip(&mut sums) {
                    let way: [S::f64s; D] =
                        std::array::from_fn(|axis| simd.sub_f64s(here[axis], there[axis]));
                    let mut squared = zero;
                    for part in way {
                        squared = simd.mul_add_e_f64s(part, part, squared);
                    }
                    tell(j, squared, way, sums);
                }
            }
            for (target, sums) in (first..last).zip(&sums) {
                for (wanted, sum) in self.wanted.iter_mut().zip(sums) {
                    wanted[target] += scale * simd.reduce_sum_f64s(*sum);
                }
            }
        }
    }
}

/// By an influence: there is one channel more than axes.
struct Influenced<'a, 'b, const D: usize>(Nearby<'a, 'b, D>);

/// By a force: ones are given, and its parts wanted.
struct Forced<'a, 'b, const D: usize>(Nearby<'a, 'b, D>);

/// Either, with a function.
struct Loops<K, N>(K, N);

impl<const D: usize> WithRadial for Influenced<'_, '_, D> {
    type Output = ();

    fn with<K: Radial>(self, radial: K) {
        vectorized(Loops(radial, self));
    }
}

impl<const D: usize> WithRadial for Forced<'_, '_, D> {
    type Output = ();

    fn with<K: Radial>(self, radial: K) {
        vectorized(Loops(radial, self));
    }
}

impl<K: Radial, const D: usize> WithSimd for Loops<K, Influenced<'_, '_, D>> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(radial, Influenced(nearby)) = self;
        // What is not named by the number of axes alone has to be told apart here.
        match D {
            2 => influenced::<S, K, D, 3>(simd, radial, nearby),
            3 => influenced::<S, K, D, 4>(simd, radial, nearby),
            _ => unreachable!("no world has {D} axes"),
        }
    }
}

#[inline(always)]
fn influenced<S: Simd, K: Radial, const D: usize, const W: usize>(
    simd: S,
    radial: K,
    nearby: Nearby<'_, '_, D>,
) {
    let given = nearby.crowd.registers::<S, W>(D);
    let count = given[0].len();
    let given = given.map(|row| &row[..count]);
    nearby.meet(simd, radial.scale(), |j, squared, _, sums: &mut [_; W]| {
        let value = radial.lanes(simd, squared);
        for (sum, given) in sums.iter_mut().zip(&given) {
            *sum = simd.mul_add_e_f64s(value, given[j], *sum);
        }
    });
}

impl<K: Radial, const D: usize> WithSimd for Loops<K, Forced<'_, '_, D>> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(radial, Forced(nearby)) = self;
        let [ones] = nearby.crowd.registers::<S, 1>(D);
        nearby.meet(
            simd,
            radial.scale(),
            |j, squared, way, sums: &mut [_; D]| {
                let value = simd.mul_f64s(radial.lanes(simd, squared), ones[j]);
                for (sum, part) in sums.iter_mut().zip(way) {
                    *sum = simd.mul_add_e_f64s(value, part, *sum);
                }
            },
        );
    }
}
