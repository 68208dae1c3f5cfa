//! A moment of a run, with what is remembered of the time before.

use std::sync::Arc;

use crate::trace::record::Frame;

/// A frame to draw.
#[derive(Debug, Clone)]
pub struct Moment {
    /// The state.
    pub frame: Frame,
    /// Where the agents were before, for trails: from long ago to lately.
    pub trail: Vec<Arc<Past>>,
    /// How far the camera has gone round, in degrees.
    pub turn: f64,
}

/// Where the agents were.
#[derive(Debug, Clone, PartialEq)]
pub struct Past {
    /// When.
    pub time: f64,
    /// Position of each agent.
    pub positions: Vec<Vec<f64>>,
}

impl Moment {
    /// A frame without anything of the time before.
    pub fn new(frame: Frame) -> Self {
        Self {
            frame,
            trail: Vec::new(),
            turn: 0.0,
        }
    }
}
