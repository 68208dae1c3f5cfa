//! Flocks with bodies.

pub mod math;
pub mod trace;
pub mod world;
