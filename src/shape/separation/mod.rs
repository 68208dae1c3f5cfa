//! How two convex things stand to each other: exactly, by their corners, edges and faces.
//!
//! A search in the manner of Gilbert, Johnson and Keerthi tells which features are nearest; these
//! are then measured in closed form, and the result is proven: along its normal nothing of the
//! one lies nearer to the other. Where that fails, all features are measured. What overlaps is
//! judged by the normals of all faces and pairs of edges. Nothing here compares a length with a
//! number, so the same two things at another scale have the same answer at that scale.

mod features;
mod pair;
mod patch;
mod point;
mod simplex;

use crate::math::Vector;
use crate::shape::polytope::{Polytope, Stand};
use crate::shape::{Bounds, Pose, Shape};
use pair::{Found, Pair};
pub(super) use point::{Feature, Foot, foot};

/// How a solid stands to something else.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation<const D: usize> {
    /// The gap between the surfaces; below 0 the depth: how far the two must be moved apart.
    pub gap: f64,
    /// The unit vector from the first to the second along which they are apart, or along which
    /// they come apart soonest; where they touch, that of the faces or edges that do.
    pub normal: Vector<D>,
    /// The nearest points of the surfaces of the first and of the second, or the deepest; where
    /// faces or edges lie flat on each other, the middle of what they share.
    pub points: [Vector<D>; 2],
}

/// A convex thing: a polytope or a half-space, rounded by a radius.
#[derive(Debug, Clone)]
pub(super) struct Figure<const D: usize> {
    core: Core<D>,
    radius: f64,
}

#[derive(Debug, Clone)]
enum Core<const D: usize> {
    Polytope(Polytope<D>),
    /// All behind the plane through the origin with this normal.
    HalfSpace(Vector<D>),
}

impl<const D: usize> Figure<D> {
    /// The figure of a shape; `None` where the points of a hull span no space.
    pub(super) fn new(shape: &Shape<D>) -> Option<Self> {
        let radius = match shape {
            Shape::Ball { radius } | Shape::Capsule { radius, .. } => *radius,
            _ => 0.0,
        };
        let core = match shape {
            Shape::HalfSpace { normal } => Core::HalfSpace(*normal),
            _ => Core::Polytope(Polytope::new(shape)?),
        };
        Some(Self { core, radius })
    }

    /// The point of its surface nearest to a point of its frame.
    pub(super) fn foot(&self, point: &Vector<D>) -> Foot<D> {
        let foot = match &self.core {
            Core::Polytope(it) => {
                let foot = foot(it, &(point - it.middle));
                Foot {
                    point: it.middle + foot.point,
                    ..foot
                }
            }
            Core::HalfSpace(normal) => {
                let distance = normal.dot(point);
                Foot {
                    distance,
                    point: point - normal * distance,
                    normal: *normal,
                    on: Feature::Face(*normal),
                }
            }
        };
        Foot {
            distance: foot.distance - self.radius,
            point: foot.point + foot.normal * self.radius,
            ..foot
        }
    }

    /// Lowest and highest corner of its box where it stands so.
    pub(super) fn bounds(&self, at: &Pose<D>) -> Bounds<D> {
        let Core::Polytope(it) = &self.core else {
            let far = Vector::repeat(f64::INFINITY);
            return (-far, far);
        };
        let middle = at.point_to_world(&it.middle);
        let corners = it.corners.iter().map(|corner| at.vector_to_world(corner));
        let (low, high) = corners.fold((middle, middle), |(low, high), corner| {
            (low.inf(&(middle + corner)), high.sup(&(middle + corner)))
        });
        let radius = Vector::repeat(self.radius);
        (low - radius, high + radius)
    }

    /// The farthest of it from the middle of its core; 0 for a half-space.
    pub(super) fn size(&self) -> f64 {
        match &self.core {
            Core::Polytope(it) => it.size + self.radius,
            Core::HalfSpace(_) => 0.0,
        }
    }

    /// The gap to another.
    pub(super) fn gap(&self, at: &Pose<D>, other: &Self, other_at: &Pose<D>) -> f64 {
        self.separation(at, other, other_at).gap
    }

