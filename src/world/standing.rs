//! Bodies that stand somewhere, so that those near a place are found without looking at all.
//!
//! Each body needs some room: half of it on every side holds whatever must not overlap it.
//! Bodies are kept in cells twice as wide as their room, on levels from the finest to the
//! coarsest: so small bodies among large ones are found in small cells, and large ones in few.

use std::collections::HashMap;

use crate::math::Vector;

/// Between the rooms of bodies on the same level, at most: twice, but for worlds whose sizes are
/// spread so wide that this would make more levels than [`MOST_LEVELS`].
const FACTOR: f64 = 2.0;

/// Levels, at most.
const MOST_LEVELS: i32 = 16;

/// Cells are not smaller, so that the numbers of cells stay finite.
const SMALLEST: f64 = 1e-200;

/// No further body in a cell.
const NONE: u32 = u32::MAX;

/// A whole number of cell widths along each axis, as the bits of a double: far from the origin
/// cells are as fine as doubles are.
type Cell<const D: usize> = [u64; D];

/// Some things that stand somewhere, each with the room that it needs.
pub(super) struct Standing<const D: usize, T> {
    levels: Vec<Level<D>>,
    things: Vec<T>,
}

/// Things on cells of one size.
struct Level<const D: usize> {
    /// The largest room of what belongs here.
    room: f64,
    side: f64,
    /// What belongs here.
    own: Chains<D>,
    /// What belongs to finer levels.
    finer: Chains<D>,
}

/// For each cell the things in it, as chains through one list.
#[derive(Default)]
struct Chains<const D: usize> {
    last: HashMap<Cell<D>, u32>,
    /// A thing, and the place of the one before it in the same cell.
    links: Vec<(u32, u32)>,
}

impl<const D: usize> Chains<D> {
    fn put(&mut self, cell: Cell<D>, thing: u32) {
        let place = self.links.len() as u32;
        let before = self.last.insert(cell, place).unwrap_or(NONE);
        self.links.push((thing, before));
    }

    fn in_cell(&self, cell: Cell<D>) -> impl Iterator<Item = u32> {
        let mut next = self.last.get(&cell).copied().unwrap_or(NONE);
        std::iter::from_fn(move || {
            let (thing, before) = *self.links.get(next as usize)?;
            next = before;
            Some(thing)
        })
    }
}

impl<const D: usize, T> Standing<D, T> {
    /// Nothing yet, for things that need these rooms.
    pub(super) fn new(rooms: impl Iterator<Item = f64>) -> Self {
        let mut rooms: Vec<f64> = rooms.map(|room| room.max(0.5 * SMALLEST)).collect();
        rooms.sort_unstable_by(f64::total_cmp);
        let (least, most) = match (rooms.first(), rooms.last()) {
            (Some(least), Some(most)) => (*least, *most),
            _ => (SMALLEST, SMALLEST),
        };
        let spread = libm::pow(most / least, 1.0 / f64::from(MOST_LEVELS));
        let mut levels: Vec<Level<D>> = Vec::new();
        let mut end = 0.0;
        for room in rooms {
            match levels.last_mut() {
                Some(level) if room <= end => level.grow(room),
                _ => {
                    levels.push(Level::new(room));
                    end = room * spread.max(FACTOR);
                }
            }
        }
        Self {
            levels,
            things: Vec::new(),
        }
    }

    /// Number of things.
    pub(super) fn len(&self) -> usize {
        self.things.len()
    }

    /// Adds a thing that needs a room which was told of.
    pub(super) fn put(&mut self, at: &Vector<D>, room: f64, thing: T) {
        let index = self.things.len() as u32;
        let own = self.level(room);
        for (number, level) in self.levels.iter_mut().enumerate().skip(own) {
            let cell = level.cell(at);
            match number == own {
                true => level.own.put(cell, index),
                false => level.finer.put(cell, index),
            }
        }
        self.things.push(thing);
    }

    /// All that may stand within its room, or within `room`, of a place, in no order: at least
    /// all that are nearer than half of both rooms together.
    pub(super) fn near(&self, at: &Vector<D>, room: f64) -> impl Iterator<Item = &T> {
        let own = self.level(room);
        let (at, levels) = (*at, self.levels.iter().enumerate().skip(own));
        levels.flat_map(move |(number, level)| {
            level.cells_about(at).flat_map(move |cell| {
                let finer = (number == own).then(|| level.finer.in_cell(cell));
                let found = level.own.in_cell(cell).chain(finer.into_iter().flatten());
                found.map(|thing| &self.things[thing as usize])
            })
        })
    }

