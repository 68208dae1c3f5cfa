//! From what the laws ask for to the forces of one step.

use super::{Bodies, Failure};
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
            // Influences in the middle of what the engine's velocities span.
            let ahead = self.lead() * self.step_size;
            let places = self.positions.iter().zip(&self.velocities);
            let positions: Vec<_> = places.map(|(x, v)| x + v * ahead).collect();
            let mut pulls = std::mem::take(&mut self.pulls);
            let positions = &positions;
            let state = State {
                positions,
                ..self.state()
            };
            flock.pulls(&state, &mut pulls);
            self.pulls = pulls;
        }
    }

    /// Turns what the laws ask for into forces within the actuators' limits.
    pub(super) fn decide(&mut self) -> Result<(), Failure> {
        let lead = self.lead();
        let wanted = self.wanted.iter().zip(&self.wanted_before);
        let mut wanted: Vec<_> = wanted.map(|(now, old)| now + (now - old) * lead).collect();
        let relaxed = self.relax(&mut wanted);
        let lag = self.lag();
        // From the engine's velocity to that read at the end of the step; what relaxes
        // gets no faster after the engine's step.
        let span = match relaxed {
            None => self.step_size + lag,
            Some(_) => self.step_size,
        };
        for (i, wanted) in wanted.iter().enumerate() {
            let mass = self.masses[i];
            let coasting = self.engine_velocities[i] + self.gravity * span;
            let before = (self.step > 0).then_some(self.pushes[i]);
            let gain = span / mass;
            let asked = wanted * mass;
            self.pushes[i] = self.actuators.act(i, asked, before, &coasting, gain);
            self.forces[i] = self.pushes[i] + self.gravity * mass;
            self.applied[i] = self.forces[i] / mass;
            self.ahead[i] = match &relaxed {
                Some(ahead) if self.pushes[i] == asked => ahead[i],
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

    /// Turns the accelerations wanted by the other laws into those that take the engine's
    /// velocities, with the pulls, to where they relax to over the step; and tells how the
    /// velocities relax on from there to the end of the step. Nothing where nothing pulls.
    fn relax(&self, wanted: &mut [Vector<D>]) -> Option<Vec<Vector<D>>> {
        if self.pulls.is_empty() {
            return None;
        }
        let drift: Vec<_> = wanted.iter().map(|wanted| wanted + self.gravity).collect();
        let lag = self.lag();
        // At the start the engine's velocities are those of the bodies.
        let first = self.step_size - if self.step == 0 { lag } else { 0.0 };
        let from = &self.engine_velocities;
        let to = relax(&self.pulls, from, &drift, first);
        let end = relax(&self.pulls, &to, &drift, lag);
        for (i, wanted) in wanted.iter_mut().enumerate() {
            *wanted = (to[i] - from[i]) / self.step_size - self.gravity;
        }
        Some(end.iter().zip(&to).map(|(end, to)| end - to).collect())
    }
}
