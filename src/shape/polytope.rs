//! Corners, edges and faces of what shapes are roundings of.

use std::collections::BTreeMap;

use crate::math::{Matrix, Vector, direction};
use crate::shape::{Shape, hull};

/// A point, a segment, a polygon, a facet or a polyhedron about its middle.
#[derive(Debug, Clone)]
pub(super) struct Polytope<const D: usize> {
    /// Its middle, in the shape's frame. All else is told from there, so that what lies far from
    /// its frame's origin is as sharp as what lies there.
    pub(super) middle: Vector<D>,
    /// The farthest of it from its middle.
    pub(super) size: f64,
    /// The corners.
    pub(super) corners: Vec<Vector<D>>,
    /// The edges; in the plane none, for there they are the faces.
    pub(super) edges: Vec<Edge<D>>,
    /// The faces. What is flat has its face twice, once for each side.
    pub(super) faces: Vec<Side<D>>,
}

/// An edge of a polytope in space.
#[derive(Debug, Clone)]
pub(super) struct Edge<const D: usize> {
    /// The corners that it joins.
    pub(super) ends: [u32; 2],
    /// The unit vector from the first to the second.
    pub(super) along: Vector<D>,
    /// The normals of the faces that meet there, where two do.
    pub(super) normals: Option<[Vector<D>; 2]>,
}

/// A face of a polytope.
#[derive(Debug, Clone)]
pub(super) struct Side<const D: usize> {
    /// Unit normal, pointing out.
    pub(super) normal: Vector<D>,
    /// Its corners, in order round it.
    pub(super) corners: Vec<u32>,
}

impl<const D: usize> Polytope<D> {
    /// The core of a shape; `None` for a half-space, and where the points of a hull span no space.
    pub(super) fn new(shape: &Shape<D>) -> Option<Self> {
        Some(match shape {
            Shape::Ball { .. } => Self::of(vec![Vector::zeros()], Vec::new()),
            Shape::Capsule { from, to, .. } | Shape::Segment { from, to } => {
                Self::of(vec![*from, *to], vec![vec![0, 1], vec![1, 0]])
            }
            Shape::Cuboid { half_extents } if D == 2 => {
                let corner = |x: f64, y: f64| {
                    Vector::from_fn(|k, _| half_extents[k] * if k == 0 { x } else { y })
                };
                let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
                let corners = corners.map(|(x, y)| corner(x, y));
                Self::of(corners.to_vec(), around(4))
            }
            Shape::Cuboid { half_extents } => {
                let corner = |bits: usize| {
                    Vector::from_fn(|k, _| match bits >> k & 1 {
                        0 => -half_extents[k],
                        _ => half_extents[k],
                    })
                };
                Self::of((0..8).map(corner).collect(), quads())
            }
            Shape::Triangle { points } if D == 3 => {
                Self::of(points.to_vec(), vec![vec![0, 1, 2], vec![2, 1, 0]])
            }
            Shape::Triangle { points } => Self::hull(points)?,
            Shape::Convex { points } => Self::hull(points)?,
            Shape::HalfSpace { .. } => return None,
        })
    }

    fn hull(points: &[Vector<D>]) -> Option<Self> {
        if D == 2 {
            let corners = hull::corners(points);
            let count = corners.len();
            let corners: Vec<_> = corners.into_iter().map(|i| points[i]).collect();
            return (count > 2).then(|| Self::of(corners, around(count)));
        }
        let triangles = hull::triangles(points);
        let mut used: Vec<usize> = triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let place = |i: &usize| used.binary_search(i).unwrap_or(0) as u32;
        let faces = triangles.iter();
        let faces: Vec<Vec<u32>> = faces.map(|face| face.iter().map(place).collect()).collect();
        let corners = used.iter().map(|&i| points[i]).collect();
        (!faces.is_empty()).then(|| Self::of(corners, faces))
    }

    /// From its corners and, for each face, theirs in order: in the plane from edge to edge
    /// counterclockwise, in space counterclockwise seen from outside.
    fn of(corners: Vec<Vector<D>>, faces: Vec<Vec<u32>>) -> Self {
        let low = corners.iter().fold(corners[0], |low, it| low.inf(it));
        let high = corners.iter().fold(corners[0], |high, it| high.sup(it));
        let middle = low * 0.5 + high * 0.5;
        // Directions are those between the corners as given: what is moved is rounded.
        let given = corners;
        let corners: Vec<_> = given.iter().map(|it| it - middle).collect();
        let size = corners.iter().map(|it| it.norm()).fold(0.0, f64::max);
        let at = |i: u32| given[i as usize];
        let mut edges: Vec<Edge<D>> = Vec::new();
        let mut place: BTreeMap<[u32; 2], usize> = BTreeMap::new();
        let mut sides: Vec<Side<D>> = Vec::new();
        for face in faces {
            if D == 3 {
                let normal = normal_of(&given, &face);
                for (k, &from) in face.iter().enumerate() {
                    let to = face[(k + 1) % face.len()];
                    // The neighbour has it the other way round.
                    if let Some(&known) = place.get(&[to, from]) {
                        let edge: &mut Edge<D> = &mut edges[known];
                        edge.normals = edge.normals.map(|[first, _]| [first, normal]);
                        continue;
                    }
                    place.insert([from, to], edges.len());
                    edges.push(Edge {
                        ends: [from, to],
                        along: direction(&(at(to) - at(from))),
                        normals: (corners.len() > 3).then_some([normal, normal]),
                    });
                }
                if corners.len() > 2 {
                    sides.push(Side {
                        normal,
                        corners: face,
                    });
                }
            } else {
                let along = direction(&(at(face[1]) - at(face[0])));
                sides.push(Side {
                    normal: right(&along),
                    corners: face,
                });
            }
        }
        Self {
            middle,
            size,
            edges,
            faces: sides,
            corners,
        }
    }

