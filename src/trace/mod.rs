//! Traces: what a run leaves behind.

pub mod record;
