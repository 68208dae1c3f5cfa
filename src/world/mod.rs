//! Worlds: what a world file says, checked and resolved.

pub mod problem;
pub mod spec;
