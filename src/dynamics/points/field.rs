//! The equations of motion: from a state to its rate of change.

use super::links::Links;
use crate::dynamics::turn;
use crate::law::{Flock, State};
use crate::math::{System, Vector, shortened};
use crate::shape::Obstacle;
use crate::world::World;

/// What is accelerated, and by what besides the laws.
pub(super) struct Agents<const D: usize> {
    pub groups: Vec<usize>,
    pub masses: Vec<f64>,
    pub force_limits: Vec<f64>,
    pub gravity: Vector<D>,
    /// Where the agents headed last.
    pub headings: Vec<Vector<D>>,
    /// The obstacles, wherever they were asked for last.
    obstacles: Vec<Obstacle<D>>,
    links: Links<D>,
    /// The largest coordinate of a position, and of a velocity, that errors are a share of.
    pub largest: [f64; 2],
    /// The least that the latter counts for, over the former (1/time).
    slowest: f64,
}

impl<const D: usize> Agents<D> {
    pub(super) fn new(world: &World<D>, flock: &Flock<D>, headings: &[Vector<D>]) -> Self {
        let agents = &world.agents;
        Self {
            groups: agents.group.clone(),
            masses: agents.mass.clone(),
            force_limits: agents.force_limit.clone(),
            gravity: world.gravity,
            headings: headings.to_vec(),
            obstacles: world.obstacles.clone(),
            links: Links::new(&flock.jumps()),
            largest: [0.0; 2],
            slowest: 1e-6 / world.spec.time.step,
        }
    }

    /// Takes note of the size of a state.
    pub(super) fn measure(&mut self, positions: &[Vector<D>], velocities: &[Vector<D>]) {
        for (largest, vectors) in self.largest.iter_mut().zip([positions, velocities]) {
            *largest = vectors.iter().map(Vector::amax).fold(*largest, f64::max);
        }
    }

    /// The force of the laws on an agent, of the acceleration that they want.
    pub(super) fn force(&self, agent: usize, wanted: &Vector<D>) -> Vector<D> {
        shortened(wanted * self.masses[agent], self.force_limits[agent])
    }
}

/// The rate of change of a state under a flock. States are flat: the coordinates of all
/// positions, agent by agent, then those of all velocities.
pub(super) struct Field<'a, const D: usize> {
    agents: &'a mut Agents<D>,
    flock: &'a mut Flock<D>,
    /// Scratch.
    positions: Vec<Vector<D>>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    accelerations: Vec<Vector<D>>,
}

impl<'a, const D: usize> Field<'a, D> {
    pub(super) fn new(agents: &'a mut Agents<D>, flock: &'a mut Flock<D>) -> Self {
        let zeros = || vec![Vector::zeros(); agents.groups.len()];
        Self {
            positions: zeros(),
            velocities: zeros(),
            headings: zeros(),
            accelerations: zeros(),
            agents,
            flock,
        }
    }
}

impl<const D: usize> System for Field<'_, D> {
    fn slope(&mut self, time: f64, state: &[f64], out: &mut [f64]) {
        let half = state.len() / 2;
        let (rates, gains) = out.split_at_mut(half);
        rates.copy_from_slice(&state[half..]);
        if !state.iter().all(|value| value.is_finite()) {
            gains.fill(f64::NAN);
            return;
        }
        read(&state[..half], &mut self.positions);
        read(&state[half..], &mut self.velocities);
        self.headings.copy_from_slice(&self.agents.headings);
        turn(&mut self.headings, &self.velocities);
        for obstacle in &mut self.agents.obstacles {
            obstacle.move_to(time);
        }
        let now = State {
            time,
            positions: &self.positions,
            velocities: &self.velocities,
            headings: &self.headings,
            groups: &self.agents.groups,
            masses: &self.agents.masses,
            rotations: &[],
            obstacles: &self.agents.obstacles,
        };
        self.flock.accelerations(&now, &mut self.accelerations);
        for (i, gain) in gains.chunks_exact_mut(D).enumerate() {
            let wanted = &self.accelerations[i];
            // What is not cut is what the laws want to the last bit.
            let acceleration = match self.agents.force_limits[i].is_finite() {
                true => self.agents.force(i, wanted) / self.agents.masses[i],
                false => *wanted,
            };
            gain.copy_from_slice((acceleration + self.agents.gravity).as_slice());
        }
    }

    fn scale(&self, k: usize, before: f64, after: f64) -> f64 {
        let [far, fast] = self.agents.largest;
        let largest = match k < D * self.positions.len() {
            true => far,
            false => fast.max(far * self.agents.slowest),
        };
        largest.max(before.abs()).max(after.abs())
    }

    fn margin(&mut self, state: &[f64]) -> f64 {
        if self.agents.links.is_empty() {
            return f64::INFINITY;
        }
        if !state.iter().all(|value| value.is_finite()) {
            // The error tells.
            return f64::INFINITY;
        }
        read(&state[..state.len() / 2], &mut self.positions);
        self.agents.links.margin(&self.positions)
    }

    fn settle(&mut self, state: &[f64]) {
        if !self.agents.links.is_empty() {
            read(&state[..state.len() / 2], &mut self.positions);
            self.agents.links.settle(&self.positions);
        }
    }
}

/// Reads vectors, one after the other, from their coordinates.
pub(super) fn read<const D: usize>(coordinates: &[f64], vectors: &mut [Vector<D>]) {
    for (vector, coordinates) in vectors.iter_mut().zip(coordinates.chunks_exact(D)) {
        vector.copy_from_slice(coordinates);
    }
}
