//! The analysis of nets: against plain dense computations, closed forms and brute force.

mod closed_forms;
mod dense;
mod planarity;
mod record;
mod sample;
mod structure;
