//! Flocks with bodies.

pub mod math;
pub mod schema;
pub mod trace;
pub mod world;
