//! Painting the items of a plot.

use super::axes::Axes;
use super::{Dash, Form, Item, Plot, thin};
use crate::picture::{Color, Label, Mark, Paint, Path, Stroke, text};

/// Width of the lines that compare, and how they are broken.
const LEVEL: f64 = 1.2;

/// Height of the strokes that stand on the x-axis.
const RUG: f64 = 7.0;

/// Width and length of an arrow's head, as multiples of the width of its shaft and of pixels.
const HEAD: [f64; 2] = [3.0, 4.0];

/// Where the items of a plot are painted: the area of its axes, from `origin` on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Canvas<'a> {
    pub(super) axes: &'a Axes,
    pub(super) origin: [f64; 2],
    pub(super) area: [f64; 2],
}

impl Canvas<'_> {
    fn at(&self, point: [f64; 2]) -> Option<[f64; 2]> {
        self.axes.at(point).map(|it| self.moved(it))
    }

    fn moved(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x + self.origin[0], y + self.origin[1]]
    }

    /// The parts of a line between its gaps.
    fn parts(&self, points: &[Option<[f64; 2]>]) -> Vec<Vec<[f64; 2]>> {
        let mut parts = vec![Vec::new()];
        for point in points {
            match (point.and_then(|it| self.at(it)), parts.last_mut()) {
                (Some(place), Some(part)) => part.push(place),
                (None, Some(part)) if !part.is_empty() => parts.push(Vec::new()),
                _ => {}
            }
        }
        parts.retain(|part| !part.is_empty());
        parts
    }

    /// Straight lines whose ends both have places.
    fn both<'a>(&'a self, ends: &'a [[[f64; 2]; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> + 'a {
        let both = ends
            .iter()
            .map(|[from, to]| Some([self.at(*from)?, self.at(*to)?]));
        both.flatten()
    }

    /// The half axes of a disk of a radius about a centre.
    fn radii(&self, center: [f64; 2], radius: f64) -> Option<[f64; 2]> {
        let [x, y] = self.at(center)?;
        let [right, top] = self.at([center[0] + radius, center[1] + radius])?;
        Some([(right - x).abs(), (top - y).abs()])
    }

    /// A line across the area at a height on the y-axis.
    fn level(&self, value: f64) -> Option<[[f64; 2]; 2]> {
        let y = self.axes.y.scale.beyond(value)?;
        Some([self.moved([0.0, y]), self.moved([self.area[0], y])])
    }

    /// A line up the area at a place on the x-axis.
    fn moment(&self, value: f64) -> Option<[[f64; 2]; 2]> {
        let x = self.axes.x.scale.beyond(value)?;
        Some([self.moved([x, self.area[1]]), self.moved([x, 0.0])])
    }

    /// Paints an item.
    pub(super) fn paint(&self, item: &Item, marks: &mut Vec<Mark>) {
        let color = item.color;
        match &item.form {
            Form::Line {
                points,
                width,
                dash,
            } => {
                for part in self.parts(points) {
                    marks.push(match part.as_slice() {
                        [alone] => disk(*alone, *width, color),
                        _ => line(Path::polyline(thin(&part)), dash.stroke(color, *width)),
                    });
                }
            }
            Form::Markers {
                points,
                marker,
                radius,
            } => {
                let places = points.iter().filter_map(|it| self.at(*it));
                marks.extend(places.map(|it| marker.mark(it, *radius, color)));
            }
            Form::Segments { ends, width } => {
                let mut path = Path::default();
                for [from, to] in self.both(ends) {
                    path.begin(from);
                    path.line(to);
                }
                marks.push(line(path, Stroke::new(color, *width)));
            }
            Form::Arrows { ends, width } => {
                let mut heads = Path::default();
                let mut shafts = Path::default();
                for [from, to] in self.both(ends) {
                    arrow(from, to, *width, &mut shafts, &mut heads);
                }
                marks.push(line(shafts, Stroke::new(color, *width)));
                marks.push(filled(heads, color));
            }
            Form::Disks { disks, filled } => {
                for (center, radius) in disks {
                    let radii = self.radii(*center, *radius);
                    if let (Some(at), Some(radii)) = (self.at(*center), radii) {
                        marks.push(ellipse(at, radii, color, *filled));
                    }
                }
            }
            Form::Area { corners } => {
                let places = corners.iter().filter_map(|it| self.at(*it));
                marks.push(filled(Path::polygon(places), color));
            }
            Form::Text { .. } => {}
            Form::Level(value) => {
                let ends = self.level(*value);
                marks.extend(ends.map(|it| line(Path::polyline(it), compare(color))));
            }
            Form::Moment(value) => {
                let ends = self.moment(*value);
                marks.extend(ends.map(|it| line(Path::polyline(it), compare(color))));
            }
            Form::Rug(places) => {
                let mut path = Path::default();
                for [foot, _] in places.iter().filter_map(|it| self.moment(*it)) {
                    path.begin(foot);
                    path.line([foot[0], foot[1] - RUG]);
                }
                marks.push(line(path, Stroke::new(color, 1.0)));
            }
        }
    }

    /// Writes an item of words, which may reach beyond the axes.
    pub(super) fn write(&self, item: &Item, marks: &mut Vec<Mark>) {
        if let Form::Text {
            text,
            at,
            size,
            anchor,
        } = &item.form
            && self.axes.holds(*at)
            && let Some([x, y]) = self.at(*at)
        {
            let label = Label::new(text, [x, y + 0.36 * size], *size, item.color);
            marks.push(Mark::Label(label.anchor(*anchor)));
        }
    }

    /// The sample of an item in a legend, from the point `[x, y]` to the right.
    pub(super) fn sample(item: &Item, [x, y]: [f64; 2], length: f64, marks: &mut Vec<Mark>) {
        let color = item.color;
        let middle = [x + 0.5 * length, y];
        let across = || Path::polyline([[x, y], [x + length, y]]);
        match &item.form {
            Form::Line { width, dash, .. } => {
                marks.push(line(across(), dash.stroke(color, width.max(1.2))));
            }
            Form::Markers { marker, radius, .. } => {
                marks.push(marker.mark(middle, radius.min(6.0), color));
            }
            Form::Segments { width, .. } => {
                marks.push(line(across(), Stroke::new(color, width.max(1.0))));
            }
            Form::Arrows { width, .. } => {
                let (mut shaft, mut head) = (Path::default(), Path::default());
                arrow([x, y], [x + length, y], *width, &mut shaft, &mut head);
                marks.push(line(shaft, Stroke::new(color, *width)));
                marks.push(filled(head, color));
            }
            Form::Disks { filled, .. } => marks.push(ellipse(middle, [5.0; 2], color, *filled)),
            Form::Area { .. } => {
                let corner = [x + 0.15 * length, y - 5.0];
                marks.push(filled(Path::rectangle(corner, [0.7 * length, 10.0]), color));
            }
            Form::Text { .. } => {}
            Form::Level(_) => marks.push(line(across(), compare(color))),
            Form::Moment(_) => {
                let up = Path::polyline([[middle[0], y + 7.0], [middle[0], y - 7.0]]);
                marks.push(line(up, compare(color)));
            }
            Form::Rug(_) => {
                let up = Path::polyline([[middle[0], y + 0.5 * RUG], [middle[0], y - 0.5 * RUG]]);
                marks.push(line(up, Stroke::new(color, 1.0)));
            }
        }
    }

    /// Straight lines that run where an item is painted, for what must not hide it.
    fn traces(&self, item: &Item, lines: &mut Vec<[[f64; 2]; 2]>) {
        let mut boxed = |[x, y]: [f64; 2], [half, high]: [f64; 2]| {
            let (a, b) = ([x - half, y - high], [x + half, y + high]);
            let (c, d) = ([x - half, y + high], [x + half, y - high]);
            lines.extend([[a, c], [c, b], [b, d], [d, a], [a, b]]);
        };
        match &item.form {
            Form::Line { points, .. } => {
                for part in self.parts(points) {
                    let part = thin(&part);
                    lines.extend(part.windows(2).map(|two| [two[0], two[1]]));
                    lines.extend(part.first().map(|it| [*it, *it]));
                }
            }
            Form::Markers { points, radius, .. } => {
                let places = points.iter().filter_map(|it| self.at(*it));
                places.for_each(|it| boxed(it, [*radius; 2]));
            }
            Form::Segments { ends, .. } | Form::Arrows { ends, .. } => {
                lines.extend(self.both(ends));
            }
            Form::Disks { disks, .. } => {
                for (center, radius) in disks {
                    if let (Some(at), Some(radii)) =
                        (self.at(*center), self.radii(*center, *radius))
                    {
                        boxed(at, radii);
                    }
                }
            }
            Form::Area { corners } => {
                let places: Vec<_> = corners.iter().filter_map(|it| self.at(*it)).collect();
                lines.extend(places.windows(2).map(|two| [two[0], two[1]]));
            }
            Form::Text { text, at, size, .. } => {
                let half = text::width(text, *size, false);
                if let Some(at) = self.at(*at) {
                    boxed(at, [half, 0.5 * size]);
                }
            }
            Form::Level(value) => lines.extend(self.level(*value)),
            Form::Moment(value) => lines.extend(self.moment(*value)),
            Form::Rug(places) => {
                let feet = places.iter().filter_map(|it| self.moment(*it));
                lines.extend(feet.map(|[foot, _]| [foot, [foot[0], foot[1] - RUG]]));
            }
        }
    }
}

