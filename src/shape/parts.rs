//! The parts of an obstacle, and the search among many.

use crate::math::Vector;
use crate::shape::boxes::{Bounds, Boxes, Plant, Reached, about_both};
use crate::shape::projection::Projection;
use crate::shape::{Geometry, In, Part, Pose, Reach, Solid};

/// Some parts, in one frame.
#[derive(Debug)]
pub(super) struct Parts<const D: usize> {
    pub(super) list: Vec<Part<D>>,
    boxes: Boxes<D>,
    /// Middle and half sides of the box about all of the tree, where there is one.
    hull: Option<(Vector<D>, Vector<D>)>,
    /// What makes trees of boxes of this dimension.
    pub(super) plant: Plant<D>,
}

impl<const D: usize> Parts<D> {
    pub(super) fn new(list: Vec<Part<D>>) -> Self
    where
        In<D>: Geometry<D>,
    {
        let here = Pose::new(Vector::zeros(), [0.0; 3]);
        let plant = <In<D> as Geometry<D>>::tree;
        let mut boxes = Boxes::default();
        boxes.follow(list.iter().map(|part| part.bounds(&here)), plant);
        let hull = boxes.hull();
        Self {
            hull: hull.map(|(min, max)| ((min + max) / 2.0, (max - min) / 2.0)),
            list,
            boxes,
            plant,
        }
    }

    /// Lowest and highest corner of a box about all parts, at a pose: for many parts one
    /// about their box, which may be larger than need be.
    pub(super) fn bounds(&self, pose: &Pose<D>) -> Bounds<D> {
        let tree = self.hull.as_ref().map(|(middle, half)| {
            let middle = pose.point_to_world(middle);
            // A hair wider, against rounding.
            let half = pose.rotation().abs() * half * (1.0 + 1e-12) + middle.abs() * 1e-12;
            (middle - half, middle + half)
        });
        let others = self.boxes.outside_the_tree();
        let others = others.map(|i| self.list[i].bounds(pose));
        let all = tree.into_iter().chain(others);
        all.reduce(about_both).expect("an obstacle has parts")
    }

    /// The part whose surface is nearest, or in which the point is deepest, with the
    /// projection on it.
    pub(super) fn nearest(&self, point: &Vector<D>) -> (usize, Projection<D>) {
        if let [only] = &self.list[..] {
            return (0, only.project(point));
        }
        let cost = |part: usize| self.list[part].project(point).distance;
        let in_tree = self.boxes.tree().and_then(|it| it.nearest(point, &cost));
        (in_tree.into_iter())
            .chain(self.boxes.outside_the_tree())
            .map(|part| (part, self.list[part].project(point)))
            .min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance))
            .expect("an obstacle has parts")
    }

    /// Whether the segment between two points meets any of the parts.
    pub(super) fn meet(&self, from: &Vector<D>, to: &Vector<D>) -> bool {
        if let [only] = &self.list[..] {
            return only.meets(from, to);
        }
        let mut near = self.boxes.reached(Reach::along(from, to));
        near.any(|part| self.list[part].meets(from, to))
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
        let gaps = near.map(|part| self.list[part].gap(here, solid, pose));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// The parts whose surface is at most `range` away, or that contain the point, with
    /// the projections on them, in their order.
    pub(super) fn within(
        &self,
        point: Vector<D>,
        range: f64,
    ) -> impl Iterator<Item = (usize, Projection<D>)> {
        let projected = (self.near(&point, range)).map(move |i| (i, self.list[i].project(&point)));
        projected.filter(move |(_, it)| it.distance <= range)
    }

    /// The parts that may come within a box of their frame, in their order.
    pub(super) fn within_box(&self, (min, max): Bounds<D>) -> Reached<'_, D> {
        self.boxes.reached(Reach::Within { min, max })
    }

    /// The parts that may be at most `range` from a point, in their order.
    pub(super) fn near(&self, point: &Vector<D>, range: f64) -> Reached<'_, D> {
        let point = *point;
        self.boxes.reached(Reach::Around { point, range })
    }
}
