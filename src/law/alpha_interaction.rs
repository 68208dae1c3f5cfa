//! The (α, α) protocols.
//!
//! u_i = Σ_j f(|q_j − q_i|) n_ij + c1 w_ij (p_j − p_i) over the neighbours j within r,
//! with n_ij the unit vector from i to j.
//! R. Olfati-Saber, "Flocking with Obstacle Avoidance", 2003.
//!
//! | protocol | f | w_ij | source |
//! |---|---|---|---|
//! | `nonsmooth` | φ_α | 1 | (34) |
//! | `smooth` | a_ij φ_α + ρ'ψ_α/r | 1 | (35) |
//! | `smooth_weighted_damping` | as `smooth` | a_ij | (35), with the weight that later papers give the damping |
//! | `approximate` | a_ij φ_α | 1 | (36) |
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `spacing` | d_α | length |
//! | `range` | r | length |
//! | `damping` | c1 | 1/time |
//! | `action.attraction`, `action.repulsion` | a, b | acceleration |
//! | `bump_start` | k0 | 1 |
//!
//! The forces on a pair are equal and opposite, so the sum over equal masses is zero, as long
//! as both perceive each other as they are.
//!
//! A smooth cone of perception multiplies the whole contribution of j by
//! ρ(|θ_j − θ_i|/φ0), (18). In `smooth_weighted_damping` and `approximate` that is a_ij
//! itself; in `smooth` the force is still the exact gradient, since headings do not depend on
//! positions; and what the print leaves unweighted, the force of `nonsmooth` and the damping,
//! is weighted by the cone as well.
//!
//! Two agents at the same point have no direction between them and exert no force.

use crate::law::Law;
use crate::math::{AlphaPair, Fade, Vector};
use crate::sense::Scene;
use crate::world::spec::{AlphaInteractionSpec, AlphaProtocol};

/// The (α, α) protocols; see the module.
#[derive(Debug, Clone)]
pub struct AlphaInteraction {
    pair: AlphaPair,
    damping: f64,
    weighted_damping: bool,
}

impl AlphaInteraction {
    /// The law with the parameters of a world file.
    pub fn new(spec: &AlphaInteractionSpec) -> Self {
        Self {
            pair: spec.pair(),
            damping: spec.damping,
            weighted_damping: spec.protocol == AlphaProtocol::SmoothWeightedDamping,
        }
    }
}

impl<const D: usize> Law<D> for AlphaInteraction {
    fn name(&self) -> &str {
        "alpha_interaction"
    }

    fn range(&self) -> f64 {
        self.pair.range
    }

    fn jump(&self) -> Option<f64> {
        let sharp = self.pair.fade == Fade::Sharp;
        let damped_to_the_end = self.damping != 0.0 && !self.weighted_damping;
        (sharp || damped_to_the_end).then_some(self.pair.range)
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (k, acceleration) in out.iter_mut().enumerate() {
            let i = first + k;
            let p = scene.velocities[i];
            let mut sum = Vector::zeros();
            scene.neighbours(i, self.pair.range, |neighbour| {
                let distance = neighbour.squared.sqrt();
                let (force, weight) = self.pair.force_and_weight(distance);
                if distance > 0.0 {
                    sum += neighbour.offset * (force / distance * neighbour.weight);
                }
                let weight = if self.weighted_damping { weight } else { 1.0 };
                sum += (neighbour.velocity - p) * (self.damping * weight * neighbour.weight);
            });
            *acceleration += sum;
        }
    }
}
