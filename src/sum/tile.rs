//! The innermost loops.
//!
//! Points come in blocks. Some targets at a time are held in registers and meet one row of
//! eight sources after the other, so that what is loaded serves all of them.

use pulp::{Simd, WithSimd};

use crate::math::{Radial, Vector};
use crate::sum::cloud::{BLOCK, Block, Column, Eight, Sums};

/// Targets that are held at a time.
pub(super) const HELD: usize = 4;

/// Registers that make eight lanes, at most: of two lanes each.
const MOST: usize = 4;

/// The sums of the points of a block, by columns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tally<const D: usize> {
    pub weight: Column,
    pub drive: [Column; D],
}

impl<const D: usize> Tally<D> {
    pub const ZERO: Self = Self {
        weight: [Eight([0.0; 8]); BLOCK / 8],
        drive: [[Eight([0.0; 8]); BLOCK / 8]; D],
    };

    /// Adds what the block was told elsewhere.
    pub fn add(&mut self, more: &Self) {
        let columns = [&mut self.weight].into_iter().chain(&mut self.drive);
        let more = [&more.weight].into_iter().chain(&more.drive);
        let eights = columns.flatten().zip(more.flatten());
        for (sum, more) in eights {
            sum.0
                .iter_mut()
                .zip(&more.0)
                .for_each(|(sum, more)| *sum += more);
        }
    }

    /// Of the point at a place of the block, times a factor.
    pub fn at(&self, place: usize, scale: f64) -> Sums<D> {
        let of = |column: &Column| column[place / 8].0[place % 8] * scale;
        Sums {
            weight: of(&self.weight),
            drive: Vector::from_fn(|axis, _| of(&self.drive[axis])),
        }
    }
}

/// Some targets, each number in all lanes of a register.
struct Held<S: Simd, const D: usize> {
    positions: [[S::f64s; D]; HELD],
    carried: [[S::f64s; D]; HELD],
    numbers: [S::f64s; HELD],
}

impl<S: Simd, const D: usize> Held<S, D> {
    /// From the places `first`, `first + 1`, … of a block.
    #[inline(always)]
    fn of(simd: S, block: &Block<D>, first: usize) -> Self {
        let all = |column: &Column, t: usize| {
            let place = first + t;
            simd.splat_f64s(column[place / 8].0[place % 8])
        };
        let vector = |columns: &[Column; D], t: usize| -> [S::f64s; D] {
            std::array::from_fn(|axis| all(&columns[axis], t))
        };
        Self {
            positions: std::array::from_fn(|t| vector(&block.positions, t)),
            carried: std::array::from_fn(|t| vector(&block.carried, t)),
            numbers: std::array::from_fn(|t| all(&block.numbers, t)),
        }
    }
}

/// The sums of the targets that are held, lane by lane: eight lanes of each.
struct Lanes<S: Simd, const D: usize> {
    weight: [[S::f64s; MOST]; HELD],
    drive: [[[S::f64s; MOST]; D]; HELD],
}

impl<S: Simd, const D: usize> Lanes<S, D> {
    #[inline(always)]
    fn zero(simd: S) -> Self {
        let zero = [simd.splat_f64s(0.0); MOST];
        Self {
            weight: [zero; HELD],
            drive: [[zero; D]; HELD],
        }
    }

    /// Adds them to the sums at the places `first`, `first + 1`, ….
    #[inline(always)]
    fn add_to(&self, tally: &mut Tally<D>, first: usize) {
        for t in 0..HELD {
            let (row, lane) = ((first + t) / 8, (first + t) % 8);
            tally.weight[row].0[lane] += total::<S>(&self.weight[t]);
            for axis in 0..D {
                tally.drive[axis][row].0[lane] += total::<S>(&self.drive[t][axis]);
            }
        }
    }
}

/// The sum over eight lanes.
#[inline(always)]
fn total<S: Simd>(lanes: &[S::f64s; MOST]) -> f64 {
    let mut eight = Eight([0.0; 8]);
    let registers = S::as_mut_simd_f64s(&mut eight.0).0;
    registers.copy_from_slice(&lanes[..8 / S::F64_LANES]);
    eight.sum()
}

/// A register of a row.
#[inline(always)]
fn register<S: Simd>(column: &Column, row: usize, part: usize) -> S::f64s {
    S::as_simd_f64s(&column[row].0).0[part]
}

/// The same, to be written.
#[inline(always)]
fn register_mut<S: Simd>(column: &mut Column, row: usize, part: usize) -> &mut S::f64s {
    &mut S::as_mut_simd_f64s(&mut column[row].0).0[part]
}

