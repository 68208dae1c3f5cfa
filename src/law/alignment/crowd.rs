//! Who stands between two points.

use crate::math::{Vector, direction};
use crate::sense::Cells;

/// The agents, sorted so that those between two points are found without looking at the
/// others.
#[derive(Debug, Clone, Default)]
pub(super) struct Crowd<const D: usize> {
    cells: Cells<D>,
    side: f64,
}

/// A part of the line from one point to another, as distances along it from the first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    pub from: f64,
    pub to: f64,
}

/// Against rounding, searches reach farther by this share.
const MARGIN: f64 = 1e-9;

impl<const D: usize> Crowd<D> {
    /// Sorts some finite positions, for searches of at least this half-width.
    pub(super) fn rebuild(&mut self, positions: &[Vector<D>], least: f64) {
        let mut min = Vector::<D>::repeat(f64::INFINITY);
        let mut max = Vector::<D>::repeat(f64::NEG_INFINITY);
        for position in positions {
            min = min.inf(position);
            max = max.sup(position);
        }
        // About one agent in a cell where they are spread evenly; cells finer than the
        // searches are wide gain nothing.
        let along_one_axis = libm::pow(positions.len().max(1) as f64, 1.0 / D as f64);
        let apart = (max - min).amax() / along_one_axis;
        self.side = apart.max(least).clamp(f64::MIN_POSITIVE, f64::MAX);
        self.cells.rebuild(positions, self.side);
    }

    /// Calls `visit` with the index of every agent whose projection on the line from `start`
    /// to `end` lies in the stretch and that is at most the half-width from the line there,
    /// and with the way to it from `start`. `half_width` tells the largest over a part of the
    /// stretch. Some agents farther from the line are visited as well; none twice.
    pub(super) fn between(
        &self,
        start: &Vector<D>,
        end: &Vector<D>,
        stretch: Stretch,
        half_width: impl Fn(Stretch) -> f64,
        mut visit: impl FnMut(usize, &Vector<D>),
    ) {
        let along = direction(&(end - start));
        let margin = MARGIN * (stretch.to - stretch.from);
        let (from, to) = (stretch.from - margin, stretch.to + margin);
        let length = to - from;
        if !length.is_finite() || length <= 0.0 {
            return;
        }
        // Balls about pieces as long as wide, each agent counted in the piece it is beside.
        let wide = 2.0 * half_width(Stretch { from, to });
        let pieces = (length / wide.max(self.side)).ceil().max(1.0) as usize;
        let piece = length / pieces as f64;
        for k in 0..pieces {
            let part = Stretch {
                from: from + piece * k as f64,
                to: from + piece * (k + 1) as f64,
            };
            let middle = start + along * (0.5 * (part.from + part.to));
            let radius = (0.5 * piece).hypot(half_width(part)) * (1.0 + MARGIN) + margin;
            self.cells.for_each_within(&middle, radius, |place, _, _| {
                let offset = self.cells.sorted()[place] - start;
                let at = offset.dot(&along) - from;
                let inside = at >= 0.0 && at <= length;
                if inside && ((at / piece) as usize).min(pieces - 1) == k {
                    visit(self.cells.order()[place] as usize, &offset);
                }
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn equals_brute_force<const D: usize>(points: &[Vector<D>], width: f64, swell: f64) {
        let mut crowd = Crowd::default();
        crowd.rebuild(points, width);
        let (start, end) = (points[0], points[1]);
        let length = (end - start).norm();
        let stretch = Stretch {
            from: -width,
            to: length + width,
        };
        // Widest in the middle.
        let at = |t: f64| width + swell * t.min(length - t).max(0.0);
        let mut found = vec![0; points.len()];
        let half_width = |part: Stretch| at((0.5 * length).max(part.from).min(part.to));
        crowd.between(&start, &end, stretch, half_width, |k, _| found[k] += 1);
        let along = direction(&(end - start));
        for (k, point) in points.iter().enumerate() {
            let t = (point - start).dot(&along);
            let beside = (point - start - along * t).norm();
            let inside = t >= stretch.from && t <= stretch.to && beside <= at(t);
            assert!(found[k] <= 1, "visited twice");
            assert!(
                found[k] == 1 || !inside,
                "{k} of {} is missed",
                points.len()
            );
        }
    }

    proptest! {
        #[test]
        fn nobody_between_is_missed_and_nobody_visited_twice(
            points in prop::collection::vec(prop::array::uniform3(-9.0..9.0f64), 2..80),
            width in 0.01..4.0f64,
            swell in 0.0..1.0f64,
        ) {
            let space: Vec<Vector<3>> = points.iter().copied().map(Vector::from).collect();
            equals_brute_force(&space, width, swell);
            let flat = |x: &[f64; 3]| Vector::<2>::new(x[0], x[1]);
            let plane: Vec<Vector<2>> = points.iter().map(flat).collect();
            equals_brute_force(&plane, width, swell);
            // On one line, as all are that this is about.
            let lined_up = |x: &[f64; 3]| Vector::<2>::new(x[0], 0.5 * x[0]);
            let line: Vec<Vector<2>> = points.iter().map(lined_up).collect();
            equals_brute_force(&line, width, swell);
        }
    }

    #[test]
    fn points_that_coincide_are_a_stretch_of_their_own() {
        let points = [[1.0, 1.0], [1.0, 1.0], [1.0, 1.2], [4.0, 1.0]].map(Vector::<2>::from);
        equals_brute_force(&points, 0.3, 0.0);
    }
}
