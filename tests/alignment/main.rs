//! Velocity alignment against the papers' formulas, its symmetries, and what it promises.

#[path = "../common/mod.rs"]
mod common;

mod all_pairs;
mod formula;
mod graph;
mod promises;
mod scene;
mod sight;
