//! Sums over all pairs of agents.

pub mod fast;
