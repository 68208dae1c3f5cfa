//! Who may be near: lists of neighbours with a skin, which serve many steps.
//!
//! All pairs within the range and a skin are listed once. While the two agents that moved
//! farthest since, against the motion that all have in common, moved less than the skin in
//! all, no other pair can have come within range: L. Verlet, "Computer experiments on
//! classical fluids", 1967. Whoever uses a list checks distances, and finds the listed agents
//! in the order of the world; so results do not tell when the list was made.

use rayon::prelude::*;

use crate::math::Vector;
use crate::sense::{CHUNK, Cells, PARALLEL_FROM};

/// For each agent the others that may be within a range.
#[derive(Debug)]
pub(crate) struct Vicinity<const D: usize> {
    range: f64,
    skin: f64,
    /// Where the agents were when the lists were made, and their mean.
    then: Vec<Vector<D>>,
    mean: Vector<D>,
    /// How often the lists were used since.
    uses: u32,
    cells: Cells<D>,
    /// Place of each agent in those cells.
    places: Vec<u32>,
    lists: Vec<List>,
}

/// The lists of one chunk of agents, in the order of the cells.
#[derive(Debug, Default)]
struct List {
    /// Where each agent's others end.
    ends: Vec<u32>,
    /// Agents of the world, each agent's in increasing order.
    others: Vec<u32>,
}

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
        }
    }
}

impl<const D: usize> Vicinity<D> {
    /// Makes the lists serve for agents at `positions`, whose mean is `mean`, up to `range`.
    pub(crate) fn follow(&mut self, positions: &[Vector<D>], mean: Vector<D>, range: f64) {
        let same = self.then.len() == positions.len() && range <= self.range;
        let moved = match same {
            true => self.moved(positions, mean),
            false => f64::INFINITY,
        };
        self.uses += 1;
        if moved <= self.skin {
            return;
        }
        // Making lists costs about as much as using them six times, so with a motion of m per
        // use the skin s that costs least has s² about range × m.
        let share = match moved.is_finite() {
            true => (4.0 * moved / (f64::from(self.uses) * range)).sqrt(),
            false => 0.1,
        };
        self.skin = share.clamp(*SKIN.start(), *SKIN.end()) * range;
        self.range = range;
        self.then.clear();
        self.then.extend_from_slice(positions);
        self.mean = mean;
        self.uses = 0;
        self.list();
    }

    /// The largest distance up to which the lists serve.
    pub(crate) fn range(&self) -> f64 {
        self.range
    }

    /// The others that may be near an agent of the world, in increasing order.
    #[inline]
    pub(crate) fn of(&self, agent: u32) -> &[u32] {
        let place = self.places[agent as usize] as usize;
        let (list, at) = (&self.lists[place / CHUNK], place % CHUNK);
        let begin = if at == 0 { 0 } else { list.ends[at - 1] };
        &list.others[begin as usize..list.ends[at] as usize]
    }

    /// By how much two agents may have come closer since the lists were made.
    fn moved(&self, positions: &[Vector<D>], mean: Vector<D>) -> f64 {
        let common = mean - self.mean;
        let [mut first, mut second] = [0.0, 0.0];
        for (now, then) in positions.iter().zip(&self.then) {
            let squared = (now - then - common).norm_squared();
            second = f64::max(second, f64::min(first, squared));
            first = f64::max(first, squared);
        }
        // More than rounding can be off, also that of a common motion far and wide.
        first.sqrt() + second.sqrt() + 1e-12 * (self.range + common.norm())
    }

    fn list(&mut self) {
        let reach = self.range + self.skin;
        self.cells.rebuild(&self.then, reach);
        self.places.resize(self.then.len(), 0);
        for (place, &agent) in self.cells.order().iter().enumerate() {
            self.places[agent as usize] = place as u32;
        }
        let cells = &self.cells;
        let fill = |(list, (order, positions)): (&mut List, (&[u32], &[Vector<D>]))| {
            list.ends.clear();
            list.others.clear();
            for (agent, position) in order.iter().zip(positions) {
                let begin = list.others.len();
                cells.for_each_within(position, reach, |place, _, _| {
                    let other = cells.order()[place];
                    if other != *agent {
                        list.others.push(other);
                    }
                });
                list.others[begin..].sort_unstable();
                list.ends.push(list.others.len() as u32);
            }
        };
        let agents = self.then.len();
        self.lists
            .resize_with(agents.div_ceil(CHUNK), List::default);
        let (order, sorted) = (cells.order(), cells.sorted());
        if agents < PARALLEL_FROM {
            let chunks = order.chunks(CHUNK).zip(sorted.chunks(CHUNK));
            self.lists.iter_mut().zip(chunks).for_each(fill);
        } else {
            let chunks = order.par_chunks(CHUNK).zip(sorted.par_chunks(CHUNK));
            self.lists.par_iter_mut().zip(chunks).for_each(fill);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::mean;
    use proptest::prelude::*;

    fn follow<const D: usize>(vicinity: &mut Vicinity<D>, positions: &[Vector<D>], range: f64) {
        vicinity.follow(positions, mean(positions), range);
    }

    /// That nobody within range is missing, and that lists are in order and without the agent.
    fn check<const D: usize>(vicinity: &Vicinity<D>, positions: &[Vector<D>], range: f64) {
        for (i, position) in positions.iter().enumerate() {
            let others = vicinity.of(i as u32);
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
