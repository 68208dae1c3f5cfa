//! What agents perceive: neighbours and obstacles.

mod cells;
mod scene;

pub use cells::Cells;
pub use scene::{Active, Scene, active_obstacles};
