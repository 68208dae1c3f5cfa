//! What the laws see at one moment.

use std::borrow::Cow;

use crate::math::{Matrix, Vector};
use crate::sense::cells::HITS;
use crate::sense::hold::{Hold, held, held_near};
use crate::sense::{Active, Cells, Perception, Surroundings, Vicinity};
use crate::shape::Obstacle;

/// The state of the world at one moment, as the laws see it.
///
/// Agents come in an order in which neighbours in space are neighbours in memory: what laws
/// call agent `i` is the agent `agents[i]` of the world. That order may tell of the past: sums
/// over agents must not follow it, but that of the world, or runs that are resumed would not go
/// on as they would have.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a, const D: usize> {
    /// Time since the start.
    pub time: f64,
    /// The world's index of each agent.
    pub agents: &'a [u32],
    /// The place in the scene of each agent of the world.
    pub places: &'a [u32],
    /// Position of each agent.
    pub positions: &'a [Vector<D>],
    /// Velocity of each agent.
    pub velocities: &'a [Vector<D>],
    /// Heading of each agent, a unit vector.
    pub headings: &'a [Vector<D>],
    /// Group of each agent.
    pub groups: &'a [u32],
    /// Mass of each agent, in the order of the world; see [`Scene::mass`].
    pub masses: &'a [f64],
    /// Rotation of each body, in the order of the world; none where all are balls.
    pub rotations: &'a [Matrix<D>],
    /// The obstacles.
    pub obstacles: &'a [Obstacle<D>],
    /// Where they are.
    pub(crate) surroundings: &'a Surroundings<D>,
    /// Mean of the positions; of those in scope where the law has a scope.
    pub mean_position: Vector<D>,
    /// Mean of the velocities, likewise.
    pub mean_velocity: Vector<D>,
    /// What the agents perceive; absent where they perceive all without limits or errors.
    pub perception: Option<&'a Perception<D>>,
    /// For each group, whether its agents count as neighbours; absent where all do.
    pub visible: Option<&'a [bool]>,
    /// Pairs whose distance does not tell whether they are near; none but for points.
    pub(crate) holds: &'a [Hold],
    /// How to find who is near.
    pub(crate) search: Search<'a, D>,
}

/// A way to find who is near.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Search<'a, const D: usize> {
    /// To look at all.
    All,
    /// Cells, with the agents in their order.
    Cells(&'a Cells<D>),
    /// Lists, with the agents in their order.
    Lists(&'a Vicinity<D>),
}

/// Another agent, as an agent perceives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbour<const D: usize> {
    /// Its index in the scene.
    pub index: usize,
    /// The way to it, from the agent that perceives it.
    pub offset: Vector<D>,
    /// Square of the distance to it: of the length of `offset`.
    pub squared: f64,
    /// Its velocity.
    pub velocity: Vector<D>,
    /// Where its velocity points, or last pointed: a unit vector.
    pub heading: Vector<D>,
    /// What laws multiply its whole contribution by, 0 to 1: less than 1 only where the
    /// agent perceives by a smooth cone, Olfati-Saber (2003), (18).
    pub weight: f64,
}

