//! From what the laws ask for to the forces of one step.

use super::Bodies;
use crate::dynamics::Failure;
use crate::dynamics::relaxation::relax;
use crate::law::{Flock, State};
use crate::math::Vector;

impl<const D: usize> Bodies<D> {
    /// Asks the laws what they want now.
    pub(super) fn ask(&mut self, flock: &mut Flock<D>) {
        let mut wanted = std::mem::take(&mut self.wanted);
        flock.forces(&self.state(), &mut wanted);
        self.wanted = wanted;
        if self.step == 0 {
            self.wanted_before.clone_from(&self.wanted);
        }
        if flock.relaxes() {
            // In the middle of what the engine's velocities span; but obstacles stay.
            let ahead = self.lead() * self.step_size;
            let later = |of: &[Vector<D>], rates: &[Vector<D>]| -> Vec<Vector<D>> {
                let pairs = of.iter().zip(rates);
                pairs.map(|(x, rate)| x + rate * ahead).collect()
            };
            let positions = later(&self.positions, &self.velocities);
            let velocities = later(&self.velocities, &self.applied);
            let mut pulls = std::mem::take(&mut self.pulls);
            let state = State {
                time: self.time() + ahead,
                positions: &positions,
                velocities: &velocities,
                ..self.state()
            };
            flock.pulls(&state, &mut pulls);
            self.pulls = pulls;
        }
    }

    /// Turns what the laws ask for into forces within the actuators' limits.
    pub(super) fn decide(&mut self) -> Result<(), Failure> {
        let relaxed = self.relax();
        let (lag, lead) = (self.lag(), self.lead());
        for i in 0..self.wanted.len() {
            // What relaxes ends the step where it ends, unless it is too fast for the body.
            let relaxed = relaxed.as_ref().map(|relaxed| &relaxed[i]);
            let wanted = match relaxed {
                Some(relaxed) => relaxed.wanted,
                None => self.wanted_in_step(i, lead),
            };
            let relaxed = relaxed.filter(|it| self.actuators.allow(i, it.fastest));
            // From the engine's velocity to that read at the end of the step.
            let span = self.step_size + if relaxed.is_some() { 0.0 } else { lag };
            let mass = self.masses[i];
            let coasting = self.engine_velocities[i] + self.gravity * span;
            let before = (self.step > 0).then_some(self.pushes[i]);
            let gain = span / mass;
            let asked = wanted * mass;
            self.pushes[i] = self.actuators.act(i, asked, before, &coasting, gain);
            self.forces[i] = self.pushes[i] + self.gravity * mass;
            self.applied[i] = self.forces[i] / mass;
            self.ahead[i] = match relaxed {
                Some(relaxed) if self.pushes[i] == asked => relaxed.ahead,
                _ => self.applied[i] * lag,
            };
            // Squared speeds must stay finite as well, or the engine stops the body.
            let speed_gained = self.applied[i] * self.step_size;
            if !(speed_gained.norm_squared() + self.forces[i].norm_squared()).is_finite() {
                return Err(Failure::Acceleration {
                    agent: i,
                    time: self.time(),
                    value: format!("{:?}", wanted.as_slice()),
                });
            }
        }
        Ok(())
    }

    /// What the laws want of an agent in the middle of what the engine's velocities span.
    fn wanted_in_step(&self, i: usize, lead: f64) -> Vector<D> {
        self.wanted[i] + (self.wanted[i] - self.wanted_before[i]) * lead
    }

    /// The accelerations that take the engine's velocities, under the other laws and with the
    /// pulls, to where they relax to over the step; and how they relax on from there to the end
    /// of the step. Nothing where nothing pulls.
    fn relax(&self) -> Option<Vec<Relaxed<D>>> {
        if self.pulls.is_empty() {
            return None;
        }
        let (lag, lead) = (self.lag(), self.lead());
        let agents = 0..self.wanted.len();
        let drift: Vec<_> = agents
            .map(|i| self.wanted_in_step(i, lead) + self.gravity)
            .collect();
        // At the start the engine's velocities are those of the bodies.
        let first = self.step_size - if self.step == 0 { lag } else { 0.0 };
        let from = &self.engine_velocities;
        let to = relax(&self.pulls, from, &drift, first);
        let end = relax(&self.pulls, &to, &drift, lag);
        let relaxed = to
            .iter()
            .zip(&end)
            .zip(from)
            .map(|((to, end), from)| Relaxed {
                wanted: (to - from) / self.step_size - self.gravity,
                ahead: end - to,
                fastest: f64::max(to.norm(), end.norm()),
            });
        Some(relaxed.collect())
    }
}

/// How a velocity relaxes over a step.
struct Relaxed<const D: usize> {
    /// The acceleration of the engine's velocity.
    wanted: Vector<D>,
    /// From the engine's velocity to that at the end of the step.
    ahead: Vector<D>,
    /// The larger of the two speeds.
    fastest: f64,
}
