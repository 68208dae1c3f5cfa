//! A flock: the sum of its laws.

use rayon::prelude::*;

use crate::law::Law;
use crate::math::{Vector, mean};
use crate::sense::{Cells, Scene};
use crate::shape::Obstacle;

/// Agents handled in one go; few enough to spread over threads, enough to be worth it.
const CHUNK: usize = 256;

/// Below this many agents, handing work to other threads costs more than it saves.
const PARALLEL_FROM: usize = 2_000;

/// The sum of some laws, with the neighbour search that they share.
pub struct Flock<const D: usize> {
    laws: Vec<Box<dyn Law<D>>>,
    cells: Cells<D>,
}

impl<const D: usize> Flock<D> {
    /// A flock that obeys some laws.
    pub fn new(laws: Vec<Box<dyn Law<D>>>) -> Self {
        Self {
            laws,
            cells: Cells::default(),
        }
    }

    /// Adds a law.
    pub fn push(&mut self, law: Box<dyn Law<D>>) {
        self.laws.push(law);
    }

    /// The laws, in their order.
    pub fn laws(&self) -> &[Box<dyn Law<D>>] {
        &self.laws
    }

    /// Writes the acceleration of each agent into `out`. All inputs must be finite.
    ///
    /// Each agent's sum is taken in a fixed order, so the result does not depend on
    /// the number of threads.
    pub fn accelerations(
        &mut self,
        time: f64,
        positions: &[Vector<D>],
        velocities: &[Vector<D>],
        obstacles: &[Obstacle<D>],
        out: &mut [Vector<D>],
    ) {
        let laws = &self.laws;
        let scene = scene(
            &mut self.cells,
            laws,
            time,
            positions,
            velocities,
            obstacles,
        );
        out.fill(Vector::zeros());
        let add = |chunk: usize, out: &mut [Vector<D>]| {
            for law in laws {
                law.accelerate(&scene, chunk * CHUNK, out);
            }
        };
        if positions.len() < PARALLEL_FROM {
            let chunks = out.chunks_mut(CHUNK).enumerate();
            chunks.for_each(|(chunk, out)| add(chunk, out));
        } else {
            let chunks = out.par_chunks_mut(CHUNK).enumerate();
            chunks.for_each(|(chunk, out)| add(chunk, out));
        }
    }

    /// The acceleration that each law alone gives each agent, by law.
    pub fn by_law(
        &mut self,
        time: f64,
        positions: &[Vector<D>],
        velocities: &[Vector<D>],
        obstacles: &[Obstacle<D>],
    ) -> Vec<(String, Vec<Vector<D>>)> {
        let laws = &self.laws;
        let scene = scene(
            &mut self.cells,
            laws,
            time,
            positions,
            velocities,
            obstacles,
        );
        laws.iter()
            .map(|law| {
                let mut out = vec![Vector::zeros(); positions.len()];
                law.accelerate(&scene, 0, &mut out);
                (law.name().to_owned(), out)
            })
            .collect()
    }
}

/// What the laws see, with the cells sorted anew where a law needs them.
fn scene<'a, const D: usize>(
    cells: &'a mut Cells<D>,
    laws: &[Box<dyn Law<D>>],
    time: f64,
    positions: &'a [Vector<D>],
    velocities: &'a [Vector<D>],
    obstacles: &'a [Obstacle<D>],
) -> Scene<'a, D> {
    let range = laws.iter().map(|law| law.range()).fold(0.0, f64::max);
    if range > 0.0 {
        cells.rebuild(positions, range);
    }
    Scene {
        time,
        positions,
        velocities,
        cells,
        obstacles,
        mean_position: mean(positions),
        mean_velocity: mean(velocities),
    }
}
