//! Friction, and what makes up for it.
//!
//! u_i = ∓ c_i |v_i|^r_i v_i; v̇_i = u_i, or u_i/m_i where it acts as a force.
//!
//! | law | sign | source |
//! |---|---|---|
//! | `friction` | − | Djokam & Rathinam, (2.8) |
//! | `friction`, acts as `force`, r = 0 | − | Shi, Wang & Chu, (3) |
//! | `friction_compensation`, acts as `force`, r = 0 | + | Shi, Wang & Chu, the last term of (4) |
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `coefficient` | c_i (Shi, Wang & Chu's k_i), one for all or one for each agent | (time/length)^r/time; times mass where it is a force |
//! | `exponent` | r ≥ 0, one for all or one for each agent | 1 |
//!
//! Compensation with the coefficients of the friction cancels it. It is a law of its own since
//! agents may only have an estimate of their friction: where that is too high, they speed up
//! without bound.

use crate::law::Law;
use crate::math::Vector;
use crate::sense::Scene;
use crate::world::spec::{ActsAs, FrictionSpec};

/// Friction, or what makes up for it; see the module.
#[derive(Debug, Clone)]
pub struct Friction {
    name: &'static str,
    sign: f64,
    /// Of each agent of the world.
    coefficients: Vec<f64>,
    exponents: Vec<f64>,
    acts_as: ActsAs,
}

impl Friction {
    /// Friction with the parameters of a checked world file, on the agents of the world for
    /// which `acts_on` is true.
    pub fn new(spec: &FrictionSpec, acts_on: &[bool]) -> Self {
        Self::signed("friction", -1.0, spec, acts_on)
    }

    /// The same with the other sign.
    pub fn compensation(spec: &FrictionSpec, acts_on: &[bool]) -> Self {
        Self::signed("friction_compensation", 1.0, spec, acts_on)
    }

    fn signed(name: &'static str, sign: f64, spec: &FrictionSpec, acts_on: &[bool]) -> Self {
        Self {
            name,
            sign,
            coefficients: spec.coefficient.spread(acts_on),
            exponents: spec.exponent.spread(acts_on),
            acts_as: spec.acts_as,
        }
    }
}

impl<const D: usize> Law<D> for Friction {
    fn name(&self) -> &str {
        self.name
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (i, acceleration) in (first..).zip(out) {
            let velocity = scene.velocities[i];
            let agent = scene.agents[i] as usize;
            let coefficient = self.coefficients[agent];
            let power = libm::pow(velocity.norm(), self.exponents[agent]);
            let factor = self.sign * self.acts_as.factor(scene.mass(i));
            *acceleration += velocity * (factor * coefficient * power);
        }
    }
}
