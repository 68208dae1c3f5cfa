//! What agents perceive: neighbours and obstacles.

mod cells;
mod scene;

pub use cells::Cells;
pub use scene::{Active, Neighbour, Scene, active_obstacles};
