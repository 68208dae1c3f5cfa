//! A frame, read for drawing.

use crate::math::{Vector, axis, direction, mean};
use crate::net::Net;
use crate::picture::Color;
use crate::render::{Moment, Scene};
use crate::shape::Pose;
use crate::trace::record::Frame;
use crate::world::vector;

use super::survey::posed;

/// A moment, its lists of numbers as vectors, and the colours of it.
#[derive(Debug)]
pub(super) struct State<'a, const D: usize> {
    pub(super) moment: &'a Moment,
    pub(super) frame: &'a Frame,
    pub(super) positions: Vec<Vector<D>>,
    pub(super) velocities: Vec<Vector<D>>,
    /// Colour of each agent.
    pub(super) colors: Vec<Color>,
    /// The colour of everything that moves, where moments are told apart by it.
    pub(super) tint: Option<Color>,
}

impl<'a, const D: usize> State<'a, D> {
    pub(super) fn new(scene: &Scene<'_, D>, moment: &'a Moment, tint: Option<Color>) -> Self {
        let frame = &moment.frame;
        let vectors = |list: &[Vec<f64>]| list.iter().map(|it| vector(it)).collect();
        let mut state = Self {
            moment,
            frame,
            positions: vectors(&frame.positions),
            velocities: vectors(&frame.velocities),
            colors: Vec::new(),
            tint,
        };
        state.colors = match tint {
            Some(tint) => vec![tint; state.positions.len()],
            None => super::coloring::colors(scene, &state),
        };
        state
    }

    /// Where the middle of the flock is.
    pub(super) fn middle(&self) -> Vector<D> {
        mean(&self.positions)
    }

    /// How an agent's body stands.
    pub(super) fn pose(&self, agent: usize) -> Pose<D> {
        let rotations = self.frame.rotations.as_ref();
        let turn = rotations.and_then(|all| Some(all.get(agent)?.turn()));
        Pose::new(self.positions[agent], turn.unwrap_or_default())
    }

    /// Which way an agent heads: along its body's first axis, a ball where it moves; zero for a
    /// ball at rest.
    pub(super) fn heading(&self, scene: &Scene<'_, D>, agent: usize) -> Vector<D> {
        let ball = scene.world.solids[scene.world.agents.group[agent]].is_ball();
        match ball || self.frame.rotations.is_none() {
            true => direction(&self.velocities[agent]),
            false => self.pose(agent).vector_to_world(&axis(0)),
        }
    }

    /// The pairs of agents that the proximity net joins: as recorded, or else by the range of the
    /// world's first (α, α) interaction; none where it has none.
    pub(super) fn edges(&self, scene: &Scene<'_, D>) -> Vec<[usize; 2]> {
        if let Some(edges) = &self.frame.edges {
            return edges.clone();
        }
        let finite = self
            .positions
            .iter()
            .all(|it| it.iter().all(|x| x.is_finite()));
        match scene.world.alpha_interaction() {
            Some(alpha) if finite => Net::new(&self.positions, alpha.range).edges().to_vec(),
            _ => Vec::new(),
        }
    }

    /// Where an obstacle stands.
    pub(super) fn obstacle_pose(&self, scene: &Scene<'_, D>, obstacle: usize) -> Pose<D> {
        let mut poses = self.frame.obstacles.iter().flatten();
        match poses.find(|pose| pose.obstacle == obstacle) {
            Some(pose) => posed(pose),
            None => scene.world.obstacles[obstacle].pose.clone(),
        }
    }
}
