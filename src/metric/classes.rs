//! Bodies by size, so that one large body does not make neighbours of all small ones.

use std::collections::BTreeMap;

use crate::math::Vector;
use crate::sense::Cells;

/// Bodies whose radii are within a factor of two of each other.
#[derive(Debug)]
pub(super) struct Class<const D: usize> {
    /// The widest of their radii.
    pub(super) widest: f64,
    members: Vec<usize>,
    positions: Vec<Vector<D>>,
}

/// The classes of some bodies, from small to large.
pub(super) fn classes<const D: usize>(positions: &[Vector<D>], radii: &[f64]) -> Vec<Class<D>> {
    let mut classes: BTreeMap<u64, Class<D>> = BTreeMap::new();
    for (i, (position, radius)) in positions.iter().zip(radii).enumerate() {
        // The exponent of a number that is not negative.
        let class = classes.entry(radius.to_bits() >> 52).or_insert(Class {
            widest: 0.0,
            members: Vec::new(),
            positions: Vec::new(),
        });
        class.widest = class.widest.max(*radius);
        class.members.push(i);
        class.positions.push(*position);
    }
    classes.into_values().collect()
}

impl<const D: usize> Class<D> {
    pub(super) fn len(&self) -> usize {
        self.members.len()
    }

    /// Sorts its bodies into cells of this side.
    pub(super) fn sort(&self, cells: &mut Cells<D>, side: f64) {
        cells.rebuild(&self.positions, side);
    }

    /// Calls `visit` with the indices and the squared distance of every pair of one of these and
    /// one of a class, sorted into cells, that is at most `range` of this one's index apart.
    /// Pairs within a class come once.
    pub(super) fn pairs(
        &self,
        other: &Self,
        cells: &Cells<D>,
        range: impl Fn(usize) -> f64,
        mut visit: impl FnMut(usize, usize, f64),
    ) {
        let one = std::ptr::eq(self, other);
        for (&i, position) in self.members.iter().zip(&self.positions) {
            cells.for_each_within(position, range(i), |place, _, squared| {
                let j = other.members[cells.order()[place] as usize];
                if !one || i < j {
                    visit(i.min(j), i.max(j), squared);
                }
            });
        }
    }
}
