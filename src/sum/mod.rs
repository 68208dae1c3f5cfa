//! Sums over pairs of points.
//!
//! Laws of all pairs come down to two sums for each agent i: Σ_j φ(r_ij²), and
//! Σ_j φ(r_ij²)(c_j − c_i) of something that each agent carries: its velocity, or its
//! position.

mod cloud;
mod direct;
pub mod fast;
#[cfg(test)]
mod tests;
mod tile;
mod ways;

pub use cloud::{Cloud, Point, Sums};
pub use direct::{at, mutual};
pub use ways::{Direct, DirectWays, Fast, Summable, Ways, direct, fast as fast_sums};
