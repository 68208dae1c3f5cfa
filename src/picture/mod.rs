//! Pictures: marks on a page, written as SVG or painted as pixels, one by one or as films.
//!
//! A [`Picture`] is a list of [`Mark`]s in pixels, x to the right and y down from the upper left
//! corner, painted in their order. It knows nothing of flocks: those who draw put marks in,
//! those who write files take them out.

mod color;
mod error;
mod film;
mod mark;
mod path;
mod raster;
mod sound;
mod svg;
#[cfg(test)]
mod tests;
pub mod text;
mod theme;

pub use color::Color;
pub use error::PictureError;
pub use film::{FileKind, Film, Reel};
pub use mark::{Anchor, Label, Mark, Paint, Stroke};
pub use path::{Path, Segment};
pub use raster::Pixels;
pub use theme::{Ramp, Theme};

use crate::file::write_whole;

/// Marks on a page.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [f64; 2],
    /// The colour of the page.
    pub background: Color,
    /// What is seen, in a line, for those who cannot see it.
    pub title: String,
    /// What is painted, in this order.
    pub marks: Vec<Mark>,
}

impl Picture {
    /// An empty page of this width and height, in pixels.
    pub fn new(size: [f64; 2], background: Color, title: impl Into<String>) -> Self {
        Self {
            size,
            background,
            title: title.into(),
            marks: Vec::new(),
        }
    }

    /// Paints a mark over what is there.
    pub fn add(&mut self, mark: Mark) {
        self.marks.push(mark);
    }

    /// Fills a path.
    pub fn fill(&mut self, path: Path, color: Color) {
        self.add(Mark::Path {
            path,
            fill: Some(Paint::Flat(color)),
            stroke: None,
        });
    }

    /// Draws the line of a path.
    pub fn stroke(&mut self, path: Path, stroke: Stroke) {
        self.add(Mark::Path {
            path,
            fill: None,
            stroke: Some(stroke),
        });
    }

    /// Fills a disk of this centre and radius.
    pub fn disk(&mut self, center: [f64; 2], radius: f64, color: Color) {
        self.add(Mark::Disk {
            center,
            radius,
            fill: Some(Paint::Flat(color)),
            stroke: None,
        });
    }

    /// Writes a line of text.
    pub fn label(&mut self, label: Label) {
        self.add(Mark::Label(label));
    }

    /// Puts another picture into this one, its upper left corner at `corner`; nothing of it is
    /// seen outside its page.
    pub fn place(&mut self, corner: [f64; 2], picture: Picture) {
        self.add(Mark::Group {
            corner,
            size: picture.size,
            background: Some(picture.background),
            marks: picture.marks,
        });
    }

    /// Writes the picture to a file, `.svg` or `.png`, which appears whole or not at all.
    ///
    /// # Errors
    /// [`PictureError::Kind`] and [`PictureError::Film`] for another ending,
    /// [`PictureError::File`] where the file is there already, without `overwrite`, or cannot
    /// be written, and those of [`Picture::paint`].
    pub fn write(&self, path: &std::path::Path, overwrite: bool) -> Result<(), PictureError> {
        let bytes = match FileKind::of(path)? {
            FileKind::Svg => self.svg().into_bytes(),
            FileKind::Png => self.paint()?.png()?,
            _ => {
                let name = path.display().to_string();
                return Err(PictureError::Film { name });
            }
        };
        Ok(write_whole(path, &bytes, overwrite)?)
    }
}
