//! Points: that they follow the equations of the papers to the accuracy asked for.

#[path = "../common/mod.rs"]
mod common;

mod dense;
mod gaps;
mod jumps;
mod nets;
mod papers;
mod reference;
mod runs;
mod sliding;
mod stiff;