/// Straight lines that run where the items of a plot are painted.
pub(super) fn traces(plot: &Plot, axes: &Axes, area: [f64; 2]) -> Vec<[[f64; 2]; 2]> {
    let origin = [0.0; 2];
    let canvas = Canvas { axes, origin, area };
    let mut lines = Vec::new();
    for item in &plot.items {
        canvas.traces(item, &mut lines);
    }
    lines
}

impl Dash {
    fn stroke(self, color: Color, width: f64) -> Stroke {
        match self {
            Self::Solid => Stroke::new(color, width),
            Self::Dashed => Stroke::dashed(color, width, 4.0 * width, 3.0 * width),
            Self::Dotted => Stroke::dashed(color, width, 0.1, 2.2 * width),
        }
    }
}

fn compare(color: Color) -> Stroke {
    Stroke::dashed(color, LEVEL, 3.0, 4.0)
}

fn line(path: Path, stroke: Stroke) -> Mark {
    Mark::Path {
        path,
        fill: None,
        stroke: Some(stroke),
    }
}

fn filled(path: Path, color: Color) -> Mark {
    Mark::Path {
        path,
        fill: Some(Paint::Flat(color)),
        stroke: None,
    }
}

fn disk(center: [f64; 2], radius: f64, color: Color) -> Mark {
    Mark::Disk {
        center,
        radius,
        fill: Some(Paint::Flat(color)),
        stroke: None,
    }
}

