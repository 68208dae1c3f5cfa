//! Laws that steer along given courses: their formulas, their symmetries, and that what they
//! promise is flown.

#[path = "../common/mod.rs"]
mod common;

mod flight;
mod formulas;
mod symmetry;
