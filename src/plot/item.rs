//! What stands on the axes of a plot.

use super::Marker;
use crate::picture::{Anchor, Color};

/// Something on the axes of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// What the legend calls it; it is not in the legend without a name. Items of one name share
    /// an entry, which shows the first of them.
    pub name: Option<String>,
    /// Its colour.
    pub color: Color,
    /// What it is, in the numbers of the axes.
    pub form: Form,
}

/// What an item is. Points are `[x, y]`; what has no place on an axis, being not finite or not
/// above 0 on a logarithmic one, is left out.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// A line through points, interrupted where there is none.
    Line {
        /// The points, in their order along the line.
        points: Vec<Option<[f64; 2]>>,
        /// Its width in pixels.
        width: f64,
        /// How it is broken.
        dash: Dash,
    },
    /// A marker at each point.
    Markers {
        /// The points.
        points: Vec<[f64; 2]>,
        /// What stands there.
        marker: Marker,
        /// Radius of the circle about a marker, in pixels.
        radius: f64,
    },
    /// Straight lines between two points each.
    Segments {
        /// The ends.
        ends: Vec<[[f64; 2]; 2]>,
        /// Their width in pixels.
        width: f64,
    },
    /// Arrows from the first point to the second.
    Arrows {
        /// The ends.
        ends: Vec<[[f64; 2]; 2]>,
        /// Width of the shafts in pixels; heads are in proportion.
        width: f64,
    },
    /// Disks; ellipses where units of the axes differ.
    Disks {
        /// Their centres, and their radii in the numbers of the axes.
        disks: Vec<([f64; 2], f64)>,
        /// Whether they are filled; circles otherwise.
        filled: bool,
    },
    /// An area within corners, filled.
    Area {
        /// The corners, in order.
        corners: Vec<[f64; 2]>,
    },
    /// Words at a point.
    Text {
        /// What it says.
        text: String,
        /// Where it stands; its middle is at this height.
        at: [f64; 2],
        /// Height of the letters in pixels.
        size: f64,
        /// Which point of it stands there.
        anchor: Anchor,
    },
    /// A line across the plot at a height, to compare with.
    Level(f64),
    /// A line up the plot at a place, to compare with.
    Moment(f64),
    /// Short strokes that stand on the x-axis.
    Rug(Vec<f64>),
}

/// How a line is broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dash {
    /// Not at all.
    #[default]
    Solid,
    /// Into dashes.
    Dashed,
    /// Into dots.
    Dotted,
}

impl Item {
    fn new(color: Color, form: Form) -> Self {
        Self {
            name: None,
            color,
            form,
        }
    }

    /// A line through points.
    pub fn line(points: impl IntoIterator<Item = [f64; 2]>, color: Color) -> Self {
        Self::parted(points.into_iter().map(Some), color)
    }

    /// A line through points, interrupted where there is none.
    pub fn parted(points: impl IntoIterator<Item = Option<[f64; 2]>>, color: Color) -> Self {
        let form = Form::Line {
            points: points.into_iter().collect(),
            width: 1.6,
            dash: Dash::Solid,
        };
        Self::new(color, form)
    }

    /// A marker at each point.
    pub fn markers(
        points: impl IntoIterator<Item = [f64; 2]>,
        marker: Marker,
        color: Color,
    ) -> Self {
        let form = Form::Markers {
            points: points.into_iter().collect(),
            marker,
            radius: 4.0,
        };
        Self::new(color, form)
    }

    /// Straight lines between two points each.
    pub fn segments(ends: impl IntoIterator<Item = [[f64; 2]; 2]>, color: Color) -> Self {
        let ends = ends.into_iter().collect();
        Self::new(color, Form::Segments { ends, width: 1.0 })
    }

    /// Arrows from the first point to the second.
    pub fn arrows(ends: impl IntoIterator<Item = [[f64; 2]; 2]>, color: Color) -> Self {
        let ends = ends.into_iter().collect();
        Self::new(color, Form::Arrows { ends, width: 1.2 })
    }

    /// Filled disks by centre and radius, in the numbers of the axes.
    pub fn disks(disks: impl IntoIterator<Item = ([f64; 2], f64)>, color: Color) -> Self {
        let disks = disks.into_iter().collect();
        let filled = true;
        Self::new(color, Form::Disks { disks, filled })
    }

    /// The area within these corners.
    pub fn area(corners: impl IntoIterator<Item = [f64; 2]>, color: Color) -> Self {
        let corners = corners.into_iter().collect();
        Self::new(color, Form::Area { corners })
    }

    /// Words whose middle stands at a point.
    pub fn text(text: impl Into<String>, at: [f64; 2], color: Color) -> Self {
        let form = Form::Text {
            text: text.into(),
            at,
            size: 11.0,
            anchor: Anchor::Middle,
        };
        Self::new(color, form)
    }

    /// A line across the plot at this height, to compare with.
    pub fn level(value: f64, color: Color) -> Self {
        Self::new(color, Form::Level(value))
    }

    /// A line up the plot at this place, to compare with.
    pub fn moment(value: f64, color: Color) -> Self {
        Self::new(color, Form::Moment(value))
    }

    /// Short strokes on the x-axis at these places.
    pub fn rug(places: impl IntoIterator<Item = f64>, color: Color) -> Self {
        Self::new(color, Form::Rug(places.into_iter().collect()))
    }

    /// The same, with a name in the legend.
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// The same in dashes, where it is a line.
    pub fn dashed(mut self) -> Self {
        if let Form::Line { dash, .. } = &mut self.form {
            *dash = Dash::Dashed;
        }
        self
    }

    /// The same in dots, where it is a line.
    pub fn dotted(mut self) -> Self {
        if let Form::Line { dash, .. } = &mut self.form {
            *dash = Dash::Dotted;
        }
        self
    }

    /// The same of this size in pixels: the width of lines and shafts, the radius of markers, the
    /// height of letters.
    pub fn sized(mut self, pixels: f64) -> Self {
        match &mut self.form {
            Form::Line { width, .. }
            | Form::Segments { width, .. }
            | Form::Arrows { width, .. }
            | Form::Markers { radius: width, .. }
            | Form::Text { size: width, .. } => *width = pixels,
            Form::Disks { .. }
            | Form::Area { .. }
            | Form::Level(_)
            | Form::Moment(_)
            | Form::Rug(_) => {}
        }
        self
    }

    /// The same in outline, where it is disks.
    pub fn hollow(mut self) -> Self {
        if let Form::Disks { filled, .. } = &mut self.form {
            *filled = false;
        }
        self
    }

    /// Whether it is there to compare others with.
    pub(super) fn compares(&self) -> bool {
        matches!(self.form, Form::Level(_) | Form::Moment(_))
    }

    /// The points that the axes must show.
    pub(super) fn points(&self) -> Box<dyn Iterator<Item = [f64; 2]> + '_> {
        match &self.form {
            Form::Line { points, .. } => Box::new(points.iter().flatten().copied()),
            Form::Markers { points, .. } => Box::new(points.iter().copied()),
            Form::Segments { ends, .. } | Form::Arrows { ends, .. } => {
                Box::new(ends.iter().flatten().copied())
            }
            Form::Disks { disks, .. } => {
                let corners = |([x, y], r): &([f64; 2], f64)| [[x - r, y - r], [x + r, y + r]];
                Box::new(disks.iter().flat_map(corners))
            }
            Form::Area { corners } => Box::new(corners.iter().copied()),
            Form::Text { at, .. } => Box::new(std::iter::once(*at)),
            Form::Level(_) | Form::Moment(_) | Form::Rug(_) => Box::new(std::iter::empty()),
        }
    }
}
