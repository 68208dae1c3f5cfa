//! What agents perceive: neighbours and obstacles.

mod cells;
mod field_of_view;
mod history;
mod hold;
mod noise;
mod obstacles;
mod perception;
mod scene;
mod senses;
mod sight;
mod vicinity;

pub use cells::Cells;
pub use field_of_view::{Cone, in_view};
pub use history::{History, Moment};
pub use hold::Hold;
pub use noise::LinkDraws;
pub use obstacles::{Active, Surroundings};
pub use perception::Perception;
pub(crate) use scene::Search;
pub use scene::{Neighbour, Scene};
pub use senses::Senses;
pub(crate) use sight::body_blocks;
pub(crate) use vicinity::Vicinity;
