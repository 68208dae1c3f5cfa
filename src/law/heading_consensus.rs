//! Turning to the neighbours' headings: attitude alignment.
//!
//! θ̇_i = k Σ_j a_ij (θ_j − θ_i) over the neighbours j within r, angles wrapped to (−π, π):
//! the agreement protocol (12), (13) of R. Olfati-Saber, "Flocking with Obstacle
//! Avoidance", 2003. In any number of dimensions the heading u_i turns at the rate
//! ω_i = k Σ_j a_ij log_{u_i}(u_j), where log_u(v) is tangent at u, points the shortest way
//! to v and is as long as the angle between them. The acceleration |p_i| ω_i makes the
//! velocity turn at this rate and keeps its size; an agent at rest stays at rest.
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `gain` | k (1 in the paper) | 1/time |
//! | `range` | r | length |
//! | `smooth` | a_ij = ρ(distance/r), (17), rather than 1, (8) | |
//! | `bump_start` | k0 | 1 |
//!
//! A smooth cone of perception multiplies a_ij by ρ(|θ_j − θ_i|/φ0), (18). Between opposite
//! headings no way is the shortest, and none is turned.
//!
//! On bodies it is of second order in the step where `smooth`; else of first, as links come and go.

use crate::law::Law;
use crate::math::{Bump, Vector, turn_between};
use crate::sense::Scene;
use crate::world::spec::HeadingConsensusSpec;

/// Turning to the neighbours' headings; see the module.
#[derive(Debug, Clone)]
pub struct HeadingConsensus {
    gain: f64,
    range: f64,
    bump: Option<Bump>,
}

impl HeadingConsensus {
    /// The law with the parameters of a world file.
    pub fn new(spec: &HeadingConsensusSpec) -> Self {
        Self {
            gain: spec.gain,
            range: spec.range,
            bump: spec.smooth.then(|| Bump::new(spec.bump_start)),
        }
    }
}

impl<const D: usize> Law<D> for HeadingConsensus {
    fn name(&self) -> &str {
        "heading_consensus"
    }

    fn range(&self) -> f64 {
        self.range
    }

    fn jump(&self) -> Option<f64> {
        self.bump.is_none().then_some(self.range)
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (k, acceleration) in out.iter_mut().enumerate() {
            let i = first + k;
            let heading = scene.headings[i];
            let mut turn = Vector::zeros();
            scene.neighbours(i, self.range, |neighbour| {
                let fade = |bump: Bump| bump.value(neighbour.squared.sqrt() / self.range);
                let weight = neighbour.weight * self.bump.map_or(1.0, fade);
                turn += turn_between(&heading, &neighbour.heading) * weight;
            });
            *acceleration += turn * (self.gain * scene.velocities[i].norm());
        }
    }
}
