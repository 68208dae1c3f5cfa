//! What is allowed for the way in which a run was computed.
//!
//! Points follow the equations but for the integrator's error: a hundred times its accuracy is
//! allowed, as a share of the size of what is measured. Bodies follow them to second order in
//! the step h: the states seen at the steps are those of a nearby motion, off by h² times
//! accelerations in position and jerks in velocity. So an energy that must not rise may seem to,
//! by no more than h² Σ w_i (|v_i||j_i| + |a_i|²) at either end; this vanishes with the step.

use super::{MovedBy, Run};
use crate::math::Vector;
use crate::metric::Observation;

/// Of points, the share of its size that a quantity may be off, over the integrator's accuracy.
const OF_ACCURACY: f64 = 100.0;

impl<const D: usize> Run<'_, D> {
    /// What a length may be off in an observation, given how long the lengths are.
    pub fn position_slack(&self, seen: &Observation<D>, scale: f64) -> f64 {
        self.slack(scale, |step| step * step * longest(&seen.accelerations))
    }

    /// What a velocity may be off in an observation, given how fast velocities are.
    pub fn velocity_slack(&self, seen: &Observation<D>, scale: f64) -> f64 {
        self.slack(scale, |step| step * step * longest(&seen.jerks))
    }

    /// What an acceleration may be off, given how large they are: the same as a velocity, over
    /// one step.
    pub fn acceleration_slack(&self, seen: &Observation<D>, scale: f64) -> f64 {
        self.slack(scale, |step| step * longest(&seen.jerks))
    }

    /// What an energy ½ Σ w_i |v_i − center|² + V may be off in an observation, given how large
    /// energies are. Weights are masses, or 1.
    pub fn energy_slack(
        &self,
        seen: &Observation<D>,
        scale: f64,
        center: &Vector<D>,
        weight: impl Fn(usize) -> f64,
    ) -> f64 {
        self.slack(scale, |step| {
            let mut sum = 0.0;
            for (i, velocity) in seen.velocities.iter().enumerate() {
                let (a, j) = (&seen.accelerations[i], &seen.jerks[i]);
                let power = (velocity - center).norm() * j.norm() + a.norm_squared();
                sum += weight(i) * power;
            }
            step * step * sum
        })
    }

    /// The share of the size of a quantity that rounding and integration may take.
    fn slack(&self, scale: f64, of_step: impl Fn(f64) -> f64) -> f64 {
        match self.moved_by {
            MovedBy::Points { relative } => OF_ACCURACY * relative * scale.abs(),
            MovedBy::Bodies { step } => 1e-12 * scale.abs() + of_step(step),
        }
    }
}

fn longest<const D: usize>(vectors: &[Vector<D>]) -> f64 {
    vectors.iter().map(Vector::norm).fold(0.0, f64::max)
}
