//! An obstacle: a posed shape that agents project themselves onto.

use std::sync::Arc;

use crate::math::{Matrix, Vector, axis, direction};
use crate::shape::{Face, Geometry, In, Pose, Query, Shape, Solid};

/// A fixed convex solid. Copies share what was prepared for queries.
#[derive(Debug, Clone)]
pub struct Obstacle<const D: usize> {
    /// Name, for reports.
    pub name: String,
    /// The solid, in its own frame.
    pub shape: Shape<D>,
    /// Where it stands.
    pub pose: Pose<D>,
    query: Arc<dyn Query<D>>,
    core: Core<D>,
    bounds: (Vector<D>, Vector<D>),
}

/// What the solid is a rounding of, in its own frame.
#[derive(Debug, Clone)]
enum Core<const D: usize> {
    /// A point or a segment, with the radius about it.
    Thin { radius: f64, axis: Option<Axis<D>> },
    /// Flat faces: a polytope or a half-space. A point this near to a face lies on it.
    Flat { faces: Vec<Face<D>>, near: f64 },
}

/// The segment inside a capsule.
#[derive(Debug, Clone)]
struct Axis<const D: usize> {
    from: Vector<D>,
    direction: Vector<D>,
    length: f64,
}

/// The point of an obstacle's surface nearest to an agent, and how it moves with
/// the agent: the β-agent of Olfati-Saber (2003), (53) to (57).
#[derive(Debug, Clone, PartialEq)]
pub struct Projection<const D: usize> {
    /// The surface point q̂.
    pub point: Vector<D>,
    /// Unit normal of the surface there, pointing out of the obstacle.
    pub normal: Vector<D>,
    /// Distance from q to the surface; negative inside.
    pub distance: f64,
    /// Derivative of the closest point of the core, a projector.
    core_map: Matrix<D>,
    /// Radius of the rounding over the distance from the core, 0 without rounding.
    stretch: f64,
}

impl<const D: usize> Projection<D> {
    /// Velocity p̂ of the surface point while the agent moves at `velocity`: the
    /// exact derivative of the closest-point map,
    /// T p + s (I − nnᵀ)(p − T p), with T the projector onto the feature of the core
    /// (face, edge, vertex) and s the stretch of the rounding. For a ball it is
    /// (56), s(I − nnᵀ)p; for a flat face (I − nnᵀ)p.
    pub fn velocity(&self, velocity: &Vector<D>) -> Vector<D> {
        let along = self.core_map * velocity;
        let across = velocity - along;
        along + (across - self.normal * self.normal.dot(&across)) * self.stretch
    }
}

/// Share of a polytope's size within which a point counts as lying on a face: far
/// above the error of the query, far below anything a law could notice.
const ON_FACE: f64 = 1e-8;

impl<const D: usize> Obstacle<D>
where
    In<D>: Geometry<D>,
{
    /// An obstacle; `None` where no solid can be made of the shape: a convex hull must be
    /// about a thousandth as thick as it is wide.
    pub fn new(name: String, shape: Shape<D>, pose: Pose<D>) -> Option<Self> {
        let query = <In<D> as Geometry<D>>::query(&shape)?;
        let core = match &shape {
            Shape::Ball { radius } => Core::Thin {
                radius: *radius,
                axis: None,
            },
            Shape::Capsule { from, to, radius } => Core::Thin {
                radius: *radius,
                axis: Some(Axis {
                    from: *from,
                    direction: direction(&(to - from)),
                    length: (to - from).norm(),
                }),
            },
            Shape::Cuboid { half_extents } => Core::Flat {
                faces: query.faces(),
                near: ON_FACE * half_extents.norm(),
            },
            Shape::HalfSpace { .. } => Core::Flat {
                faces: query.faces(),
                near: ON_FACE,
            },
            Shape::Convex { points } => hull(points, query.faces())?,
        };
        let bounds = query.bounds(&pose);
        Some(Self {
            name,
            shape,
            pose,
            query: query.into(),
            core,
            bounds,
        })
    }
}

impl<const D: usize> Obstacle<D> {
    /// Whether `point` is within `range` of the obstacle's bounding box: a cheap test
    /// that never misses an obstacle within range.
    pub fn may_reach(&self, point: &Vector<D>, range: f64) -> bool {
        let (min, max) = &self.bounds;
        (0..D).all(|k| point[k] >= min[k] - range && point[k] <= max[k] + range)
    }

    /// Projects a point onto the surface, from outside or inside. Inside, and exactly
    /// on the surface, the normal is that of the nearest part of the surface; where
    /// that is not unique (the centre of a ball) one of the directions is taken.
    pub fn project(&self, point: &Vector<D>) -> Projection<D> {
        let local = self.pose.point_to_local(point);
        let projection = match &self.core {
            Core::Thin { radius, axis } => {
                thin(&local, &self.query.closest(&local), *radius, axis.as_ref())
            }
            Core::Flat { faces, near } => self.flat(&local, faces, *near),
        };
        Projection {
            point: self.pose.point_to_world(&projection.point),
            normal: self.pose.vector_to_world(&projection.normal),
            core_map: self.pose.map_to_world(&projection.core_map),
            ..projection
        }
    }

    fn flat(&self, q: &Vector<D>, faces: &[Face<D>], near: f64) -> Projection<D> {
        let height = |face: &Face<D>| face.normal.dot(q) - face.offset;
        let nearest = faces
            .iter()
            .max_by(|a, b| height(a).total_cmp(&height(b)))
            .expect("checked when the obstacle was made");
        if height(nearest) <= near {
            // Inside, or on the surface: the nearest face, as if it had no end.
            return onto(q, std::slice::from_ref(&nearest), nearest.normal);
        }
        let closest = self.query.closest(q);
        let mut touched: Vec<&Face<D>> = faces
            .iter()
            .filter(|face| (face.normal.dot(&closest) - face.offset).abs() <= near)
            .collect();
        if touched.is_empty() {
            touched.push(nearest);
        }
        onto(q, &touched, nearest.normal)
    }

    /// The gap between its surface and that of a solid at `pose`; negative by the depth of
    /// penetration where they overlap.
    pub fn gap(&self, solid: &Solid<D>, pose: &Pose<D>) -> f64 {
        self.query.gap(&self.pose, solid.query(), pose)
    }

    /// The centre b_k: the centroid; `None` for a half-space, which has none.
    pub fn center(&self) -> Option<Vector<D>> {
        match self.shape {
            Shape::HalfSpace { .. } => None,
            _ => Some(self.pose.point_to_world(&self.query.centroid())),
        }
    }

    /// The point on the way from the centre to the surface along the unit vector
    /// `along`, at the share `offset` of that way: the γ-agent
    /// x_k = b_k + λ_d l_k n_d of Olfati-Saber (2003), Fig. 6, with l_k the distance
    /// from centre to surface. `None` for a half-space.
    pub fn interior_point(&self, along: &Vector<D>, offset: f64) -> Option<Vector<D>> {
        let center = self.center()?;
        let (min, max) = &self.bounds;
        // The signed distance grows along the way out of a convex solid, so halving
        // the interval finds the surface.
        let (mut inside, mut outside) = (0.0, (max - min).norm());
        for _ in 0..100 {
            let middle = 0.5 * (inside + outside);
            if self.project(&(center + along * middle)).distance < 0.0 {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        Some(center + along * (offset * 0.5 * (inside + outside)))
    }
}

/// Whether a hull with these faces, made of these points, is a solid.
pub(super) fn is_solid<const D: usize>(points: &[Vector<D>], faces: Vec<Face<D>>) -> bool {
    hull(points, faces).is_some()
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
