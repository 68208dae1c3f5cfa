//! Flocks with bodies: the flocking and steering laws of the literature as forces on rigid
//! bodies in a rapier world, in 2-D and 3-D.
//!
//! A [`World`](world::World) comes from a JSON file and names agents, obstacles and laws. A
//! [`Simulation`](simulation::Simulation) moves it: each step, the sum of the
//! [`law`]s accelerates the agents, which are rigid bodies that push, block and touch each
//! other and the obstacles. What happens comes out as the [`record`](trace::record)s of a
//! [`trace`], which [`render`] and [`series`] draw.
//!
//! ```
//! use std::ops::ControlFlow;
//! use volary::simulation::Simulation;
//! use volary::world::{AnyWorld, Document};
//!
//! let file = r#"{
//!   "dimension": 2,
//!   "time": { "end": 20 },
//!   "agents": [{ "radius": 0.5, "positions": { "explicit": [[0, 0], [6, 0], [3, 6]] } }],
//!   "laws": [{ "alpha_interaction": { "spacing": 7, "range": 8.4 } }]
//! }"#;
//! let AnyWorld::Plane(world) = Document::new("three.json", file).world("three")? else {
//!     panic!("the world is flat");
//! };
//! let mut simulation = Simulation::new(world)?;
//! let summary = simulation.run(
//!     |_record| Ok::<_, std::convert::Infallible>(()),
//!     |_state| ControlFlow::Continue(()),
//! )?;
//! // Three agents settle in a triangle of side 7.
//! assert!((summary.last.position_diameter - 7.0).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Layout
//!
//! From the bottom up; each module uses only those above it in this list.
//!
//! - [`profile`]: where the time goes
//! - [`parallel`]: work shared out over threads
//! - [`stop`]: a request to stop
//! - [`mod@file`]: files that appear whole or not at all
//! - [`math`]: vectors and the scalar functions that laws are made of
//! - [`picture`]: marks on a page, as SVG or as pixels, and films
//! - [`plot`]: axes and curves
//! - [`sum`]: sums over all pairs of points, on vector registers
//! - [`shape`]: obstacle shapes, closest points and their derivatives
//! - [`world`]: the world file, read, checked and resolved
//! - [`sense`]: what agents perceive, neighbours and obstacles
//! - [`net`]: the graphs that agents induce, and their analysis
//! - [`law`]: one file per law, and the flock that sums them
//! - [`dynamics`]: what moves the agents
//! - [`trace`]: what a run leaves behind
//! - [`metric`]: functions of a state, and the ledger of contacts
//! - [`reduced`]: the reduced model of fast flocking
//! - [`claim`]: the papers' theorems, and what they come to on a run
//! - [`simulation`]: the loop
//! - [`checkpoint`]: a simulation in a file, to go on with later
//! - [`validate`]: worlds run as points and as bodies, and their claims judged
//! - [`export`]: traces as tables and in the formats of other tools
//! - [`render`]: what happens in a trace, drawn
//! - [`series`]: quantities along traces, plotted
//! - [`figure`]: the figures of the papers, made anew
//! - [`schema`]: JSON Schemas of the file formats

pub mod checkpoint;
pub mod claim;
mod csv;
pub mod dynamics;
pub mod export;
pub mod figure;
pub mod file;
pub mod law;
pub mod math;
pub mod metric;
pub mod net;
pub mod parallel;
pub mod picture;
pub mod plot;
pub mod profile;
pub mod reduced;
pub mod render;
pub mod schema;
pub mod sense;
pub mod series;
pub mod shape;
pub mod simulation;
pub mod stop;
pub mod sum;
pub mod trace;
pub mod validate;
pub mod world;