    /// Whether it has no inside.
    pub(super) fn is_thin(&self) -> bool {
        self.corners.len() <= D
    }

    /// A corner.
    pub(super) fn at(&self, index: u32) -> Vector<D> {
        self.corners[index as usize]
    }

    /// The corner farthest along a direction, and how far that is.
    #[inline]
    pub(super) fn farthest(&self, along: &Vector<D>) -> (u32, f64) {
        let (mut best, mut far) = (0, f64::NEG_INFINITY);
        for (i, corner) in self.corners.iter().enumerate() {
            let height = corner.dot(along);
            if height > far {
                (best, far) = (i as u32, height);
            }
        }
        (best, far)
    }
}

/// The way to the right of a direction in the plane.
pub(super) fn right<const D: usize>(along: &Vector<D>) -> Vector<D> {
    Vector::from_fn(|k, _| if k == 0 { along[1] } else { -along[0] })
}

/// The cross product in space; zero in the plane.
pub(super) fn cross<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
    if D != 3 {
        return Vector::zeros();
    }
    let entry = |k: usize| {
        let (i, j) = ((k + 1) % D, (k + 2) % D);
        a[i] * b[j] - a[j] * b[i]
    };
    Vector::from_fn(|k, _| entry(k))
}

/// A unit vector across another.
pub(super) fn across<const D: usize>(along: &Vector<D>) -> Vector<D> {
    let basis = crate::math::axis(along.iamin());
    direction(&(basis - along * along.dot(&basis)))
}

/// The unit normal of a face in space, right to rounding however thin the face is.
fn normal_of<const D: usize>(corners: &[Vector<D>], face: &[u32]) -> Vector<D> {
    let [a, b, c] = [0, 1, 2].map(|k| corners[face[k % face.len()] as usize]);
    let entry = |k: usize| {
        let (i, j) = ((k + 1) % D, (k + 2) % D);
        let way = |to: &Vector<D>, axis: usize| Double::difference(to[axis], a[axis]);
        let first = way(&b, i).times(&way(&c, j));
        let second = way(&b, j).times(&way(&c, i));
        first.less(&second)
    };
    direction(&Vector::from_fn(|k, _| entry(k)))
}

/// A number as the sum of two, of twice the digits.
#[derive(Debug, Clone, Copy)]
struct Double(f64, f64);

impl Double {
    /// The difference of two numbers, exactly.
    fn difference(a: f64, b: f64) -> Self {
        let sum = a - b;
        let part = sum - a;
        Self(sum, (a - (sum - part)) - (b + part))
    }

    fn times(&self, other: &Self) -> Self {
        let product = self.0 * other.0;
        let rest = self.0.mul_add(other.0, -product);
        Self(product, rest + (self.0 * other.1 + self.1 * other.0))
    }

    fn less(&self, other: &Self) -> f64 {
        let Self(high, low) = Self::difference(self.0, other.0);
        high + (low + (self.1 - other.1))
    }
}

/// The edges of a polygon.
fn around(count: usize) -> Vec<Vec<u32>> {
    let count = count as u32;
    (0..count).map(|k| vec![k, (k + 1) % count]).collect()
}

/// The faces of a box whose corner `i` has the signs of the bits of `i`.
fn quads() -> Vec<Vec<u32>> {
    let face = |axis: u32, high: bool| {
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let base = if high { 1 << axis } else { 0 };
        let round = [base, base + u, base + u + v, base + v];
        match high {
            true => round.to_vec(),
            false => round.into_iter().rev().collect(),
        }
    };
    (0..3)
        .flat_map(|axis| [face(axis, false), face(axis, true)])
        .collect()
}

/// The other polytope's frame, seen from the one's, both about their middles.
pub(super) struct Stand<const D: usize> {
    pub(super) turn: Matrix<D>,
    pub(super) shift: Vector<D>,
}

impl<const D: usize> Stand<D> {
    /// A point of the other frame.
    pub(super) fn point(&self, point: &Vector<D>) -> Vector<D> {
        self.turn * point + self.shift
    }

    /// A direction of the other frame.
    pub(super) fn vector(&self, vector: &Vector<D>) -> Vector<D> {
        self.turn * vector
    }

    /// A direction of the one's frame, in the other's.
    pub(super) fn back(&self, vector: &Vector<D>) -> Vector<D> {
        self.turn.tr_mul(vector)
    }
}
