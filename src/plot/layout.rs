//! Where the parts of a plot stand.

use super::axes::Axes;
use super::legend::{Entry, Legend};
use super::words::wrap;
use super::{Plot, paint};
use crate::picture::text;

/// Height of the letters of titles, of labels and legends, of ticks.
pub(super) const TITLE: f64 = 13.0;
pub(super) const LABEL: f64 = 12.0;
pub(super) const TICK: f64 = 11.0;

/// Height of a line of letters, as a multiple of their size.
pub(super) const LINE: f64 = 1.3;

/// Room between things, in pixels.
pub(super) const PAD: f64 = 8.0;

/// Length of a tick, and of the room between it and what it says.
pub(super) const STROKE: f64 = 4.0;

/// Room around the area between the axes, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Margins {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

impl Margins {
    /// The larger of both, on each side.
    pub(super) fn or_more(self, other: Self) -> Self {
        Self {
            left: self.left.max(other.left),
            right: self.right.max(other.right),
            top: self.top.max(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// What is left of a page of this size between the margins.
    fn area(self, [width, height]: [f64; 2]) -> [f64; 2] {
        [
            (width - self.left - self.right).max(1.0),
            (height - self.top - self.bottom).max(1.0),
        ]
    }
}

/// What a sheet tells a panel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame<'a> {
    /// What stands above it.
    pub(super) title: &'a str,
    /// Width and height of its page, in pixels.
    pub(super) size: [f64; 2],
    /// The least room around it.
    pub(super) margins: Margins,
    /// Whether a plot below it tells what is along the x-axis.
    pub(super) shares_x: bool,
}

/// A plot whose parts have their places.
#[derive(Debug)]
pub(super) struct Panel<'a> {
    pub(super) plot: &'a Plot,
    pub(super) frame: Frame<'a>,
    /// The room around the area between the axes.
    pub(super) margins: Margins,
    pub(super) title: Vec<String>,
    pub(super) axes: Axes,
    pub(super) x_label: Vec<String>,
    pub(super) y_label: Vec<String>,
    pub(super) legend: Legend,
}

impl<'a> Panel<'a> {
    /// Finds the places. The legend leaves out what was `told` before.
    pub(super) fn new(plot: &'a Plot, frame: Frame<'a>, told: &[Entry]) -> Self {
        let area = frame.margins.area(frame.size);
        let mut panel = Self {
            plot,
            frame,
            margins: frame.margins,
            title: Vec::new(),
            axes: Axes::of(plot, area),
            x_label: Vec::new(),
            y_label: Vec::new(),
            legend: Legend::of(&plot.items, told),
        };
        panel.settle(0.0);
        let area = panel.area();
        let traces = paint::traces(plot, &panel.axes, area);
        if !panel.legend.find_corner(area, &traces) {
            let width = frame.size[0] - 2.0 * PAD;
            panel.legend.flow(width, 0.4 * frame.size[1]);
            panel.settle(panel.legend.height);
        }
        panel
    }

    /// Width and height of the area between the axes.
    pub(super) fn area(&self) -> [f64; 2] {
        self.margins.area(self.frame.size)
    }

    /// Widens the margins until all words have their room; `legend` is the height of what stands
    /// below the axes.
    fn settle(&mut self, legend: f64) {
        // The ticks depend on the area, which depends on the ticks; margins only grow.
        for _ in 0..3 {
            let [width, height] = self.area();
            self.axes = Axes::of(self.plot, [width, height]);
            self.title = wrap(
                self.frame.title,
                width + self.margins.right - PAD,
                TITLE,
                true,
            );
            // A long word may reach beside the margin above rather than be broken.
            let words = self.plot.y.label.split_whitespace();
            let longest = words.map(|it| text::width(it, LABEL, false));
            let longest = longest.fold(0.0, f64::max);
            let high = height.max(longest.min(height + self.margins.top - 2.0));
            self.y_label = wrap(&self.plot.y.label, high, LABEL, false);
            self.x_label = match self.frame.shares_x {
                true => Vec::new(),
                false => wrap(&self.plot.x.label, width, LABEL, false),
            };
            self.margins = self.margins.or_more(self.needed(legend));
        }
        self.axes = Axes::of(self.plot, self.area());
    }

    /// The room that the words need.
    fn needed(&self, legend: f64) -> Margins {
        let width = |text: &String| text::width(text, TICK, false);
        let lines = |lines: &[String], size: f64| match lines.len() {
            0 => 0.0,
            count => count as f64 * size * LINE + 0.5 * PAD,
        };
        let widest = self.axes.y.ticks.iter().map(|(_, text)| width(text));
        let widest = widest.fold(0.0, f64::max);
        // The words at the last tick may reach beyond the end of the axis.
        let over = self
            .axes
            .x
            .ticks
            .last()
            .map_or(0.0, |(at, text)| at + 0.5 * width(text) - self.area()[0]);
        let below = match self.frame.shares_x {
            true => 0.0,
            false => STROKE + TICK * LINE,
        };
        Margins {
            left: PAD + lines(&self.y_label, LABEL) + widest + 2.0 * STROKE,
            right: PAD + over.max(2.0),
            top: PAD + lines(&self.title, TITLE),
            bottom: PAD + below + lines(&self.x_label, LABEL) + legend,
        }
    }
}
