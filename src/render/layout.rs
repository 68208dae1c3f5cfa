//! Where on the page the scene is, and what stands around it.

use crate::picture::Mark;
use crate::render::{Layer, Scene, Size};

use super::legend::{self, LETTERS, ROW};
use super::scale_bar;

/// How much wider and higher a page of several scenes may be than that of one.
const MANY: f64 = 1.4;

/// Room at the edge of the page, in pixels.
pub(super) const MARGIN: f64 = 10.0;

/// Width and height of a page from which on it has a legend and a bar.
const ROOMY: [f64; 2] = [300.0, 200.0];

/// Height of the line with the time, in pixels.
pub(super) const HEAD: f64 = 24.0;

/// Size of the letters of the time, in pixels.
pub(super) const TIME: f64 = 14.0;

/// A page with some scenes of one size in rows.
#[derive(Debug)]
pub(super) struct Layout {
    /// Width and height of the page.
    pub(super) page: [f64; 2],
    /// Upper left corner of each scene.
    pub(super) corners: Vec<[f64; 2]>,
    /// Width and height of each.
    pub(super) stage: [f64; 2],
    /// Height of the line above each.
    pub(super) head: f64,
    /// The legend, and where its upper left corner is.
    legend: Vec<Mark>,
    foot: [f64; 2],
    /// Whether there is room for legend and bar.
    roomy: bool,
}

impl Layout {
    /// The page of this many scenes, each with a line above it that is no wider than told, or
    /// without. Bodies may be `tinted` by moments.
    pub(super) fn new<const D: usize>(
        scene: &Scene<'_, D>,
        count: usize,
        title: Option<f64>,
        tinted: bool,
    ) -> Self {
        let head = match title {
            Some(_) => HEAD,
            None => 0.0,
        };
        let sides = scene.sides();
        let most = match scene.look.size {
            Size::Exact(size) => size,
            Size::Within(size) if count > 1 => size.map(|side| MANY * side),
            Size::Within(size) => size,
        };
        let roomy = most.iter().zip(ROOMY).all(|(side, least)| *side >= least);
        let legend = |width| match roomy {
            true => legend(scene, width, tinted),
            false => (Vec::new(), 0.0),
        };
        let (marks, height) = legend(most[0]);
        let fit = |columns| Grid::new(count, columns, head, height).stage(most);
        let scale = |[width, height]: [f64; 2]| (width / sides[0]).min(height / sides[1]);
        let title = title.unwrap_or(0.0);
        let wide = |&columns: &usize| columns == 1 || fit(columns)[0] >= title;
        let columns = (1..=count)
            .filter(wide)
            .max_by(|&a, &b| scale(fit(a)).total_cmp(&scale(fit(b))));
        let columns = columns.unwrap_or(1);
        let stage = fit(columns);
        let (stage, (legend, height)) = match scene.look.size {
            Size::Exact(_) => (stage, (marks, height)),
            Size::Within(_) => {
                let least = 0.3 * stage[0].min(stage[1]);
                let stage = sides.map(|side| (side * scale(stage)).max(least));
                let [width, _] = Grid::new(count, columns, head, height).page(stage);
                (stage, legend(width))
            }
        };
        let grid = Grid::new(count, columns, head, height);
        // Films need even numbers of pixels.
        let page = grid.page(stage).map(|side| 2.0 * (0.5 * side).round());
        let page = match scene.look.size {
            Size::Exact(size) => size,
            Size::Within(_) => page,
        };
        let stage = grid.stage(page);
        Self {
            page,
            corners: (0..count).map(|k| grid.corner(k, stage)).collect(),
            stage,
            head,
            legend,
            foot: [MARGIN, page[1] - height - 0.5 * MARGIN],
            roomy,
        }
    }