impl<const D: usize> Scene<'_, D> {
    /// Mass of agent `i` of the scene.
    #[inline]
    pub fn mass(&self, i: usize) -> f64 {
        self.masses[self.agents[i] as usize]
    }

    /// A value of each agent of the scene, in the order of the world: that order does not depend
    /// on where they are or were, so sums in it are the same whatever other laws there are.
    pub fn in_world_order<T>(&self, value: impl Fn(usize) -> T) -> impl Iterator<Item = T> {
        self.places.iter().map(move |&place| value(place as usize))
    }

    /// Number of agents that the law may count as neighbours, however far away: the N of
    /// the papers' means. All agents, or those that its scope lets it see.
    pub fn count(&self) -> usize {
        match self.visible {
            None => self.groups.len(),
            Some(_) => (0..self.groups.len()).filter(|&i| self.sees(i)).count(),
        }
    }

    /// The active obstacles of a point: see [`Surroundings::active`].
    pub fn active_obstacles(
        &self,
        point: &Vector<D>,
        range: f64,
    ) -> impl Iterator<Item = Active<D>> {
        self.surroundings.active(self.obstacles, point, range)
    }

    /// The indices of the obstacles that stand between two points, in the order of the world.
    pub fn obstacles_between(
        &self,
        from: &Vector<D>,
        to: &Vector<D>,
    ) -> impl Iterator<Item = usize> {
        self.surroundings.between(self.obstacles, from, to)
    }

    /// Whether the law may count agent `i` of the scene as a neighbour.
    #[inline]
    pub fn sees(&self, i: usize) -> bool {
        self.visible
            .is_none_or(|visible| visible[self.groups[i] as usize])
    }

    /// Calls `visit` with every neighbour of agent `i`: each other agent that it perceives
    /// at most `range` away, in an order that does not depend on the number of threads.
    ///
    /// This is the only door to neighbours: what comes through it is what the agent's
    /// senses tell. With noise, `offset` may be longer than the range: that is of the true
    /// distance. An infinite range is that of all pairs.
    #[inline]
    pub fn neighbours(&self, i: usize, range: f64, mut visit: impl FnMut(Neighbour<D>)) {
        if self.perception.is_some() || self.visible.is_some() || !self.holds.is_empty() {
            return self.perceived(i, range, &mut visit);
        }
        self.within(i, range, |index, offset, squared| {
            visit(self.neighbour(index, offset, squared));
        });
    }

    /// Calls `visit` with index, offset and squared distance of all others at most `range`
    /// away from agent `i`, in the order of the world.
    #[inline]
    fn within(&self, i: usize, range: f64, mut visit: impl FnMut(usize, Vector<D>, f64)) {
        let point = &self.positions[i];
        let limit = range * range;
        let mut hits = [0u32; HITS];
        for others in self.candidates(i, range).chunks(HITS) {
            // As in the search of cells: no branch that depends on where they are.
            let mut count = 0;
            for &place in others {
                let squared = (self.positions[place as usize] - point).norm_squared();
                hits[count] = place;
                count += usize::from((squared <= limit) & (place as usize != i));
            }
            for &hit in &hits[..count] {
                let offset = self.positions[hit as usize] - point;
                visit(hit as usize, offset, offset.norm_squared());
            }
        }
    }

    /// Agents in the order of the world, with all those among them that are at most `range` away
    /// from agent `i`.
    #[inline]
    fn candidates(&self, i: usize, range: f64) -> Cow<'_, [u32]> {
        match self.search {
            Search::Lists(lists) if range <= lists.range() => Cow::Borrowed(lists.of(i)),
            Search::Cells(cells) if range.is_finite() => {
                let mut found = Vec::new();
                cells.for_each_within(&self.positions[i], range, |place, _, _| {
                    found.push(self.agents[place]);
                });
                found.sort_unstable();
                let place = |agent: &mut u32| *agent = self.places[*agent as usize];
                found.iter_mut().for_each(place);
                Cow::Owned(found)
            }
            _ => Cow::Borrowed(self.places),
        }
    }

    /// The neighbours of agents with senses of their own, or of laws with a scope, or where
    /// pairs are held. Apart, so that the plain search stays small enough to be built into the
    /// laws.
    #[inline(never)]
    fn perceived(&self, i: usize, range: f64, visit: &mut dyn FnMut(Neighbour<D>)) {
        match self.perception {
            Some(perception) => perception
                .of(i, range, |index| self.held(i, index, range))
                .filter(|neighbour| self.sees(neighbour.index))
                .for_each(visit),
            None => self.within_or_held(i, range, |index, offset, squared, share| {
                if self.sees(index) {
                    let neighbour = self.neighbour(index, offset, squared);
                    visit(Neighbour {
                        weight: share,
                        ..neighbour
                    });
                }
            }),
        }
    }

    /// What is held of agents `i` and `index` of the scene at a distance, if anything is.
    pub(super) fn held(&self, i: usize, index: usize, distance: f64) -> Option<f64> {
        match self.holds {
            [] => None,
            holds => held(holds, [self.agents[i], self.agents[index]], distance),
        }
    }

    /// The agents that are held near agent `i` of the scene at a distance, each with its share.
    pub(super) fn held_near(&self, i: usize, distance: f64) -> impl Iterator<Item = (usize, f64)> {
        let near = held_near(self.holds, self.agents[i], distance);
        near.map(|(other, share)| (self.places[other as usize] as usize, share))
    }

    /// As [`Scene::within`], with the share that each counts for: those that are held near as
    /// well, and not those that are held far.
    fn within_or_held(
        &self,
        i: usize,
        range: f64,
        mut visit: impl FnMut(usize, Vector<D>, f64, f64),
    ) {
        let me = self.agents[i];
        let concerned = |hold: &Hold| hold.distance == range && hold.other(me).is_some();
        if !self.holds.iter().any(concerned) {
            return self.within(i, range, |index, offset, squared| {
                visit(index, offset, squared, 1.0);
            });
        }
        let mut found: Vec<(u32, usize, f64)> = Vec::new();
        self.within(i, range, |index, _, _| {
            if self.held(i, index, range).is_none() {
                found.push((self.agents[index], index, 1.0));
            }
        });
        let held = self.held_near(i, range);
        found.extend(held.map(|(index, share)| (self.agents[index], index, share)));
        found.sort_unstable_by_key(|(agent, ..)| *agent);
        for (_, index, share) in found {
            let offset = self.positions[index] - self.positions[i];
            visit(index, offset, offset.norm_squared(), share);
        }
    }

    /// An agent as it is.
    #[inline]
    fn neighbour(&self, index: usize, offset: Vector<D>, squared: f64) -> Neighbour<D> {
        Neighbour {
            index,
            offset,
            squared,
            velocity: self.velocities[index],
            heading: self.headings[index],
            weight: 1.0,
        }
    }
}
