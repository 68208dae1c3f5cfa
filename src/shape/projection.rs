//! A projection onto an obstacle, and how it moves: the β-agent.

use crate::math::{Matrix, Vector};
use crate::shape::{Pose, Twist};

/// The point of an obstacle's surface nearest to an agent, and how it moves with
/// the agent and the obstacle: the β-agent of Olfati-Saber (2003), (53) to (57).
#[derive(Debug, Clone, PartialEq)]
pub struct Projection<const D: usize> {
    /// The surface point q̂.
    pub point: Vector<D>,
    /// Unit normal of the surface there, pointing out of the obstacle.
    pub normal: Vector<D>,
    /// Distance from q to the surface; negative inside.
    pub distance: f64,
    /// Derivative of the closest point of the core, a projector.
    pub(super) core_map: Matrix<D>,
    /// Radius of the rounding over the distance from the core, 0 without rounding.
    pub(super) stretch: f64,
    /// How the obstacle moves, where it does.
    pub(super) carried: Option<Carried<D>>,
}

/// Velocities of a moving obstacle's frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Carried<const D: usize> {
    /// At the surface point.
    surface: Vector<D>,
    /// At the agent.
    agent: Vector<D>,
}

impl<const D: usize> Projection<D> {
    /// Velocity p̂ of the surface point while the agent moves at `velocity`: the exact
    /// derivative of the closest-point map, T p + s (I − nnᵀ)(p − T p), with T the
    /// projector onto the feature of the core (face, edge, vertex) and s the stretch of
    /// the rounding. For a ball it is (56), s(I − nnᵀ)p; for a flat face (I − nnᵀ)p.
    ///
    /// Where the obstacle moves, p is counted in its frame: with v_O(x) the velocity of
    /// the frame at x, p̂ = v_O(q̂) + M (p − v_O(q)), M being the derivative above. This
    /// is what Remark 7 of the paper leaves room for.
    pub fn velocity(&self, velocity: &Vector<D>) -> Vector<D> {
        match &self.carried {
            None => self.map(velocity),
            Some(carried) => carried.surface + self.map(&(velocity - carried.agent)),
        }
    }

    /// Velocity of the obstacle's own point under q̂; zero where the obstacle is fixed.
    pub fn surface_velocity(&self) -> Vector<D> {
        match &self.carried {
            None => Vector::zeros(),
            Some(carried) => carried.surface,
        }
    }

    /// The derivative of the closest point, applied.
    fn map(&self, velocity: &Vector<D>) -> Vector<D> {
        let along = self.core_map * velocity;
        let across = velocity - along;
        along + (across - self.normal * self.normal.dot(&across)) * self.stretch
    }

    /// The same, seen from the frame in which its own frame has this pose.
    pub(super) fn to_world(&self, pose: &Pose<D>) -> Self {
        Self {
            point: pose.point_to_world(&self.point),
            normal: pose.vector_to_world(&self.normal),
            distance: self.distance,
            core_map: pose.map_to_world(&self.core_map),
            stretch: self.stretch,
            carried: None,
        }
    }

    /// The projection of an agent at `agent`, on an obstacle that moves so.
    pub(super) fn carried(self, agent: &Vector<D>, twist: &Twist<D>) -> Self {
        let carried = Carried {
            surface: twist.at(&self.point),
            agent: twist.at(agent),
        };
        Self {
            carried: Some(carried),
            ..self
        }
    }
}
