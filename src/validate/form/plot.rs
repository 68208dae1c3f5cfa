//! Plots: quantities along runs against their bounds, as SVG.
//!
//! Colours and strokes come from the classes of the page's style.

use std::fmt::Write;

use super::markup::escape;
use super::words::{dynamics, number};
use crate::claim::Side;
use crate::plot::{Kind, Scale, thin};
use crate::world::spec::DynamicsName;

/// Size of the picture, and the edges of the plot in it.
const SIZE: [f64; 2] = [640.0, 260.0];
const LEFT: f64 = 70.0;
const RIGHT: f64 = 624.0;
const TOP: f64 = 42.0;
const BOTTOM: f64 = 222.0;

/// Bounds that are no further apart on paper are drawn once.
const SAME: f64 = 0.75;

/// A quantity over time, on one or more runs.
#[derive(Debug)]
pub(super) struct Plot<'a> {
    /// What tells it from all others in the document.
    pub(super) id: String,
    /// What is plotted.
    pub(super) name: &'a str,
    /// One line for each run.
    pub(super) lines: Vec<Line<'a>>,
    /// A value to compare with, and what it is.
    pub(super) level: Option<(f64, &'static str)>,
    /// A time at which something happened, and what it was.
    pub(super) moment: Option<(f64, &'static str)>,
    /// Whether the axis must be logarithmic; else the data choose.
    pub(super) logarithmic: bool,
}

/// A quantity along one run.
#[derive(Debug)]
pub(super) struct Line<'a> {
    pub(super) dynamics: DynamicsName,
    pub(super) times: &'a [f64],
    pub(super) values: Vec<Option<f64>>,
    /// The bound at each time; empty where there is none.
    pub(super) bounds: &'a [Option<f64>],
    /// The side of the bound to stay on.
    pub(super) side: Side,
    /// The time of the closest approach to the bound.
    pub(super) closest: Option<f64>,
}

/// Parts of a line without holes, in pixels.
type Parts = Vec<Vec<[f64; 2]>>;

impl Line<'_> {
    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        finite(self.times, &self.values)
    }

    fn bounds(&self) -> impl Iterator<Item = (f64, f64)> {
        finite(self.times, self.bounds)
    }
}

fn finite(times: &[f64], values: &[Option<f64>]) -> impl Iterator<Item = (f64, f64)> {
    let points = times.iter().zip(values);
    let points = points.filter_map(|(time, value)| Some((*time, (*value)?)));
    points.filter(|(time, value)| time.is_finite() && value.is_finite())
}

/// Where times and values stand in the picture.
struct Axes {
    time: Scale,
    value: Scale,
}

impl Axes {
    /// Nothing where there are fewer than two times with a value.
    fn of(plot: &Plot) -> Option<Self> {
        let times = || {
            plot.lines
                .iter()
                .flat_map(Line::points)
                .map(|(time, _)| time)
        };
        let (first, last) = (times().reduce(f64::min)?, times().reduce(f64::max)?);
        if first >= last {
            return None;
        }
        let values: Vec<f64> = plot
            .lines
            .iter()
            .flat_map(Line::points)
            .map(|(_, value)| value)
            .collect();
        let bounds = plot.lines.iter().flat_map(Line::bounds);
        let bounds = bounds.map(|(_, value)| value);
        let levels: Vec<f64> = bounds.chain(plot.level.map(|(level, _)| level)).collect();
        let kind = match plot.logarithmic {
            true => Kind::Logarithmic,
            false => Kind::Auto,
        };
        let value = Scale::of(&values, &levels, kind, [BOTTOM, TOP])?;
        let time = Scale::tight(first, last, [LEFT, RIGHT]);
        Some(Self { time, value })
    }

    fn at(&self, time: f64, value: f64) -> Option<[f64; 2]> {
        Some([self.time.at(time)?, self.value.at(value)?])
    }

    /// A line, parted where it has no value, or none that the axis can show.
    fn parts(&self, times: &[f64], values: &[Option<f64>]) -> Parts {
        let mut parts = vec![Vec::new()];
        for (time, value) in times.iter().zip(values) {
            let place = value.and_then(|value| self.at(*time, value));
            match (place, parts.last_mut()) {
                (Some(place), Some(part)) => part.push(place),
                (None, Some(part)) if !part.is_empty() => parts.push(Vec::new()),
                _ => {}
            }
        }
        parts.retain(|part| !part.is_empty());
        parts
    }
}

