//! Plots as pictures.

#[path = "../common/image.rs"]
mod image;

mod golden;
mod marks;
