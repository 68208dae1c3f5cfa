//! Parts of obstacles that agents may touch.

use rayon::prelude::*;

use super::STEPS;
use crate::dynamics::contact::CROWDED;
use crate::math::Vector;
use crate::parallel::{CHUNK, for_each};
use crate::shape::{Bounds, Boxes, Obstacle, Pose, Reach, Solid};

/// A part of an obstacle near an agent.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Near {
    obstacle: u32,
    part: u32,
    /// The gap to the ball about the agent when it was found.
    gap: f64,
}

/// What of the obstacles is near one agent.
#[derive(Debug, Default)]
struct List {
    near: Vec<Near>,
    /// The length of the agent's and of the obstacles' ways when this was found, and up to which
    /// nothing else can have come near.
    since: f64,
    until: f64,
}

/// Parts of obstacles near agents.
#[derive(Debug)]
pub(in crate::dynamics::contact) struct Walls<const D: usize> {
    /// The balls about the agents.
    balls: Vec<Solid<D>>,
    kinds: Vec<usize>,
    radii: Vec<f64>,
    /// Boxes about the obstacles.
    pub(in crate::dynamics::contact) boxes: Boxes<D>,
    /// Obstacles whose ways have no bound, and are near everybody.
    everywhere: Vec<u32>,
    /// How far each agent and the moving obstacles have gone in all.
    gone: Vec<f64>,
    moved: f64,
    /// Whether there are obstacles at all.
    any: bool,
    lists: Vec<List>,
    /// The agents that bounced farther than their lists serve.
    strayed: Vec<usize>,
}

impl<const D: usize> Walls<D> {
    /// No lists yet, of agents in balls of some kinds.
    pub(in crate::dynamics::contact) fn new(balls: Vec<Solid<D>>, kinds: &[usize]) -> Self {
        Self {
            radii: kinds.iter().map(|&kind| balls[kind].radius()).collect(),
            kinds: kinds.to_vec(),
            balls,
            boxes: Boxes::default(),
            everywhere: Vec::new(),
            gone: vec![0.0; kinds.len()],
            moved: 0.0,
            any: false,
            lists: kinds.iter().map(|_| List::default()).collect(),
            strayed: Vec::new(),
        }
    }

    /// Has the lists serve for a step that led from `from` to `to` on ways that bend by at most
    /// the lengths that `bend` tells, and for the start of the next, up to the widest gap at which
    /// a pair may be held. No surface of the obstacles, which are where they are at its end, moved
    /// farther than `moved` tells.
    pub(in crate::dynamics::contact) fn follow(
        &mut self,
        [from, to]: [&[Vector<D>]; 2],
        bend: &(impl Fn(usize) -> f64 + Sync),
        obstacles: &[Obstacle<D>],
        moved: &dyn Fn(usize) -> f64,
    ) {
        if obstacles.is_empty() {
            return;
        }
        self.any = true;
        self.boxes.about(obstacles);
        let before = std::mem::take(&mut self.everywhere);
        let mut step = 0.0f64;
        for k in 0..obstacles.len() {
            match moved(k) {
                way if way.is_finite() => step = step.max(way),
                _ => self.everywhere.push(k as u32),
            }
        }
        self.moved += step;
        let changed = self.everywhere != before;
        let agents = to.len();
        let mut gone = std::mem::take(&mut self.gone);
        let mut lists = std::mem::take(&mut self.lists);
        let chunks = gone.par_chunks_mut(CHUNK).enumerate();
        let chunks = chunks.zip(lists.par_chunks_mut(CHUNK));
        for_each(agents, chunks, |((chunk, gone), lists)| {
            for (k, i) in (chunk * CHUNK..).take(gone.len()).enumerate() {
                let way = (to[i] - from[i]).norm() + 2.0 * bend(i);
                let travel = (way + step) * (1.0 + 1e-9) + 1e-15 * to[i].amax();
                gone[k] += travel - step;
                let list = &mut lists[k];
                if changed || gone[k] + self.moved + self.spare(i) > list.until {
                    let budget = (STEPS * travel).max(0.1 * self.radii[i]) + self.spare(i);
                    list.since = gone[k] + self.moved - travel;
                    list.until = list.since + budget;
                    self.list(i, &to[i], obstacles, list);
                }
            }
        });
        (self.gone, self.lists) = (gone, lists);
        self.strayed.clear();
    }

    /// Has the lists serve again where agents are after bounces in the same step.
    pub(in crate::dynamics::contact) fn follow_bounces(
        &mut self,
        to: &[Vector<D>],
        obstacles: &[Obstacle<D>],
    ) {
        let mut strayed = std::mem::take(&mut self.strayed);
        // Who bounced more than once is listed once.
        strayed.sort_unstable();
        strayed.dedup();
        for agent in strayed {
            let mut list = std::mem::take(&mut self.lists[agent]);
            // For as long again.
            let budget = list.until - list.since;
            list.since = self.gone(agent);
            list.until = list.since + budget;
            self.list(agent, &to[agent], obstacles, &mut list);
            self.lists[agent] = list;
        }
    }

