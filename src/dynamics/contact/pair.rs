//! Who may touch whom: pairs of agents, and of agents and parts of obstacles.

use super::Touched;

/// A pair, of which the first is an agent. Of two agents the one with the lower index comes
/// first.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
)]
pub struct Pair {
    /// The agent.
    pub agent: u32,
    /// The other one.
    pub other: Other,
}

/// The second of a pair.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
)]
pub enum Other {
    /// An agent.
    Agent(u32),
    /// An obstacle, and one of its parts.
    Part(u32, u32),
}

impl Pair {
    /// Two agents.
    pub(super) fn agents(one: usize, other: usize) -> Self {
        let (one, other) = (one.min(other), one.max(other));
        Self {
            agent: one as u32,
            other: Other::Agent(other as u32),
        }
    }

    /// An agent and a part of an obstacle.
    pub(super) fn wall(agent: usize, obstacle: usize, part: usize) -> Self {
        Self {
            agent: agent as u32,
            other: Other::Part(obstacle as u32, part as u32),
        }
    }

    /// The agents of the pair.
    pub(super) fn members(self) -> impl Iterator<Item = usize> {
        let other = match self.other {
            Other::Agent(other) => Some(other as usize),
            Other::Part(..) => None,
        };
        std::iter::once(self.agent as usize).chain(other)
    }

    /// The agent, and what it touches.
    pub(super) fn touched(self) -> (usize, Touched) {
        let touched = match self.other {
            Other::Agent(other) => Touched::Agent(other as usize),
            Other::Part(obstacle, _) => Touched::Obstacle(obstacle as usize),
        };
        (self.agent as usize, touched)
    }
}
