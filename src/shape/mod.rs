//! Shapes of obstacles and bodies: closest points, their exact derivatives, bounds and gaps.
//!
//! A shape is a core (a point, a segment, a triangle in space, a convex polytope or a
//! half-space) rounded by a radius. What is nearest, to a point or to another shape, is found
//! among the core's own corners, edges and faces, once for both dimensions, and with it the
//! derivative of the closest-point map. Parry tells masses, boxes and lines of sight.
//! An obstacle is made of one such shape or of many, its parts, and may move.

mod boxes;
mod core;
mod facet;
mod hull;
mod motion;
mod obstacle;
mod part;
mod parts;
mod polytope;
mod pose;
mod projection;
mod separation;
mod sight;
mod solid;
pub mod surface;
mod walls;

pub(crate) use boxes::Boxes;
pub use boxes::{Bounds, Reach};
pub use motion::{Easing, Motion, Twist};
pub use obstacle::{Acting, Obstacle};
pub use part::Part;
pub use pose::Pose;
pub use projection::Projection;
pub use separation::Separation;
pub use solid::Solid;
pub(crate) use walls::is_exposed;

use std::fmt::Debug;

use crate::math::{Matrix, Vector};
use polytope::{Polytope, Side};

/// A convex shape of `D` dimensions, in its own frame: a solid, or something thin.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape<const D: usize> {
    /// All points within `radius` of the origin.
    Ball {
        /// Radius, above 0.
        radius: f64,
    },
    /// An axis-aligned box about the origin.
    Cuboid {
        /// Half the sides, above 0.
        half_extents: Vector<D>,
    },
    /// All points within `radius` of a segment.
    Capsule {
        /// One end of the segment.
        from: Vector<D>,
        /// The other end.
        to: Vector<D>,
        /// Radius, above 0.
        radius: f64,
    },
    /// All points behind the plane through the origin.
    HalfSpace {
        /// Unit normal, pointing out of the solid.
        normal: Vector<D>,
    },
    /// The convex hull of some points that span the space.
    Convex {
        /// The points.
        points: Vec<Vector<D>>,
    },
    /// All points of a segment, which has no inside.
    Segment {
        /// One end.
        from: Vector<D>,
        /// The other end.
        to: Vector<D>,
    },
    /// A triangle: a solid in the plane, a thin facet without inside in space.
    Triangle {
        /// The corners, not on one line.
        points: [Vector<D>; 3],
    },
}

impl<const D: usize> Shape<D> {
    /// Whether it has no inside, so that it is outside on both sides.
    pub fn is_thin(&self) -> bool {
        match self {
            Self::Segment { .. } => true,
            Self::Triangle { .. } => D == 3,
            _ => false,
        }
    }

    /// The same shape with all lengths times a number above 0.
    pub fn scaled(&self, by: f64) -> Self {
        match self {
            Self::Ball { radius } => Self::Ball {
                radius: radius * by,
            },
            Self::Cuboid { half_extents } => Self::Cuboid {
                half_extents: half_extents * by,
            },
            Self::Capsule { from, to, radius } => Self::Capsule {
                from: from * by,
                to: to * by,
                radius: radius * by,
            },
            Self::HalfSpace { normal } => Self::HalfSpace { normal: *normal },
            Self::Convex { points } => Self::Convex {
                points: points.iter().map(|point| point * by).collect(),
            },
            Self::Segment { from, to } => Self::Segment {
                from: from * by,
                to: to * by,
            },
            Self::Triangle { points } => Self::Triangle {
                points: points.map(|point| point * by),
            },
        }
    }

    /// The flat faces of a box or a hull, in its own frame; none where it is no solid.
    pub fn faces(&self) -> Vec<Face<D>> {
        let polytope = match self {
            Self::Cuboid { .. } | Self::Convex { .. } => Polytope::new(self),
            _ => None,
        };
        let faces = polytope.iter().flat_map(|polytope| {
            let face = |side: &Side<D>| Face {
                normal: side.normal,
                offset: side
                    .normal
                    .dot(&(polytope.middle + polytope.at(side.corners[0]))),
            };
            polytope.faces.iter().map(face)
        });
        faces.collect()
    }

    /// Whether it ends somewhere in every direction.
    pub fn is_bounded(&self) -> bool {
        !matches!(self, Self::HalfSpace { .. })
    }
}

/// A flat face of a polytope: the solid lies where normal · x ≤ offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face<const D: usize> {
    /// Unit normal, pointing out.
    pub normal: Vector<D>,
    /// Distance of the face from the origin along the normal.
    pub offset: f64,
}

/// What the shape code asks of parry, in the shape's own frame.
pub trait Query<const D: usize>: Debug + Send + Sync {
    /// The point of the solid core nearest to `point`; `point` itself inside.
    fn closest(&self, point: &Vector<D>) -> Vector<D>;
    /// Whether the segment between two points meets the solid.
    fn meets(&self, from: &Vector<D>, to: &Vector<D>) -> bool;
    /// The centroid; the origin for a half-space.
    fn centroid(&self) -> Vector<D>;
    /// Lowest and highest corner of the bounding box of the posed shape.
    fn bounds(&self, pose: &Pose<D>) -> (Vector<D>, Vector<D>);
    /// Volume (area), and the inertia tensor about the centroid at density 1; in the plane
    /// only the tensor's last entry counts. Both 0 for a half-space.
    fn volume_and_inertia(&self) -> (f64, Matrix<3>);
}

