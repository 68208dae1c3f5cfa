//! The adapter to parry, compiled once for each dimension (see `shape::plane` and
//! `shape::space`, which say what `parry` and `D` are).

use std::any::Any;

use super::parry::bounding_volume::Aabb;
use super::parry::math::{Pose as ParryPose, Vector as ParryVector};
use super::parry::partitioning::{Bvh, BvhBuildStrategy, BvhNode};
use super::parry::query::{self, Ray};
use super::parry::shape::{Segment, SharedShape};
use super::{D, hull, inertia, parry, rotation};
use crate::math::{Matrix, Vector};
use crate::shape::{Bounds, Geometry, In, Pose, Query, Reach, Shape, Tree};

/// A pose in parry's terms.
pub(crate) fn pose(pose: &Pose<D>) -> ParryPose {
    ParryPose::from_parts(vector(&pose.translation), rotation(pose.rotation()))
}

/// The solid in parry's terms; `None` where it is flat or empty.
pub(crate) fn solid(shape: &Shape<D>) -> Option<SharedShape> {
    Some(match shape {
        Shape::Ball { radius } => SharedShape::ball(*radius),
        Shape::Cuboid { half_extents } => {
            SharedShape::new(parry::shape::Cuboid::new(vector(half_extents)))
        }
        Shape::Capsule { from, to, radius } => {
            SharedShape::capsule(vector(from), vector(to), *radius)
        }
        Shape::HalfSpace { normal } => SharedShape::halfspace(vector(normal)),
        Shape::Convex { points } => hull(points)?,
        Shape::Segment { from, to } => SharedShape::segment(vector(from), vector(to)),
        Shape::Triangle { points: [a, b, c] } => {
            SharedShape::triangle(vector(a), vector(b), vector(c))
        }
    })
}

impl Geometry<D> for In<D> {
    fn query(shape: &Shape<D>) -> Option<Box<dyn Query<D>>> {
        let solid = solid(shape)?;
        let core = match shape {
            Shape::Capsule { from, to, .. } => {
                SharedShape::new(Segment::new(vector(from), vector(to)))
            }
            Shape::Ball { .. } => SharedShape::ball(0.0),
            _ => solid.clone(),
        };
        let radius = match shape {
            Shape::Ball { radius } | Shape::Capsule { radius, .. } => *radius,
            _ => 0.0,
        };
        Some(Box::new(ParryQuery {
            solid,
            core,
            thin: shape.is_thin() || matches!(shape, Shape::Ball { .. } | Shape::Capsule { .. }),
            radius,
        }))
    }

    fn tree(boxes: &[Bounds<D>]) -> Box<dyn Tree<D>> {
        let leaves = bounded(boxes);
        Box::new(ParryTree(Bvh::from_iter(BvhBuildStrategy::Binned, leaves)))
    }
}

/// The bounded ones among some boxes, with their indices.
fn bounded(boxes: &[Bounds<D>]) -> impl Iterator<Item = (usize, Aabb)> {
    let boxes = boxes
        .iter()
        .map(|(min, max)| Aabb::new(vector(min), vector(max)));
    let finite = |it: &Aabb| it.mins.is_finite() && it.maxs.is_finite();
    boxes.enumerate().filter(move |(_, it)| finite(it))
}

/// Parry's tree of boxes.
struct ParryTree(Bvh);

impl std::fmt::Debug for ParryTree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "ParryTree({})", self.0.leaf_count())
    }
}

/// Distance from a point to a box, 0 inside.
fn distance(node: &BvhNode, point: ParryVector) -> f64 {
    (point - point.max(node.mins()).min(node.maxs())).length()
}

impl Tree<D> for ParryTree {
    fn search(&self, reach: &Reach<D>, visit: &mut dyn FnMut(usize)) {
        let met = |node: &BvhNode| {
            reach.meets(
                &node.mins().to_array().into(),
                &node.maxs().to_array().into(),
            )
        };
        (self.0.leaves(met)).for_each(|leaf| visit(leaf as usize));
    }

    fn fit(&mut self, boxes: &[Bounds<D>]) {
        for (index, at) in bounded(boxes) {
            self.0.insert_or_update_partially(at, index as u32, 0.0);
        }
        self.0.refit_without_opt();
    }

