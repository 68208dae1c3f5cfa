//! Points in blocks, laid out for vector registers.

use crate::math::Vector;

/// Eight numbers that lie as registers and caches like them. Sums over lanes are taken eight
/// at a time whatever the registers hold, so they do not depend on the processor.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Eight(pub [f64; 8]);

impl Eight {
    /// The sum, in a fixed order.
    #[inline(always)]
    pub fn sum(&self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.0;
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }
}

/// Points in a block.
pub(super) const BLOCK: usize = 256;

/// A number for each point of a block.
pub(super) type Column = [Eight; BLOCK / 8];

/// Some points of a cloud. Places without a point lie where a point is, and have no number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block<const D: usize> {
    pub positions: [Column; D],
    /// What each point carries.
    pub carried: [Column; D],
    /// The number of each point, NaN where there is none.
    pub numbers: Column,
}

/// Points, each with a vector that it carries and a number.
#[derive(Debug, Clone, Default)]
pub struct Cloud<const D: usize> {
    blocks: Vec<Block<D>>,
    count: usize,
}

/// The sums at a point, over all others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sums<const D: usize> {
    /// Σ_j φ(r_ij²).
    pub weight: f64,
    /// Σ_j φ(r_ij²)(c_j − c_i).
    pub drive: Vector<D>,
}

/// A point of a cloud.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point<const D: usize> {
    /// Its number: it is no other point's.
    pub number: usize,
    /// Where it is.
    pub position: Vector<D>,
    /// What it carries.
    pub carried: Vector<D>,
}

impl<const D: usize> Cloud<D> {
    /// Forgets what was there and takes these points.
    pub fn refill(&mut self, points: impl Iterator<Item = Point<D>>) {
        self.blocks.clear();
        self.count = 0;
        for point in points {
            let place = self.count % BLOCK;
            if place == 0 {
                let all = |x: f64| [Eight([x; 8]); BLOCK / 8];
                self.blocks.push(Block {
                    positions: std::array::from_fn(|axis| all(point.position[axis])),
                    carried: [all(0.0); D],
                    numbers: all(f64::NAN),
                });
            }
            let last = self.blocks.len() - 1;
            let block = &mut self.blocks[last];
            let (row, lane) = (place / 8, place % 8);
            for axis in 0..D {
                block.positions[axis][row].0[lane] = point.position[axis];
                block.carried[axis][row].0[lane] = point.carried[axis];
            }
            block.numbers[row].0[lane] = point.number as f64;
            self.count += 1;
        }
    }

    /// How many points there are.
    pub fn count(&self) -> usize {
        self.count
    }

    pub(super) fn blocks(&self) -> &[Block<D>] {
        &self.blocks
    }
}
