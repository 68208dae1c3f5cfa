//! Dynamics: what moves the agents.
//!
//! [`Bodies`] couples a flock to rigid bodies in rapier. The engine itself sits behind
//! [`Physics`], written once and compiled for each dimension.

mod bodies;

pub use bodies::{Bodies, BodiesState, Failure};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::math::Vector;
use crate::shape::{Geometry, In, Obstacle};
use crate::world::World;

/// The state of the agents at the end of a step, for those who observe.
#[derive(Debug, Clone, Copy)]
pub struct Snapshot<'a, const D: usize> {
    /// Steps taken so far.
    pub step: u64,
    /// Time, step × size of the step.
    pub time: f64,
    /// Position of each agent.
    pub positions: &'a [Vector<D>],
    /// Velocity of each agent.
    pub velocities: &'a [Vector<D>],
    /// Heading of each agent, a unit vector: where its velocity points, or last pointed.
    pub headings: &'a [Vector<D>],
    /// The obstacles, where they are now.
    pub obstacles: &'a [Obstacle<D>],
}

/// What drives the bodies through one step.
#[derive(Debug, Clone, Copy)]
pub struct Drive<'a, const D: usize> {
    /// Force on each agent.
    pub forces: &'a [Vector<D>],
    /// The obstacles, where they are at the end of the step.
    pub obstacles: &'a [Obstacle<D>],
}

/// What a body touched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Touched {
    /// Another agent, by index.
    Agent(usize),
    /// An obstacle, by index.
    Obstacle(usize),
}

/// Two bodies that touched during a step: a positive impulse, or a gap of zero or less.
#[derive(Debug, Clone, PartialEq)]
pub struct Touch<const D: usize> {
    /// The agent; the one with the lower index where both are agents.
    pub agent: usize,
    /// What it touched.
    pub touched: Touched,
    /// Gap between the surfaces at the start of the step; negative where they overlap.
    pub gap: f64,
    /// Normal impulse of the step.
    pub impulse: f64,
    /// Speed of approach along the normal, had nothing been in the way.
    pub approach_speed: f64,
    /// Speed at which the surface of a moving obstacle advances into the agent along the
    /// normal; 0 where it recedes, and for fixed obstacles and agents.
    pub push_speed: f64,
    /// Unit normal, pointing from the agent to what it touched.
    pub normal: Vector<D>,
    /// Position of the agent at the start of the step.
    pub position: Vector<D>,
}

/// A world of rigid bodies: one for each agent, and the obstacles.
pub trait Physics<const D: usize>: Send {
    /// Copies the positions and the engine's velocities of the agents.
    fn read(&self, positions: &mut [Vector<D>], velocities: &mut [Vector<D>]);

    /// Sets the velocity of each agent.
    fn set_velocities(&mut self, velocities: &[Vector<D>]);

    /// Takes one step under these forces, in place of those of the step before. An empty
    /// list of forces leaves them as they were, at first none.
    fn step(&mut self, drive: Drive<'_, D>);

    /// Finds the contacts of the present positions, without moving anything.
    fn detect(&mut self);

    /// Appends the contacts of the last step or detection; `position` and the speeds are
    /// left at zero. An obstacle of several parts may come once for each.
    fn touches(&self, out: &mut Vec<Touch<D>>);

    /// The agents that the engine gave up because their state became non-finite.
    fn lost(&self) -> Vec<usize>;

    /// Everything that the engine must know to go on bit for bit, in a form of its own:
    /// forces apart, which each step sets anew.
    ///
    /// # Errors
    /// What keeps the engine's state from being written.
    fn save(&self) -> Result<Vec<u8>, Unusable>;
}

/// A state that cannot be saved or taken up again.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Unusable(pub String);

/// Access to the engine of one dimension; implemented by [`In<2>`] and [`In<3>`].
pub trait Engine<const D: usize>: Geometry<D> {
    /// The bodies of a world, at its start.
    fn physics(world: &World<D>) -> Box<dyn Physics<D>>;

    /// The bodies of a world as they were when [`Physics::save`] gave `saved`.
    ///
    /// # Errors
    /// Where `saved` is not what the same version saved of the same world.
    fn restore(world: &World<D>, saved: &[u8]) -> Result<Box<dyn Physics<D>>, Unusable>;
}

#[path = "."]
#[allow(clippy::duplicate_mod, reason = "one source for both dimensions")]
mod plane {
    use crate::shape::plane as geometry;
    use rapier2d as rapier;
    const D: usize = 2;

    /// An angular velocity in the engine's terms.
    fn angular(rate: [f64; 3]) -> f64 {
        rate[2]
    }

    #[path = "rapier.rs"]
    mod adapter;
}

#[path = "."]
#[allow(clippy::duplicate_mod, reason = "one source for both dimensions")]
mod space {
    use crate::shape::space as geometry;
    use rapier3d as rapier;
    const D: usize = 3;

    /// An angular velocity in the engine's terms.
    fn angular(rate: [f64; 3]) -> rapier::math::Vector {
        rate.into()
    }

    #[path = "rapier.rs"]
    mod adapter;
}

const _: () = {
    // Both dimensions must have an engine, or no world of that dimension could run.
    const fn has_engine<const D: usize>()
    where
        In<D>: Engine<D>,
    {
    }
    has_engine::<2>();
    has_engine::<3>();
};
