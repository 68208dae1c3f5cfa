//! Damped springs between any two agents.
//!
//! u_i = σ/N Σ_j [K1/(2r²) ⟨v_i − v_j, x_i − x_j⟩ + K2/(2r) (r − 2R)] (x_j − x_i), with
//! r = |x_i − x_j|: Park et al., as in Song et al. (2013), (7). v̇_i = u_i, or u_i/m_i where it
//! acts as a force. (7)'s first term, alignment, is a law of its own.
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `strength` | σ | 1 |
//! | `velocity_gain` | K1 | 1/time |
//! | `position_gain` | K2 | 1/time² |
//! | `radius` | R | length |
//! | `range` | beyond which bonds end; absent in the paper | length |
//!
//! N is the number of agents that the law sees. The forces on a pair are equal and opposite.
//! The damping takes relative velocities down at rates of up to σ K1/2. Two agents at the same
//! point have no direction between them and exert no force.
//!
//! On bodies it is of second order in the step without a `range`; with one of first order, as links
//! come and go.

use crate::law::Law;
use crate::math::Vector;
use crate::sense::Scene;
use crate::world::spec::{ActsAs, ParkBondingSpec};

/// Damped springs between any two agents; see the module.
#[derive(Debug, Clone)]
pub struct ParkBonding {
    strength: f64,
    velocity_gain: f64,
    position_gain: f64,
    length: f64,
    acts_as: ActsAs,
    range: f64,
    /// σ/N.
    share: f64,
}

impl ParkBonding {
    /// The law with the parameters of a world file.
    pub fn new(spec: &ParkBondingSpec) -> Self {
        Self {
            strength: spec.strength,
            velocity_gain: spec.velocity_gain,
            position_gain: spec.position_gain,
            length: 2.0 * spec.radius,
            acts_as: spec.acts_as,
            range: spec.range.unwrap_or(f64::INFINITY),
            share: 0.0,
        }
    }
}

impl<const D: usize> Law<D> for ParkBonding {
    fn name(&self) -> &str {
        "park_bonding"
    }

    fn range(&self) -> f64 {
        self.range
    }

    fn jump(&self) -> Option<f64> {
        self.range.is_finite().then_some(self.range)
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        self.share = self.strength / scene.count().max(1) as f64;
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (i, acceleration) in (first..).zip(out) {
            let mut sum = Vector::zeros();
            scene.neighbours(i, self.range, |neighbour| {
                let squared = neighbour.squared;
                if squared > 0.0 {
                    let distance = squared.sqrt();
                    // ⟨v_i − v_j, x_i − x_j⟩ with both signs turned.
                    let parting = (neighbour.velocity - scene.velocities[i]).dot(&neighbour.offset);
                    let damping = self.velocity_gain / 2.0 * parting / squared;
                    let spring = self.position_gain / 2.0 * (1.0 - self.length / distance);
                    sum += neighbour.offset * ((damping + spring) * neighbour.weight);
                }
            });
            *acceleration += sum * (self.share * self.acts_as.factor(scene.mass(i)));
        }
    }
}
