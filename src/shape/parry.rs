//! The adapter to parry, compiled once for each dimension (see `shape::plane` and
//! `shape::space`, which say what `parry` and `D` are).

use super::parry::bounding_volume::Aabb;
use super::parry::math::{Pose as ParryPose, Vector as ParryVector};
use super::parry::partitioning::{Bvh, BvhBuildStrategy, BvhNode};
use super::parry::query::Ray;
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
        let scale = near_one(shape);
        let shape = &shape.scaled(scale);
        let solid = solid(shape)?;
        let core = match shape {
            Shape::Capsule { from, to, .. } => {
                SharedShape::new(Segment::new(vector(from), vector(to)))
            }
            Shape::Ball { .. } => SharedShape::ball(0.0),
            _ => solid.clone(),
        };
        Some(Box::new(ParryQuery { solid, core, scale }))
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

/// The power of two that brings a shape's size near to 1. Parry compares lengths with numbers, so
/// it is asked at that scale alone.
fn near_one(shape: &Shape<D>) -> f64 {
    let far = |points: &[Vector<D>]| points.iter().map(Vector::amax).fold(0.0, f64::max);
    let size = match shape {
        Shape::Ball { radius } => *radius,
        Shape::Cuboid { half_extents } => half_extents.amax(),
        Shape::Capsule { from, to, radius } => far(&[*from, *to]) + radius,
        Shape::HalfSpace { .. } => 1.0,
        Shape::Convex { points } => far(points),
        Shape::Segment { from, to } => far(&[*from, *to]),
        Shape::Triangle { points } => far(points),
    };
    // The exponent, which is exact at every power of two.
    match size.is_normal() {
        true => f64::from_bits((2046 - (size.to_bits() >> 52).clamp(1, 2045)) << 52),
        false => 1.0,
    }
}

/// A solid and the core that it is a rounding of, both at a scale of their own.
#[derive(Clone)]
struct ParryQuery {
    solid: SharedShape,
    core: SharedShape,
    /// What lengths are multiplied by.
    scale: f64,
}

impl std::fmt::Debug for ParryQuery {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "ParryQuery({:?})", self.solid.shape_type())
    }
}

impl ParryQuery {
    fn length(&self, v: &Vector<D>) -> ParryVector {
        vector(&(v * self.scale))
    }

    fn back(&self, v: ParryVector) -> Vector<D> {
        Vector::<D>::from(v.to_array()) / self.scale
    }
}

impl Query<D> for ParryQuery {
    fn closest(&self, point: &Vector<D>) -> Vector<D> {
        // Only the solid query: with `solid = false` parry's answers inside
        // convex hulls and at the centre of balls cannot be relied on.
        let found = self.core.project_local_point(self.length(point), true);
        self.back(found.point)
    }

    fn meets(&self, from: &Vector<D>, to: &Vector<D>) -> bool {
        let ray = Ray::new(self.length(from), self.length(&(to - from)));
        self.solid.cast_local_ray(&ray, 1.0, true).is_some()
    }

    fn centroid(&self) -> Vector<D> {
        if self.solid.as_halfspace().is_some() {
            return Vector::zeros();
        }
        self.back(self.solid.mass_properties(1.0).local_com)
    }

    fn bounds(&self, at: &Pose<D>) -> (Vector<D>, Vector<D>) {
        if self.solid.as_halfspace().is_some() {
            return (
                Vector::repeat(f64::NEG_INFINITY),
                Vector::repeat(f64::INFINITY),
            );
        }
        let at = at.at(at.translation * self.scale);
        let aabb = self.solid.compute_aabb(&pose(&at));
        (self.back(aabb.mins), self.back(aabb.maxs))
    }

    fn volume_and_inertia(&self) -> (f64, Matrix<3>) {
        if self.solid.as_halfspace().is_some() {
            return (0.0, Matrix::zeros());
        }
        let volume = self.scale.powi(D as i32);
        let inertia = inertia(&self.solid) / (volume * self.scale * self.scale);
        (self.solid.mass_properties(1.0).mass() / volume, inertia)
    }
}

fn vector(v: &Vector<D>) -> ParryVector {
    <[f64; D]>::from(*v).into()
}
