//! The command as its users meet it: what it prints, writes, refuses and returns.

#[path = "../common/mod.rs"]
mod common;

mod claims;
mod columns;
mod content;
mod determinism;
mod export;
mod figures;
mod files;
mod input;
mod plot;
mod points;
mod profile;
mod reduce;
mod render;
mod resume;
mod scene;
#[cfg(unix)]
mod signals;
#[cfg(unix)]
mod stopping;
