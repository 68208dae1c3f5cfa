//! Markers: signs of one size that stand at points.

use crate::picture::{Color, Mark, Paint, Path, Stroke};

/// A sign that stands at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A filled circle.
    Disk,
    /// A circle.
    Ring,
    /// A filled star of five points.
    Star,
    /// An upright cross, +.
    Plus,
    /// A slanted cross, ×.
    Cross,
    /// A filled square.
    Square,
    /// A filled triangle that points upwards.
    Triangle,
}

impl Marker {
    /// The marker within a circle of this centre and radius, in pixels.
    pub(super) fn mark(self, [x, y]: [f64; 2], radius: f64, color: Color) -> Mark {
        let corner = |turn: f64, share: f64| {
            let (sin, cos) = libm::sincos(turn * std::f64::consts::TAU);
            [x + share * radius * sin, y - share * radius * cos]
        };
        let filled = |path: Path| Mark::Path {
            path,
            fill: Some(Paint::Flat(color)),
            stroke: None,
        };
        let regular = |count: usize, first: f64| {
            let turns = (0..count).map(move |k| first + k as f64 / count as f64);
            Path::polygon(turns.map(|turn| corner(turn, 1.0)))
        };
        let stroke = Stroke::new(color, (0.35 * radius).max(1.0));
        match self {
            Self::Disk => Mark::Disk {
                center: [x, y],
                radius,
                fill: Some(Paint::Flat(color)),
                stroke: None,
            },
            Self::Ring => Mark::Disk {
                center: [x, y],
                radius: radius - 0.5 * stroke.width,
                fill: None,
                stroke: Some(stroke),
            },
            Self::Star => filled(Path::polygon((0..10).map(|k| {
                // The inner corners of a pentagram.
                let share = if k % 2 == 0 { 1.0 } else { 0.382 };
                corner(0.1 * f64::from(k), share)
            }))),
            Self::Plus | Self::Cross => {
                let first = if self == Self::Plus { 0.0 } else { 0.125 };
                let mut path = Path::default();
                for turn in [first, first + 0.25] {
                    path.begin(corner(turn, 1.0));
                    path.line(corner(turn + 0.5, 1.0));
                }
                Mark::Path {
                    path,
                    fill: None,
                    stroke: Some(stroke),
                }
            }
            Self::Square => filled(regular(4, 0.125)),
            Self::Triangle => filled(regular(3, 0.0)),
        }
    }
}
