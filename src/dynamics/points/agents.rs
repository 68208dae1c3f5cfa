//! The agents whose equations are solved.

use super::links::Links;
use super::watched::Side;
use crate::law::Flock;
use crate::math::{Vector, shortened};
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
    pub obstacles: Vec<Obstacle<D>>,
    pub links: Links<D>,
    /// The pairs that slide, and at which distances.
    pub sliding: Vec<([u32; 2], f64)>,
    /// The largest coordinate of a position, and of a velocity, that errors are a share of.
    pub largest: [f64; 2],
    /// The least that the latter counts for, over the former (1/time).
    pub slowest: f64,
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
            sliding: Vec::new(),
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

    /// Takes note of the pairs that slide at the end of a step of the world. How many others have
    /// come to a distance so exactly then that they are beyond by rounding, and cross there.
    pub(super) fn note_sliding(&mut self, positions: &[Vector<D>]) -> usize {
        let sliding = self.links.watched().iter();
        let sliding = sliding.filter(|one| one.side == Side::Sliding);
        self.sliding.clear();
        self.sliding
            .extend(sliding.map(|one| (one.pair, one.distance)));
        let mut held = Vec::new();
        self.links.hold(positions, &mut held);
        held.len()
    }

    /// The force of the laws on an agent, of the acceleration that they want.
    pub(super) fn force(&self, agent: usize, wanted: &Vector<D>) -> Vector<D> {
        shortened(wanted * self.masses[agent], self.force_limits[agent])
    }
}
