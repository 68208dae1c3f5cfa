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
/// Where f jumps, a system holds it as it was before the jump, continued smoothly, until it is
/// told that the state has crossed: so no step mixes values of f from both sides, and a step that
/// goes too far can be measured and taken back.
pub trait System {
    /// Writes f(t, y) into `out`, as it is on this side of the next jump.
    fn slope(&mut self, time: f64, state: &[f64], out: &mut [f64]);

    /// What an error in entry `k` is measured by, where a step takes that from `before` to
    /// `after`: the larger of these and 1, unless a system knows better.
    fn scale(&self, _k: usize, before: f64, after: f64) -> f64 {
        before.abs().max(after.abs()).max(1.0)
    }

    /// How far a state is from the place where the slope next jumps: positive before it,
    /// negative beyond, infinite where nothing jumps; no number where it is too far away to tell.
    fn margin(&mut self, _time: f64, _state: &[f64]) -> f64 {
        f64::INFINITY
    }

    /// About how long a state with this slope takes to the next jump; infinite where none is
    /// near.
    fn foresee(&mut self, _state: &[f64], _slope: &[f64]) -> f64 {
        f64::INFINITY
    }

    /// About how long ago a state that is beyond a jump, with the slope of the side before it,
    /// crossed that; nothing where only the margin tells.
    fn hindsight(&mut self, _state: &[f64], _slope: &[f64]) -> Option<f64> {
        None
    }

    /// When within a step that ends before every jump the state is about to have been beyond one
    /// all the same, from what is known at both ends.
    fn dip(&mut self, _step: f64, _begin: [&[f64]; 2], _end: [&[f64]; 2]) -> Option<f64> {
        None
    }

    /// Says that the state has come to the jumps that it is beyond, or crosses next: from now on
    /// it is on the other side of them. What cannot be crossed may put the state right. A step
    /// that met no jump would be about `free` long. Returns how many jumps were crossed.
    fn cross(&mut self, _time: f64, _free: f64, _state: &mut [f64]) -> usize {
        0
    }

    /// As [`System::slope`], beyond the jumps that the state is beyond.
    fn peek(&mut self, time: f64, state: &[f64], out: &mut [f64]) {
        self.slope(time, state, out);
    }

    /// Says that a step has ended before every jump. Whether the slope is another one now all the
    /// same.
    fn arrive(&mut self, _time: f64, _state: &[f64]) -> bool {
        false
    }

    /// Says that the state which is about to be crossed has a slope that changes by so little
    /// there that the place need not be looked for again.
    fn disregard(&mut self) {}

    /// Says that a solution begins at a state.
    fn settle(&mut self, _time: f64, _state: &[f64]) {}

    /// Whether the integration should stop where it is.
    fn stopped(&self) -> bool {
        false
    }
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
}

/// A method of one step.
pub trait Method {
    /// By which power of a step's length the error falls that it finds for it.
    const POWER: f64;

    /// Tries a step of this length; `end` becomes the state at its end. Its error as a share of
    /// the one allowed, or nothing where it does not find its end.
    fn attempt(
        &mut self,
        system: &mut impl System,
        stand: Stand<'_>,
        step: f64,
        end: &mut Vec<f64>,
    ) -> Option<f64>;
}