    /// How it stands to another.
    pub(super) fn separation(
        &self,
        at: &Pose<D>,
        other: &Self,
        other_at: &Pose<D>,
    ) -> Separation<D> {
        let found = match (&self.core, &other.core) {
            (Core::Polytope(one), Core::Polytope(two)) => between(one, at, two, other_at),
            (Core::Polytope(one), Core::HalfSpace(normal)) => {
                turned_round(above(normal, other_at, one, at))
            }
            (Core::HalfSpace(normal), Core::Polytope(two)) => above(normal, at, two, other_at),
            (Core::HalfSpace(normal), Core::HalfSpace(_)) => Separation {
                gap: f64::NEG_INFINITY,
                normal: at.vector_to_world(normal),
                points: [at.translation, other_at.translation],
            },
        };
        let [one, two] = found.points;
        Separation {
            gap: found.gap - self.radius - other.radius,
            normal: found.normal,
            points: [
                one + found.normal * self.radius,
                two - found.normal * other.radius,
            ],
        }
    }
}

impl<const D: usize> Figure<D> {
    /// Visits the corners of what its surface and another's share where they touch with this
    /// normal: one point, or several where faces or edges lie flat on each other. Its own
    /// surface's points are told, in the world.
    pub(super) fn spots(
        &self,
        at: &Pose<D>,
        (other, other_at): (&Self, &Pose<D>),
        found: &Separation<D>,
        visit: &mut dyn FnMut(Vector<D>),
    ) {
        let (rounding, normal) = (found.normal * self.radius, found.normal);
        let mut count = 0;
        let mut tell = |point: Vector<D>| {
            count += 1;
            visit(point + rounding);
        };
        match (&self.core, &other.core) {
            (Core::Polytope(one), Core::Polytope(two)) => {
                let along = at.vector_to_local(&normal);
                let pair = Pair::new(one, two, stand(one, at, two, other_at));
                let world = |point: Vector<D>| at.point_to_world(&(one.middle + point));
                patch::corners(&pair, &along, &mut |point| tell(world(point)));
            }
            (Core::Polytope(one), Core::HalfSpace(_)) => {
                let along = at.vector_to_local(&normal);
                let world = |point: Vector<D>| at.point_to_world(&(one.middle + point));
                patch::farthest_corners(one, &along, &mut |point| tell(world(point)));
            }
            _ => {}
        }
        if count == 0 {
            visit(found.points[0]);
        }
    }
}

/// How a polytope stands to another.
fn stand<const D: usize>(
    one: &Polytope<D>,
    at: &Pose<D>,
    other: &Polytope<D>,
    other_at: &Pose<D>,
) -> Stand<D> {
    let middle = |of: &Polytope<D>, at: &Pose<D>| at.vector_to_world(&of.middle);
    let way = (other_at.translation - at.translation) + (middle(other, other_at) - middle(one, at));
    Stand {
        turn: at.rotation().tr_mul(other_at.rotation()),
        shift: at.vector_to_local(&way),
    }
}

/// Two polytopes.
fn between<const D: usize>(
    one: &Polytope<D>,
    at: &Pose<D>,
    other: &Polytope<D>,
    other_at: &Pose<D>,
) -> Separation<D> {
    let stand = stand(one, at, other, other_at);
    let Found {
        gap,
        normal,
        points,
    } = Pair::new(one, other, stand).solve();
    let world = |point: Vector<D>| at.point_to_world(&(one.middle + point));
    Separation {
        gap,
        normal: at.vector_to_world(&normal),
        points: points.map(world),
    }
}

/// A half-space and a polytope.
fn above<const D: usize>(
    normal: &Vector<D>,
    at: &Pose<D>,
    other: &Polytope<D>,
    other_at: &Pose<D>,
) -> Separation<D> {
    let normal = at.vector_to_world(normal);
    let down = -other_at.vector_to_local(&normal);
    let (_, depth) = other.farthest(&down);
    let way = (other_at.translation - at.translation) + other_at.vector_to_world(&other.middle);
    let gap = way.dot(&normal) - depth;
    let lowest = other_at.point_to_world(&(other.middle + patch::farthest(other, &down)));
    Separation {
        gap,
        normal,
        points: [lowest - normal * gap, lowest],
    }
}

fn turned_round<const D: usize>(it: Separation<D>) -> Separation<D> {
    let [one, other] = it.points;
    Separation {
        gap: it.gap,
        normal: -it.normal,
        points: [other, one],
    }
}
