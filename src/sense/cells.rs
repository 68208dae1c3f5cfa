//! Neighbour search: a list of cells, sorted.

use crate::math::Vector;

/// Agents sorted by cubic cells, so that those near a point are found without
/// looking at the others.
///
/// The grid wraps around: cells a whole number of grid widths apart share a slot, so
/// that its size follows the number of agents, however far they fly apart. Distances
/// are always checked, so sharing costs time and never correctness. Agents come in a
/// fixed order (by slot, then by index), whatever the number of threads.
#[derive(Debug, Clone)]
pub struct Cells<const D: usize> {
    side: f64,
    per_side: f64,
    /// Slots along each axis, a power of two.
    slots: [usize; D],
    /// Where each slot begins in `order`; one more entry than slots.
    starts: Vec<u32>,
    order: Vec<u32>,
    sorted: Vec<Vector<D>>,
    /// Number of pairs that share a slot.
    pairs: u64,
    /// Scratch: the slot of each agent.
    slot_of: Vec<u32>,
}

/// Hits that a search writes down before it visits them.
pub(super) const HITS: usize = 64;

impl<const D: usize> Default for Cells<D> {
    fn default() -> Self {
        Self {
            side: 1.0,
            per_side: 1.0,
            slots: [1; D],
            starts: vec![0, 0],
            order: Vec::new(),
            sorted: Vec::new(),
            pairs: 0,
            slot_of: Vec::new(),
        }
    }
}

impl<const D: usize> Cells<D> {
    /// Sorts finite `positions` into cells whose side is `side` > 0, forgetting what
    /// was there. Searches are quickest with a range of one side.
    pub fn rebuild(&mut self, positions: &[Vector<D>], side: f64) {
        debug_assert!(side > 0.0);
        // A hair wider, so that rounding cannot put agents one side apart two cells apart.
        self.side = side * (1.0 + 1e-9);
        self.per_side = 1.0 / self.side;
        let mut min = Vector::<D>::repeat(f64::INFINITY);
        let mut max = Vector::<D>::repeat(f64::NEG_INFINITY);
        for position in positions {
            min = min.inf(position);
            max = max.sup(position);
        }
        let target = (2 * positions.len()).max(1);
        self.slots = std::array::from_fn(|axis| {
            let cells = ((max[axis] - min[axis]) / side).floor() + 1.0;
            (cells.clamp(1.0, target as f64) as usize).next_power_of_two()
        });
        let total = |slots: &[usize; D]| slots.iter().map(|&n| n as f64).product::<f64>();
        while total(&self.slots) > 2.0 * target as f64 {
            let longest = (0..D).max_by_key(|&axis| self.slots[axis]).unwrap_or(0);
            self.slots[longest] /= 2;
        }

        let total: usize = self.slots.iter().product();
        self.starts.clear();
        self.starts.resize(total + 1, 0);
        self.slot_of.clear();
        self.pairs = 0;
        for position in positions {
            let slot = self.slot(&self.cell(position));
            self.slot_of.push(slot as u32);
            self.pairs += u64::from(self.starts[slot + 1]);
            self.starts[slot + 1] += 1;
        }
        for slot in 0..total {
            self.starts[slot + 1] += self.starts[slot];
        }
        // Filling from the front moves each start to its slot's end; shifting the
        // table by one slot afterwards restores it.
        self.order.clear();
        self.order.resize(positions.len(), 0);
        self.sorted.clear();
        self.sorted.resize(positions.len(), Vector::zeros());
        for (agent, &slot) in self.slot_of.iter().enumerate() {
            let place = &mut self.starts[slot as usize];
            self.order[*place as usize] = agent as u32;
            self.sorted[*place as usize] = positions[agent];
            *place += 1;
        }
        self.starts.copy_within(0..total, 1);
        self.starts[0] = 0;
    }

    /// Calls `visit` with place in the sorted order, offset from `point` and squared
    /// distance of every agent at most `range` from `point`, an agent at the point itself
    /// included.
    #[inline]
    pub fn for_each_within(
        &self,
        point: &Vector<D>,
        range: f64,
        mut visit: impl FnMut(usize, Vector<D>, f64),
    ) {
        let limit = range * range;
        let cell = self.cell(point);
        let reach = (range / self.side).ceil().min(1e9) as i64;
        // Along an axis with few slots the window may wrap onto itself: each slot once.
        let width: [usize; D] =
            std::array::from_fn(|axis| self.slots[axis].min(2 * reach as usize + 1));
        let first: [usize; D] = std::array::from_fn(|axis| {
            (cell[axis].wrapping_sub(reach)) as usize & (self.slots[axis] - 1)
        });
        // Hits are written down first and visited afterwards: one store for each agent
        // looked at, and no branch that depends on where it is.
        let mut hits = [0u32; HITS];
        let mut count = 0;
        let mut report = |hits: &[u32]| {
            for &hit in hits {
                let offset = self.sorted[hit as usize] - point;
                visit(hit as usize, offset, offset.norm_squared());
            }
        };
        let mut scan = |from: usize, to: usize| {
            let (from, to) = (self.starts[from], self.starts[to]);
            for (place, position) in (from..to).zip(&self.sorted[from as usize..to as usize]) {
                hits[count] = place;
                count += usize::from((position - point).norm_squared() <= limit);
                if count == HITS {
                    report(&hits);
                    count = 0;
                }
            }
        };
        // Rows run along the first axis, where slots are neighbours in memory.
        let rows: usize = width[1..].iter().product();
        for row in 0..rows {
            let (mut rest, mut base, mut stride) = (row, 0, self.slots[0]);
            for axis in 1..D {
                let at = (first[axis] + rest % width[axis]) & (self.slots[axis] - 1);
                base += at * stride;
                stride *= self.slots[axis];
                rest /= width[axis];
            }
            let end = first[0] + width[0];
            if end <= self.slots[0] {
                scan(base + first[0], base + end);
            } else {
                scan(base + first[0], base + self.slots[0]);
                scan(base, base + end - self.slots[0]);
            }
        }
        report(&hits[..count]);
    }

