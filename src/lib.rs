//! Flocks with bodies.

pub mod dynamics;
pub mod law;
pub mod math;
pub mod metric;
pub mod schema;
pub mod sense;
pub mod shape;
pub mod simulation;
pub mod trace;
pub mod world;
