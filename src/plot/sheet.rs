//! Several plots on one page.

use super::layout::{Frame, LINE, Margins, PAD, Panel};
use super::words::wrap;
use super::{Plot, frame};
use crate::picture::{Label, Mark, Picture, Theme};

/// Height of the letters of the title of a sheet.
const TITLE: f64 = 15.0;

/// Width and height of the least area between axes that shows anything, in pixels.
const LEAST: [f64; 2] = [60.0, 40.0];

/// Several plots on one page, in rows, their axes in line.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sheet {
    /// Above all plots; a long one is broken into lines.
    pub title: String,
    /// The plots, row by row.
    pub plots: Vec<Plot>,
    /// How many stand side by side; one where it is 0.
    pub columns: usize,
    /// Whether plots are called (a), (b), … before their own titles.
    pub letters: bool,
    /// Whether plots below one another have the same x-axis, so that the lowest tells it for
    /// all. Their ranges are to be the same.
    pub shared_x: bool,
}

impl Sheet {
    /// Whether a page of this width and height, in pixels, leaves each plot room to be read: at
    /// least 60 × 40 pixels between its axes.
    pub fn has_room(&self, size: [f64; 2]) -> bool {
        let titles = self.titles();
        let top = self.heading(size[0]).1;
        self.plots.is_empty()
            || self
                .panels(&titles, [size[0], size[1] - top])
                .iter()
                .all(|(_, panel)| {
                    let [width, height] = panel.area();
                    width >= LEAST[0] && height >= LEAST[1]
                })
    }

    /// The sheet on a page of this width and height, in pixels. What one plot's legend tells,
    /// those of later ones do not tell again.
    pub fn draw(&self, size: [f64; 2], theme: &Theme) -> Picture {
        let mut picture = Picture::new(size, theme.page, &self.title);
        let (heading, top) = self.heading(size[0]);
        for (k, line) in heading.iter().enumerate() {
            let at = [PAD, PAD + (k as f64 + 1.0) * TITLE * LINE - 0.1 * TITLE];
            picture.label(Label::new(line, at, TITLE, theme.ink).bold());
        }
        if self.plots.is_empty() {
            return picture;
        }
        let titles = self.titles();
        for (corner, panel) in self.panels(&titles, [size[0], size[1] - top]) {
            picture.add(Mark::Group {
                corner: [corner[0], corner[1] + top],
                size: panel.frame.size,
                background: None,
                marks: frame::paint(&panel, theme),
            });
        }
        picture
    }

    /// The lines of the title, and the room that they take above the plots.
    fn heading(&self, width: f64) -> (Vec<String>, f64) {
        let lines = wrap(&self.title, width - 2.0 * PAD, TITLE, true);
        let top = match lines.len() {
            0 => 0.0,
            count => PAD + count as f64 * TITLE * LINE,
        };
        (lines, top)
    }

    fn titles(&self) -> Vec<String> {
        (0..self.plots.len()).map(|k| self.title_of(k)).collect()
    }

    fn title_of(&self, place: usize) -> String {
        let title = &self.plots[place].title;
        let letter = char::from(b'a' + (place % 26) as u8);
        match self.letters {
            true => format!("({letter}) {title}").trim_end().to_owned(),
            false => title.clone(),
        }
    }

    /// The plots on a page of this size, each with the upper left corner of its own page.
    fn panels<'a>(&'a self, titles: &'a [String], size: [f64; 2]) -> Vec<([f64; 2], Panel<'a>)> {
        let count = self.plots.len();
        let columns = self.columns.clamp(1, count);
        let rows = count.div_ceil(columns);
        let mut margins = vec![Margins::default(); count];
        let mut placed = Vec::new();
        // The margins of one change those of others; they only grow.
        for _ in 0..4 {
            let widest = |chosen: &dyn Fn(usize) -> bool| {
                let own = margins.iter().enumerate().filter(|(k, _)| chosen(*k));
                own.fold(Margins::default(), |sum, (_, it)| sum.or_more(*it))
            };
            let across: Vec<_> = (0..columns)
                .map(|column| widest(&|k| k % columns == column))
                .map(|it| [it.left, it.right])
                .collect();
            let down: Vec<_> = (0..rows)
                .map(|row| widest(&|k| k / columns == row))
                .map(|it| [it.top, it.bottom])
                .collect();
            let (across, down) = (parts(size[0], &across), parts(size[1], &down));
            placed.clear();
            let mut told = Vec::new();
            for (k, plot) in self.plots.iter().enumerate() {
                let (column, row) = (&across[k % columns], &down[k / columns]);
                let frame = Frame {
                    title: &titles[k],
                    size: [column.length, row.length],
                    margins: Margins {
                        left: column.margins[0],
                        right: column.margins[1],
                        top: row.margins[0],
                        bottom: row.margins[1],
                    },
                    shares_x: self.shared_x && k + columns < count,
                };
                let panel = Panel::new(plot, frame, &told);
                told.extend_from_slice(panel.legend.entries());
                placed.push(([column.start, row.start], panel));
            }
            let grown: Vec<Margins> = placed.iter().map(|(_, it)| it.margins).collect();
            if grown == margins {
                break;
            }
            margins = grown;
        }
        placed
    }
}

/// A row or a column of plots.
struct Part {
    start: f64,
    length: f64,
    margins: [f64; 2],
}

/// Rows or columns on so many pixels, with margins on both sides and equal room between them.
fn parts(pixels: f64, margins: &[[f64; 2]]) -> Vec<Part> {
    let sum: f64 = margins.iter().flatten().sum();
    let area = ((pixels - sum) / margins.len() as f64).max(1.0);
    let mut start = 0.0;
    let mut parts = Vec::new();
    for margins in margins {
        let length = area + margins[0] + margins[1];
        parts.push(Part {
            start,
            length,
            margins: *margins,
        });
        start += length;
    }
    parts
}
