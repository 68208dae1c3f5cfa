//! A flock: the sum of its laws.

use rayon::prelude::*;

use crate::law::Law;
use crate::math::{Vector, mean};
use crate::sense::{Cells, Scene};
use crate::shape::Obstacle;

/// Agents handled in one go; few enough to spread over threads, enough to be worth it.
const CHUNK: usize = 128;

/// Below this many agents, handing work to other threads costs more than it saves.
const PARALLEL_FROM: usize = 500;

/// The sum of some laws, with the neighbour search that they share.
pub struct Flock<const D: usize> {
    laws: Vec<Box<dyn Law<D>>>,
    scratch: Scratch<D>,
}

/// The state in the order of the cells, kept from step to step to save allocations.
#[derive(Default)]
struct Scratch<const D: usize> {
    cells: Cells<D>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    groups: Vec<u32>,
    accelerations: Vec<Vector<D>>,
}

/// A state of the agents and what stands around them: the input of a flock.
#[derive(Debug, Clone, Copy)]
pub struct State<'a, const D: usize> {
    /// Time since the start.
    pub time: f64,
    /// Position of each agent, finite.
    pub positions: &'a [Vector<D>],
    /// Velocity of each agent, finite.
    pub velocities: &'a [Vector<D>],
    /// Heading of each agent, a unit vector.
    pub headings: &'a [Vector<D>],
    /// Group of each agent.
    pub groups: &'a [usize],
    /// The obstacles.
    pub obstacles: &'a [Obstacle<D>],
}

impl<const D: usize> Flock<D> {
    /// A flock that obeys some laws.
    pub fn new(laws: Vec<Box<dyn Law<D>>>) -> Self {
        Self {
            laws,
            scratch: Scratch::default(),
        }
    }

    /// The laws, in their order.
    pub fn laws(&self) -> &[Box<dyn Law<D>>] {
        &self.laws
    }

    /// Writes the acceleration of each agent into `out`.
    ///
    /// Each agent's sum is taken in a fixed order, so the result does not depend on
    /// the number of threads.
    pub fn accelerations(&mut self, state: &State<'_, D>, out: &mut [Vector<D>]) {
        sum(&mut self.laws, state, &mut self.scratch, out);
    }

    /// The acceleration that each law alone gives each agent, by name of the law.
    pub fn by_law(&mut self, state: &State<'_, D>) -> Vec<(String, Vec<Vector<D>>)> {
        let mut by_law = Vec::new();
        for law in &mut self.laws {
            let mut out = vec![Vector::zeros(); state.positions.len()];
            sum(
                std::slice::from_mut(law),
                state,
                &mut self.scratch,
                &mut out,
            );
            by_law.push((law.name().to_owned(), out));
        }
        by_law
    }
}

/// Sums the laws over all agents.
fn sum<const D: usize>(
    laws: &mut [Box<dyn Law<D>>],
    state: &State<'_, D>,
    scratch: &mut Scratch<D>,
    out: &mut [Vector<D>],
) {
    let Scratch {
        cells,
        velocities,
        headings,
        groups,
        accelerations,
    } = scratch;
    let range = laws.iter().map(|law| law.range()).fold(0.0, f64::max);
    // Without neighbours to look for, one cell will do.
    cells.rebuild(state.positions, if range > 0.0 { range } else { f64::MAX });
    let order = || cells.order().iter().map(|&agent| agent as usize);
    velocities.clear();
    velocities.extend(order().map(|agent| state.velocities[agent]));
    headings.clear();
    headings.extend(order().map(|agent| state.headings[agent]));
    groups.clear();
    groups.extend(order().map(|agent| state.groups[agent] as u32));
    accelerations.clear();
    accelerations.resize(out.len(), Vector::zeros());
    let scene = Scene {
        time: state.time,
        agents: cells.order(),
        positions: cells.sorted(),
        velocities,
        headings,
        groups,
        cells,
        obstacles: state.obstacles,
        mean_position: mean(state.positions),
        mean_velocity: mean(state.velocities),
    };
    for law in &mut *laws {
        law.prepare(&scene);
    }
    let laws = &*laws;
    let add = |(chunk, out): (usize, &mut [Vector<D>])| {
        for law in laws {
            law.accelerate(&scene, chunk * CHUNK, out);
        }
    };
    if out.len() < PARALLEL_FROM {
        accelerations.chunks_mut(CHUNK).enumerate().for_each(add);
    } else {
        accelerations
            .par_chunks_mut(CHUNK)
            .enumerate()
            .for_each(add);
    }
    for (&agent, acceleration) in cells.order().iter().zip(&*accelerations) {
        out[agent as usize] = *acceleration;
    }
}
