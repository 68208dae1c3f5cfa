//! Whether frames are those of their trace: what is drawn of others would be wrong.

use super::SeriesError;
use crate::trace::record::{Frame, Header};

/// The frames of a trace, one after the other.
#[derive(Debug)]
pub(super) struct Frames {
    name: String,
    agents: usize,
    dimension: usize,
    /// Time of the frame before.
    time: Option<f64>,
}

impl Frames {
    /// Those that are to follow a header of a trace of this name.
    pub(super) fn of(name: &str, header: &Header) -> Result<Self, SeriesError> {
        let dimension = header.world.dimension;
        match dimension {
            2 | 3 => Ok(Self {
                name: name.to_owned(),
                agents: header.bodies.radius.len(),
                dimension,
                time: None,
            }),
            _ => Err(SeriesError::Dimension {
                name: name.to_owned(),
                dimension,
            }),
        }
    }

    /// Refuses a frame without a position and a velocity for each agent, or that is not later
    /// than the one before.
    pub(super) fn check(&mut self, frame: &Frame) -> Result<(), SeriesError> {
        let before = self.time.replace(frame.time);
        let problem = self
            .problem(&frame.positions, "position")
            .or_else(|| self.problem(&frame.velocities, "velocity"))
            .or_else(|| match before {
                _ if !frame.time.is_finite() => Some(format!("has time {}", frame.time)),
                Some(before) if frame.time <= before => Some(format!(
                    "has time {}, which is not after {before}, that of the frame before",
                    frame.time
                )),
                _ => None,
            });
        match problem {
            Some(problem) => Err(SeriesError::Frame {
                name: self.name.clone(),
                step: frame.step,
                problem,
            }),
            None => Ok(()),
        }
    }

    /// What is wrong with the vectors of the agents.
    fn problem(&self, vectors: &[Vec<f64>], what: &str) -> Option<String> {
        if vectors.len() != self.agents {
            let (found, agents) = (vectors.len(), self.agents);
            return Some(format!(
                "does not have a {what} for each agent, but {found} for {agents}"
            ));
        }
        vectors.iter().enumerate().find_map(|(agent, vector)| {
            if vector.len() != self.dimension {
                let (found, dimension) = (vector.len(), self.dimension);
                return Some(format!(
                    "has a {what} of agent {agent} with {found} components, in {dimension} dimensions"
                ));
            }
            let infinite = vector.iter().find(|it| !it.is_finite())?;
            Some(format!("has a {what} of agent {agent} with {infinite} in it"))
        })
    }
}
