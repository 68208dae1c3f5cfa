//! What an answer must be, by all corners and normals.

use volary::math::{Vector, axis};
use volary::shape::{Pose, Separation, Shape};

/// The corners of what a shape is a rounding of, and the radius; none for a half-space.
pub fn corners<const D: usize>(shape: &Shape<D>) -> (Vec<Vector<D>>, f64) {
    match shape {
        Shape::Ball { radius } => (vec![Vector::zeros()], *radius),
        Shape::Capsule { from, to, radius } => (vec![*from, *to], *radius),
        Shape::Segment { from, to } => (vec![*from, *to], 0.0),
        Shape::Cuboid { half_extents } => {
            let sign = |signs: usize, k: usize| if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
            let corner = |signs| Vector::from_fn(|k, _| half_extents[k] * sign(signs, k));
            ((0..1 << D).map(corner).collect(), 0.0)
        }
        Shape::Convex { points } => (points.clone(), 0.0),
        Shape::Triangle { points } => (points.to_vec(), 0.0),
        Shape::HalfSpace { .. } => (Vec::new(), 0.0),
    }
}

/// How far a posed shape reaches along a direction.
fn reach<const D: usize>(shape: &Shape<D>, at: &Pose<D>, along: &Vector<D>) -> f64 {
    if let Shape::HalfSpace { normal } = shape {
        let normal = at.vector_to_world(normal);
        return match (normal - along).norm() < 1e-9 {
            true => normal.dot(&at.translation),
            false => f64::INFINITY,
        };
    }
    let (corners, radius) = corners(shape);
    let far = corners.iter().map(|p| at.point_to_world(p).dot(along));
    far.fold(f64::NEG_INFINITY, f64::max) + radius
}

/// The cross product; zero in the plane.
fn cross<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
    Vector::from_fn(|k, _| match D {
        3 => a[(k + 1) % D] * b[(k + 2) % D] - a[(k + 2) % D] * b[(k + 1) % D],
        _ => 0.0,
    })
}

/// By how much a point lies outside of the hull of some points, by all planes through them.
fn outside<const D: usize>(points: &[Vector<D>], q: &Vector<D>) -> f64 {
    let mut most: f64 = 0.0;
    for normal in normals(points) {
        let far = points
            .iter()
            .map(|p| normal.dot(p))
            .fold(f64::MIN, f64::max);
        most = most.max(normal.dot(q) - far);
    }
    let low = points
        .iter()
        .copied()
        .reduce(|a, b| a.inf(&b))
        .expect("some");
    let high = points
        .iter()
        .copied()
        .reduce(|a, b| a.sup(&b))
        .expect("some");
    most.max((low - q).max()).max((q - high).max())
}

/// Unit normals of all planes through some points, both ways; of lines, some across.
fn normals<const D: usize>(points: &[Vector<D>]) -> Vec<Vector<D>> {
    let mut all = Vec::new();
    for a in points {
        for b in points {
            let e = b - a;
            if D == 2 {
                all.push(Vector::from_fn(|k, _| if k == 0 { -e[1] } else { e[0] }));
                continue;
            }
            if points.len() == 2 {
                all.extend((0..D).map(|k| cross(&e, &axis(k))));
            }
            for c in points {
                let out = cross(&e, &(c - a));
                all.push(out);
                all.push(cross(&out, &e));
            }
        }
    }
    all.retain(|n| n.norm() > 1e-9);
    all.iter()
        .flat_map(|n| [n.normalize(), -n.normalize()])
        .collect()
}

/// Normals that two polytopes can come apart along soonest.
fn both<const D: usize>(one: &[Vector<D>], other: &[Vector<D>]) -> Vec<Vector<D>> {
    let mut all = normals(one);
    all.extend(normals(other));
    for a in one {
        for b in one {
            for c in other {
                for d in other {
                    let normal = cross(&(b - a), &(d - c));
                    if normal.norm() > 1e-9 {
                        all.push(normal.normalize());
                        all.push(-normal.normalize());
                    }
                }
            }
        }
    }
    all
}

/// Proves an answer.
pub fn prove<const D: usize>(
    [one, other]: [&Shape<D>; 2],
    [at, there]: [&Pose<D>; 2],
    found: &Separation<D>,
    size: f64,
) {
    let rounding = 2e-14 * (size + at.translation.norm() + there.translation.norm());
    let name = || format!("{one:?} {other:?}\n{found:?}");
    let Separation {
        gap,
        normal,
        points,
    } = found;
    if *gap == f64::NEG_INFINITY {
        return;
    }
    assert!((normal.norm() - 1.0).abs() < 1e-14, "{}", name());
    let way = points[1] - points[0];
    assert!((way - normal * *gap).norm() < rounding, "{}", name());
    // Nothing is nearer along the normal.
    let apart = |normal: &Vector<D>| -reach(other, there, &-normal) - reach(one, at, normal);
    // A direction between near corners is told to no better than rounding over their gap.
    let sharp = match corners(one).1 + corners(other).1 {
        0.0 if *gap > 0.0 => (4e-16 * size / gap).min(1e-6) * size,
        _ => 0.0,
    };
    let along = apart(normal);
    assert!((along - gap).abs() < rounding + sharp, "{along} {}", name());
    for (shape, pose, point, sign) in [(one, at, points[0], -1.0), (other, there, points[1], 1.0)] {
        let (corners, radius) = corners(shape);
        if corners.is_empty() {
            continue;
        }
        let core = pose.point_to_local(&(point + normal * (sign * radius)));
        if *gap + radius > 0.0 {
            let out = outside(&corners, &core);
            // Faces count as parallel up to some 1e-10 of an angle.
            assert!(out < 3.0 * rounding + 1e-9 * size, "{out} {}", name());
        }
    }
    // No other way out is shorter.
    let [first, second] = [(one, at), (other, there)].map(|(shape, pose)| {
        let corners = corners(shape).0;
        corners
            .iter()
            .map(|p| pose.point_to_world(p))
            .collect::<Vec<_>>()
    });
    for normal in both(&first, &second) {
        let along = apart(&normal);
        // Normals of faces are preferred up to 1e-13 of the size.
        let most = gap + rounding + 1e-13 * size;
        assert!(along < most, "{along} along {normal} {}", name());
    }
}
