//! Why what moves the agents cannot start or go on.

use thiserror::Error;

/// Positions and speeds from here on end a run: the squares and energies that metrics
/// sum would overflow.
pub(super) const LARGEST: f64 = 1e100;

/// Why a run cannot start or go on.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Failure {
    /// The laws gave an acceleration that is not a number, or too large to act on.
    #[error(
        "the acceleration of agent {agent} at time {time} is {value}: the laws ask for more than \
         can be computed; a smaller step or smaller gains may help"
    )]
    Acceleration {
        /// The agent.
        agent: usize,
        /// The time.
        time: f64,
        /// The acceleration, printed.
        value: String,
    },
    /// A position or velocity is not finite any more, or so large that its metrics would
    /// not be.
    #[error(
        "the position or velocity of agent {agent} at time {time} is not a number, or too large \
         to compute with; a smaller step or smaller gains may help"
    )]
    State {
        /// The agent.
        agent: usize,
        /// The time.
        time: f64,
    },
    /// No step of the integration, however short, is as exact as asked for: forces without
    /// bound, for one, or more digits than the numbers have.
    #[error(
        "the integration gets stuck at time {time}: no step, however short, is as exact as asked \
         for; do agents meet where forces have no bound?"
    )]
    Stuck {
        /// The time that was reached.
        time: f64,
    },
    /// Somebody asked to stop within a step.
    #[error("stopped")]
    Stopped,
    /// The world asks for what points do not have.
    #[error("{field}: points {why}; run it with bodies, or leave the field out")]
    NotForPoints {
        /// Path of the field in the world file.
        field: String,
        /// What points lack.
        why: &'static str,
    },
    /// The accuracy asked for is none that can be had.
    #[error(
        "the accuracy is {value:e}; it must be from {:e} to {:e}",
        super::Accuracy::FINEST,
        super::Accuracy::COARSEST
    )]
    Accuracy {
        /// What was asked for.
        value: f64,
    },
}

impl Failure {
    /// Whether the run never began, for what was asked for makes no sense.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::NotForPoints { .. } | Self::Accuracy { .. })
    }
}
