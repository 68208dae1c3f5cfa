//! The agents in an adaptive tree of squares or cubes.

use std::ops::Range;

use crate::math::Vector;

/// Places of a level are numbers of this many bits for each axis: sides down to a billionth of
/// a billionth of the root's in the plane, to a ten thousandth of a billionth in space.
const fn deepest<const D: usize>() -> usize {
    126 / D
}

/// A square or cube of the tree, and the agents in it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cell<const D: usize> {
    /// Its agents, in the order of the tree.
    pub agents: Range<usize>,
    /// Index of its parent in the level above.
    pub parent: usize,
    /// Its children in the level below; none where it is a leaf.
    pub children: Range<usize>,
    /// Its place among the cells of its level that are no leaves.
    pub branch: usize,
    /// Its place in the grid of its level.
    pub at: [i64; D],
}

impl<const D: usize> Cell<D> {
    pub fn is_leaf(&self) -> bool {
        self.children.is_empty()
    }
}

/// The tree: cells by level, the root alone in the first.
#[derive(Debug, Clone)]
pub(super) struct Tree<const D: usize> {
    pub levels: Vec<Vec<Cell<D>>>,
    /// The agents in the order of the tree: by cell, at every level.
    pub order: Vec<u32>,
    /// Least corner of the root.
    corner: [f64; D],
    /// Side of the root.
    side: f64,
    keys: Vec<(u128, u32)>,
}

impl<const D: usize> Default for Tree<D> {
    fn default() -> Self {
        Self {
            levels: Vec::new(),
            order: Vec::new(),
            corner: [0.0; D],
            side: 0.0,
            keys: Vec::new(),
        }
    }
}

impl<const D: usize> Tree<D> {
    /// Sorts agents into a root of the given least corner and side, which must hold them, and
    /// splits cells of more than `most` agents, down to the level `last`. The root is always
    /// split.
    pub fn rebuild(
        &mut self,
        positions: &[Vector<D>],
        corner: [f64; D],
        side: f64,
        most: usize,
        last: usize,
    ) {
        (self.corner, self.side) = (corner, side);
        let bits = deepest::<D>();
        let scale = 2f64.powi(bits as i32) / side;
        let top = (1u128 << bits) - 1;
        self.keys.clear();
        self.keys
            .extend(positions.iter().zip(0..).map(|(x, agent)| {
                let mut key = 0;
                for axis in 0..D {
                    let place = (((x[axis] - corner[axis]) * scale) as u128).min(top);
                    key |= spread::<D>(place) << axis;
                }
                (key, agent)
            }));
        // Agents of one place stay in their order: the index is part of the key.
        self.keys.sort_unstable();
        self.order.clear();
        self.order.extend(self.keys.iter().map(|(_, agent)| *agent));
        self.levels.clear();
        self.levels.push(vec![Cell {
            agents: 0..positions.len(),
            parent: 0,
            children: 0..0,
            branch: 0,
            at: [0; D],
        }]);
        let last = last.min(bits);
        while self.levels.len() <= last.max(1) {
            let level = self.levels.len();
            let below = self.split(level, most);
            if below.is_empty() {
                break;
            }
            self.levels.push(below);
        }
    }

    /// Splits the cells of the lowest level that hold too many, and returns the new ones.
    fn split(&mut self, level: usize, most: usize) -> Vec<Cell<D>> {
        let shift = D * (deepest::<D>() - level);
        let mut below = Vec::new();
        let mut branches = 0;
        let above = self.levels.last_mut().expect("there is a root");
        for (index, cell) in above.iter_mut().enumerate() {
            let first = below.len();
            if cell.agents.len() > most || level == 1 {
                let mut rest = cell.agents.clone();
                while !rest.is_empty() {
                    let keys = &self.keys[rest.clone()];
                    let place = keys[0].0 >> shift;
                    let count = keys.partition_point(|(key, _)| key >> shift == place);
                    below.push(Cell {
                        agents: rest.start..rest.start + count,
                        parent: index,
                        children: 0..0,
                        branch: 0,
                        at: std::array::from_fn(|axis| {
                            2 * cell.at[axis] + (place >> axis & 1) as i64
                        }),
                    });
                    rest.start += count;
                }
                cell.branch = branches;
                branches += 1;
            }
            cell.children = first..below.len();
        }
        below
    }

    /// The side of the cells of a level.
    pub fn side(&self, level: usize) -> f64 {
        self.side * 0.5f64.powi(level as i32)
    }

    /// The centre of a cell of a level.
    pub fn centre(&self, level: usize, cell: &Cell<D>) -> [f64; D] {
        let side = self.side(level);
        std::array::from_fn(|axis| self.corner[axis] + (cell.at[axis] as f64 + 0.5) * side)
    }
}

/// The bits of a number, D apart.
fn spread<const D: usize>(place: u128) -> u128 {
    let bytes = place.to_le_bytes();
    (0..deepest::<D>().div_ceil(8)).fold(0, |spread, byte| {
        let bits = const { spread_bytes::<D>() }[bytes[byte] as usize];
        spread | u128::from(bits) << (8 * D * byte)
    })
}

/// The same for each byte.
const fn spread_bytes<const D: usize>() -> [u32; 256] {
    let mut spread = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut bit = 0;
        while bit < 8 {
            spread[byte] |= ((byte >> bit & 1) as u32) << (D * bit);
            bit += 1;
        }
        byte += 1;
    }
    spread
}