    fn nearest(&self, point: &Vector<D>, cost: &dyn Fn(usize) -> f64) -> Option<usize> {
        let point = vector(point);
        // Around the point, boxes are looked at whatever has been found already: in a
        // solid, costs fall below 0.
        let least = |node: &BvhNode, _| match distance(node, point) {
            0.0 => f64::NEG_INFINITY,
            apart => apart,
        };
        let best = self
            .0
            .find_best(f64::MAX, least, |leaf, _| Some(cost(leaf as usize)));
        best.map(|(leaf, _)| leaf as usize)
    }
}

/// A solid and the core that it is a rounding of.
#[derive(Clone)]
struct ParryQuery {
    solid: SharedShape,
    core: SharedShape,
    /// Whether the core is a point, a line or a facet.
    thin: bool,
    /// Radius of the rounding.
    radius: f64,
}

impl std::fmt::Debug for ParryQuery {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "ParryQuery({:?})", self.solid.shape_type())
    }
}

impl Query<D> for ParryQuery {
    fn closest(&self, point: &Vector<D>) -> Vector<D> {
        // Only the solid query: with `solid = false` parry's answers inside
        // convex hulls and at the centre of balls cannot be relied on.
        let projection = self.core.project_local_point(vector(point), true);
        projection.point.to_array().into()
    }

    fn meets(&self, from: &Vector<D>, to: &Vector<D>) -> bool {
        let ray = Ray::new(vector(from), vector(&(to - from)));
        self.solid.cast_local_ray(&ray, 1.0, true).is_some()
    }

    fn centroid(&self) -> Vector<D> {
        if self.solid.as_halfspace().is_some() {
            return Vector::zeros();
        }
        self.solid.mass_properties(1.0).local_com.to_array().into()
    }

    fn bounds(&self, at: &Pose<D>) -> (Vector<D>, Vector<D>) {
        if self.solid.as_halfspace().is_some() {
            return (
                Vector::repeat(f64::NEG_INFINITY),
                Vector::repeat(f64::INFINITY),
            );
        }
        let aabb = self.solid.compute_aabb(&pose(at));
        (aabb.mins.to_array().into(), aabb.maxs.to_array().into())
    }

    fn gap(&self, at: &Pose<D>, other: &dyn Query<D>, other_at: &Pose<D>) -> f64 {
        let other: &dyn Any = other;
        let other: &Self = other
            .downcast_ref()
            .expect("one adapter for each dimension");
        let (at, other_at) = (pose(at), pose(other_at));
        // Distances of cores are exact where those of rounded shapes are iterated.
        let cores = query::distance(&at, &*self.core, &other_at, &*other.core);
        let cores = cores.map_or(f64::NAN, |found| found.distance);
        if cores > 0.0 {
            return cores - self.radius - other.radius;
        }
        let radii = self.radius + other.radius;
        if self.thin && other.thin {
            // Lines and facets that cross come apart by the sum of their radii at least.
            return -radii;
        }
        // Where sides are parallel to the last digit the query may find nothing; it does
        // a hair beside.
        let size = self.solid.compute_local_aabb().half_extents().length();
        let nudges = (0..=D).map(|k| match k.checked_sub(1) {
            None => ParryVector::ZERO,
            Some(axis) => vector(&crate::math::axis(axis)) * (1e-7 * size.min(1e30)),
        });
        let depth = |nudge: ParryVector| {
            let there = ParryPose {
                translation: other_at.translation + nudge,
                ..other_at
            };
            let found = query::contact(&at, &*self.solid, &there, &*other.solid, 0.0);
            found.ok().flatten().map(|found| found.dist)
        };
        let found = nudges.filter_map(depth).find(|dist| *dist < 0.0);
        found.unwrap_or(-radii)
    }

    fn volume_and_inertia(&self) -> (f64, Matrix<3>) {
        if self.solid.as_halfspace().is_some() {
            return (0.0, Matrix::zeros());
        }
        let volume = self.solid.mass_properties(1.0).mass();
        (volume, inertia(&self.solid))
    }
}

fn vector(v: &Vector<D>) -> ParryVector {
    <[f64; D]>::from(*v).into()
}
