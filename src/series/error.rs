//! Why there is no plot of a trace.

use crate::trace::TraceError;

/// Why there is no plot of a trace. Each message names the trace.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SeriesError {
    /// It cannot be read.
    #[error(transparent)]
    Trace(#[from] TraceError),
    /// Its world is in neither the plane nor space.
    #[error("{name} has a world of {dimension} dimensions; only 2 or 3 can be drawn")]
    Dimension {
        /// The trace.
        name: String,
        /// How many dimensions its header tells.
        dimension: usize,
    },
    /// A frame is not one of its world, or not later than the one before.
    #[error("{name}: the frame of step {step} {problem}")]
    Frame {
        /// The trace.
        name: String,
        /// The frame.
        step: u64,
        /// What is wrong with it.
        problem: String,
    },
    /// It has no frame in the time asked for.
    #[error("{name}: no frame {between}")]
    Empty {
        /// The trace.
        name: String,
        /// The time asked for.
        between: String,
    },
    /// It records nothing of this name.
    #[error("{name} does not record {quantity};{hint} {recorded}")]
    Unknown {
        /// The trace.
        name: String,
        /// What was asked for.
        quantity: String,
        /// What may have been meant.
        hint: String,
        /// What there is, or how to learn that where it is much.
        recorded: String,
    },
    /// It records this, but without a value in any frame.
    #[error("{name}: {quantity} has no value in any frame{reason}")]
    Undefined {
        /// The trace.
        name: String,
        /// What was asked for.
        quantity: String,
        /// Why, where that is known.
        reason: String,
    },
    /// It has no agent of this index.
    #[error("{name} has no agent {agent}; its agents are 0 to {last}")]
    NoAgent {
        /// The trace.
        name: String,
        /// The index asked for.
        agent: usize,
        /// The last index that there is.
        last: usize,
    },
    /// It has no agents at all.
    #[error("{name} has no agents")]
    NoAgents {
        /// The trace.
        name: String,
    },
    /// A logarithmic axis has no place for a level.
    #[error("a level of {value} has no place on a logarithmic axis; it must be above 0")]
    NoPlace {
        /// The level.
        value: f64,
    },
    /// A logarithmic axis has nothing to show.
    #[error("{what} has no value above 0, as a logarithmic axis needs")]
    NotPositive {
        /// What is along the axis.
        what: String,
    },
}
