//! What a picture is made of.

use super::{Color, Path};

/// Something painted.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// An area, a line, or an area with its outline.
    Path {
        /// Where it runs.
        path: Path,
        /// What fills it: where parts overlap, the non-zero rule holds.
        fill: Option<Paint>,
        /// What draws its line.
        stroke: Option<Stroke>,
    },
    /// A disk, a circle, or both.
    Disk {
        /// Its centre.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
        /// What fills it.
        fill: Option<Paint>,
        /// What draws its circle.
        stroke: Option<Stroke>,
    },
    /// A line of text.
    Label(Label),
    /// Marks with an origin of their own, seen within a rectangle only.
    Group {
        /// The upper left corner of the rectangle, the origin of the marks.
        corner: [f64; 2],
        /// Width and height of the rectangle.
        size: [f64; 2],
        /// What covers the rectangle before the marks are painted.
        background: Option<Color>,
        /// The marks.
        marks: Vec<Mark>,
    },
}

/// What fills an area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Paint {
    /// One colour.
    Flat(Color),
    /// From one colour at `center` to another at `radius` and beyond.
    Radial {
        /// Where the inner colour is.
        center: [f64; 2],
        /// How far from there the outer colour is.
        radius: f64,
        /// The colour at the centre.
        inner: Color,
        /// The colour from the radius on.
        outer: Color,
    },
}

/// What draws a line; its ends and corners are round.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub color: Color,
    /// Its width in pixels.
    pub width: f64,
    /// Lengths of dashes and of the gaps behind them, in turn, in pixels; a line without gaps
    /// where there are none.
    pub dashes: Vec<f64>,
}

impl Stroke {
    /// A line without gaps.
    pub fn new(color: Color, width: f64) -> Self {
        Self {
            color,
            width,
            dashes: Vec::new(),
        }
    }

    /// A line of dashes and gaps of these lengths, in pixels.
    pub fn dashed(color: Color, width: f64, dash: f64, gap: f64) -> Self {
        Self {
            color,
            width,
            dashes: vec![dash, gap],
        }
    }
}

/// A line of text.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// What it says.
    pub text: String,
    /// A point on its base line.
    pub at: [f64; 2],
    /// Height of the letters from base line to base line, in pixels.
    pub size: f64,
    /// Its colour.
    pub color: Color,
    /// Which point of it stands at `at`.
    pub anchor: Anchor,
    /// Whether it is bold.
    pub bold: bool,
    /// Whether it runs upwards instead of to the right.
    pub upwards: bool,
}

impl Label {
    /// A line that begins at this point of its base line.
    pub fn new(text: impl Into<String>, at: [f64; 2], size: f64, color: Color) -> Self {
        Self {
            text: text.into(),
            at,
            size,
            color,
            anchor: Anchor::Start,
            bold: false,
            upwards: false,
        }
    }

    /// The same, with another point of it at its place.
    pub fn anchor(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// The same in bold.
    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// The same, running upwards.
    pub fn upwards(self) -> Self {
        Self {
            upwards: true,
            ..self
        }
    }
}

/// A point of a line of text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Where it begins.
    Start,
    /// The middle.
    Middle,
    /// Where it ends.
    End,
}
