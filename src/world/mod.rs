//! Worlds: what a world file says, checked and resolved.
//!
//! A [`Document`](document::Document) reads the text of a file, in stages, into a
//! [`WorldSpec`](spec::WorldSpec), or into a [`Report`](report::Report) of
//! everything that is wrong with it.

pub mod check;
mod describe;
pub mod document;
pub mod path;
pub mod problem;
pub mod report;
pub mod set;
pub mod shipped;
mod span;
pub mod spec;
mod syntax;
mod validate;
mod words;
