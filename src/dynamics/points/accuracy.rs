//! How exactly points are integrated, and by what.

use serde::{Deserialize, Serialize};

use crate::dynamics::Failure;

/// How exactly points are integrated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// The largest error that one step of the solver may make in a position or velocity, as a
    /// share of the largest position and velocity so far: from [`Accuracy::FINEST`] to
    /// [`Accuracy::COARSEST`].
    pub relative: f64,
}

impl Accuracy {
    /// The finest that can be asked for: beyond, there is only rounding.
    pub const FINEST: f64 = 1e-13;
    /// The coarsest that can be asked for.
    pub const COARSEST: f64 = 1e-3;

    /// Finds out whether it can be had.
    pub(super) fn check(self) -> Result<(), Failure> {
        match (Self::FINEST..=Self::COARSEST).contains(&self.relative) {
            true => Ok(()),
            false => Err(Failure::Accuracy {
                value: self.relative,
            }),
        }
    }
}

impl Default for Accuracy {
    /// 10⁻¹⁰.
    fn default() -> Self {
        Self { relative: 1e-10 }
    }
}

/// What solves the equations of motion of points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solver {
    /// Name of the method.
    pub method: &'static str,
    /// Its order.
    pub order: usize,
    /// See [`Accuracy::relative`].
    pub relative: f64,
    /// How often so far a pair of agents came to or left a distance at which some law jumps.
    pub jumps: u64,
}
