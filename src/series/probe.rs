//! What is read from every frame of a trace.

use super::Quantity;
use crate::trace::record::Frame;

/// What is read from every frame: a point of a plot.
#[derive(Debug, Clone, PartialEq)]
pub enum Probe {
    /// A quantity over time.
    Quantity(Quantity),
    /// A component of an agent's state over time.
    Component {
        /// The agent.
        agent: usize,
        /// Of which state.
        motion: Motion,
        /// The component, from 0.
        axis: usize,
    },
    /// Two components of an agent's state against each other.
    Place {
        /// The agent.
        agent: usize,
        /// Of which state.
        motion: Motion,
        /// The components, from 0.
        axes: [usize; 2],
    },
}

/// Positions or velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// Where agents are.
    Positions,
    /// How they move.
    Velocities,
}

impl Motion {
    /// What the components are called.
    pub(super) fn name(self, axis: usize) -> &'static str {
        match self {
            Self::Positions => ["x", "y", "z"][axis],
            Self::Velocities => ["v_x", "v_y", "v_z"][axis],
        }
    }

    /// What it is called.
    pub(super) fn plural(self) -> &'static str {
        match self {
            Self::Positions => "positions",
            Self::Velocities => "velocities",
        }
    }

    /// A component of an agent's state.
    pub(super) fn of(self, frame: &Frame, agent: usize, axis: usize) -> Option<f64> {
        let states = match self {
            Self::Positions => &frame.positions,
            Self::Velocities => &frame.velocities,
        };
        states.get(agent)?.get(axis).copied()
    }
}
