//! Plots: axes and what stands on them, on a picture.
//!
//! A [`Plot`] has two [`Axis`]es and a list of [`Item`]s in the numbers of the axes: lines,
//! markers, arrows, levels. [`Plot::draw`] finds scales, ticks that do not run into each other, a
//! place for the legend where nothing is hidden by it, and draws all of it on a
//! [`Picture`]. A [`Sheet`] is several plots on one page.
//!
//! ```
//! use volary::picture::Theme;
//! use volary::plot::{Axis, Item, Plot};
//!
//! let points = (0..=100).map(|k| 0.1 * k as f64).map(|t| [t, (-t).exp()]);
//! let plot = Plot {
//!     title: "Decay".to_owned(),
//!     x: Axis::new("time"),
//!     y: Axis::new("speed").logarithmic(),
//!     items: vec![Item::line(points, Theme::LIGHT.of(0)).named("exp(−t)")],
//!     ..Plot::default()
//! };
//! let picture = plot.draw([480.0, 320.0], &Theme::LIGHT);
//! assert_eq!(picture.title, "Decay");
//! ```

mod axes;
mod frame;
mod item;
mod layout;
mod legend;
mod marker;
mod paint;
mod polyline;
mod scale;
mod sheet;
mod ticks;
mod words;

pub use item::{Dash, Form, Item};
pub use marker::Marker;
pub use polyline::thin;
pub use scale::{Kind, Scale};
pub use sheet::Sheet;

use crate::picture::{Picture, Theme};

/// Two axes and what stands on them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plot {
    /// Above the axes; a long one is broken into lines.
    pub title: String,
    /// The axis that runs to the right.
    pub x: Axis,
    /// The axis that runs upwards.
    pub y: Axis,
    /// What stands on the axes, painted in this order; levels and moments below all others.
    pub items: Vec<Item>,
    /// Whether a unit is as long on both axes, as in a map; both are linear then.
    pub equal: bool,
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// What is along it.
    pub label: String,
    /// How numbers stand on it.
    pub kind: Kind,
    /// Its ends, the lower first; what is beyond them is not seen. Chosen by the items where
    /// absent, and where it could be none: not finite, empty, or not above 0 on a logarithmic
    /// axis.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    /// An axis that its items choose, with this label.
    pub fn new(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            ..Self::default()
        }
    }

    /// The same, logarithmic.
    pub fn logarithmic(self) -> Self {
        let kind = Kind::Logarithmic;
        Self { kind, ..self }
    }

    /// The same, linear.
    pub fn linear(self) -> Self {
        let kind = Kind::Linear;
        Self { kind, ..self }
    }

    /// The same, between these ends.
    pub fn range(self, range: [f64; 2]) -> Self {
        let range = Some(range);
        Self { range, ..self }
    }
}

impl Plot {
    /// The plot on a page of this width and height, in pixels.
    pub fn draw(&self, size: [f64; 2], theme: &Theme) -> Picture {
        let sheet = Sheet {
            plots: vec![self.clone()],
            ..Sheet::default()
        };
        let title = self.title.clone();
        Picture {
            title,
            ..sheet.draw(size, theme)
        }
    }
}
