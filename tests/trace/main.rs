//! Traces: what is written is read, whole or cut, and nothing else is.

mod background;
mod cut;
mod files;
mod foreign;
mod non_finite;
mod resume;
mod round_trip;
mod sample;
