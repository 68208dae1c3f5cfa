//! The (α, β) and (α, γ) interactions: agents keep off obstacles and are drawn past them.
//!
//! For each obstacle O_k whose surface is at most r0 away, with q̂ the projection of q on
//! it, d = |q̂ − q| (negative inside), n̂ the unit vector from q to q̂ (into the obstacle)
//! and x_k the γ-agent,
//! u_i = c3 ρ(d/r0) [φ_β(d − d_β) n̂ + φ_γ(|x_k − q| − d_γ) n(x_k − q) + c4 (p̂ − p)],
//! φ_β = min(φ_α, 0), φ_γ = φ_α, x_k = b_k + λ_d l_k n_d.
//! R. Olfati-Saber, "Flocking with Obstacle Avoidance", 2003, (53) to (57); the brackets
//! of (54) are broken in print and read as above.
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `range` | r0 | length |
//! | `standoff` | d_β | length |
//! | `gain` | c3 | 1 |
//! | `damping` | c4 | 1/time |
//! | `action.attraction`, `action.repulsion` | a, b | acceleration |
//! | `bump_start` | k0 | 1 |
//! | `gamma.offset` | λ_d | 1 |
//! | `gamma.spacing` | d_γ | length |
//! | `gamma.direction` | n_d | direction |
//!
//! A half-space has no centre and so no γ-agent. Inside an obstacle (d < 0) the damping takes
//! the part of p across the surface only: p̂ has no bound there.

use crate::law::Law;
use crate::math::{Action, Bump, Vector, direction};
use crate::sense::{Scene, active_obstacles};
use crate::shape::{Obstacle, Projection};
use crate::world::spec::ObstacleAvoidanceSpec;
use crate::world::{World, vector};

/// The (α, β) and (α, γ) interactions; see the module.
#[derive(Debug, Clone)]
pub struct ObstacleAvoidance<const D: usize> {
    range: f64,
    standoff: f64,
    gain: f64,
    damping: f64,
    action: Action,
    bump: Bump,
    gamma_spacing: f64,
    /// The γ-agent of each obstacle, where it has one.
    gamma_agents: Vec<Option<Vector<D>>>,
}

impl<const D: usize> ObstacleAvoidance<D> {
    /// The law with the parameters of a checked world file, for that world's obstacles.
    pub fn new(spec: &ObstacleAvoidanceSpec, world: &World<D>) -> Self {
        let along = spec.gamma.as_ref().and_then(|gamma| {
            let along = vector(gamma.direction.as_ref()?);
            Some((direction(&along), gamma.offset))
        });
        let gamma_agent = |obstacle: &Obstacle<D>| {
            let (along, offset) = along?;
            obstacle.interior_point(&along, offset)
        };
        Self {
            range: spec.range,
            standoff: spec.standoff,
            gain: spec.gain,
            damping: spec.damping,
            action: spec.action.action(),
            bump: Bump::new(spec.bump_start),
            gamma_spacing: spec.gamma.as_ref().map_or(0.0, |gamma| gamma.spacing),
            gamma_agents: world.obstacles.iter().map(gamma_agent).collect(),
        }
    }
}

impl<const D: usize> Law<D> for ObstacleAvoidance<D> {
    fn name(&self) -> &str {
        "obstacle_avoidance"
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (k, acceleration) in out.iter_mut().enumerate() {
            let (q, p) = (&scene.positions[first + k], &scene.velocities[first + k]);
            for active in active_obstacles(scene.obstacles, q, self.range) {
                let beta = &active.projection;
                let distance = beta.distance;
                let mut sum = beta.normal * -self.action.repulsion(distance - self.standoff);
                if let Some(gamma) = &self.gamma_agents[active.obstacle] {
                    let way = gamma - q;
                    let stretch = way.norm() - self.gamma_spacing;
                    sum += direction(&way) * self.action.force(stretch);
                }
                if self.damping > 0.0 {
                    sum += drift(beta, p) * self.damping;
                }
                *acceleration += sum * (self.gain * self.bump.value(distance / self.range));
            }
        }
    }
}

/// p̂ − p outside. Inside, the surface point runs ever faster the nearer the agent is to
/// the middle, so there only the part across the surface is damped.
fn drift<const D: usize>(beta: &Projection<D>, p: &Vector<D>) -> Vector<D> {
    if beta.distance >= 0.0 {
        beta.velocity(p) - p
    } else {
        beta.normal * -beta.normal.dot(p)
    }
}
