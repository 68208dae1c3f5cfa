//! A solid of its own: how large and heavy it is, and how far from others.

use std::sync::Arc;

use crate::math::{Matrix, Vector};
use crate::shape::separation::{Figure, Separation};
use crate::shape::{Geometry, In, Pose, Query, Shape};

/// A convex solid that may stand anywhere. Copies share what was prepared for queries.
#[derive(Debug, Clone)]
pub struct Solid<const D: usize> {
    shape: Shape<D>,
    query: Arc<dyn Query<D>>,
    figure: Arc<Figure<D>>,
    radius: f64,
    volume: f64,
    inertia: Matrix<3>,
}

impl<const D: usize> Solid<D>
where
    In<D>: Geometry<D>,
{
    /// A solid; `None` where none can be made of the shape: in space a convex hull must be about
    /// a thousandth as thick as it is wide, in the plane its points may not lie in line.
    pub fn new(shape: Shape<D>) -> Option<Self> {
        let query = <In<D> as Geometry<D>>::query(&shape)?;
        let figure = Figure::new(&shape)?;
        let (volume, inertia) = query.volume_and_inertia();
        Some(Self {
            radius: radius(&shape),
            shape,
            query: query.into(),
            figure: Arc::new(figure),
            volume,
            inertia,
        })
    }

    /// The same solid with its centroid at the origin of its frame. Only hulls can have
    /// theirs elsewhere.
    pub fn centered(self) -> Option<Self> {
        let centroid = self.query.centroid();
        match self.shape {
            Shape::Convex { points } => Self::new(Shape::Convex {
                points: points.iter().map(|point| point - centroid).collect(),
            }),
            _ => Some(self),
        }
    }
}

impl<const D: usize> Solid<D> {
    /// The shape, in its own frame.
    pub fn shape(&self) -> &Shape<D> {
        &self.shape
    }

    /// Whether it is a ball, which looks the same however it is turned.
    pub fn is_ball(&self) -> bool {
        matches!(self.shape, Shape::Ball { .. })
    }

    /// Radius of the smallest ball about its origin that holds it; infinite for a half-space.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Its volume, or area in the plane; 0 for a half-space.
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Its inertia tensor about its centroid at density 1, in its own frame; in the plane
    /// only the last entry of the diagonal counts.
    pub fn inertia(&self) -> &Matrix<3> {
        &self.inertia
    }

    /// The gap between its surface and another's where they stand so; negative by the depth
    /// of penetration where they overlap: how far the two must be moved apart. Lines that cross
    /// in space are no deeper than the sum of their radii.
    pub fn gap(&self, at: &Pose<D>, other: &Self, other_at: &Pose<D>) -> f64 {
        self.figure.gap(at, &other.figure, other_at)
    }

    /// How it stands to another solid, where the two stand so. The gap is right to rounding of
    /// their size and of the way between them, at any scale.
    pub fn separation(&self, at: &Pose<D>, other: &Self, other_at: &Pose<D>) -> Separation<D> {
        self.figure.separation(at, &other.figure, other_at)
    }

    /// Visits the corners of what its surface and another's share where they touch as `found`: one
    /// point, or several where faces or edges lie flat on each other.
    pub fn spots(
        &self,
        at: &Pose<D>,
        (other, other_at): (&Self, &Pose<D>),
        found: &Separation<D>,
        visit: &mut dyn FnMut(Vector<D>),
    ) {
        let other = (other.figure(), other_at);
        self.figure().spots(at, other, found, visit);
    }

    /// Whether the segment between two points meets it where it stands so.
    pub fn meets(&self, at: &Pose<D>, from: &Vector<D>, to: &Vector<D>) -> bool {
        self.query
            .meets(&at.point_to_local(from), &at.point_to_local(to))
    }

    /// What tells how it stands to others.
    pub(super) fn figure(&self) -> &Figure<D> {
        &self.figure
    }
}

fn radius<const D: usize>(shape: &Shape<D>) -> f64 {
    match shape {
        Shape::Ball { radius } => *radius,
        Shape::Cuboid { half_extents } => half_extents.norm(),
        Shape::Capsule { from, to, radius } => from.norm().max(to.norm()) + radius,
        Shape::HalfSpace { .. } => f64::INFINITY,
        Shape::Segment { from, to } => from.norm().max(to.norm()),
        Shape::Triangle { points } => farthest(points),
        Shape::Convex { points } => farthest(points),
    }
}

fn farthest<const D: usize>(points: &[Vector<D>]) -> f64 {
    points.iter().map(Vector::norm).fold(0.0, f64::max)
}
