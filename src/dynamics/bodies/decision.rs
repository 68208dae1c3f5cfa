//! From what the laws ask for to the forces of one step.

use rayon::prelude::*;

use super::Bodies;
use crate::dynamics::Failure;
use crate::dynamics::actuator::{Cuts, Limited};
use crate::dynamics::relaxation::relax;
use crate::law::{Flock, State};
use crate::math::Vector;
use crate::parallel::{CHUNK, for_each};

impl<const D: usize> Bodies<D> {
    /// Asks the laws what they want now.
    pub(super) fn ask(&mut self, flock: &mut Flock<D>) {
        let mut wanted = std::mem::take(&mut self.wanted);
        let soft = flock.pulls_softly();
        let before: Option<Vec<_>> = (soft && !self.late.is_empty()).then(|| {
            let pairs = self.velocities.iter().zip(&self.late);
            pairs.map(|(velocity, late)| velocity - late).collect()
        });
        flock.forces(&self.state(), before.as_deref(), &mut wanted);
        if self.step == 0 && soft {
            // Nothing was applied before the start.
            self.earlier = vec![None; self.masses.len()];
            self.late = vec![Vector::zeros(); self.masses.len()];
        }
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
        let (lag, lead, step) = (self.lag(), self.lead(), self.step_size);
        let mut out = [
            &mut self.pushes,
            &mut self.forces,
            &mut self.applied,
            &mut self.ahead,
        ]
        .map(std::mem::take);
        let mut verdicts = std::mem::take(&mut self.verdicts);
        verdicts.clear();
        verdicts.resize_with(self.wanted.len().div_ceil(CHUNK), Verdict::default);
        let decide = |((chunk, verdict), (((pushes, forces), applied), ahead)): Part<'_, D>| {
            for (k, i) in (chunk * CHUNK..).take(pushes.len()).enumerate() {
                // What relaxes ends the step where it ends, unless it is too fast for the body.
                let relaxed = relaxed.as_ref().map(|relaxed| &relaxed[i]);
                let wanted = match relaxed {
                    Some(relaxed) => relaxed.wanted,
                    None => self.wanted_in_step(i, lead),
                };
                let relaxed = relaxed.filter(|it| self.actuators.allow(i, it.fastest));
                // From the engine's velocity to that read at the end of the step.
                let span = step + if relaxed.is_some() { 0.0 } else { lag };
                let mass = self.masses[i];
                let coasting = self.engine_velocities[i] + self.gravity * span;
                let before = (self.step > 0).then_some(pushes[k]);
                let limited = Limited {
                    before,
                    coasting: &coasting,
                    gain: span / mass,
                };
                let asked = wanted * mass;
                pushes[k] = self.actuators.act(i, asked, limited, &mut verdict.cuts);
                forces[k] = pushes[k] + self.gravity * mass;
                applied[k] = forces[k] / mass;
                ahead[k] = match relaxed {
                    Some(relaxed) if pushes[k] == asked => relaxed.ahead,
                    _ => applied[k] * lag,
                };
                // Squared speeds must stay finite as well, or the engine stops the body.
                let speed_gained = applied[k] * step;
                if !(speed_gained.norm_squared() + forces[k].norm_squared()).is_finite() {
                    verdict.broken = Some((i, wanted));
                    return;
                }
            }
        };
        let [pushes, forces, applied, ahead] = out.each_mut().map(|it| it.par_chunks_mut(CHUNK));
        let out_by_chunk = pushes.zip(forces).zip(applied).zip(ahead);
        let chunks = verdicts.par_iter_mut().enumerate().zip(out_by_chunk);
        for_each(self.wanted.len(), chunks, decide);
        [self.pushes, self.forces, self.applied, self.ahead] = out;
        let mut broken = None;
        for verdict in &verdicts {
            self.actuators.count(verdict.cuts);
            broken = verdict.broken;
            if broken.is_some() {
                break;
            }
        }
        self.verdicts = verdicts;
        self.refine();
        match broken {
            None => Ok(()),
            Some((agent, wanted)) => Err(Failure::Acceleration {
                agent,
                time: self.time(),
                value: format!("{:?}", wanted.as_slice()),
            }),
        }
    }

    /// Where laws pull softly, finds velocities at the end of the step to third order: what is
    /// applied over the half substep until then differs from what is applied in the step by its
    /// change since the step before. Not where a contact came between.
    fn refine(&mut self) {
        let lag = self.lag();
        let share = 0.5 * lag * (1.0 + lag / self.step_size);
        for (i, late) in self.late.iter_mut().enumerate() {
            let applied = self.applied[i];
            let change = self.earlier[i].replace(applied).map(|it| applied - it);
            *late = change.unwrap_or_else(Vector::zeros) * share;
            let ahead = self.ahead[i] + *late;
            let end = self.engine_velocities[i] + applied * self.step_size + ahead;
            if self.actuators.allow(i, end.norm()) {
                self.ahead[i] = ahead;
            } else {
                *late = Vector::zeros();
            }
        }
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

/// A chunk of the agents: its number, what came of it, and where pushes, forces, applied
/// accelerations and what is ahead are to be written.
type Part<'a, const D: usize> = (
    (usize, &'a mut Verdict<D>),
    (((Out<'a, D>, Out<'a, D>), Out<'a, D>), Out<'a, D>),
);

type Out<'a, const D: usize> = &'a mut [Vector<D>];

/// What came of the decisions for a chunk of agents.
#[derive(Debug, Default)]
pub(super) struct Verdict<const D: usize> {
    cuts: Cuts,
    /// The first agent whose force is no number, and what the laws want of it.
    broken: Option<(usize, Vector<D>)>,
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