    /// How many others share an agent's slot, on average.
    pub fn crowding(&self) -> f64 {
        2.0 * self.pairs as f64 / self.sorted.len().max(1) as f64
    }

    /// Whether one slot holds all agents.
    pub fn is_one(&self) -> bool {
        self.starts.len() == 2
    }

    /// The agent at each place of the sorted order.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Writes the place of each agent in the sorted order into `places`.
    pub fn places(&self, places: &mut Vec<u32>) {
        places.resize(self.order.len(), 0);
        for (place, &agent) in self.order.iter().enumerate() {
            places[agent as usize] = place as u32;
        }
    }

    /// The positions in the sorted order.
    pub fn sorted(&self) -> &[Vector<D>] {
        &self.sorted
    }

    #[inline]
    fn cell(&self, point: &Vector<D>) -> [i64; D] {
        std::array::from_fn(|axis| {
            // The floor; that of the library is a call on older processors.
            let number = point[axis] * self.per_side;
            let whole = number as i64;
            whole.saturating_sub(i64::from(whole as f64 > number))
        })
    }

    fn slot(&self, cell: &[i64; D]) -> usize {
        let mut slot = 0;
        for axis in (0..D).rev() {
            slot = slot * self.slots[axis] + (cell[axis] as usize & (self.slots[axis] - 1));
        }
        slot
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn brute<const D: usize>(positions: &[Vector<D>], point: &Vector<D>, range: f64) -> Vec<usize> {
        (0..positions.len())
            .filter(|&j| (positions[j] - point).norm_squared() <= range * range)
            .collect()
    }

    fn found<const D: usize>(cells: &Cells<D>, point: &Vector<D>, range: f64) -> Vec<usize> {
        let mut found = Vec::new();
        cells.for_each_within(point, range, |place, _, _| {
            found.push(cells.order()[place] as usize)
        });
        found.sort_unstable();
        found
    }

    fn check<const D: usize>(positions: &[Vector<D>], side: f64, range: f64) {
        let mut cells = Cells::default();
        cells.rebuild(positions, side);
        for point in positions {
            assert_eq!(found(&cells, point, range), brute(positions, point, range));
        }
        let outside = Vector::repeat(-3.7);
        assert_eq!(
            found(&cells, &outside, range),
            brute(positions, &outside, range)
        );
    }

    proptest! {
        #[test]
        fn equals_brute_force_in_the_plane(
            points in prop::collection::vec(prop::array::uniform2(-20.0..20.0f64), 1..120),
            side in 0.3..9.0f64,
            range in 0.0..15.0f64,
        ) {
            let points: Vec<Vector<2>> = points.into_iter().map(Vector::from).collect();
            check(&points, side, range);
        }

        #[test]
        fn equals_brute_force_in_space(
            points in prop::collection::vec(prop::array::uniform3(-6.0..6.0f64), 1..120),
            side in 0.3..4.0f64,
            range in 0.0..6.0f64,
        ) {
            let points: Vec<Vector<3>> = points.into_iter().map(Vector::from).collect();
            check(&points, side, range);
        }
    }

    #[test]
    fn outliers_neither_confuse_nor_exhaust_it() {
        let mut points: Vec<Vector<2>> = (0..50)
            .map(|k| Vector::<2>::new(f64::from(k) * 0.5, 0.0))
            .collect();
        points.push(Vector::<2>::new(1e300, -1e300));
        points.push(Vector::<2>::new(-1e12, 1e12));
        check(&points, 1.0, 1.0);
    }

    #[test]
    fn one_agent_far_below_the_others_hides_none_of_them() {
        let mut points: Vec<Vector<2>> = (0..50)
            .map(|k| Vector::<2>::new(f64::from(k) * 0.5, 0.0))
            .collect();
        points.push(Vector::<2>::new(-1e17, -1e17));
        check(&points, 1.0, 1.0);
    }

    #[test]
    fn a_million_agents_in_a_vast_space_fit_the_table() {
        let mut cells = Cells::default();
        let points: Vec<Vector<3>> = (0..1_100_000)
            .map(|k| Vector::<3>::repeat(f64::from(k) * 1e6))
            .collect();
        cells.rebuild(&points, 1.0);
        assert_eq!(found(&cells, &points[777], 1.0), [777]);
    }
}
