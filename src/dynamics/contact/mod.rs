//! Contacts: what touches within a step, and what comes of it.

mod blow;
mod contacts;
mod flight;
mod meet;
mod near;
mod pair;
mod roster;
mod sweep;
mod way;

pub(crate) use contacts::{CROWDED, Contacts, ContactsState, Start};
pub(crate) use flight::Flight;
pub use pair::{Other, Pair};
pub(crate) use roster::{can_turn, has_friction};
pub use sweep::Change;

use serde::{Deserialize, Serialize};

use crate::math::Vector;

/// What a body touched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Touched {
    /// Another agent, by index.
    Agent(usize),
    /// An obstacle, by index.
    Obstacle(usize),
}

/// Two bodies that touched during a step: their surfaces met, or had met before and were
/// still at each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Touch<const D: usize> {
    /// The agent; the one with the lower index where both are agents.
    pub agent: usize,
    /// What it touched.
    pub touched: Touched,
    /// Time at which the surfaces met first in the step; the start of the step where they
    /// touched already.
    pub time: f64,
    /// Smallest gap between the surfaces in the step; negative where they overlap, 0 to rounding
    /// where they met.
    pub gap: f64,
    /// Normal impulse of the blows in the step: of surfaces that met and were turned back or
    /// stopped (mass × velocity).
    pub blow: f64,
    /// Normal impulse of lasting contact in the step (mass × velocity).
    pub press: f64,
    /// Impulse of friction in the step, blows and lasting contact together: the sum of its
    /// sizes (mass × velocity).
    pub friction: f64,
    /// Speed of approach of the surfaces along the normal just before they met; negative where
    /// they were parting.
    pub approach_speed: f64,
    /// Speed at which the surface of a moving obstacle advances into the agent along the
    /// normal; 0 where it recedes, and for fixed obstacles and agents.
    pub push_speed: f64,
    /// Unit normal, pointing from the agent to what it touched.
    pub normal: Vector<D>,
    /// Where the surfaces met, in the world.
    pub point: Vector<D>,
    /// Position of the agent when the surfaces met.
    pub position: Vector<D>,
}

impl<const D: usize> Touch<D> {
    /// Normal impulse of the step, blows and lasting contact together.
    pub fn impulse(&self) -> f64 {
        self.blow + self.press
    }
}

/// The smallest gap so far, looked for in every step and along the ways within it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Closest {
    /// The gap between the surfaces; negative where they overlap.
    pub gap: f64,
    /// The agent; the one with the lower index where both are agents.
    pub agent: usize,
    /// What it came closest to.
    pub to: Touched,
    /// When.
    pub time: f64,
}

/// The smallest gaps so far.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Gaps {
    /// Between two agents; nothing with one agent.
    pub agents: Option<Closest>,
    /// Between an agent and an obstacle; nothing without obstacles.
    pub obstacles: Option<Closest>,
}

/// How near a run came to what contacts can do at its step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Strain {
    /// Longest way of a body in a step, over its own radius (the inner one, of bodies that are
    /// not round).
    pub travel: f64,
    /// Deepest overlap, over the smaller body's radius.
    pub overlap: f64,
    /// Steps in which more bounces followed each other than are told apart.
    pub unordered: u64,
}
