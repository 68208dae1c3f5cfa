//! Self-propulsion to a cruising speed.
//!
//! u_i = α v_i − β |v_i|² v_i; v̇_i = u_i, or u_i/m_i where it acts as a force. D'Orsogna et al.,
//! as in Djokam & Rathinam, section 2.5.
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `propulsion` | α | 1/time; times mass where it is a force |
//! | `drag` | β | time/length²; times mass where it is a force |
//!
//! An agent left alone comes to the speed √(α/β) along its way, near there at the rate 2α; an
//! agent at rest stays at rest.

use crate::law::Law;
use crate::math::Vector;
use crate::sense::Scene;
use crate::world::spec::{ActsAs, SelfPropulsionSpec};

/// Self-propulsion to a cruising speed; see the module.
#[derive(Debug, Clone)]
pub struct SelfPropulsion {
    propulsion: f64,
    drag: f64,
    acts_as: ActsAs,
}

impl SelfPropulsion {
    /// The law with the parameters of a world file.
    pub fn new(spec: &SelfPropulsionSpec) -> Self {
        Self {
            propulsion: spec.propulsion,
            drag: spec.drag,
            acts_as: spec.acts_as,
        }
    }
}

impl<const D: usize> Law<D> for SelfPropulsion {
    fn name(&self) -> &str {
        "self_propulsion"
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (i, acceleration) in (first..).zip(out) {
            let velocity = scene.velocities[i];
            let thrust = self.propulsion - self.drag * velocity.norm_squared();
            *acceleration += velocity * (thrust * self.acts_as.factor(scene.mass(i)));
        }
    }
}
