//! What can be wrong with what is to be drawn.

use crate::picture::PictureError;
use crate::render::Clip;
use crate::trace::TraceError;
use crate::world::Problem;

/// Why a trace cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// It cannot be read.
    #[error(transparent)]
    Trace(#[from] TraceError),
    /// Its header holds no sound world.
    #[error("the world of the trace is not sound: {}", first(.0))]
    World(Vec<Problem>),
    /// It holds no frame.
    #[error("the trace has no frames: there is nothing to draw")]
    Empty,
    /// A frame does not fit the world.
    #[error("the frame at t = {time} does not fit the world of the trace: {problem}")]
    Frame {
        /// Time of the frame.
        time: f64,
        /// What is wrong with it.
        problem: String,
    },
    /// Positions are so far apart that their distance is no number.
    #[error("positions are too far apart to be drawn")]
    Boundless,
    /// A film of too many pictures.
    #[error("a film of {pictures:.0e} pictures; the most is {:e}", Clip::MOST)]
    TooLong {
        /// How many it would have.
        pictures: f64,
    },
    /// Someone stopped it.
    #[error("stopped; no film was written")]
    Stopped,
    /// What is drawn cannot be painted or written.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A layer has another name.
    #[error("{0}")]
    Layer(String),
}

/// The first problem, in a line.
fn first(problems: &[Problem]) -> String {
    match problems.first() {
        Some(problem) => format!("{} {}", problem.path, problem.what),
        None => "it cannot be built".to_owned(),
    }
}
