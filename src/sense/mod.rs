//! What agents perceive: neighbours and obstacles.

mod cells;
mod field_of_view;
mod history;
mod noise;
mod perception;
mod scene;
mod senses;
mod sight;
mod vicinity;

pub use cells::Cells;
pub use field_of_view::{Cone, in_view};
pub use history::{History, Moment};
pub use noise::LinkDraws;
pub use perception::Perception;
pub(crate) use scene::Search;
pub use scene::{Active, Neighbour, Scene, active_obstacles};
pub use senses::Senses;
pub(crate) use sight::body_blocks;
pub(crate) use vicinity::Vicinity;
