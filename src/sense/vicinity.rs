//! Who may be near: lists of neighbours with a skin, which serve many steps.
//!
//! All pairs within the range and a skin are listed once. While the two agents that moved
//! farthest since, against the motion that all have in common, moved less than the skin in
//! all, no other pair can have come within range: L. Verlet, "Computer experiments on
//! classical fluids", 1967. Whoever uses a list checks distances, and finds the listed agents
//! in the order of the world; so results do not tell when the list was made.
//!
//! While lists serve, agents keep the order that they had in the cells from which the lists
//! were made: neighbours in space stay neighbours in memory, and lists tell places in it.

use rayon::prelude::*;

use crate::math::Vector;
use crate::parallel::{CHUNK, for_each};
use crate::sense::Cells;

/// For each agent the others that may be within a range.
#[derive(Debug)]
pub(crate) struct Vicinity<const D: usize> {
    range: f64,
    skin: f64,
    /// Where the agents were when the lists were made, in their order, and their mean.
    then: Vec<Vector<D>>,
    mean: Vector<D>,
    /// How often the lists were used since.
    uses: u32,
    cells: Cells<D>,
    /// Place of each agent in those cells.
    places: Vec<u32>,
    lists: Vec<List>,
    /// What each chunk of agents finds when it looks how far they moved.
    farthest: Vec<[f64; 2]>,
}

/// The lists of one chunk of agents, in the order of the cells.
#[derive(Debug, Default)]
struct List {
    /// Where each agent's others end.
    ends: Vec<u32>,
    /// Their places, each agent's in the order of the world.
    others: Vec<u32>,
}

/// Others in an agent's cell from which on, on average, lists grow too long to be kept.
const CROWDED: f64 = 32.0;

/// Skins as shares of the range. A wide one serves longer, a narrow one lists less.
const SKIN: std::ops::RangeInclusive<f64> = 0.03..=0.5;

impl<const D: usize> Default for Vicinity<D> {
    fn default() -> Self {
        Self {
            range: 0.0,
            skin: 0.0,
            then: Vec::new(),
            mean: Vector::zeros(),
            uses: 0,
            cells: Cells::default(),
            places: Vec::new(),
            lists: Vec::new(),
            farthest: Vec::new(),
        }
    }
}

impl<const D: usize> Vicinity<D> {
    /// Makes the lists serve for agents at `positions`, whose mean is `mean`, up to `range`.
    /// Returns whether they do: not where so many are near each other that lists grow too long
    /// to be kept.
    pub(crate) fn follow(&mut self, positions: &[Vector<D>], mean: Vector<D>, range: f64) -> bool {
        let same = self.then.len() == positions.len() && range <= self.range;
        let moved = match same {
            true => self.moved(positions, mean),
            false => f64::INFINITY,
        };
        self.uses += 1;
        if moved <= self.skin {
            return true;
        }
        // Making lists costs about as much as using them six times, so with a motion of m per
        // use the skin s that costs least has s² about range × m.
        let share = match moved.is_finite() {
            true => (4.0 * moved / (f64::from(self.uses) * range)).sqrt(),
            false => 0.1,
        };
        self.skin = share.clamp(*SKIN.start(), *SKIN.end()) * range;
        self.range = range;
        self.mean = mean;
        self.uses = 0;
        let reach = self.range + self.skin;
        self.cells.rebuild(positions, reach);
        self.cells.places(&mut self.places);
        if self.cells.crowding() > CROWDED {
            self.then.clear();
            return false;
        }
        self.then.clear();
        self.then.extend_from_slice(self.cells.sorted());
        self.list(reach);
        true
    }

    /// The largest distance up to which the lists serve.
    pub(crate) fn range(&self) -> f64 {
        self.range
    }

    /// The cells of the agents as they were when [`Vicinity::follow`] looked at all of them last,
    /// which is just now where it has no lists.
    pub(crate) fn cells(&self) -> &Cells<D> {
        &self.cells
    }

    /// The place of each agent of the world in the order of those cells.
    pub(crate) fn places(&self) -> &[u32] {
        &self.places
    }

    /// The places of the others that may be near the agent at a place, in the order of the
    /// world.
    #[inline]
    pub(crate) fn of(&self, place: usize) -> &[u32] {
        let (list, at) = (&self.lists[place / CHUNK], place % CHUNK);
        let begin = if at == 0 { 0 } else { list.ends[at - 1] };
        &list.others[begin as usize..list.ends[at] as usize]
    }

    /// By how much two agents may have come closer since the lists were made.
    fn moved(&mut self, positions: &[Vector<D>], mean: Vector<D>) -> f64 {
        let common = mean - self.mean;
        let agents = self.then.len();
        self.farthest.resize(agents.div_ceil(CHUNK), [0.0; 2]);
        let then = self.then.par_chunks(CHUNK);
        let chunks = then.zip(self.cells.order().par_chunks(CHUNK));
        for_each(
            agents,
            chunks.zip(&mut self.farthest),
            |((then, order), farthest)| {
                let now = order.iter().map(|&agent| positions[agent as usize]);
                let ways = now.zip(then).map(|(now, then)| now - then - common);
                *farthest = two_largest(ways.map(|way| way.norm_squared()));
            },
        );
        let [first, second] = two_largest(self.farthest.iter().flatten().copied());
        // More than rounding can be off, also that of a common motion far and wide.
        first.sqrt() + second.sqrt() + 1e-12 * (self.range + common.norm())
    }

