//! Ordinary differential equations, integrated with an error that is asked for.
//!
//! A [`Solution`] of a [`System`] goes on in steps of a [`Method`]: [`DormandPrince`] where
//! the equations are smooth, [`Radau`] where they are stiff. It chooses how long the steps are,
//! and ends them where the slope jumps.

mod dormand_prince;
mod radau;
mod solution;

pub use dormand_prince::DormandPrince;
pub use radau::Radau;
pub use solution::{Solution, Stuck, Stumble};

/// The equations y' = f(t, y).
///
/// Where f jumps, a system tells by its margin, and no step mixes values of f from both sides,
/// but where the jump is too small to show in its error.
pub trait System {
    /// Writes f(t, y) into `out`.
    fn slope(&mut self, time: f64, state: &[f64], out: &mut [f64]);

    /// What an error in entry `k` is measured by, where a step takes that from `before` to
    /// `after`: the larger of these and 1, unless a system knows better.
    fn scale(&self, _k: usize, before: f64, after: f64) -> f64 {
        before.abs().max(after.abs()).max(1.0)
    }

    /// How far the state is from the place where the slope next jumps, as seen from the side
    /// that [`System::settle`] told: positive before it, negative beyond. It must change
    /// steadily with the state, about in proportion to the way left where that is short, and
    /// is infinite where nothing jumps.
    fn margin(&mut self, _state: &[f64]) -> f64 {
        f64::INFINITY
    }

    /// Says that from now on the state is on the side where it is now.
    fn settle(&mut self, _state: &[f64]) {}
}

impl<F: FnMut(f64, &[f64], &mut [f64])> System for F {
    fn slope(&mut self, time: f64, state: &[f64], out: &mut [f64]) {
        self(time, state, out);
    }
}

/// Where a solution stands when a step is tried.
#[derive(Debug, Clone, Copy)]
pub struct Stand<'a> {
    /// The time.
    pub time: f64,
    /// The state.
    pub state: &'a [f64],
    /// The slope there.
    pub slope: &'a [f64],
    /// The error that a step may make in an entry, as a share of its scale.
    pub tolerance: f64,
    /// Whether a step may go through a jump.
    pub through: bool,
}

/// What became of a step that was tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Attempt {
    /// It came to its end.
    Done {
        /// Its error, as a share of the one allowed.
        error: f64,
        /// The margin at its end, negative only if it has gone through a jump.
        margin: f64,
    },
    /// Some state that it asked for lies beyond a jump.
    Crossed {
        /// The time of that state, as a share of the step.
        share: f64,
        /// Its margin, negative.
        margin: f64,
    },
    /// It did not find its end.
    Lost,
}

/// A method of one step.
pub trait Method {
    /// By which power of a step's length the error falls that it finds for it.
    const POWER: f64;

    /// Tries a step of this length; `end` becomes the state at its end.
    fn attempt(
        &mut self,
        system: &mut impl System,
        stand: Stand<'_>,
        step: f64,
        end: &mut Vec<f64>,
    ) -> Attempt;
}
