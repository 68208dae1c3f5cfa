//! Parts of obstacles that agents may touch.

use rayon::prelude::*;

use super::STEPS;
use crate::math::Vector;
use crate::parallel::{CHUNK, for_each};
use crate::shape::{Boxes, Obstacle, Pose, Reach, Solid};

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
        }
    }

    /// Has the lists serve for a step that led from `from` to `to` on ways that bend by at most
    /// the lengths that `bend` tells, and for the start of the next. No surface of the obstacles,
    /// which are where they are at its end, moved farther than `moved` tells.
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
        self.everywhere.clear();
        let mut step = 0.0f64;
        for k in 0..obstacles.len() {
            match moved(k) {
                way if way.is_finite() => step = step.max(way),
                _ => self.everywhere.push(k as u32),
            }
        }
        self.moved += step;
        let agents = to.len();
        let chunks = self.gone.par_chunks_mut(CHUNK).enumerate();
        let chunks = chunks.zip(self.lists.par_chunks_mut(CHUNK));
        let (boxes, everywhere, all) = (&self.boxes, &self.everywhere, self.moved);
        let (balls, kinds) = (&self.balls, &self.kinds);
        for_each(agents, chunks, |((chunk, gone), lists)| {
            for (k, i) in (chunk * CHUNK..).take(gone.len()).enumerate() {
                let way = (to[i] - from[i]).norm() + 2.0 * bend(i);
                let travel = (way + step) * (1.0 + 1e-9) + 1e-15 * to[i].amax();
                gone[k] += travel - step;
                let list = &mut lists[k];
                if gone[k] + all <= list.until {
                    continue;
                }
                let ball = &balls[kinds[i]];
                let budget = (STEPS * travel).max(0.1 * ball.radius());
                list.since = gone[k] + all - travel;
                list.until = list.since + budget;
                list.near.clear();
                find(
                    ball,
                    &to[i],
                    budget,
                    (obstacles, boxes, everywhere),
                    &mut list.near,
                );
            }
        });
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
        let list = &self.lists[agent];
        !self.any || self.gone[agent] + self.moved <= list.until
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
    let range = ball.radius() + budget;
    let reach = Vector::repeat(range);
    let (point, bounds) = (*place, (place - reach, place + reach));
    let mut look = |k: usize, budget: f64| {
        let obstacle = &obstacles[k];
        obstacle.parts_near(&bounds, &mut |part| {
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
