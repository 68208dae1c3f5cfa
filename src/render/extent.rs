//! How far shapes reach.

use crate::math::{Vector, axis};
use crate::shape::{Bounds, Part, Pose, Shape};

/// Points whose convex hull, widened by a radius, is the shape; none for a half-space.
pub(super) fn hull_of<const D: usize>(shape: &Shape<D>) -> (Vec<Vector<D>>, f64) {
    match shape {
        Shape::Ball { radius } => (vec![Vector::zeros()], *radius),
        Shape::Cuboid { half_extents } => {
            let corner = |k: usize| {
                let sign = |d: usize| if k >> d & 1 == 0 { -1.0 } else { 1.0 };
                (0..D)
                    .map(|d| axis::<D>(d) * (sign(d) * half_extents[d]))
                    .sum()
            };
            ((0..1 << D).map(corner).collect(), 0.0)
        }
        Shape::Capsule { from, to, radius } => (vec![*from, *to], *radius),
        Shape::HalfSpace { .. } => (Vec::new(), 0.0),
        Shape::Convex { points } => (points.clone(), 0.0),
        Shape::Segment { from, to } => (vec![*from, *to], 0.0),
        Shape::Triangle { points } => (points.to_vec(), 0.0),
    }
}

/// The box that holds some parts of an obstacle that stands at `pose`; nothing where all of them
/// are without bounds.
pub(super) fn extent_of<const D: usize>(parts: &[Part<D>], pose: &Pose<D>) -> Option<Bounds<D>> {
    let mut found = None;
    for part in parts {
        let pose = part.world_pose(pose);
        let (points, radius) = hull_of(&part.shape);
        let reach = Vector::repeat(radius);
        for point in points.iter().map(|point| pose.point_to_world(point)) {
            found = Some(around(found, (point - reach, point + reach)));
        }
    }
    found
}

/// The box that holds two.
pub(super) fn around<const D: usize>(one: Option<Bounds<D>>, (min, max): Bounds<D>) -> Bounds<D> {
    match one {
        Some((lowest, highest)) => (lowest.inf(&min), highest.sup(&max)),
        None => (min, max),
    }
}
