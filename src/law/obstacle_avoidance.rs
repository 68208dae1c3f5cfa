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
//! Of an obstacle of several parts, either each part in range is an O_k, or the obstacle as
//! a whole is one, acting by its nearest point. γ-agents belong to what has a centre within
//! it: solid convex parts. Half-spaces, thin walls and obstacles that act as a whole but
//! have several parts have none.
//!
//! Where an obstacle moves, p̂ counts its motion (Remark 7), and the γ-agent moves along.
//! Inside an obstacle (d < 0) the damping takes the part of the relative velocity across the
//! surface only: p̂ has no bound there.

use crate::law::Law;
use crate::math::{Action, Bump, Vector, direction};
use crate::sense::Scene;
use crate::shape::{Acting, Obstacle, Projection};
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
    /// n_d and λ_d, where there are γ-agents.
    gamma: Option<(Vector<D>, f64)>,
    /// The γ-agents of each obstacle, by part; none for obstacles that have none.
    gamma_agents: Vec<Vec<Option<Vector<D>>>>,
}

impl<const D: usize> ObstacleAvoidance<D> {
    /// The law with the parameters of a checked world file, for that world's obstacles.
    pub fn new(spec: &ObstacleAvoidanceSpec, world: &World<D>) -> Self {
        let gamma = spec.gamma.as_ref().and_then(|gamma| {
            let along = vector(gamma.direction.as_ref()?);
            Some((direction(&along), gamma.offset))
        });
        let of_obstacle = |obstacle| gamma_agents(obstacle, gamma);
        Self {
            range: spec.range,
            standoff: spec.standoff,
            gain: spec.gain,
            damping: spec.damping,
            action: spec.action.action(),
            bump: Bump::new(spec.bump_start),
            gamma_spacing: spec.gamma.as_ref().map_or(0.0, |gamma| gamma.spacing),
            gamma,
            gamma_agents: world.obstacles.iter().map(of_obstacle).collect(),
        }
    }

    /// The γ-agents x_k of an obstacle where it stands, one entry for each part that acts on its
    /// own, empty where that has none; no entry where nothing has: Fig. 6.
    pub fn gamma_agents(&self, obstacle: &Obstacle<D>) -> Vec<Option<Vector<D>>> {
        gamma_agents(obstacle, self.gamma)
    }
}

impl<const D: usize> Law<D> for ObstacleAvoidance<D> {
    fn name(&self) -> &str {
        "obstacle_avoidance"
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        for (agents, obstacle) in self.gamma_agents.iter_mut().zip(scene.obstacles) {
            if obstacle.motion().is_some() {
                *agents = gamma_agents(obstacle, self.gamma);
            }
        }
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (k, acceleration) in out.iter_mut().enumerate() {
            let (q, p) = (&scene.positions[first + k], &scene.velocities[first + k]);
            for active in scene.active_obstacles(q, self.range) {
                let beta = &active.projection;
                let distance = beta.distance;
                let mut sum = beta.normal * -self.action.repulsion(distance - self.standoff);
                let gamma_agents = &self.gamma_agents[active.obstacle];
                if let Some(Some(gamma)) = gamma_agents.get(active.part) {
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

/// The γ-agents of an obstacle, one for each part that acts on its own, where it has one.
fn gamma_agents<const D: usize>(
    obstacle: &Obstacle<D>,
    gamma: Option<(Vector<D>, f64)>,
) -> Vec<Option<Vector<D>>> {
    let parts = obstacle.parts().len();
    match gamma {
        Some((along, offset)) if parts == 1 || obstacle.acting() == Acting::Each => (0..parts)
            .map(|part| obstacle.part_interior_point(part, &along, offset))
            .collect(),
        _ => Vec::new(),
    }
}

/// p̂ − p outside. Inside, the surface point runs ever faster the nearer the agent is to
/// the middle, so there only the part across the surface is damped, relative to it.
fn drift<const D: usize>(beta: &Projection<D>, p: &Vector<D>) -> Vector<D> {
    if beta.distance >= 0.0 {
        beta.velocity(p) - p
    } else {
        let relative = p - beta.surface_velocity();
        beta.normal * -beta.normal.dot(&relative)
    }
}
