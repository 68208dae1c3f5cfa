//! A part: one convex piece of an obstacle.

use std::sync::Arc;

use crate::math::Vector;
use crate::shape::core::Core;
use crate::shape::projection::Projection;
use crate::shape::separation::{Figure, Foot, Separation};
use crate::shape::{Geometry, In, Pose, Query, Shape, Solid};

/// A convex piece of an obstacle, in the obstacle's frame. Copies share what was
/// prepared for queries.
#[derive(Debug, Clone)]
pub struct Part<const D: usize> {
    /// The shape, in its own frame.
    pub shape: Shape<D>,
    /// Where it is in the obstacle's frame; absent where the frames are the same.
    pub pose: Option<Pose<D>>,
    query: Arc<dyn Query<D>>,
    core: Core<D>,
    figure: Arc<Figure<D>>,
}

impl<const D: usize> Part<D>
where
    In<D>: Geometry<D>,
{
    /// A part; `None` where no solid can be made of the shape: in space a convex hull must be
    /// about a thousandth as thick as it is wide, in the plane its points may not lie in line.
    pub fn new(shape: Shape<D>, pose: Option<Pose<D>>) -> Option<Self> {
        let query = <In<D> as Geometry<D>>::query(&shape)?;
        let figure = Figure::new(&shape)?;
        Some(Self {
            core: Core::new(&shape),
            shape,
            pose,
            query: query.into(),
            figure: Arc::new(figure),
        })
    }
}

impl<const D: usize> Part<D> {
    /// Projects a point of the obstacle's frame.
    pub(super) fn project(&self, point: &Vector<D>) -> Projection<D> {
        let project = |at: &Vector<D>| self.core.project(at, &*self.query, &self.figure);
        match &self.pose {
            None => project(point),
            Some(pose) => project(&pose.point_to_local(point)).to_world(pose),
        }
    }

    /// The gap to a solid at `pose`, of a part of an obstacle that stands at `here`.
    pub(super) fn gap(&self, here: &Pose<D>, solid: &Solid<D>, pose: &Pose<D>) -> f64 {
        let there = self.world_pose(here);
        solid.figure().gap(pose, &self.figure, &there)
    }

    /// How a solid at `at`, the first, stands to this part, the second, of an obstacle that
    /// stands at `here`.
    pub fn separation(&self, here: &Pose<D>, solid: &Solid<D>, at: &Pose<D>) -> Separation<D> {
        let there = self.world_pose(here);
        solid.figure().separation(at, &self.figure, &there)
    }

    /// The point of its surface nearest to a point of the obstacle's frame, to rounding.
    pub(super) fn foot(&self, point: &Vector<D>) -> Foot<D> {
        match &self.pose {
            None => self.figure.foot(point),
            Some(pose) => {
                let foot = self.figure.foot(&pose.point_to_local(point));
                Foot {
                    point: pose.point_to_world(&foot.point),
                    normal: pose.vector_to_world(&foot.normal),
                    ..foot
                }
            }
        }
    }

    /// How large it is, about.
    pub(super) fn size(&self) -> f64 {
        self.figure.size()
    }

    /// As [`Solid::spots`], of a solid that touches this part of an obstacle which stands at
    /// `here`.
    pub fn spots(
        &self,
        here: &Pose<D>,
        (solid, at): (&Solid<D>, &Pose<D>),
        found: &Separation<D>,
        visit: &mut dyn FnMut(Vector<D>),
    ) {
        let other = (&*self.figure, &self.world_pose(here));
        solid.figure().spots(at, other, found, visit);
    }

    /// Whether the segment between two points of the obstacle's frame meets the part.
    pub(super) fn meets(&self, from: &Vector<D>, to: &Vector<D>) -> bool {
        match &self.pose {
            None => self.query.meets(from, to),
            Some(pose) => {
                let (from, to) = (pose.point_to_local(from), pose.point_to_local(to));
                self.query.meets(&from, &to)
            }
        }
    }

    /// The pose in the world, of a part of an obstacle that stands at `pose`.
    pub fn world_pose(&self, pose: &Pose<D>) -> Pose<D> {
        match &self.pose {
            None => pose.clone(),
            Some(inner) => pose.then(inner),
        }
    }

    /// Lowest and highest corner of the bounding box, of a part of an obstacle that
    /// stands at `pose`.
    pub(super) fn bounds(&self, pose: &Pose<D>) -> (Vector<D>, Vector<D>) {
        let pose = self.world_pose(pose);
        match self.shape {
            Shape::Convex { .. } => self.figure.bounds(&pose),
            _ => self.query.bounds(&pose),
        }
    }

    /// The centroid, in the obstacle's frame; `None` for what has none inside it:
    /// half-spaces and thin parts.
    pub(super) fn center(&self) -> Option<Vector<D>> {
        if !self.shape.is_bounded() || self.shape.is_thin() {
            return None;
        }
        let center = self.query.centroid();
        Some(match &self.pose {
            None => center,
            Some(pose) => pose.point_to_world(&center),
        })
    }
}
