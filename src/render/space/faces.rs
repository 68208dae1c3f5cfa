//! Shapes of space as faces, in pieces small enough to be sorted by distance.

use crate::math::{Vector, axis};
use crate::shape::Shape;

use super::super::extent::hull_of;
use super::super::view::Form;

/// A shape of space, made ready, its faces cut into pieces no wider than `piece`.
pub(in crate::render) fn form(shape: &Shape<3>, piece: f64) -> Form<3> {
    let whole = match shape {
        Shape::Ball { radius } => return Form::Ball(*radius),
        Shape::Capsule { from, to, radius } => {
            return Form::Rod {
                ends: [*from, *to],
                radius: *radius,
            };
        }
        Shape::HalfSpace { normal } => return Form::Ground(*normal),
        Shape::Segment { from, to } => return Form::Line([*from, *to]),
        Shape::Triangle { points } => vec![points.to_vec()],
        Shape::Cuboid { .. } | Shape::Convex { .. } => faces(shape),
    };
    // What is much larger than the scene is not worth millions of pieces.
    let size = |face: &Vec<Vector<3>>| face.iter().map(Vector::amax).fold(0.0, f64::max);
    let piece = whole
        .iter()
        .map(size)
        .fold(piece, |piece, size| piece.max(size / 16.0));
    let mut faces = Vec::new();
    for face in whole {
        cut(face, piece, &mut faces);
    }
    Form::Faces {
        faces,
        thin: shape.is_thin(),
    }
}

/// The faces of a polytope, each by its corners, counter-clockwise seen from outside.
fn faces(shape: &Shape<3>) -> Vec<Vec<Vector<3>>> {
    let (points, _) = hull_of(shape);
    let size = points.iter().map(Vector::norm).fold(0.0, f64::max);
    let mut seen: Vec<Vector<3>> = Vec::new();
    let mut found = Vec::new();
    for face in shape.faces() {
        // Hulls of points may come in triangles, several of which lie in one plane.
        if seen
            .iter()
            .any(|normal| (normal - face.normal).norm() < 1e-6)
        {
            continue;
        }
        seen.push(face.normal);
        let on = |point: &&Vector<3>| (face.normal.dot(point) - face.offset).abs() < 1e-6 * size;
        let corners: Vec<Vector<3>> = points.iter().filter(on).copied().collect();
        found.push(around(corners, &face.normal));
    }
    found
}

/// Points of a plane that are corners of a convex polygon, in order about a normal.
fn around(mut corners: Vec<Vector<3>>, normal: &Vector<3>) -> Vec<Vector<3>> {
    let center = crate::math::mean(&corners);
    let [first, second] = crate::math::plane_across(normal);
    let angle = |corner: &Vector<3>| {
        let way = corner - center;
        way.dot(&second).atan2(way.dot(&first))
    };
    corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    corners
}

/// Cuts a convex polygon into pieces no wider along any axis than `piece`.
fn cut(face: Vec<Vector<3>>, piece: f64, pieces: &mut Vec<Vec<Vector<3>>>) {
    let Some(first) = face.first() else {
        return;
    };
    let (min, max) = face.iter().fold((*first, *first), |(min, max), corner| {
        (min.inf(corner), max.sup(corner))
    });
    let widest = (max - min).imax();
    let wide = (max - min)[widest] > piece;
    if !wide {
        pieces.push(face);
        return;
    }
    let middle = 0.5 * (min[widest] + max[widest]);
    for side in [1.0, -1.0] {
        cut(
            half(&face, &(axis::<3>(widest) * side), middle * side),
            piece,
            pieces,
        );
    }
}

/// The part of a convex polygon where normal · x ≤ offset.
pub(super) fn half(face: &[Vector<3>], normal: &Vector<3>, offset: f64) -> Vec<Vector<3>> {
    let mut part = Vec::new();
    for (k, corner) in face.iter().enumerate() {
        let next = &face[(k + 1) % face.len()];
        let (here, there) = (normal.dot(corner) - offset, normal.dot(next) - offset);
        if here <= 0.0 {
            part.push(*corner);
        }
        if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
            part.push(corner + (next - corner) * (here / (here - there)));
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the area of a polygon, along its normal.
    fn area(face: &[Vector<3>]) -> Vector<3> {
        let pairs = (0..face.len()).map(|k| face[k].cross(&face[(k + 1) % face.len()]));
        pairs.sum()
    }

    #[test]
    fn pieces_make_up_the_faces_and_look_outwards() {
        let half_extents = Vector::<3>::new(1.0, 2.0, 3.0);
        let Form::Faces { faces, thin } = form(&Shape::Cuboid { half_extents }, 0.7) else {
            panic!("a box has faces");
        };
        assert!(!thin);
        let total: f64 = faces.iter().map(|face| 0.5 * area(face).norm()).sum();
        assert!((total - 88.0).abs() < 1e-9, "{total}");
        for face in &faces {
            let center = crate::math::mean(face);
            assert!(center.dot(&area(face)) > 0.0);
            for pair in face.windows(2) {
                assert!((pair[0] - pair[1]).amax() <= 0.7);
            }
        }
    }

    #[test]
    fn hulls_have_the_faces_of_their_planes() {
        let points = (0..8).map(|k: i32| {
            let side = |d: i32| f64::from(k >> d & 1);
            Vector::<3>::new(side(0), side(1), side(2))
        });
        let mut points: Vec<_> = points.collect();
        points.push(Vector::<3>::repeat(0.5));
        let Form::Faces { faces, .. } = form(&Shape::Convex { points }, 10.0) else {
            panic!("a hull has faces");
        };
        assert_eq!(faces.len(), 6);
        let total: f64 = faces.iter().map(|face| 0.5 * area(face).norm()).sum();
        assert!((total - 6.0).abs() < 1e-9, "{total}");
    }
}
