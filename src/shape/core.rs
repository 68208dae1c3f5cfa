//! Cores: what shapes are roundings of, and the projection onto each kind.

use crate::math::{Matrix, Vector, axis, direction};
use crate::shape::facet::Facet;
use crate::shape::projection::Projection;
use crate::shape::{Face, Query, Shape};

/// What a shape is a rounding of, in its own frame.
#[derive(Debug, Clone)]
pub(super) enum Core<const D: usize> {
    /// A point or a segment, with the radius about it.
    Thin { radius: f64, axis: Option<Axis<D>> },
    /// Flat faces: a polytope or a half-space. A point this near to a face lies on it.
    Flat { faces: Vec<Face<D>>, near: f64 },
    /// A triangle in space.
    Facet(Facet<D>),
}

/// The segment inside a capsule.
#[derive(Debug, Clone)]
pub(super) struct Axis<const D: usize> {
    from: Vector<D>,
    direction: Vector<D>,
    length: f64,
}

/// Share of a polytope's size within which a point counts as lying on a face: far
/// above the error of the query, far below anything a law could notice.
const ON_FACE: f64 = 1e-8;

impl<const D: usize> Core<D> {
    /// The core of a shape; `None` where no solid can be made of it.
    pub(super) fn new(shape: &Shape<D>, query: &dyn Query<D>) -> Option<Self> {
        let segment = |from: &Vector<D>, to: &Vector<D>, radius: f64| Self::Thin {
            radius,
            axis: Some(Axis {
                from: *from,
                direction: direction(&(to - from)),
                length: (to - from).norm(),
            }),
        };
        Some(match shape {
            Shape::Ball { radius } => Self::Thin {
                radius: *radius,
                axis: None,
            },
            Shape::Capsule { from, to, radius } => segment(from, to, *radius),
            Shape::Segment { from, to } => segment(from, to, 0.0),
            Shape::Cuboid { half_extents } => Self::Flat {
                faces: query.faces(),
                near: ON_FACE * half_extents.norm(),
            },
            Shape::HalfSpace { .. } => Self::Flat {
                faces: query.faces(),
                near: ON_FACE,
            },
            Shape::Convex { points } => hull(points, query.faces())?,
            Shape::Triangle { points } if D == 2 => hull(points, query.faces())?,
            Shape::Triangle { points } => Self::Facet(Facet::new(*points)),
        })
    }

    /// Projects a point of the shape's frame.
    pub(super) fn project(&self, q: &Vector<D>, query: &dyn Query<D>) -> Projection<D> {
        match self {
            Self::Thin { radius, axis } => thin(q, &query.closest(q), *radius, axis.as_ref()),
            Self::Flat { faces, near } => flat(q, query, faces, *near),
            Self::Facet(facet) => facet.project(q),
        }
    }
}

/// The edges of a triangle in the plane, given by its first two coordinates.
pub(super) fn triangle_faces<const D: usize>(corners: &[Vector<D>; 3]) -> Vec<Face<D>> {
    (0..3)
        .map(|k| {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            let along = direction(&(to - from));
            let mut normal = Vector::<D>::zeros();
            normal[0] = along[1];
            normal[1] = -along[0];
            // Away from the corner across, whichever way round the triangle is given.
            if normal.dot(&(corners[(k + 2) % 3] - from)) > 0.0 {
                normal = -normal;
            }
            Face {
                normal,
                offset: normal.dot(&from),
            }
        })
        .collect()
}

fn flat<const D: usize>(
    q: &Vector<D>,
    query: &dyn Query<D>,
    faces: &[Face<D>],
    near: f64,
) -> Projection<D> {
    let height = |face: &Face<D>| face.normal.dot(q) - face.offset;
    let nearest = faces
        .iter()
        .max_by(|a, b| height(a).total_cmp(&height(b)))
        .expect("checked when the obstacle was made");
    if height(nearest) <= near {
        // Inside, or on the surface: the nearest face, as if it had no end.
        return onto(q, std::slice::from_ref(&nearest), nearest.normal);
    }
    let closest = query.closest(q);
    let mut touched: Vec<&Face<D>> = faces
        .iter()
        .filter(|face| (face.normal.dot(&closest) - face.offset).abs() <= near)
        .collect();
    if touched.is_empty() {
        touched.push(nearest);
    }
    onto(q, &touched, nearest.normal)
}

/// The core of a hull; `None` where the query made something flat of it, which it does with
/// thin ones: a polytope has more faces than dimensions, and all points behind each.
fn hull<const D: usize>(points: &[Vector<D>], faces: Vec<Face<D>>) -> Option<Core<D>> {
    let first = points.first()?;
    let largest = |size: fn(&Vector<D>, &Vector<D>) -> f64| {
        points.iter().map(|p| size(p, first)).fold(0.0, f64::max)
    };
    let spread = largest(|p, first| (p - first).norm());
    // Far from the origin, rounding outgrows the share of the size.
    let near = ON_FACE * spread + 16.0 * f64::EPSILON * largest(|p, _| p.norm());
    let behind = |face: &Face<D>| {
        let height = |p: &Vector<D>| face.normal.dot(p) - face.offset;
        points.iter().all(|p| height(p) <= 100.0 * near)
    };
    (faces.len() > D && faces.iter().all(behind)).then_some(Core::Flat { faces, near })
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

/// Projection onto the intersection of some faces' planes, which is the feature of
/// the polytope (face, edge or vertex) that a query found. `fallback` is the normal
/// to use on the feature itself.
fn onto<const D: usize>(q: &Vector<D>, faces: &[&Face<D>], fallback: Vector<D>) -> Projection<D> {
    let mut core_map = Matrix::identity();
    let mut point = *q;
    for face in faces {
        // Step within the planes already met, so that they stay met.
        let step = core_map * face.normal;
        let length = step.norm_squared();
        if length > 1e-12 {
            point -= step * ((face.normal.dot(&point) - face.offset) / length);
            core_map -= step * step.transpose() / length;
        }
    }
    let offset = q - point;
    let reach = offset.norm();
    let outside = offset.dot(&fallback) > 0.0;
    let single = faces.len() == 1;
    let normal = if single || reach == 0.0 {
        fallback
    } else {
        offset / reach
    };
    Projection {
        point,
        normal,
        // Subtracted, for a distance of −0 would puzzle whoever reads it.
        distance: if outside { reach } else { 0.0 - reach },
        core_map,
        stretch: 0.0,
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
