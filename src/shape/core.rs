//! Cores: what shapes are roundings of, and the projection onto each kind.

use crate::math::{Matrix, Vector, axis, direction};
use crate::shape::facet::Facet;
use crate::shape::projection::Projection;
use crate::shape::separation::{Feature, Figure, Foot};
use crate::shape::{Query, Shape};

/// What a shape is a rounding of, in its own frame.
#[derive(Debug, Clone)]
pub(super) enum Core<const D: usize> {
    /// A point or a segment, with the radius about it.
    Thin { radius: f64, axis: Option<Axis<D>> },
    /// A box about the origin, by half its sides.
    Block(Vector<D>),
    /// A triangle in space.
    Facet(Facet<D>),
    /// A polytope or a half-space: what its figure tells.
    Figure,
}

/// The segment inside a capsule.
#[derive(Debug, Clone)]
pub(super) struct Axis<const D: usize> {
    from: Vector<D>,
    direction: Vector<D>,
    length: f64,
}

impl<const D: usize> Core<D> {
    /// The core of a shape.
    pub(super) fn new(shape: &Shape<D>) -> Self {
        let segment = |from: &Vector<D>, to: &Vector<D>, radius: f64| Self::Thin {
            radius,
            axis: Some(Axis {
                from: *from,
                direction: direction(&(to - from)),
                length: (to - from).norm(),
            }),
        };
        match shape {
            Shape::Ball { radius } => Self::Thin {
                radius: *radius,
                axis: None,
            },
            Shape::Capsule { from, to, radius } => segment(from, to, *radius),
            Shape::Segment { from, to } => segment(from, to, 0.0),
            Shape::Cuboid { half_extents } => Self::Block(*half_extents),
            Shape::Triangle { points } if D == 3 => Self::Facet(Facet::new(*points)),
            Shape::HalfSpace { .. } | Shape::Convex { .. } | Shape::Triangle { .. } => Self::Figure,
        }
    }

    /// Projects a point of the shape's frame.
    pub(super) fn project(
        &self,
        q: &Vector<D>,
        query: &dyn Query<D>,
        figure: &Figure<D>,
    ) -> Projection<D> {
        match self {
            Self::Thin { radius, axis } => thin(q, &query.closest(q), *radius, axis.as_ref()),
            Self::Block(half) => block(q, half),
            Self::Facet(facet) => facet.project(q),
            Self::Figure => flat(figure.foot(q)),
        }
    }
}

/// Projection onto a polytope, by the nearest point of it.
fn flat<const D: usize>(foot: Foot<D>) -> Projection<D> {
    Projection {
        point: foot.point,
        normal: foot.normal,
        // Added, for a distance of −0 would puzzle whoever reads it.
        distance: foot.distance + 0.0,
        core_map: match foot.on {
            Feature::Face(normal) => Matrix::identity() - normal * normal.transpose(),
            Feature::Edge(along) => along * along.transpose(),
            Feature::Corner => Matrix::zeros(),
        },
        stretch: 0.0,
        carried: None,
    }
}

/// Projection onto a box.
fn block<const D: usize>(q: &Vector<D>, half: &Vector<D>) -> Projection<D> {
    let outside = q.abs() - half;
    let side = outside.imax();
    let mut point = *q;
    let mut core_map = Matrix::identity();
    // From inside, and on the surface: the nearest face.
    let leaves = |k: usize| match outside[side] > 0.0 {
        true => outside[k] > 0.0,
        false => k == side,
    };
    for k in (0..D).filter(|&k| leaves(k)) {
        point[k] = half[k].copysign(q[k]);
        core_map[(k, k)] = 0.0;
    }
    let out: Vector<D> = axis(side) * 1f64.copysign(q[side]);
    let offset = q - point;
    let reach = offset.norm();
    // So near to the surface that rounding tells the way, the face does.
    let sharp = reach > 1e-13 * half.norm() && outside[side] > 0.0;
    Projection {
        point,
        normal: if sharp { offset / reach } else { out },
        distance: if outside[side] > 0.0 {
            reach
        } else {
            0.0 - reach
        },
        core_map,
        stretch: 0.0,
        carried: None,
    }
}

/// Projection onto a rounded point or segment, `core` being the point of it nearest to `q`.
fn thin<const D: usize>(
    q: &Vector<D>,
    core: &Vector<D>,
    radius: f64,
    axis: Option<&Axis<D>>,
) -> Projection<D> {
    let offset = q - core;
    let reach = offset.norm();
    let normal = if reach > 0.0 {
        offset / reach
    } else {
        across(axis.map(|axis| axis.direction))
    };
    let core_map = match axis {
        Some(axis) => {
            // Judged by `q`: at an end, rounding can put the core point on either side.
            let at = (q - axis.from).dot(&axis.direction);
            if at > 0.0 && at < axis.length {
                axis.direction * axis.direction.transpose()
            } else {
                Matrix::zeros()
            }
        }
        None => Matrix::zeros(),
    };
    Projection {
        point: core + normal * radius,
        normal,
        distance: reach - radius,
        core_map,
        // At the core itself the map has no derivative: the agent's own motion
        // tells nothing about where the surface point goes.
        stretch: if reach > 0.0 { radius / reach } else { 0.0 },
        carried: None,
    }
}

/// A unit vector across `along`, or any where there is none.
fn across<const D: usize>(along: Option<Vector<D>>) -> Vector<D> {
    match along {
        None => axis(0),
        Some(along) => {
            let basis = axis(along.iamin());
            direction(&(basis - along * along.dot(&basis)))
        }
    }
}
