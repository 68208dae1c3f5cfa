//! What can go wrong with a picture.

use super::FileKind;
use crate::file::FileError;

/// Why a picture or a film could not be painted or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// Width or height is no number of pixels that can be painted.
    #[error(
        "a picture of {width} × {height} pixels cannot be painted: each side has 1 to {} pixels",
        super::Pixels::MOST
    )]
    Size {
        /// The width asked for.
        width: f64,
        /// The height asked for.
        height: f64,
    },
    /// One picture belongs over another, and has not its size.
    #[error("a picture of {} × {} pixels has not the size of the one below it, {} × {}",
        found[0], found[1], expected[0], expected[1])]
    OtherSize {
        /// Width and height of the picture.
        found: [u32; 2],
        /// Width and height of what it belongs to.
        expected: [u32; 2],
    },
    /// The pixels could not be written as PNG.
    #[error("the picture cannot be written as PNG: {0}")]
    Png(#[from] png::EncodingError),
    /// The frames could not be written as GIF.
    #[error("the film cannot be written as GIF: {0}")]
    Gif(#[from] gif::EncodingError),
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file's name does not tell its kind.
    #[error(
        "{name}: the name of a still ends in {}, that of a film in {}",
        FileKind::STILLS,
        FileKind::FILMS
    )]
    Kind {
        /// The file.
        name: String,
    },
    /// The file's name asks for a still where a film is to be written.
    #[error("{name}: the name of a film ends in {}", FileKind::FILMS)]
    Still {
        /// The file.
        name: String,
    },
    /// The file's name asks for a film where a still is to be written.
    #[error("{name}: the name of a still ends in {}", FileKind::STILLS)]
    Film {
        /// The file.
        name: String,
    },
    /// Nobody can see that many, or that few, frames a second.
    #[error("{rate} frames a second are out of range: 0.1 to 240")]
    Rate {
        /// What was asked for.
        rate: f64,
    },
    /// A film of nothing.
    #[error("a film has at least one frame")]
    NoFrames,
    /// A film got more or fewer frames than it was to have.
    #[error("a film of {expected} frames cannot have {found}")]
    Frames {
        /// What it has.
        found: u32,
        /// What it was to have.
        expected: u32,
    },
    /// There is no ffmpeg.
    #[error("{ending} needs ffmpeg, which was not found; .gif and .apng need nothing")]
    NoFfmpeg {
        /// The kind of film, "mp4" or "webm".
        ending: &'static str,
    },
    /// ffmpeg failed.
    #[error("ffmpeg failed: {problem}")]
    Ffmpeg {
        /// Its last words.
        problem: String,
    },
}
