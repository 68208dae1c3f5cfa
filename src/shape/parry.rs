//! The adapter to parry, compiled once for each dimension (see `shape::plane` and
//! `shape::space`, which say what `parry` and `D` are).

use std::any::Any;

use super::parry::math::{Pose as ParryPose, Vector as ParryVector};
use super::parry::query;
use super::parry::shape::{Segment, SharedShape};
use super::{D, hull_faces, inertia, parry, turn};
use crate::math::{Matrix, Vector};
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
        let radius = match shape {
            Shape::Ball { radius } | Shape::Capsule { radius, .. } => *radius,
            _ => 0.0,
        };
        Some(Box::new(ParryQuery {
            solid,
            core,
            radius,
        }))
    }
}

/// A solid and the core that it is a rounding of.
#[derive(Clone)]
struct ParryQuery {
    solid: SharedShape,
    core: SharedShape,
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
        let contact = query::contact(&at, &*self.solid, &other_at, &*other.solid, 0.0);
        contact
            .ok()
            .flatten()
            .map_or(0.0, |found| found.dist.min(0.0))
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