/// A disk or its circle where both half axes are the same, else an ellipse of four Bézier curves.
fn ellipse([x, y]: [f64; 2], [a, b]: [f64; 2], color: Color, filled: bool) -> Mark {
    let fill = filled.then_some(Paint::Flat(color));
    let stroke = (!filled).then(|| Stroke::new(color, 1.2));
    if (a - b).abs() < 0.01 {
        return Mark::Disk {
            center: [x, y],
            radius: a,
            fill,
            stroke,
        };
    }
    // The control points of the cubic nearest to a quarter of a circle.
    let (c, d) = (0.552_284_75 * a, 0.552_284_75 * b);
    let mut path = Path::default();
    path.begin([x + a, y]);
    path.cubic([x + a, y + d], [x + c, y + b], [x, y + b]);
    path.cubic([x - c, y + b], [x - a, y + d], [x - a, y]);
    path.cubic([x - a, y - d], [x - c, y - b], [x, y - b]);
    path.cubic([x + c, y - b], [x + a, y - d], [x + a, y]);
    path.close();
    Mark::Path { path, fill, stroke }
}

/// Adds an arrow to shafts and heads; a short one has a head as long as itself.
fn arrow(from: [f64; 2], to: [f64; 2], width: f64, shafts: &mut Path, heads: &mut Path) {
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = way[0].hypot(way[1]);
    if length < 1e-3 {
        return;
    }
    let [x, y] = way.map(|it| it / length);
    let head = (HEAD[0] * width + HEAD[1]).min(length);
    let half = 0.38 * head;
    let neck = [to[0] - head * x, to[1] - head * y];
    shafts.begin(from);
    shafts.line(neck);
    heads.begin(to);
    heads.line([neck[0] - half * y, neck[1] + half * x]);
    heads.line([neck[0] + half * y, neck[1] - half * x]);
    heads.close();
}
