//! What of a mark can be drawn: the same for SVG and for pixels.

use super::{Color, Label, Mark, Paint, Path, Segment, Stroke};

/// Coordinates are cut off this many pixels from the origin: far beyond every page, and near
/// enough that neither `f32` nor a viewer of SVG loses its way.
const FAR: f64 = 1e6;

/// A coordinate, cut off where it is far away.
pub(super) fn near(x: f64) -> f64 {
    x.clamp(-FAR, FAR)
}

/// A share from 0 to 1; 0 for what is no number.
pub(super) fn share(x: f64) -> f64 {
    if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) }
}

impl Color {
    /// Whether it leaves a trace.
    pub(super) fn seen(self) -> bool {
        share(self.opacity) > 0.0
    }
}

impl Paint {
    /// Whether it leaves a trace.
    pub(super) fn seen(&self) -> bool {
        match self {
            Self::Flat(color) => color.seen(),
            Self::Radial {
                center,
                radius,
                inner,
                outer,
            } => {
                finite(center)
                    && *radius > 0.0
                    && radius.is_finite()
                    && (inner.seen() || outer.seen())
            }
        }
    }
}

impl Stroke {
    /// Whether it leaves a trace.
    pub(super) fn seen(&self) -> bool {
        self.color.seen() && self.width > 0.0 && self.width.is_finite()
    }

    /// Dashes and gaps, as many of the one as of the other; none for a line without gaps.
    pub(super) fn pattern(&self) -> Vec<f64> {
        let sound = self.dashes.iter().all(|x| x.is_finite() && *x >= 0.0);
        if !sound || self.dashes.iter().sum::<f64>() <= 0.0 {
            return Vec::new();
        }
        match self.dashes.len() % 2 {
            0 => self.dashes.clone(),
            _ => self.dashes.repeat(2),
        }
    }
}

/// What of a mark's fill and stroke can be seen.
pub(super) fn seen<'a>(
    fill: &'a Option<Paint>,
    stroke: &'a Option<Stroke>,
) -> (Option<&'a Paint>, Option<&'a Stroke>) {
    (
        fill.as_ref().filter(|paint| paint.seen()),
        stroke.as_ref().filter(|stroke| stroke.seen()),
    )
}

impl Mark {
    /// Whether it can be drawn and leaves a trace. A mark with a coordinate that is no number
    /// is nowhere, so it does not.
    pub(super) fn drawable(&self) -> bool {
        let any = |fill, stroke| {
            let (fill, stroke) = seen(fill, stroke);
            fill.is_some() || stroke.is_some()
        };
        match self {
            Self::Path { path, fill, stroke } => path.drawable() && any(fill, stroke),
            Self::Disk {
                center,
                radius,
                fill,
                stroke,
            } => finite(center) && *radius > 0.0 && radius.is_finite() && any(fill, stroke),
            Self::Label(label) => label.drawable(),
            Self::Group { corner, size, .. } => {
                finite(corner) && finite(size) && size.iter().all(|side| *side > 0.0)
            }
        }
    }
}

impl Path {
    fn drawable(&self) -> bool {
        let mut segments = self.segments.iter();
        matches!(self.segments.first(), Some(Segment::Move(_)))
            && segments.all(|segment| match segment {
                Segment::Move(point) | Segment::Line(point) => finite(point),
                Segment::Cubic(first, second, end) => {
                    finite(first) && finite(second) && finite(end)
                }
                Segment::Close => true,
            })
    }
}

impl Label {
    fn drawable(&self) -> bool {
        finite(&self.at)
            && self.size > 0.0
            && self.size.is_finite()
            && self.color.seen()
            && !self.text.trim().is_empty()
    }
}

fn finite(numbers: &[f64]) -> bool {
    numbers.iter().all(|x| x.is_finite())
}
