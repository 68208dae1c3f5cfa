//! What agents perceive, and laws for some groups: against brute force, hand-kept
//! histories, closed forms and statistics.

#[path = "../common/mod.rs"]
mod common;

mod heading;
mod limits;
mod random;
mod scene;
mod scopes;
mod sight;
mod time;