    /// Lists those at most `reach` from each other in the cells.
    fn list(&mut self, reach: f64) {
        let agents = self.then.len();
        let (cells, places) = (&self.cells, &self.places);
        let fill = |(list, (chunk, positions)): (&mut List, (usize, &[Vector<D>]))| {
            list.ends.clear();
            list.others.clear();
            for (me, position) in (chunk * CHUNK..).zip(positions) {
                let begin = list.others.len();
                cells.for_each_within(position, reach, |place, _, _| {
                    if place != me {
                        list.others.push(cells.order()[place]);
                    }
                });
                let others = &mut list.others[begin..];
                others.sort_unstable();
                let place = |agent: &mut u32| *agent = places[*agent as usize];
                others.iter_mut().for_each(place);
                list.ends.push(list.others.len() as u32);
            }
        };
        let chunks = agents.div_ceil(CHUNK);
        self.lists.resize_with(chunks, List::default);
        let sorted = cells.sorted().par_chunks(CHUNK).enumerate();
        for_each(agents, self.lists.par_iter_mut().zip(sorted), fill);
    }
}

/// The two largest of some values that are not negative.
fn two_largest(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([0.0; 2], |[first, second], value| {
        [
            f64::max(first, value),
            f64::max(second, f64::min(first, value)),
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::mean;
    use proptest::prelude::*;

    fn follow<const D: usize>(vicinity: &mut Vicinity<D>, positions: &[Vector<D>], range: f64) {
        assert!(vicinity.follow(positions, mean(positions), range));
    }

    /// That nobody within range is missing, and that lists are in order and without the agent.
    fn check<const D: usize>(vicinity: &Vicinity<D>, positions: &[Vector<D>], range: f64) {
        for (i, position) in positions.iter().enumerate() {
            let others = vicinity.of(vicinity.places()[i] as usize);
            let agents = others
                .iter()
                .map(|&place| vicinity.cells().order()[place as usize]);
            let others: Vec<u32> = agents.collect();
            assert!(others.is_sorted() && !others.contains(&(i as u32)));
            for (j, other) in positions.iter().enumerate() {
                let near = i != j && (other - position).norm_squared() <= range * range;
                assert!(!near || others.contains(&(j as u32)), "{i} misses {j}");
            }
        }
    }

    fn drift<const D: usize>(start: &[[f64; D]], pushes: &[[f64; D]], range: f64, speed: f64) {
        let mut positions: Vec<Vector<D>> = start.iter().map(|at| Vector::from(*at)).collect();
        let mut vicinity = Vicinity::default();
        for step in 0..40 {
            follow(&mut vicinity, &positions, range);
            check(&vicinity, &positions, range);
            for (k, position) in positions.iter_mut().enumerate() {
                let push = Vector::from(pushes[(k + step) % pushes.len()]);
                *position += push * speed + Vector::repeat(3.0);
            }
        }
    }

    proptest! {
        #[test]
        fn nobody_within_range_is_missing_in_the_plane(
            start in prop::collection::vec(prop::array::uniform2(-9.0..9.0f64), 1..60),
            pushes in prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 1..9),
            range in 0.1..6.0f64,
            speed in 0.0..0.5f64,
        ) {
            drift(&start, &pushes, range, speed);
        }

        #[test]
        fn nobody_within_range_is_missing_in_space(
            start in prop::collection::vec(prop::array::uniform3(-4.0..4.0f64), 1..60),
            pushes in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 1..9),
            range in 0.1..4.0f64,
            speed in 0.0..0.5f64,
        ) {
            drift(&start, &pushes, range, speed);
        }
    }

    #[test]
    fn lists_serve_as_long_as_the_motion_is_common() {
        let mut positions: Vec<Vector<2>> = (0..30)
            .map(|k| Vector::<2>::new(f64::from(k), f64::from(k % 7)))
            .collect();
        let mut vicinity = Vicinity::default();
        for _ in 0..50 {
            follow(&mut vicinity, &positions, 2.5);
            positions.iter_mut().for_each(|at| at[0] += 1e3);
        }
        assert_eq!(vicinity.uses, 49);
        // A shorter range is served as well; another number of agents, or a longer range, not.
        follow(&mut vicinity, &positions, 1.0);
        assert_eq!(vicinity.uses, 50);
        positions.pop();
        follow(&mut vicinity, &positions, 1.0);
        assert_eq!((vicinity.uses, vicinity.range()), (0, 1.0));
        follow(&mut vicinity, &positions, 2.0);
        assert_eq!((vicinity.uses, vicinity.range()), (0, 2.0));
    }

    #[test]
    fn one_agent_that_moves_ends_them() {
        let mut positions: Vec<Vector<2>> = (0..30)
            .map(|k| Vector::<2>::new(3.0 * f64::from(k), 0.0))
            .collect();
        let mut vicinity = Vicinity::default();
        follow(&mut vicinity, &positions, 1.0);
        positions[29] = Vector::<2>::new(0.9, 0.0);
        follow(&mut vicinity, &positions, 1.0);
        assert_eq!(vicinity.uses, 0);
        check(&vicinity, &positions, 1.0);
    }
}
