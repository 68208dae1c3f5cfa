//! Validation: worlds run as points and as bodies, and what the papers' claims come to.

mod expectation;
pub mod form;
pub mod report;

pub use expectation::problems;
