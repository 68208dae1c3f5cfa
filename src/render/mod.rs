//! What happens in a trace, drawn: bodies, obstacles and what passes between them.
//!
//! A trace is read twice. A [`Survey`] of it tells how far the flock comes, how fast, and what it
//! touches; then a [`Scene`] draws the [`Moment`]s that are wanted, each as a
//! [`Picture`](crate::picture::Picture), in the way that a [`Look`] says. Worlds in the plane are
//! seen from above, worlds in space in perspective: what is drawn is the same, told once, and a
//! view of the dimension puts it on the page.
//!
//! ```
//! use volary::render::{Look, Moment, Scene, Survey};
//! use volary::trace::record::Record;
//! # use volary::simulation::Simulation;
//! # use volary::world::{AnyWorld, Document};
//! # let file = r#"{ "dimension": 2, "time": { "end": 1 }, "agents":
//! #   [{ "radius": 0.5, "positions": { "explicit": [[0, 0], [6, 0], [3, 6]] } }] }"#;
//! # let AnyWorld::Plane(world) = Document::new("three.json", file).world("three")? else {
//! #     panic!("the world is flat");
//! # };
//! # let mut records = Vec::new();
//! # let mut simulation = Simulation::new(world.clone())?;
//! # simulation.run(
//! #     |record| { records.push(record); Ok::<_, std::convert::Infallible>(()) },
//! #     |_| std::ops::ControlFlow::Continue(()),
//! # )?;
//! let survey = Survey::of(&world, &records)?;
//! let scene = Scene::new(&world, &survey, Look::default());
//! let last = records.iter().rev().find_map(|record| match record {
//!     Record::Frame(frame) => Some(Moment::new(frame.clone())),
//!     _ => None,
//! });
//! let picture = scene.picture(&last.expect("a run has frames"));
//! assert!(picture.size[0] <= 800.0 && picture.size[1] <= 600.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod clip;
mod coloring;
mod error;
mod extent;
mod film;
mod frame;
mod framing;
mod hull;
mod layer;
mod layout;
mod legend;
mod look;
mod moment;
mod moments;
mod plane;
mod scale_bar;
mod scene;
mod space;
mod strip;
mod survey;
mod view;

pub use clip::Clip;
pub use error::RenderError;
pub use film::film;
pub use layer::{Layer, Layers};
pub use look::{Camera, Coloring, Look, Size};
pub use moment::{Moment, Past};
pub use moments::{Moments, open};
pub use scene::Scene;
pub use strip::{Panel, overlay, strip};
pub use survey::{Recorded, Survey, Touch};
pub use view::{Eye, Form, Framing, Seen, Sight, View};