/// The plot as SVG; nothing where there is nothing to show.
pub(super) fn svg(plot: &Plot) -> Option<String> {
    let axes = Axes::of(plot)?;
    let [width, height] = SIZE;
    let id = escape(&plot.id);
    let mut out = format!(
        "<svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-labelledby=\"{id}-t {id}-d\">\n\
         <title id=\"{id}-t\">{}</title>\n<desc id=\"{id}-d\">{}</desc>\n",
        escape(plot.name),
        escape(&describe(plot, &axes))
    );
    let bounds = bounds(plot, &axes);
    for (line, parts) in &bounds {
        out += &forbidden(line.side, parts);
    }
    out += &grid(&axes);
    let own_colours = bounds.len() > 1;
    for (line, parts) in &bounds {
        let class = match own_colours {
            true => format!("bound {}", dynamics(line.dynamics)),
            false => "bound".to_owned(),
        };
        out += &polylines(&class, parts);
    }
    for line in &plot.lines {
        let parts = axes.parts(line.times, &line.values);
        out += &polylines(&format!("line {}", dynamics(line.dynamics)), &parts);
    }
    if let Some((level, what)) = plot.level
        && let Some(y) = axes.value.at(level)
    {
        let text = format!("{what} {}", number(level));
        out += &horizontal(y, &text);
    }
    for line in &plot.lines {
        out += &closest(line, &axes).unwrap_or_default();
    }
    if let Some((time, what)) = plot.moment
        && let Some(x) = axes.time.at(time)
    {
        out += &vertical(x, what);
    }
    out += &legend(plot, &bounds);
    out += "</svg>\n";
    Some(out)
}

/// The bounds to draw: one of those that are the same.
fn bounds<'a>(plot: &'a Plot<'a>, axes: &Axes) -> Vec<(&'a Line<'a>, Parts)> {
    let mut bounds: Vec<(&Line, Parts)> = Vec::new();
    // The longest first: a shorter one may be a part of it.
    let mut lines: Vec<&Line> = plot.lines.iter().collect();
    lines.sort_by_key(|line| std::cmp::Reverse(line.bounds().count()));
    for line in lines.into_iter().filter(|it| it.bounds().next().is_some()) {
        let same = |(drawn, _): &(&Line, Parts)| {
            let drawn_bounds: Vec<_> = drawn.bounds().collect();
            let near = |(time, value)| {
                let drawn = axes.value.at(between(&drawn_bounds, time)?)?;
                Some((drawn - axes.value.at(value)?).abs() <= SAME)
            };
            drawn.side == line.side && line.bounds().all(|it| near(it) == Some(true))
        };
        if !bounds.iter().any(same) {
            bounds.push((line, axes.parts(line.times, line.bounds)));
        }
    }
    bounds
}

/// The value at a time on the straight lines between some points; nothing outside of them.
fn between(points: &[(f64, f64)], time: f64) -> Option<f64> {
    let right = points.partition_point(|point| point.0 < time);
    let (t1, after) = *points.get(right)?;
    let (t0, before) = match right {
        0 if t1 > time => return None,
        0 => (t1, after),
        _ => points[right - 1],
    };
    match t1 > t0 {
        true => Some(before + (after - before) * (time - t0) / (t1 - t0)),
        false => Some(after),
    }
}

/// The side of a bound where the quantity must not be.
fn forbidden(side: Side, parts: &Parts) -> String {
    let edge = match side {
        Side::Below => TOP,
        Side::Above => BOTTOM,
    };
    let mut out = String::new();
    for part in parts {
        if let (Some(first), Some(last)) = (part.first(), part.last()) {
            let mut area = thin(part);
            area.extend([[last[0], edge], [first[0], edge]]);
            let points = coordinates(&area);
            let _ = writeln!(out, "<polygon class=\"forbidden\" points=\"{points}\"/>");
        }
    }
    out
}

fn polylines(class: &str, parts: &Parts) -> String {
    let mut out = String::new();
    for part in parts {
        let _ = match part.as_slice() {
            [[x, y]] => writeln!(
                out,
                "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"1\"/>"
            ),
            _ => writeln!(
                out,
                "<polyline class=\"{class}\" points=\"{}\"/>",
                coordinates(&thin(part))
            ),
        };
    }
    out
}

/// The points in the letters of SVG.
fn coordinates(points: &[[f64; 2]]) -> String {
    let points = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}"));
    points.collect::<Vec<_>>().join(" ")
}

fn text(class: &str, x: f64, y: f64, text: &str) -> String {
    format!(
        "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>\n",
        escape(text)
    )
}

fn segment(class: &str, from: (f64, f64), to: (f64, f64)) -> String {
    format!(
        "<line class=\"{class}\" x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\"/>\n",
        from.0, from.1, to.0, to.1
    )
}

