//! Kinds of files, told by their names.

use std::path::Path;

use crate::picture::PictureError;

/// What a picture or a film is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// A still of lines and text, `.svg`.
    Svg,
    /// A still of pixels, `.png`.
    Png,
    /// A film of at most 255 colours, `.gif`.
    Gif,
    /// A film of all colours, `.apng`.
    Apng,
    /// A film in H.264, `.mp4`; needs ffmpeg.
    Mp4,
    /// A film in VP9, `.webm`; needs ffmpeg.
    Webm,
}

impl FileKind {
    /// The endings of stills, in words.
    pub const STILLS: &'static str = ".svg or .png";
    /// The endings of films, in words.
    pub const FILMS: &'static str = ".gif, .apng, .mp4 or .webm";

    /// The kind that a file's name asks for, in any case.
    ///
    /// # Errors
    /// [`PictureError::Kind`] for another ending.
    pub fn of(path: &Path) -> Result<Self, PictureError> {
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        match ending.to_str() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            Some("gif") => Ok(Self::Gif),
            Some("apng") => Ok(Self::Apng),
            Some("mp4") => Ok(Self::Mp4),
            Some("webm") => Ok(Self::Webm),
            _ => Err(PictureError::Kind {
                name: path.display().to_string(),
            }),
        }
    }

    /// Whether it holds many frames, and not one.
    pub fn is_film(self) -> bool {
        !matches!(self, Self::Svg | Self::Png)
    }
}