/// A tree of the bounded ones among some boxes, to find those near to a point or a way.
pub trait Tree<const D: usize>: Debug + Send + Sync {
    /// Calls `visit` with the index of each box that something reaches, in no particular order.
    fn search(&self, reach: &Reach<D>, visit: &mut dyn FnMut(usize));
    /// Takes the same boxes where they are now.
    fn fit(&mut self, boxes: &[Bounds<D>]);
    /// The box of the lowest cost. No cost may be below the distance to the box, but for
    /// points inside the box.
    fn nearest(&self, point: &Vector<D>, cost: &dyn Fn(usize) -> f64) -> Option<usize>;
}

/// Access to parry's types of one dimension; implemented by [`In<2>`] and [`In<3>`].
pub trait Geometry<const D: usize> {
    /// Prepares a shape for queries; `None` where parry finds no solid in it.
    fn query(shape: &Shape<D>) -> Option<Box<dyn Query<D>>>;
    /// A tree of the bounded ones among some boxes, of which there are three at least.
    fn tree(boxes: &[Bounds<D>]) -> Box<dyn Tree<D>>;
}

/// The dimension `D` as a type, to hang per-dimension code on.
#[derive(Debug)]
pub struct In<const D: usize>;

/// The adapter to parry, compiled for the plane.
#[path = "."]
#[allow(clippy::duplicate_mod, reason = "one source for both dimensions")]
pub(crate) mod plane {
    use parry2d as parry;
    const D: usize = 2;
    #[path = "parry.rs"]
    mod adapter;
    pub(crate) use adapter::solid;

    fn rotation(matrix: &crate::math::Matrix<D>) -> parry::math::Rotation {
        parry::math::Rotation::from_cos_sin_unchecked(matrix[(0, 0)], matrix[(1, 0)])
    }

    /// The moment of inertia, as the tensor's entry about the third axis.
    fn inertia(solid: &parry::shape::SharedShape) -> super::Matrix<3> {
        let moment = match solid.as_capsule() {
            // Parry takes the centroid of half a disk for that of half a ball.
            Some(capsule) => flat_capsule(capsule.half_height(), capsule.radius),
            None => solid.mass_properties(1.0).principal_inertia(),
        };
        super::Matrix::<3>::from_diagonal(&[0.0, 0.0, moment].into())
    }

    /// The moment of inertia of a flat capsule at density 1: a rectangle, and two half disks
    /// whose centroids are 4r/(3π) beyond its ends.
    fn flat_capsule(half_length: f64, radius: f64) -> f64 {
        use std::f64::consts::PI;
        let (l, r) = (half_length, radius);
        let (bar, disk) = (4.0 * l * r, PI * r * r);
        let ends = 0.5 * r * r + l * l + 8.0 * l * r / (3.0 * PI);
        bar * (l * l + r * r) / 3.0 + disk * ends
    }

    /// The hull of some points, with all its corners: parry's own drops those where edges are
    /// nearly in line.
    fn hull(points: &[super::Vector<D>]) -> Option<parry::shape::SharedShape> {
        let corners = super::hull::corners(points);
        let corners = corners.into_iter().map(|i| <[f64; D]>::from(points[i]));
        parry::shape::SharedShape::convex_polyline_unmodified(corners.map(Into::into).collect())
    }
}

/// The adapter to parry, compiled for space.
#[path = "."]
#[allow(clippy::duplicate_mod, reason = "one source for both dimensions")]
pub(crate) mod space {
    use parry3d as parry;
    const D: usize = 3;
    #[path = "parry.rs"]
    mod adapter;
    pub(crate) use adapter::solid;

    fn rotation(matrix: &crate::math::Matrix<D>) -> parry::math::Rotation {
        let columns = std::array::from_fn(|k| {
            let column: [f64; D] = matrix.column(k).into();
            column.into()
        });
        let [x, y, z] = columns;
        parry::math::Rotation::from_mat3(&parry::math::Matrix::from_cols(x, y, z))
    }

    /// The inertia tensor.
    fn inertia(solid: &parry::shape::SharedShape) -> super::Matrix<3> {
        let properties = solid.mass_properties(1.0);
        super::Matrix::<3>::from_column_slice(
            &properties.reconstruct_inertia_matrix().to_cols_array(),
        )
    }

    /// The hull of some points; `None` where parry makes something flat of it, which it does with
    /// thin ones.
    fn hull(points: &[super::Vector<D>]) -> Option<parry::shape::SharedShape> {
        let all: Vec<_> = points
            .iter()
            .map(|it| <[f64; D]>::from(*it).into())
            .collect();
        let hull = parry::shape::SharedShape::convex_hull(&all)?;
        let solid = hull.as_convex_polyhedron()?.faces().len() > D;
        let volume = super::hull::volume(points);
        let missing = (hull.mass_properties(1.0).mass() - volume).abs();
        (solid && missing <= 0.01 * volume).then_some(hull)
    }
}
