//! Actuators: what the bodies can do of what the laws ask of them.
//!
//! A body is told to exert a force. Three limits cut what it does, in this order:
//!
//! 1. the force limit, the largest force;
//! 2. the rate limit, the largest change since the step before per unit of time. It leads
//!    from one force within the force limit to another, so that one still holds;
//! 3. the top speed. The force may not take the body beyond it or, where something else has,
//!    not make it any faster. Of the velocity that it would take the body to, the
//!    nearest one that is slow enough is taken: that leaves steering alone, and never needs
//!    more force. It overrules the rate limit.
//!
//! Gravity is not cut. What is not cut is the force asked for to the last bit, so that the
//! coupling keeps its order.

use serde::{Deserialize, Serialize};

use crate::math::Vector;
use crate::world::Agents;

/// How often the actuators' limits cut a force: numbers of agent-steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Cuts {
    /// By the force limit.
    pub force: u64,
    /// By the rate limit.
    pub rate: u64,
    /// By the top speed.
    pub speed: u64,
}

/// What, besides the limits, decides about a body's force.
pub(super) struct Limited<'a, const D: usize> {
    /// The force of the step before; none at the start, when any may come.
    pub(super) before: Option<Vector<D>>,
    /// The velocity that the body will have without.
    pub(super) coasting: &'a Vector<D>,
    /// How much velocity a unit of force adds.
    pub(super) gain: f64,
}

/// The actuators of all bodies; each list has one entry for each agent.
pub(super) struct Actuators {
    force_limits: Vec<f64>,
    /// Largest change of the force in a step.
    changes: Vec<f64>,
    top_speeds: Vec<f64>,
    cuts: Cuts,
}

impl Actuators {
    /// The actuators of some agents, that act once in a step of this size.
    pub(super) fn new<const D: usize>(agents: &Agents<D>, step: f64) -> Self {
        let rates = agents.force_rate_limit.iter();
        Self {
            force_limits: agents.force_limit.clone(),
            changes: rates.map(|rate| rate * step).collect(),
            top_speeds: agents.top_speed.clone(),
            cuts: Cuts::default(),
        }
    }

    /// The force that a body exerts when told to exert `force`; counts what it was cut by.
    pub(super) fn act<const D: usize>(
        &self,
        body: usize,
        mut force: Vector<D>,
        Limited {
            before,
            coasting,
            gain,
        }: Limited<'_, D>,
        cuts: &mut Cuts,
    ) -> Vector<D> {
        if self.force_limits[body].is_finite() {
            let size = force.norm();
            if size > self.force_limits[body] {
                force *= self.force_limits[body] / size;
                cuts.force += 1;
            }
        }
        if let Some(before) = before
            && self.changes[body].is_finite()
        {
            let change = force - before;
            let size = change.norm();
            if size > self.changes[body] {
                force = before + change * (self.changes[body] / size);
                cuts.rate += 1;
            }
        }
        if self.top_speeds[body].is_finite() {
            let fastest = coasting.norm().max(self.top_speeds[body]);
            let velocity = coasting + force * gain;
            let speed = velocity.norm();
            if speed > fastest {
                force = (velocity * (fastest / speed) - coasting) / gain;
                cuts.speed += 1;
            }
        }
        force
    }

    /// Whether a body may go at this speed.
    pub(super) fn allow(&self, body: usize, speed: f64) -> bool {
        speed <= self.top_speeds[body]
    }

    /// Adds to what was counted.
    pub(super) fn count(&mut self, more: Cuts) {
        self.cuts.force += more.force;
        self.cuts.rate += more.rate;
        self.cuts.speed += more.speed;
    }

    /// Goes on counting from what was counted before.
    pub(super) fn resume(&mut self, cuts: Cuts) {
        self.cuts = cuts;
    }

    /// How often each limit cut a force so far.
    pub(super) fn cuts(&self) -> Cuts {
        self.cuts
    }
}
