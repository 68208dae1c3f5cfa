//! The parts of an obstacle, and the search among many.

use crate::math::Vector;
use crate::shape::projection::Projection;
use crate::shape::{Geometry, In, Part, Pose, Solid, Tree};

/// From this number of parts on, a tree of boxes finds the near ones.
const MANY: usize = 9;

/// Some parts, in one frame.
#[derive(Debug)]
pub(super) struct Parts<const D: usize> {
    pub(super) list: Vec<Part<D>>,
    /// The bounded parts, where there are many of them.
    tree: Option<Box<dyn Tree<D>>>,
    /// What the tree's boxes are: indices of bounded parts.
    boxed: Vec<usize>,
    /// The parts outside the tree.
    others: Vec<usize>,
    /// Middle and half sides of the box about all of the tree.
    hull: (Vector<D>, Vector<D>),
}

impl<const D: usize> Parts<D> {
    pub(super) fn new(list: Vec<Part<D>>) -> Self
    where
        In<D>: Geometry<D>,
    {
        let all = 0..list.len();
        let (boxed, others): (Vec<_>, Vec<_>) = all.partition(|&i| list[i].shape.is_bounded());
        if boxed.len() < MANY {
            return Self {
                others: (0..list.len()).collect(),
                list,
                tree: None,
                boxed: Vec::new(),
                hull: (Vector::zeros(), Vector::zeros()),
            };
        }
        let here = Pose::new(Vector::zeros(), [0.0; 3]);
        let boxes: Vec<_> = boxed.iter().map(|&i| list[i].bounds(&here)).collect();
        let (min, max) = boxes[1..].iter().fold(boxes[0], about_both);
        Self {
            hull: ((min + max) / 2.0, (max - min) / 2.0),
            tree: Some(<In<D> as Geometry<D>>::tree(&boxes)),
            list,
            boxed,
            others,
        }
    }

    /// Lowest and highest corner of a box about all parts, at a pose: for many parts one
    /// about their box, which may be larger than need be.
    pub(super) fn bounds(&self, pose: &Pose<D>) -> (Vector<D>, Vector<D>) {
        let tree = self.tree.is_some().then(|| {
            let (middle, half) = &self.hull;
            let middle = pose.point_to_world(middle);
            // A hair wider, against rounding.
            let half = pose.rotation().abs() * half * (1.0 + 1e-12) + middle.abs() * 1e-12;
            (middle - half, middle + half)
        });
        let others = self.others.iter().map(|&i| self.list[i].bounds(pose));
        let all = tree.into_iter().chain(others);
        all.reduce(|a, b| about_both(a, &b))
            .expect("an obstacle has parts")
    }

    /// The part whose surface is nearest, or in which the point is deepest, with the
    /// projection on it.
    pub(super) fn nearest(&self, point: &Vector<D>) -> (usize, Projection<D>) {
        if let [only] = &self.list[..] {
            return (0, only.project(point));
        }
        let cost = |leaf: usize| self.list[self.boxed[leaf]].project(point).distance;
        let in_tree = self.tree.as_ref().and_then(|it| it.nearest(point, &cost));
        let candidates = in_tree.map(|leaf| self.boxed[leaf]).into_iter();
        candidates
            .chain(self.others.iter().copied())
            .map(|part| (part, self.list[part].project(point)))
            .min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance))
            .expect("an obstacle has parts")
    }

    /// Whether the segment between two points meets any of the parts.
    pub(super) fn meet(&self, from: &Vector<D>, to: &Vector<D>) -> bool {
        let middle = (from + to) * 0.5;
        let near = self.near(&middle, (to - from).norm() * 0.5);
        near.into_iter().any(|part| self.list[part].meets(from, to))
    }

    /// The smallest gap between a part and a solid that stands at `pose`, while the parts'
    /// frame stands at `here`, where the solid's origin is `center`.
    pub(super) fn gap(
        &self,
        center: &Vector<D>,
        here: &Pose<D>,
        solid: &Solid<D>,
        pose: &Pose<D>,
    ) -> f64 {
        // A part farther from the centre than the nearest, by the solid's radius or more,
        // is farther from the solid.
        let (_, nearest) = self.nearest(center);
        let near = self.near(center, nearest.distance.max(0.0) + solid.radius());
        let gaps = near
            .into_iter()
            .map(|part| self.list[part].gap(here, solid, pose));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// The parts whose surface is at most `range` away, or that contain the point, with
    /// the projections on them, in their order.
    pub(super) fn within(&self, point: &Vector<D>, range: f64) -> Vec<(usize, Projection<D>)> {
        let near = self.near(point, range).into_iter();
        let projected = near.map(|i| (i, self.list[i].project(point)));
        projected.filter(|(_, it)| it.distance <= range).collect()
    }

    /// The parts that may be at most `range` from a point, in their order.
    fn near(&self, point: &Vector<D>, range: f64) -> Vec<usize> {
        let mut near = self.others.clone();
        if let Some(tree) = &self.tree {
            let from = near.len();
            tree.within(point, range, &mut near);
            for leaf in &mut near[from..] {
                *leaf = self.boxed[*leaf];
            }
            near.sort_unstable();
        }
        near
    }
}

/// The box about two boxes.
fn about_both<const D: usize>(
    (min, max): (Vector<D>, Vector<D>),
    (low, high): &(Vector<D>, Vector<D>),
) -> (Vector<D>, Vector<D>) {
    (min.inf(low), max.sup(high))
}