    /// The level of things that need a room.
    fn level(&self, room: f64) -> usize {
        self.levels.partition_point(|level| level.room < room)
    }
}

impl<const D: usize> Level<D> {
    fn new(room: f64) -> Self {
        Self {
            room,
            side: 2.0 * room,
            own: Chains::default(),
            finer: Chains::default(),
        }
    }

    fn grow(&mut self, room: f64) {
        (self.room, self.side) = (room, 2.0 * room);
    }

    fn number(&self, x: f64) -> u64 {
        // There is one zero only.
        ((x / self.side).floor() + 0.0).to_bits()
    }

    fn cell(&self, at: &Vector<D>) -> Cell<D> {
        std::array::from_fn(|axis| self.number(at[axis]))
    }

    /// The cells within the room about a place: two along each axis, or three where numbers
    /// are so large that they round.
    fn cells_about(&self, at: Vector<D>) -> impl Iterator<Item = Cell<D>> {
        let mut along = [[0; 3]; D];
        let mut counts = [0; D];
        for axis in 0..D {
            for x in [at[axis] - self.room, at[axis], at[axis] + self.room] {
                let number = self.number(x);
                let known = &along[axis][..counts[axis]];
                if !known.contains(&number) {
                    along[axis][counts[axis]] = number;
                    counts[axis] += 1;
                }
            }
        }
        (0..counts.iter().product()).map(move |mut index: usize| {
            std::array::from_fn(|axis| {
                let number = along[axis][index % counts[axis]];
                index /= counts[axis];
                number
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn finds_all_that_are_near<const D: usize>(dice: &[([f64; 3], usize)], scale: f64) {
        let rooms = [0.1, 0.15, 1.0, 7.0, 1e-3];
        let at = |dice: &[f64; 3]| Vector::<D>::from_fn(|axis, _| 20.0 * dice[axis]) * scale;
        let room = |kind: usize| rooms[kind % rooms.len()] * scale;
        let mut standing = Standing::new(rooms.iter().map(|room| room * scale));
        for (index, (place, kind)) in dice.iter().enumerate() {
            let (place, own) = (at(place), room(*kind));
            let found: Vec<usize> = standing.near(&place, own).copied().collect();
            for (other, (there, kind)) in dice[..index].iter().enumerate() {
                let apart = (at(there) - place).norm();
                if apart < 0.5 * (own + room(*kind)) {
                    assert!(found.contains(&other), "{other} is near {index}");
                }
            }
            let mut once = found.clone();
            once.sort_unstable();
            once.dedup();
            assert_eq!(once.len(), found.len(), "each is found once");
            standing.put(&place, own, index);
        }
    }

    proptest! {
        #[test]
        fn whatever_is_near_is_found(
            dice in prop::collection::vec((prop::array::uniform3(-1.0..1.0f64), 0..5usize), 0..80),
            scale in prop::sample::select(&[1.0, 1e-120, 1e80][..]),
        ) {
            finds_all_that_are_near::<2>(&dice, scale);
            finds_all_that_are_near::<3>(&dice, scale);
        }
    }

    /// How much is looked at for each of some disks, every one of which stands clear.
    fn looks_per_disk(rooms: [f64; 2], count: usize) -> f64 {
        let mut standing = Standing::<2, usize>::new(rooms.into_iter());
        let (mut looks, mut index) = (0, 0);
        for room in rooms {
            // Far apart for large ones, side by side for small ones.
            let pitch = 1.01 * room;
            let side = (count as f64).sqrt() as usize;
            for k in 0..count {
                let at = Vector::<2>::new((k % side) as f64 * pitch, (k / side) as f64 * pitch);
                looks += standing.near(&at, room).count();
                standing.put(&at, room, index);
                index += 1;
            }
        }
        looks as f64 / index as f64
    }

    #[test]
    fn what_is_looked_at_does_not_grow_with_the_crowd() {
        for rooms in [[1.0, 1.0], [1.0, 1000.0], [0.9, 1.7]] {
            let [few, many] = [400, 10_000].map(|count| looks_per_disk(rooms, count));
            assert!(many < 60.0 && many < 3.0 * few + 10.0, "{few} and {many}");
        }
    }

    #[test]
    fn far_away_doubles_are_told_apart() {
        let mut standing = Standing::<2, usize>::new(std::iter::once(1.0));
        for k in 0..1000 {
            let at = Vector::<2>::new(1e30 * (k as f64 + 1.0), 0.0);
            assert_eq!(standing.near(&at, 1.0).count(), 0);
            standing.put(&at, 1.0, k);
        }
    }
}