/// φ and φ(c_j − c_i) of target `t` and one register of sources. Where `KEEP` is false,
/// sources without a number, and the target itself, count for nothing.
#[inline(always)]
fn pair<S: Simd, K: Radial, const D: usize, const KEEP: bool>(
    simd: S,
    radial: &K,
    held: &Held<S, D>,
    t: usize,
    (positions, carried, numbers): (&[S::f64s; D], &[S::f64s; D], S::f64s),
) -> (S::f64s, [S::f64s; D]) {
    let first = simd.sub_f64s(positions[0], held.positions[t][0]);
    let mut squared = simd.mul_f64s(first, first);
    for (axis, position) in positions.iter().enumerate().skip(1) {
        let offset = simd.sub_f64s(*position, held.positions[t][axis]);
        squared = simd.mul_add_f64s(offset, offset, squared);
    }
    let mut weight = radial.lanes(simd, squared);
    if !KEEP {
        let zero = simd.splat_f64s(0.0);
        let apart = simd.sub_f64s(numbers, held.numbers[t]);
        let other = simd.greater_than_f64s(simd.abs_f64s(apart), zero);
        weight = simd.select_f64s(other, weight, zero);
    }
    let drive = std::array::from_fn(|axis| {
        let difference = simd.sub_f64s(carried[axis], held.carried[t][axis]);
        simd.mul_f64s(weight, difference)
    });
    (weight, drive)
}

/// Sums at all points of one block over those of some blocks, themselves left out.
pub(super) struct Gather<'a, K, const D: usize> {
    pub radial: K,
    pub targets: &'a Block<D>,
    /// How many of its points are asked for.
    pub count: usize,
    pub sources: &'a [Block<D>],
    pub tally: &'a mut Tally<D>,
}

impl<K: Radial, const D: usize> WithSimd for Gather<'_, K, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for first in (0..self.count).step_by(HELD) {
            let held = Held::of(simd, self.targets, first);
            let mut lanes = Lanes::zero(simd);
            for block in self.sources {
                for row in 0..BLOCK / 8 {
                    for part in 0..8 / S::F64_LANES {
                        let take = |column| register::<S>(column, row, part);
                        let positions = block.positions.each_ref().map(take);
                        let carried = block.carried.each_ref().map(take);
                        let source = (&positions, &carried, take(&block.numbers));
                        for t in 0..HELD {
                            let (weight, drive) =
                                pair::<S, K, D, false>(simd, &self.radial, &held, t, source);
                            let sum = &mut lanes.weight[t][part];
                            *sum = simd.add_f64s(*sum, weight);
                            for (axis, drive) in drive.iter().enumerate() {
                                let sum = &mut lanes.drive[t][axis][part];
                                *sum = simd.add_f64s(*sum, *drive);
                            }
                        }
                    }
                }
            }
            lanes.add_to(self.tally, first);
        }
    }
}

/// The pairs of two different blocks, each counted once and added to both of its points. The
/// blocks are full.
pub(super) struct Exchange<'a, K, const D: usize> {
    pub radial: K,
    pub blocks: [&'a Block<D>; 2],
    pub tallies: [&'a mut Tally<D>; 2],
}

impl<K: Radial, const D: usize> WithSimd for Exchange<'_, K, D> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [one, other] = self.blocks;
        let [mine, theirs] = self.tallies;
        for first in (0..BLOCK).step_by(HELD) {
            let held = Held::of(simd, one, first);
            let mut lanes = Lanes::zero(simd);
            for row in 0..BLOCK / 8 {
                for part in 0..8 / S::F64_LANES {
                    let take = |column| register::<S>(column, row, part);
                    let positions = other.positions.each_ref().map(take);
                    let carried = other.carried.each_ref().map(take);
                    let source = (&positions, &carried, take(&other.numbers));
                    let mut their_weight = take(&theirs.weight);
                    let mut their_drive = theirs.drive.each_ref().map(take);
                    for t in 0..HELD {
                        let (weight, drive) =
                            pair::<S, K, D, true>(simd, &self.radial, &held, t, source);
                        let sum = &mut lanes.weight[t][part];
                        *sum = simd.add_f64s(*sum, weight);
                        their_weight = simd.add_f64s(their_weight, weight);
                        for (axis, drive) in drive.iter().enumerate() {
                            let sum = &mut lanes.drive[t][axis][part];
                            *sum = simd.add_f64s(*sum, *drive);
                            their_drive[axis] = simd.sub_f64s(their_drive[axis], *drive);
                        }
                    }
                    *register_mut::<S>(&mut theirs.weight, row, part) = their_weight;
                    for (column, drive) in theirs.drive.iter_mut().zip(their_drive) {
                        *register_mut::<S>(column, row, part) = drive;
                    }
                }
            }
            lanes.add_to(mine, first);
        }
    }
}
