//! What scenes look like: known places, invariances, and pictures that were looked at once.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/image.rs"]
mod image;

mod golden;
mod invariance;
mod stage;
mod survey;