    /// What must be left of an agent's list: the widest gap at which it may be held at a wall.
    fn spare(&self, agent: usize) -> f64 {
        CROWDED * self.radii[agent]
    }

    /// Lists the parts whose gap to an agent is within what its list serves for.
    fn list(&self, agent: usize, place: &Vector<D>, obstacles: &[Obstacle<D>], list: &mut List) {
        list.near.clear();
        let ball = &self.balls[self.kinds[agent]];
        find(
            ball,
            place,
            list.until - list.since,
            (obstacles, &self.boxes, &self.everywhere),
            &mut list.near,
        );
    }

    /// Visits the parts whose gap to an agent may be below `gap` in the step.
    pub(in crate::dynamics::contact) fn below(
        &self,
        gap: f64,
        mut visit: impl FnMut(usize, usize, usize),
    ) {
        for (agent, list) in self.lists.iter().enumerate() {
            if !list.near.is_empty() {
                self.of(agent, gap, |obstacle, part| visit(agent, obstacle, part));
            }
        }
    }

    /// Visits the parts whose gap to one agent may be below `gap` in the step.
    pub(in crate::dynamics::contact) fn of(
        &self,
        agent: usize,
        gap: f64,
        mut visit: impl FnMut(usize, usize),
    ) {
        let list = &self.lists[agent];
        let used = self.gone[agent] + self.moved - list.since;
        for near in &list.near {
            if near.gap - used < gap {
                visit(near.obstacle as usize, near.part as usize);
            }
        }
    }

    /// Notes that one agent goes so far beyond its way in the step; tells whether it is still
    /// within its budget.
    pub(in crate::dynamics::contact) fn stray(&mut self, agent: usize, way: f64) -> bool {
        self.gone[agent] += way;
        let (gone, until) = (self.gone(agent), self.lists[agent].until);
        if self.any && gone + self.spare(agent) > until {
            self.strayed.push(agent);
        }
        !self.any || gone <= until
    }

    /// How far an agent and the obstacles have gone in all: gaps change by no more.
    pub(in crate::dynamics::contact) fn gone(&self, agent: usize) -> f64 {
        self.gone[agent] + self.moved
    }

    /// The gap from the ball about an agent to the nearest obstacle, if that is at most `reach`.
    pub(in crate::dynamics::contact) fn nearest(
        &self,
        agent: usize,
        place: &Vector<D>,
        obstacles: &[Obstacle<D>],
        reach: f64,
    ) -> Option<f64> {
        let radius = self.radii[agent];
        let (point, range) = (*place, reach + radius);
        let mut least = f64::INFINITY;
        for k in self.boxes.reached(Reach::Around { point, range }) {
            if obstacles[k].may_reach(place, least.min(reach) + radius) {
                least = least.min(obstacles[k].project(place).distance - radius);
            }
        }
        (least <= reach).then_some(least)
    }

    /// Visits the parts of obstacles that may be within a range of a place.
    pub(in crate::dynamics::contact) fn parts_around(
        &self,
        place: &Vector<D>,
        range: f64,
        obstacles: &[Obstacle<D>],
        mut visit: impl FnMut(usize, usize),
    ) {
        let (point, bounds) = (*place, about(place, range));
        for k in self.boxes.reached(Reach::Around { point, range }) {
            obstacles[k].parts_near(&bounds, &mut |part| visit(k, part));
        }
    }
}

/// Finds the parts whose gap to a ball is at most `budget`.
fn find<const D: usize>(
    ball: &Solid<D>,
    place: &Vector<D>,
    budget: f64,
    (obstacles, boxes, everywhere): (&[Obstacle<D>], &Boxes<D>, &[u32]),
    out: &mut Vec<Near>,
) {
    let here = Pose::from_matrix(*place, nalgebra::SMatrix::identity());
    let (point, range) = (*place, ball.radius() + budget);
    let mut look = |k: usize, budget: f64| {
        let obstacle = &obstacles[k];
        obstacle.parts_near(&about(place, range), &mut |part| {
            let found = obstacle.parts()[part].separation(&obstacle.pose, ball, &here);
            if found.gap <= budget {
                out.push(Near {
                    obstacle: k as u32,
                    part: part as u32,
                    gap: match budget.is_finite() {
                        true => found.gap,
                        false => f64::NEG_INFINITY,
                    },
                });
            }
        });
    };
    for k in boxes.reached(Reach::Around { point, range }) {
        if !everywhere.contains(&(k as u32)) {
            look(k, budget);
        }
    }
    everywhere
        .iter()
        .for_each(|&k| look(k as usize, f64::INFINITY));
    out.sort_unstable_by_key(|near| (near.obstacle, near.part));
}

/// The box about a place.
fn about<const D: usize>(place: &Vector<D>, range: f64) -> Bounds<D> {
    let reach = Vector::repeat(range);
    (place - reach, place + reach)
}
