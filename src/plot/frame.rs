//! Painting what is around the items of a plot: grid, ticks, words, legend.

use super::axes::Ruler;
use super::layout::{LABEL, LINE, PAD, Panel, STROKE, TICK, TITLE};
use super::legend::SAMPLE;
use super::paint::Canvas;
use crate::picture::{Anchor, Label, Mark, Paint, Path, Stroke, Theme, text};

/// How far lines may reach over the ends of the axes, so that half of them is not cut off.
const BLEED: f64 = 2.0;

/// How far below the middle of a line of letters its base line is, as a share of their size.
const MIDDLE: f64 = 0.36;

/// The marks of a panel, from the upper left corner of its page.
pub(super) fn paint(panel: &Panel, theme: &Theme) -> Vec<Mark> {
    let corner = [panel.margins.left, panel.margins.top];
    let area = panel.area();
    let axes = &panel.axes;
    let mut marks = grid(panel, theme);
    let inside = Canvas {
        axes,
        origin: [BLEED; 2],
        area,
    };
    let mut clipped = Vec::new();
    let (below, above): (Vec<_>, Vec<_>) = panel.plot.items.iter().partition(|it| it.compares());
    for item in below.into_iter().chain(above) {
        inside.paint(item, &mut clipped);
    }
    marks.push(Mark::Group {
        corner: corner.map(|it| it - BLEED),
        size: area.map(|it| it + 2.0 * BLEED),
        background: None,
        marks: clipped,
    });
    let outside = Canvas {
        origin: corner,
        ..inside
    };
    for item in &panel.plot.items {
        outside.write(item, &mut marks);
    }
    words(panel, theme, &mut marks);
    legend(panel, theme, &mut marks);
    marks
}

/// Lines of the grid, the frame about the area, and ticks.
fn grid(panel: &Panel, theme: &Theme) -> Vec<Mark> {
    let [left, top] = [panel.margins.left, panel.margins.top];
    let [width, height] = panel.area();
    let bottom = top + height;
    let (mut lines, mut ticks) = (Path::default(), Path::default());
    let segment = |path: &mut Path, from: [f64; 2], to: [f64; 2]| {
        path.begin(from);
        path.line(to);
    };
    for x in places(&panel.axes.x) {
        segment(&mut lines, [left + x, top], [left + x, bottom]);
        segment(&mut ticks, [left + x, bottom], [left + x, bottom + STROKE]);
    }
    for y in places(&panel.axes.y) {
        segment(&mut lines, [left, top + y], [left + width, top + y]);
        segment(&mut ticks, [left, top + y], [left - STROKE, top + y]);
    }
    for x in &panel.axes.x.minor {
        let end = bottom + 0.5 * STROKE;
        segment(&mut ticks, [left + x, bottom], [left + x, end]);
    }
    for y in &panel.axes.y.minor {
        let end = left - 0.5 * STROKE;
        segment(&mut ticks, [left, top + y], [end, top + y]);
    }
    let mut frame = Path::rectangle([left, top], [width, height]);
    frame.segments.extend(ticks.segments);
    [(lines, theme.grid), (frame, theme.faint)]
        .map(|(path, color)| Mark::Path {
            path,
            fill: None,
            stroke: Some(Stroke::new(color, 1.0)),
        })
        .into()
}

fn places(ruler: &Ruler) -> impl Iterator<Item = f64> {
    ruler.ticks.iter().map(|(at, _)| *at)
}

/// What ticks, axes and plot are called.
fn words(panel: &Panel, theme: &Theme, marks: &mut Vec<Mark>) {
    let [left, top] = [panel.margins.left, panel.margins.top];
    let [width, height] = panel.area();
    let mut say = |text: &str, at: [f64; 2], size: f64, anchor: Anchor| {
        let label = Label::new(text, at, size, theme.ink).anchor(anchor);
        marks.push(Mark::Label(label));
    };
    let below = top + height + STROKE + TICK * LINE;
    if !panel.frame.shares_x {
        for (x, text) in &panel.axes.x.ticks {
            let at = [left + x, below - 0.2 * TICK];
            say(&minus(text), at, TICK, Anchor::Middle);
        }
    }
    for (y, text) in &panel.axes.y.ticks {
        let at = [left - 2.0 * STROKE, top + y + MIDDLE * TICK];
        say(&minus(text), at, TICK, Anchor::End);
    }
    for (k, line) in panel.x_label.iter().enumerate() {
        let y = below + (k as f64 + 1.0) * LABEL * LINE;
        say(line, [left + 0.5 * width, y], LABEL, Anchor::Middle);
    }
    let upwards = panel.y_label.iter().enumerate().map(|(k, line)| {
        let x = 0.5 * PAD + (k as f64 + 0.8) * LABEL * LINE;
        let half = 0.5 * text::width(line, LABEL, false).max(height);
        let label = Label::new(line, [x, top + height - half], LABEL, theme.ink);
        Mark::Label(label.anchor(Anchor::Middle).upwards())
    });
    marks.extend(upwards);
    let first = top - 0.5 * PAD - (panel.title.len() as f64 - 1.0) * TITLE * LINE;
    for (k, line) in panel.title.iter().enumerate() {
        let at = [left, first + k as f64 * TITLE * LINE - 0.2 * TITLE];
        let label = Label::new(line, at, TITLE, theme.ink).bold();
        marks.push(Mark::Label(label));
    }
}

/// Numbers with the sign that is as wide as a plus.
fn minus(number: &str) -> String {
    number.replace('-', "−")
}

fn legend(panel: &Panel, theme: &Theme, marks: &mut Vec<Mark>) {
    let origin = match panel.legend.card {
        Some((corner, size)) => {
            let corner = [
                corner[0] + panel.margins.left,
                corner[1] + panel.margins.top,
            ];
            marks.push(Mark::Path {
                path: Path::rectangle(corner, size),
                fill: Some(Paint::Flat(theme.page.opacity(0.85))),
                stroke: Some(Stroke::new(theme.grid, 1.0)),
            });
            corner
        }
        None => [PAD, panel.frame.size[1] - panel.legend.height - 0.5 * PAD],
    };
    for row in &panel.legend.rows {
        let [x, y] = [origin[0] + row.at[0], origin[1] + row.at[1]];
        if let Some(sample) = &row.sample {
            Canvas::sample(sample, [x, y], SAMPLE, marks);
        }
        let indent = if row.sample.is_some() {
            SAMPLE + 0.75 * PAD
        } else {
            0.0
        };
        for (k, line) in row.lines.iter().enumerate() {
            let at = [x + indent, y + MIDDLE * LABEL + k as f64 * LABEL * LINE];
            marks.push(Mark::Label(Label::new(line, at, LABEL, theme.ink)));
        }
    }
}
