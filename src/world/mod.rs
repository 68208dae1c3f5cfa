//! Worlds: what a world file says, checked and resolved into agents and obstacles.
//!
//! A [`Document`] reads the text of a file, in stages, into a
//! [`WorldSpec`](spec::WorldSpec), or into a [`Report`] of
//! everything that is wrong with it. The spec is then resolved into a [`World`].

mod agents;
pub mod check;
mod crowd;
mod crowded_start;
mod describe;
pub mod document;
mod graph;
pub mod limits;
mod obstacles;
mod overlap;
pub mod path;
mod placement;
pub mod problem;
mod random;
pub mod report;
mod resolve;
pub mod set;
pub mod shipped;
mod sites;
mod span;
pub mod spec;
mod standing;
mod start_distance;
mod strict;
mod syntax;
mod validate;
mod velocity;
mod watch;
mod words;

pub use agents::Agents;
pub use document::Document;
pub use problem::Problem;
pub use report::Report;
pub use resolve::{AnyWorld, World};
pub use set::{Override, OverrideError};
pub use watch::{Stage, Watch};
pub use words::nearest_path;

use crate::math::Vector;

/// A vector from a list of numbers; numbers beyond `D` are left out, missing ones are 0.
/// Checked worlds hold lists of the right length only.
pub fn vector<const D: usize>(numbers: &[f64]) -> Vector<D> {
    Vector::from_fn(|k, _| numbers.get(k).copied().unwrap_or(0.0))
}

/// As [`vector`]; zero where nothing is given.
pub fn vector_or_zero<const D: usize>(numbers: &Option<Vec<f64>>) -> Vector<D> {
    vector(numbers.as_deref().unwrap_or_default())
}