/// Frame, ticks and what they say.
fn grid(axes: &Axes) -> String {
    let mut out = String::new();
    for (y, label) in axes.value.ticks() {
        out += &segment("grid", (LEFT, y), (RIGHT, y));
        out += &text("end", LEFT - 6.0, y + 4.0, &label);
    }
    for (x, label) in axes.time.ticks() {
        out += &segment("axis", (x, BOTTOM), (x, BOTTOM + 4.0));
        out += &text("middle", x, BOTTOM + 17.0, &label);
    }
    out += &segment("axis", (LEFT, BOTTOM), (RIGHT, BOTTOM));
    out += &segment("axis", (LEFT, TOP), (LEFT, BOTTOM));
    out + &text("middle", 0.5 * (LEFT + RIGHT), SIZE[1] - 5.0, "time")
}

/// A value to compare with, its label on the side of the line that has room.
fn horizontal(y: f64, label: &str) -> String {
    let place = if y - TOP > 18.0 { y - 5.0 } else { y + 14.0 };
    segment("level", (LEFT, y), (RIGHT, y)) + &text("end level", RIGHT - 4.0, place, label)
}

/// A moment, its label above the plot, on the side of the line that has room.
fn vertical(x: f64, label: &str) -> String {
    let class = match x < 0.5 * (LEFT + RIGHT) {
        true => "moment",
        false => "end moment",
    };
    segment("moment", (x, TOP), (x, BOTTOM)) + &text(class, x, TOP - 6.0, label)
}

/// A ring about the point where a line comes closest to its bound.
fn closest(line: &Line, axes: &Axes) -> Option<String> {
    let time = line.closest?;
    let (time, value) = line
        .points()
        .min_by(|a, b| (a.0 - time).abs().total_cmp(&(b.0 - time).abs()))?;
    let [x, y] = axes.at(time, value)?;
    let class = dynamics(line.dynamics);
    Some(format!(
        "<circle class=\"closest {class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\"/>\n"
    ))
}

/// What the lines are, above the plot.
fn legend(plot: &Plot, bounds: &[(&Line, Parts)]) -> String {
    const SAMPLE: f64 = 20.0;
    let (mut x, y) = (LEFT, 12.0);
    let mut out = String::new();
    let mut entry = |class: &str, label: &str| {
        out += &match class {
            "closest" => format!(
                "<circle class=\"closest\" cx=\"{:.1}\" cy=\"{y}\" r=\"4.5\"/>\n",
                x + 0.5 * SAMPLE
            ),
            _ => segment(class, (x, y), (x + SAMPLE, y)),
        };
        out += &text("label", x + SAMPLE + 5.0, y + 4.0, label);
        // The width of letters is not known here; 6.5 pixels are enough for most.
        x += SAMPLE + 20.0 + 6.5 * label.chars().count() as f64;
    };
    for line in &plot.lines {
        let name = dynamics(line.dynamics);
        entry(&format!("line {name}"), name);
    }
    for (line, _) in bounds {
        let name = dynamics(line.dynamics);
        match bounds.len() {
            1 => entry("bound", "bound"),
            _ => entry(&format!("bound {name}"), &format!("bound, {name}")),
        }
    }
    if plot.lines.iter().any(|line| line.closest.is_some()) {
        entry("closest", "closest approach");
    }
    out
}

/// The plot in words.
fn describe(plot: &Plot, axes: &Axes) -> String {
    let mut out = match axes.value.is_logarithmic() {
        true => "On a logarithmic axis. ".to_owned(),
        false => String::new(),
    };
    for line in &plot.lines {
        let (Some((start, first)), Some((end, last))) =
            (line.points().next(), line.points().last())
        else {
            continue;
        };
        let values = || line.points().map(|(_, value)| value);
        let least = values().fold(f64::INFINITY, f64::min);
        let most = values().fold(f64::NEG_INFINITY, f64::max);
        let _ = write!(
            out,
            "As {}: {} at time {}, {} at time {}, between {} and {}.",
            dynamics(line.dynamics),
            number(first),
            number(start),
            number(last),
            number(end),
            number(least),
            number(most)
        );
        let ends = line.bounds().next().zip(line.bounds().last());
        if let Some(((_, first), (_, last))) = ends {
            let side = match line.side {
                Side::Below => "at most",
                Side::Above => "at least",
            };
            let bound = match first == last {
                true => number(first),
                false => format!(
                    "{} at the start, {} at the end",
                    number(first),
                    number(last)
                ),
            };
            let _ = write!(out, " It must be {side} its bound, {bound}.");
        }
        out.push(' ');
    }
    if let Some((level, what)) = plot.level {
        let _ = write!(out, "For comparison, {what}: {}. ", number(level));
    }
    if let Some((time, what)) = plot.moment {
        let _ = write!(out, "At time {}: {what}. ", number(time));
    }
    out.truncate(out.trim_end().len());
    out
}
