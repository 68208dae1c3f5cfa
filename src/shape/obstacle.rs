//! An obstacle: posed parts that agents project themselves onto, fixed or moving.

use std::sync::Arc;

use crate::math::Vector;
use crate::shape::boxes::{Bounds, Boxes};
use crate::shape::parts::Parts;
use crate::shape::projection::Projection;
use crate::shape::{Geometry, In, Motion, Part, Pose, Reach, Shape, Solid, Twist};

/// What stands in the way: one convex part or many, in one rigid frame. Copies share what
/// was prepared for queries.
#[derive(Debug, Clone)]
pub struct Obstacle<const D: usize> {
    /// Name, for reports.
    pub name: String,
    /// Where it stands now.
    pub pose: Pose<D>,
    acting: Acting,
    pub(super) parts: Arc<Parts<D>>,
    /// The outline of parts that are solid together, where their own edges are not it.
    outline: Option<Arc<Parts<D>>>,
    bounds: Bounds<D>,
    moving: Option<Moving<D>>,
}

/// How an obstacle of several parts acts on an agent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Acting {
    /// Every part in range has a β-agent of its own.
    Each,
    /// The nearest point of all parts is the only β-agent.
    Nearest,
}

/// What makes an obstacle move.
#[derive(Debug, Clone)]
struct Moving<const D: usize> {
    motion: Arc<Motion<D>>,
    /// The pose before any motion.
    rest: Pose<D>,
    twist: Twist<D>,
}

impl<const D: usize> Obstacle<D>
where
    In<D>: Geometry<D>,
{
    /// A fixed obstacle of one part; `None` where no solid can be made of the shape, see
    /// [`Part::new`].
    pub fn new(name: String, shape: Shape<D>, pose: Pose<D>) -> Option<Self> {
        Self::of_parts(name, vec![Part::new(shape, None)?], Acting::Each, pose)
    }

    /// A fixed obstacle of some parts; `None` without any.
    pub fn of_parts(
        name: String,
        parts: Vec<Part<D>>,
        acting: Acting,
        pose: Pose<D>,
    ) -> Option<Self> {
        if parts.is_empty() {
            return None;
        }
        let mut obstacle = Self {
            name,
            pose,
            acting,
            parts: Arc::new(Parts::new(parts)),
            outline: None,
            bounds: (Vector::zeros(), Vector::zeros()),
            moving: None,
        };
        obstacle.find_bounds();
        Some(obstacle)
    }

    /// The same, its solid parts taken as one solid with this outline: from inside, agents
    /// are projected on the outline rather than on edges between parts.
    pub fn outlined(self, outline: Vec<Part<D>>) -> Self {
        let outline = (!outline.is_empty()).then(|| Arc::new(Parts::new(outline)));
        Self { outline, ..self }
    }
}

impl<const D: usize> Obstacle<D> {
    /// The same, moving, where it is at time 0.
    pub fn moving(self, motion: Motion<D>) -> Self {
        let (_, twist) = motion.at(&self.pose, 0.0);
        let moving = Moving {
            motion: Arc::new(motion),
            rest: self.pose.clone(),
            twist,
        };
        let mut obstacle = Self {
            moving: Some(moving),
            ..self
        };
        obstacle.move_to(0.0);
        obstacle
    }

    /// Puts it where it is at a time; an obstacle without motion stays.
    pub fn move_to(&mut self, time: f64) {
        let Some(moving) = &mut self.moving else {
            return;
        };
        (self.pose, moving.twist) = moving.motion.at(&moving.rest, time);
        self.find_bounds();
    }

    /// Its motion, where it has one.
    pub fn motion(&self) -> Option<&Motion<D>> {
        self.moving.as_ref().map(|moving| moving.motion.as_ref())
    }

    /// Its velocity now, where it has a motion.
    pub fn twist(&self) -> Option<&Twist<D>> {
        self.moving.as_ref().map(|moving| &moving.twist)
    }

    /// Its parts, in their order.
    pub fn parts(&self) -> &[Part<D>] {
        &self.parts.list
    }

    /// How its parts act.
    pub fn acting(&self) -> Acting {
        self.acting
    }

    /// Whether `point` is within `range` of the obstacle's bounding box: a cheap test
    /// that never misses an obstacle within range.
    pub fn may_reach(&self, point: &Vector<D>, range: f64) -> bool {
        let point = *point;
        self.is_met(&Reach::Around { point, range })
    }

    /// Whether something reaches its bounding box.
    pub(super) fn is_met(&self, reach: &Reach<D>) -> bool {
        let (min, max) = &self.bounds;
        reach.meets(min, max)
    }

    /// Projects a point onto the surface, from outside or inside. Inside, and exactly
    /// on the surface, the normal is that of the nearest part of the surface; where
    /// that is not unique (the centre of a ball) one of the directions is taken. Thin
    /// parts have no inside: the distance from them is never negative.
    ///
    /// Of several parts the nearest counts, or the one in which the point is deepest.
    pub fn project(&self, point: &Vector<D>) -> Projection<D> {
        self.nearest(point).1
    }

    /// The part that [`Obstacle::project`] projects on, by index, and the projection.
    pub fn nearest(&self, point: &Vector<D>) -> (usize, Projection<D>) {
        let local = self.pose.point_to_local(point);
        let (part, mut projection) = self.parts.nearest(&local);
        let (min, max) = &self.bounds;
        let no_gap = NO_GAP * (local.norm() + (max - min).norm());
        if let Some(outline) = &self.outline
            && projection.distance <= no_gap
        {
            let (_, edge) = outline.nearest(&local);
            if edge.distance > no_gap {
                projection = Projection {
                    normal: -edge.normal,
                    distance: -edge.distance,
                    ..edge
                };
            }
        }
        (part, self.in_world(point, projection))
    }