    /// The legend and the bar below the scenes, which have this many pixels per length.
    pub(super) fn foot<const D: usize>(&self, scene: &Scene<'_, D>, scale: f64) -> Vec<Mark> {
        let mut marks = Vec::new();
        if !self.legend.is_empty() {
            marks.push(Mark::Group {
                corner: self.foot,
                size: [self.page[0] - MARGIN, self.page[1] - self.foot[1]],
                background: None,
                marks: self.legend.clone(),
            });
        }
        if self.roomy && scene.layers.has(Layer::Scale) {
            let remark = match D {
                2 => "",
                _ => " in the middle",
            };
            let at = [self.page[0] - MARGIN, self.foot[1] + 0.5 * ROW + 5.0];
            let longest = bar(self.stage[0]);
            let theme = &scene.look.theme;
            marks.extend(scale_bar::draw(theme, scale, at, longest, LETTERS, remark));
        }
        marks
    }
}

/// Length in pixels that the bar may have below a scene of this width.
fn bar(width: f64) -> f64 {
    (0.25 * width).min(160.0)
}

/// The legend below scenes, which leaves room for the bar; its height is that of what stands
/// there.
fn legend<const D: usize>(scene: &Scene<'_, D>, width: f64, tinted: bool) -> (Vec<Mark>, f64) {
    let shows = |layer| scene.layers.has(layer);
    let bar = match shows(Layer::Scale) {
        // In space the words are longer than a short bar.
        true if D == 3 => bar(width).max(105.0) + MARGIN,
        true => bar(width) + MARGIN,
        false => 0.0,
    };
    let (marks, height) = match shows(Layer::Legend) {
        true => legend::draw(scene, width - 2.0 * MARGIN - bar, tinted),
        false => (Vec::new(), 0.0),
    };
    let least = match shows(Layer::Scale) {
        true => ROW,
        false => 0.0,
    };
    (marks, f64::max(height, least))
}

/// Scenes in rows.
struct Grid {
    columns: usize,
    rows: usize,
    /// Height of the line above each scene.
    head: f64,
    /// Height of what stands below all.
    foot: f64,
}

impl Grid {
    fn new(count: usize, columns: usize, head: f64, legend: f64) -> Self {
        Self {
            columns,
            rows: count.div_ceil(columns),
            head,
            foot: match legend > 0.0 {
                true => legend + 0.5 * MARGIN,
                false => 0.0,
            },
        }
    }

    /// Width and height of the page that is not the scenes'.
    fn around(&self) -> [f64; 2] {
        let (columns, rows) = (self.columns as f64, self.rows as f64);
        let above = self.head * rows + MARGIN * (rows + 1.0) + self.foot;
        [MARGIN * (columns + 1.0), above]
    }

    /// Width and height of each scene, on a page of this size.
    fn stage(&self, page: [f64; 2]) -> [f64; 2] {
        let around = self.around();
        let width = (page[0] - around[0]) / self.columns as f64;
        let height = (page[1] - around[1]) / self.rows as f64;
        [width.max(1.0), height.max(1.0)]
    }

    /// Width and height of the page, for scenes of this size.
    fn page(&self, stage: [f64; 2]) -> [f64; 2] {
        let around = self.around();
        let width = stage[0] * self.columns as f64 + around[0];
        [width, stage[1] * self.rows as f64 + around[1]]
    }

    /// Upper left corner of a scene.
    fn corner(&self, number: usize, stage: [f64; 2]) -> [f64; 2] {
        let column = (number % self.columns) as f64;
        let row = (number / self.columns) as f64;
        [
            MARGIN + column * (stage[0] + MARGIN),
            MARGIN + self.head + row * (stage[1] + self.head + MARGIN),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_and_what_is_around_them_make_up_the_page() {
        let grid = Grid::new(5, 2, HEAD, ROW);
        let stage = grid.stage([800.0, 600.0]);
        let page = grid.page(stage);
        assert!((page[0] - 800.0).abs() < 1e-9 && (page[1] - 600.0).abs() < 1e-9);
        let [x, y] = grid.corner(4, stage);
        assert_eq!(x, MARGIN);
        assert!((y + stage[1] + 1.5 * MARGIN + ROW - 600.0).abs() < 1e-9);
    }
}
