//! Quantities along traces, plotted: numbers of each frame over time, and where agents went.
//!
//! A [`Reading`] goes through a trace once and keeps a [`Course`] for each [`Probe`], thinned
//! while it comes; [`over_time`], [`trajectories`] and [`components`] make
//! [`Plot`](crate::plot::Plot)s of them.

mod components;
mod course;
mod defined;
mod derived;
mod error;
mod frames;
mod laps;
mod listing;
mod names;
mod over_time;
mod path;
mod probe;
mod quantity;
mod reading;
mod reference;
mod targets;
mod trajectories;

pub use components::{component_probes, components};
pub use course::Course;
pub use defined::{demand, drop_undefined};
pub use error::SeriesError;
pub use listing::{Extent, Listing};
pub use names::{agents_of, apart};
pub use over_time::{OverTime, over_time};
pub use probe::{Motion, Probe};
pub use quantity::Quantity;
pub use reading::{Reading, Run, Span};
pub use trajectories::{trajectories, trajectory_probes};