    /// The projections that act on an agent at most `range` away: of an obstacle of one
    /// part, or that acts by its nearest point, the only one; otherwise that on each part
    /// in range, in their order. Each comes with the index of its part.
    pub fn projections<'a>(
        &'a self,
        point: &Vector<D>,
        range: f64,
    ) -> impl Iterator<Item = (usize, Projection<D>)> + use<'a, D> {
        let point = *point;
        let single = self.parts.list.len() == 1 || self.acting == Acting::Nearest;
        let one = single.then(|| self.nearest(&point));
        let each = (!single).then(|| {
            let local = self.pose.point_to_local(&point);
            let each = self.parts.within(local, range);
            each.map(move |(part, projection)| (part, self.in_world(&point, projection)))
        });
        one.into_iter()
            .filter(move |(_, it)| it.distance <= range)
            .chain(each.into_iter().flatten())
    }

    fn in_world(&self, point: &Vector<D>, local: Projection<D>) -> Projection<D> {
        let projection = local.to_world(&self.pose);
        match &self.moving {
            None => projection,
            Some(moving) => projection.carried(point, &moving.twist),
        }
    }

    /// The gap between its surface and that of a solid at `pose`; negative by the depth of
    /// penetration where they overlap. Of several parts the nearest counts.
    pub fn gap(&self, solid: &Solid<D>, pose: &Pose<D>) -> f64 {
        let center = self.pose.point_to_local(&pose.translation);
        self.parts.gap(&center, &self.pose, solid, pose)
    }

    /// Calls `visit` with the index of each part that may come within a box, in their order; a few
    /// that do not may be among them.
    pub fn parts_near(&self, bounds: &Bounds<D>, visit: &mut dyn FnMut(usize)) {
        let (min, max) = *bounds;
        if !self.is_met(&Reach::Within { min, max }) {
            return;
        }
        if self.parts.list.len() == 1 {
            return visit(0);
        }
        let middle = self.pose.point_to_local(&(min * 0.5 + max * 0.5));
        let half = (max - min) * 0.5;
        let turned = self.pose.rotation().abs().tr_mul(&half);
        // A hair wider, against rounding.
        let coarse = self.pose.translation.abs() + min.abs().sup(&max.abs());
        let half = turned * (1.0 + 1e-12) + Vector::repeat(coarse.sum() * 1e-14);
        self.parts
            .within_box((middle - half, middle + half))
            .for_each(visit);
    }

    /// The centre b_k of an obstacle of one part: the centroid. `None` for a half-space,
    /// for something thin, and for several parts, which have no centre that must lie in
    /// them.
    pub fn center(&self) -> Option<Vector<D>> {
        let [only] = self.parts() else {
            return None;
        };
        Some(self.pose.point_to_world(&only.center()?))
    }

    /// The point on the way from the centre to the surface along the unit vector
    /// `along`, at the share `offset` of that way: the γ-agent
    /// x_k = b_k + λ_d l_k n_d of Olfati-Saber (2003), Fig. 6, with l_k the distance
    /// from centre to surface. `None` where there is no [centre](Self::center).
    pub fn interior_point(&self, along: &Vector<D>, offset: f64) -> Option<Vector<D>> {
        match self.parts() {
            [_] => self.part_interior_point(0, along, offset),
            _ => None,
        }
    }

    /// The γ-agent of one part, as if it stood alone; `None` for half-spaces and thin
    /// parts.
    pub fn part_interior_point(
        &self,
        part: usize,
        along: &Vector<D>,
        offset: f64,
    ) -> Option<Vector<D>> {
        let part = &self.parts.list[part];
        let center = self.pose.point_to_world(&part.center()?);
        let (min, max) = part.bounds(&self.pose);
        // The signed distance grows along the way out of a convex solid, so halving
        // the interval finds the surface.
        let (mut inside, mut outside) = (0.0, (max - min).norm());
        for _ in 0..100 {
            let middle = 0.5 * (inside + outside);
            let place = self.pose.point_to_local(&(center + along * middle));
            if part.project(&place).distance < 0.0 {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        Some(center + along * (offset * 0.5 * (inside + outside)))
    }

    /// Distance from its frame's origin within which all of it lies; infinite for what has
    /// no bounds.
    pub fn reach(&self) -> f64 {
        let (min, max) = &self.bounds;
        let at = &self.pose.translation;
        (max - at).abs().sup(&(min - at).abs()).norm()
    }

    /// A box about each of its parts, where they are now; infinite for what has no bounds.
    pub(crate) fn boxes_of_parts(&self) -> impl Iterator<Item = Bounds<D>> {
        self.parts().iter().map(|part| part.bounds(&self.pose))
    }

    /// Finds the bounds at the present pose.
    fn find_bounds(&mut self) {
        self.bounds = self.parts.bounds(&self.pose);
    }
}

impl<const D: usize> Boxes<D> {
    /// Takes the bounding boxes of some obstacles, where they are now.
    pub(crate) fn about(&mut self, obstacles: &[Obstacle<D>]) {
        match obstacles.first() {
            None => *self = Self::default(),
            Some(first) => {
                let boxes = obstacles.iter().map(|obstacle| obstacle.bounds);
                self.follow(boxes, first.parts.plant);
            }
        }
    }
}

/// Share of its coordinates and of the obstacle's size within which a point counts as lying on the edge between two
/// parts: far above rounding, far below anything a law could notice.
const NO_GAP: f64 = 1e-8;
