//! The adapter to parry, compiled once for each dimension (see `shape::plane` and
//! `shape::space`, which say what `parry` and `D` are).

use super::parry::math::{Pose as ParryPose, Vector as ParryVector};
use super::parry::query::Ray;
use super::parry::shape::{Segment, SharedShape};
use super::{D, hull_faces, parry, turn};
use crate::math::Vector;
use crate::shape::{Face, Geometry, In, Pose, Query, Shape};

/// A pose in parry's terms.
pub(crate) fn pose(pose: &Pose<D>) -> ParryPose {
    ParryPose::new(vector(&pose.translation), turn(pose.turn))
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
        Shape::Convex { points } => {
            let points: Vec<_> = points.iter().map(vector).collect();
            SharedShape::convex_hull(&points)?
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
        Some(Box::new(ParryQuery { solid, core }))
    }
}

/// A solid and the core that it is a rounding of.
#[derive(Clone)]
struct ParryQuery {
    solid: SharedShape,
    core: SharedShape,
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

    fn faces(&self) -> Vec<Face<D>> {
        if let Some(cuboid) = self.solid.as_cuboid() {
            let half: Vector<D> = cuboid.half_extents.to_array().into();
            let along = |axis: usize, sign: f64| Face {
                normal: Vector::<D>::ith(axis, sign),
                offset: half[axis],
            };
            (0..D)
                .flat_map(|axis| [along(axis, -1.0), along(axis, 1.0)])
                .collect()
        } else if let Some(half_space) = self.solid.as_halfspace() {
            vec![Face {
                normal: half_space.normal.to_array().into(),
                offset: 0.0,
            }]
        } else {
            hull_faces(&self.solid)
        }
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
}

fn vector(v: &Vector<D>) -> ParryVector {
    <[f64; D]>::from(*v).into()
}
