//! The equations of motion: from a state to its rate of change.

use super::{Points, turn};
use crate::law::{Flock, State};
use crate::math::{Vector, shortened};
use crate::shape::Obstacle;

/// The rate of change of a state. States are flat: the coordinates of all positions, agent
/// by agent, then those of all velocities.
pub(super) struct Field<'a, const D: usize> {
    flock: &'a mut Flock<D>,
    groups: &'a [usize],
    masses: &'a [f64],
    force_limits: &'a [f64],
    gravity: Vector<D>,
    /// Where the agents headed last.
    headed: &'a [Vector<D>],
    obstacles: Vec<Obstacle<D>>,
    headings: Vec<Vector<D>>,
    accelerations: Vec<Vector<D>>,
}

impl<'a, const D: usize> Field<'a, D> {
    pub(super) fn new(points: &'a Points<D>, flock: &'a mut Flock<D>) -> Self {
        Self {
            flock,
            groups: &points.groups,
            masses: &points.masses,
            force_limits: &points.force_limits,
            gravity: points.gravity,
            headed: &points.headings,
            obstacles: points.obstacles.clone(),
            headings: Vec::new(),
            accelerations: vec![Vector::zeros(); points.positions.len()],
        }
    }

    pub(super) fn flat(&self, positions: &[Vector<D>], velocities: &[Vector<D>]) -> Vec<f64> {
        let vectors = positions.iter().chain(velocities);
        vectors.flat_map(|v| v.as_slice().iter().copied()).collect()
    }

    /// Writes the rate of change of `state` at `time` into `out`.
    pub(super) fn slope(&mut self, time: f64, state: &[f64], out: &mut [f64]) {
        let (positions, velocities) = unflat::<D>(state);
        self.headings.clear();
        self.headings.extend_from_slice(self.headed);
        turn(&mut self.headings, &velocities);
        for obstacle in &mut self.obstacles {
            obstacle.move_to(time);
        }
        let half = state.len() / 2;
        let (rates, gains) = out.split_at_mut(half);
        rates.copy_from_slice(&state[half..]);
        let finite = state.iter().all(|value| value.is_finite());
        if !finite {
            gains.fill(f64::NAN);
            return;
        }
        self.flock.accelerations(
            &State {
                time,
                positions: &positions,
                velocities: &velocities,
                headings: &self.headings,
                groups: self.groups,
                masses: self.masses,
                rotations: &[],
                obstacles: &self.obstacles,
            },
            &mut self.accelerations,
        );
        for (i, gain) in gains.chunks_exact_mut(D).enumerate() {
            let mass = self.masses[i];
            let force = self.accelerations[i] * mass;
            let cut = match force.norm() > self.force_limits[i] {
                true => shortened(force, self.force_limits[i]) / mass,
                false => self.accelerations[i],
            };
            gain.copy_from_slice((cut + self.gravity).as_slice());
        }
    }
}

/// Positions and velocities of a flat state.
pub(super) fn unflat<const D: usize>(state: &[f64]) -> (Vec<Vector<D>>, Vec<Vector<D>>) {
    let vectors = |half: &[f64]| {
        half.chunks_exact(D)
            .map(Vector::from_column_slice)
            .collect()
    };
    let (positions, velocities) = state.split_at(state.len() / 2);
    (vectors(positions), vectors(velocities))
}
