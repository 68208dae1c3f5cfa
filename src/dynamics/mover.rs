//! What moves the agents of a simulation: bodies or points.

use serde::{Deserialize, Serialize};

use super::points::{Accuracy, Points, PointsState, Solver};
use super::{Bodies, BodiesState, Cuts, Engine, Failure, Gaps, Snapshot, Strain, Touch, Unusable};
use crate::law::{Flock, State};
use crate::math::Vector;
use crate::shape::In;
use crate::stop::Stop;
use crate::world::World;

/// How agents are moved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Dynamics {
    /// As rigid bodies, by the engine: [`Bodies`].
    #[default]
    Bodies,
    /// As point masses that nothing can touch, integrated to an accuracy: [`Points`].
    Points(Accuracy),
}

/// Agents in motion; both kinds take the steps of the world.
#[allow(
    clippy::large_enum_variant,
    reason = "a simulation has one, which gains nothing from a box"
)]
pub enum Mover<const D: usize> {
    /// Rigid bodies.
    Bodies(Bodies<D>),
    /// Point masses.
    Points(Points<D>),
}

/// What a mover must know between two steps, besides its world, to go on bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(
    clippy::large_enum_variant,
    reason = "a checkpoint has one, which gains nothing from a box"
)]
pub enum MoverState<const D: usize> {
    /// Of rigid bodies.
    Bodies(BodiesState<D>),
    /// Of point masses.
    Points(PointsState<D>),
}

impl<const D: usize> Mover<D>
where
    In<D>: Engine<D>,
{
    /// The agents of a world at its start, about to obey `flock`.
    ///
    /// # Errors
    /// Where the laws give no finite acceleration at the start, or the world cannot be moved
    /// in this way.
    pub fn new(
        world: &World<D>,
        flock: &mut Flock<D>,
        dynamics: Dynamics,
    ) -> Result<Self, Failure> {
        Ok(match dynamics {
            Dynamics::Bodies => Self::Bodies(Bodies::new(world, flock)?),
            Dynamics::Points(accuracy) => Self::Points(Points::new(world, flock, accuracy)?),
        })
    }

    /// The agents of a world as they were when [`Mover::capture`] gave `state`, under the same
    /// flock.
    ///
    /// # Errors
    /// Where the state is not one of this world.
    pub fn restore(
        world: &World<D>,
        flock: &Flock<D>,
        state: MoverState<D>,
    ) -> Result<Self, Unusable> {
        Ok(match state {
            MoverState::Bodies(state) => Self::Bodies(Bodies::restore(world, state)?),
            MoverState::Points(state) => Self::Points(Points::restore(world, flock, state)?),
        })
    }
}

impl<const D: usize> Mover<D> {
    /// Stops from now on within a step where somebody asks for it; bodies end their steps.
    pub fn heed(&mut self, stop: Stop) {
        if let Self::Points(points) = self {
            points.heed(stop);
        }
    }

    /// Takes one step of the world. One that fails, or was stopped, leaves the state before it.
    ///
    /// # Errors
    /// Where the state or the laws are no longer finite, the integration gets stuck, or it was
    /// stopped.
    pub fn step(&mut self, flock: &mut Flock<D>) -> Result<(), Failure> {
        match self {
            Self::Bodies(bodies) => bodies.step(flock),
            Self::Points(points) => points.step(flock),
        }
    }

    /// Measures from now on where the time goes, or does so no longer.
    pub fn measure(&mut self, on: bool) {
        if let Self::Bodies(bodies) = self {
            bodies.measure(on);
        }
    }

    /// Where the time went while it was measured, as [`Bodies::profile`]; of points nothing, for
    /// whom solving the equations is all there is besides the laws.
    pub fn profile(&self) -> Vec<(String, f64)> {
        match self {
            Self::Bodies(bodies) => bodies.profile(),
            Self::Points(_) => Vec::new(),
        }
    }

    /// The state now.
    pub fn snapshot(&self) -> Snapshot<'_, D> {
        match self {
            Self::Bodies(bodies) => bodies.snapshot(),
            Self::Points(points) => points.snapshot(),
        }
    }

    /// The state now, as laws see it.
    pub fn state(&self) -> State<'_, D> {
        match self {
            Self::Bodies(bodies) => bodies.state(),
            Self::Points(points) => points.state(),
        }
    }

    /// The contacts of the last step; points have none.
    pub fn touches(&self) -> &[Touch<D>] {
        match self {
            Self::Bodies(bodies) => bodies.touches(),
            Self::Points(_) => &[],
        }
    }

    /// The contacts of the present positions; points have none.
    pub fn touches_now(&mut self) -> Vec<Touch<D>> {
        match self {
            Self::Bodies(bodies) => bodies.touches_now(),
            Self::Points(_) => Vec::new(),
        }
    }

    /// The smallest gaps so far; of points those between the bodies that they would be.
    pub fn gaps(&self) -> Gaps {
        match self {
            Self::Bodies(bodies) => bodies.gaps(),
            Self::Points(points) => points.gaps(),
        }
    }

    /// How near the run came so far to what contacts can do at its step; points touch nothing.
    pub fn strain(&self) -> Strain {
        match self {
            Self::Bodies(bodies) => bodies.strain(),
            Self::Points(_) => Strain::default(),
        }
    }

    /// How often the actuators' limits cut the laws' forces; those of points are not counted.
    pub fn cuts(&self) -> Cuts {
        match self {
            Self::Bodies(bodies) => bodies.cuts(),
            Self::Points(_) => Cuts::default(),
        }
    }

    /// The force that the laws exert on each agent, after all cuts: on bodies in the last
    /// step, at the start that of the step to come; on points now.
    pub fn pushes(&self) -> &[Vector<D>] {
        match self {
            Self::Bodies(bodies) => bodies.pushes(),
            Self::Points(points) => points.pushes(),
        }
    }

    /// What solves the equations of motion, of points.
    pub fn solver(&self) -> Option<Solver> {
        match self {
            Self::Bodies(_) => None,
            Self::Points(points) => Some(points.solver()),
        }
    }

    /// What [`Mover::restore`] needs.
    ///
    /// # Errors
    /// Where the engine cannot tell its state.
    pub fn capture(&self) -> Result<MoverState<D>, Unusable> {
        Ok(match self {
            Self::Bodies(bodies) => MoverState::Bodies(bodies.capture()?),
            Self::Points(points) => MoverState::Points(points.capture()),
        })
    }
}
