//! What the laws see at one moment.

use crate::math::Vector;
use crate::sense::Cells;
use crate::shape::{Obstacle, Projection};

/// The state of the world at one moment, as the laws see it.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a, const D: usize> {
    /// Time since the start.
    pub time: f64,
    /// Position of each agent.
    pub positions: &'a [Vector<D>],
    /// Velocity of each agent.
    pub velocities: &'a [Vector<D>],
    /// The same positions, for neighbour searches.
    pub cells: &'a Cells<D>,
    /// The obstacles.
    pub obstacles: &'a [Obstacle<D>],
    /// Mean of the positions.
    pub mean_position: Vector<D>,
    /// Mean of the velocities.
    pub mean_velocity: Vector<D>,
}

/// An obstacle near enough to act on an agent, with the agent's projection on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Active<const D: usize> {
    /// Index of the obstacle.
    pub obstacle: usize,
    /// The β-agent.
    pub projection: Projection<D>,
}

/// The obstacles whose surface is at most `range` from `point`, or that contain it:
/// the active obstacles of Olfati-Saber (2003), §11, in the order of the world.
pub fn active_obstacles<'a, const D: usize>(
    obstacles: &'a [Obstacle<D>],
    point: &'a Vector<D>,
    range: f64,
) -> impl Iterator<Item = Active<D>> + 'a {
    obstacles
        .iter()
        .enumerate()
        .filter(move |(_, obstacle)| obstacle.may_reach(point, range))
        .map(|(index, obstacle)| Active {
            obstacle: index,
            projection: obstacle.project(point),
        })
        .filter(move |active| active.projection.distance <= range)
}
