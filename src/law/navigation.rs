//! Steering to a common velocity or to a destination.
//!
//! u_i = −c_q F(q − q_d) − c_p F(p − p_d), where (q, p) is the agent's own position and
//! velocity or the mean of all agents in scope, and F the identity or F(z) = z/√(1+|z|²).
//! R. Olfati-Saber, "Flocking with Obstacle Avoidance", 2003.
//!
//! | world file | source |
//! |---|---|
//! | `steer: mean`, `feedback: bounded`, `destination` | (64) |
//! | `steer: mean`, `feedback: bounded`, `velocity` | (66) |
//! | `steer: agent`, `feedback: bounded` | the distributed forms of (64), (66) |
//! | `steer: agent`, `feedback: linear`, `destination` | the sink (50), with gains |
//! | `steer: agent`, `feedback: linear`, `velocity` | linear velocity tracking |
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `destination` | q_d | length |
//! | `velocity` | p_d | length/time |
//! | `position_gain` | c_q (1 in the paper) | acceleration when bounded, 1/time² when linear |
//! | `velocity_gain` | c_p (the paper's c2) | acceleration when bounded, 1/time when linear |
//!
//! Bounded, the acceleration never exceeds c_q + c_p, or c_p without destination.

use crate::law::Law;
use crate::math::{Vector, saturate};
use crate::sense::Scene;
use crate::world::spec::{Feedback, NavigationSpec, Steered};
use crate::world::{vector, vector_or_zero};

/// Steering to a common velocity or to a destination; see the module.
#[derive(Debug, Clone)]
pub struct Navigation<const D: usize> {
    steer: Steered,
    feedback: Feedback,
    destination: Option<Vector<D>>,
    velocity: Vector<D>,
    position_gain: f64,
    velocity_gain: f64,
}

impl<const D: usize> Navigation<D> {
    /// The law with the parameters of a checked world file.
    pub fn new(spec: &NavigationSpec) -> Self {
        Self {
            steer: spec.steer,
            feedback: spec.feedback,
            destination: spec.destination.as_deref().map(vector),
            velocity: vector_or_zero(&spec.velocity),
            position_gain: spec.position_gain,
            velocity_gain: spec.velocity_gain,
        }
    }

    fn acceleration(&self, q: &Vector<D>, p: &Vector<D>) -> Vector<D> {
        let response = |error: Vector<D>| match self.feedback {
            Feedback::Bounded => saturate(&error),
            Feedback::Linear => error,
        };
        let mut acceleration = response(p - self.velocity) * -self.velocity_gain;
        if let Some(destination) = self.destination {
            acceleration -= response(q - destination) * self.position_gain;
        }
        acceleration
    }
}

impl<const D: usize> Law<D> for Navigation<D> {
    fn name(&self) -> &str {
        "navigation"
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        match self.steer {
            Steered::Mean => {
                let common = self.acceleration(&scene.mean_position, &scene.mean_velocity);
                out.iter_mut()
                    .for_each(|acceleration| *acceleration += common);
            }
            Steered::Agent => {
                let agents = scene.positions[first..]
                    .iter()
                    .zip(&scene.velocities[first..]);
                for (acceleration, (q, p)) in out.iter_mut().zip(agents) {
                    *acceleration += self.acceleration(q, p);
                }
            }
        }
    }
}
