//! Convex hulls of points that lie nearly in line or in a plane, and thin ones, against brute
//! force: over all segments or triangles between the points, which lie in the hull, and over
//! those that bound it, found by exact signs.

use proptest::prelude::*;
use volary::math::{Vector, direction};
use volary::shape::{Geometry, In, Obstacle, Pose, Shape};

fn point<const D: usize>(x: &[f64; 3]) -> Vector<D> {
    Vector::from_fn(|k, _| x[k])
}

fn cross(a: &Vector<3>, b: &Vector<3>) -> Vector<3> {
    a.cross(b)
}

fn to_segment<const D: usize>(q: &Vector<D>, a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
    let way = b - a;
    let length = way.norm();
    if length == 0.0 {
        return *a;
    }
    let along = way / length;
    a + along * (q - a).dot(&along).clamp(0.0, length)
}

/// A foot within a triangle, where there is one.
fn to_triangle<const D: usize>(q: &Vector<D>, corners: [&Vector<D>; 3]) -> Option<Vector<D>> {
    let full = |v: &Vector<D>| Vector::<3>::from_fn(|k, _| if k < D { v[k] } else { 0.0 });
    let [a, b, c] = corners.map(full);
    let normal = cross(&(b - a), &(c - a));
    let flat = (b - a).norm() * (c - a).norm();
    // Of what is nearly a line the edges tell as much.
    if normal.norm() < 1e-12 * flat || flat == 0.0 {
        return None;
    }
    let normal = normal.normalize();
    let foot = full(q) - normal * normal.dot(&(full(q) - a));
    let inner =
        |from: &Vector<3>, to: &Vector<3>| cross(&(to - from), &(foot - from)).dot(&normal) >= 0.0;
    (inner(&a, &b) && inner(&b, &c) && inner(&c, &a)).then(|| Vector::from_fn(|k, _| foot[k]))
}

/// The side of the plane through some of the points that another is on, exactly.
fn side<const D: usize>(on: &[&Vector<D>], p: &Vector<D>) -> f64 {
    let flat = |v: &Vector<D>| robust::Coord { x: v[0], y: v[1] };
    let full = |v: &Vector<D>| robust::Coord3D {
        x: v[0],
        y: v[1],
        z: v[D - 1],
    };
    match on {
        [a, b] => robust::orient2d(flat(a), flat(b), flat(p)),
        [a, b, c] => robust::orient3d(full(a), full(b), full(c), full(p)),
        _ => unreachable!("two points or three"),
    }
}

/// The signed distance to the hull of some points.
fn brute<const D: usize>(points: &[Vector<D>], q: &Vector<D>) -> f64 {
    let (mut apart, mut depth) = (f64::INFINITY, f64::INFINITY);
    let mut inside = true;
    let mut bound = |on: &[&Vector<D>], normal: Vector<D>| {
        let sides: Vec<f64> = points.iter().map(|p| side(on, p)).collect();
        let (above, below) = (
            sides.iter().any(|s| *s > 0.0),
            sides.iter().any(|s| *s < 0.0),
        );
        if above == below {
            return;
        }
        let own = side(on, q);
        inside &= !(above && own < 0.0 || below && own > 0.0);
        if normal.norm() > 0.0 {
            depth = depth.min(direction(&normal).dot(&(q - on[0])).abs());
        }
    };
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().take(i) {
            apart = apart.min((to_segment(q, a, b) - q).norm());
            if D == 2 {
                let e = b - a;
                bound(
                    &[a, b],
                    Vector::from_fn(|k, _| if k == 0 { -e[1] } else { e[0] }),
                );
                continue;
            }
            for c in points.iter().take(j) {
                if let Some(foot) = to_triangle(q, [a, b, c]) {
                    apart = apart.min((foot - q).norm());
                }
                let full = |v: Vector<D>| Vector::<3>::from_fn(|k, _| v[k]);
                let normal = cross(&full(b - a), &full(c - a));
                // Thin triangles tell no sharp normal; their neighbours bound the depth too.
                let sharp = normal.norm() > 1e-4 * (b - a).norm() * (c - a).norm();
                let normal = normal * f64::from(u8::from(sharp));
                bound(&[a, b, c], Vector::from_fn(|k, _| normal[k]));
            }
        }
    }
    if inside { -depth } else { apart }
}

fn hull<const D: usize>(points: &[Vector<D>], pose: &Pose<D>) -> Option<Obstacle<D>>
where
    In<D>: Geometry<D>,
{
    let points = points.to_vec();
    Obstacle::new("hull".into(), Shape::Convex { points }, pose.clone())
}

/// Compares distance, foot and derivative at some points.
fn check<const D: usize>(points: &[Vector<D>], at: &[[f64; 3]], exact: f64)
where
    In<D>: Geometry<D>,
{
    let here = Pose::<D>::new(Vector::zeros(), [0.0; 3]);
    let Some(hull) = hull(points, &here) else {
        panic!("refused: {points:?}");
    };
    let size = points.iter().map(Vector::norm).fold(0.0, f64::max);
    // Anywhere, and near the points and between them.
    let near = at.iter().zip(points).map(|(x, p)| p + point::<D>(x) * 0.01);
    let between = points
        .windows(2)
        .zip(at)
        .map(|(pair, x)| (pair[0] + pair[1]) * 0.5 + point::<D>(x) * 1e-4);
    let all: Vec<Vector<D>> = at.iter().map(point).chain(near).chain(between).collect();
    for q in all {
        let found = hull.project(&q);
        let distance = brute(points, &q);
        let error = (found.distance - distance).abs();
        assert!(error < exact * size, "{q} {distance} {found:?} {points:?}");
        assert!((found.normal.norm() - 1.0).abs() < 1e-12);
        let back = found.point + found.normal * found.distance - q;
        assert!(back.norm() < 1e-12 * size, "{q} {found:?}");
        assert!(hull.may_reach(&q, found.distance.max(0.0) + 1e-12 * size));
        // The derivative is that of differences, but where they see a kink.
        let velocity = point::<D>(&[0.3, -0.8, 0.5]);
        let step = 1e-7 * size;
        let foot = |s: f64| hull.project(&(q + velocity * s)).point;
        let (forward, backward) = (
            (foot(step) - foot(0.0)) / step,
            (foot(0.0) - foot(-step)) / step,
        );
        if found.distance.abs() > 1e-5 * size && (forward - backward).norm() < 1e-6 {
            let wrong = (found.velocity(&velocity) - forward).norm();
            assert!(wrong < 1e-5, "{q} {found:?} {forward} {points:?}");
        }
    }
}

/// Three points of a cloud, the shares of the ways between them, and how far off, a power of two,
/// along which way.
type More = ([usize; 3], [f64; 2], f64, [f64; 3]);

/// A cloud, and more points nearly on lines between two of it, or in planes of three.
fn cloud<const D: usize>(cloud: &[[f64; 3]], more: &[More]) -> Vec<Vector<D>> {
    let mut points: Vec<Vector<D>> = cloud.iter().map(point).collect();
    for (of, share, offset, along) in more {
        let [a, b, c] = of.map(|k| points[k % cloud.len()]);
        let on = a + (b - a) * share[0] + (c - a) * share[1];
        points.push(on + point::<D>(along) * offset.exp2());
    }
    points
}

fn some() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-1.0..1.0f64)
}

fn more() -> impl Strategy<Value = Vec<More>> {
    let share = prop_oneof![
        (0.0..1.0f64).prop_map(|s| [s, 0.0]),
        prop::array::uniform2(0.0..0.5f64),
    ];
    let one = (
        prop::array::uniform3(0..8usize),
        share,
        -30.0..-6.0f64,
        some(),
    );
    prop::collection::vec(one, 0..5)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn hulls_of_points_nearly_in_line(
        points in prop::collection::vec(some(), 3..8),
        more in more(),
        at in prop::collection::vec(some().prop_map(|x| x.map(|x| 2.0 * x)), 8),
    ) {
        check::<2>(&cloud(&points, &more), &at, 1e-13);
    }

    #[test]
    fn hulls_of_points_nearly_in_a_plane(
        points in prop::collection::vec(some(), 4..7),
        more in more(),
        at in prop::collection::vec(some().prop_map(|x| x.map(|x| 2.0 * x)), 8),
    ) {
        let points = cloud::<3>(&points, &more);
        // Thin ones are refused, or right.
        let here = Pose::<3>::new(Vector::zeros(), [0.0; 3]);
        if hull(&points, &here).is_some() {
            check::<3>(&points, &at, 1e-12);
        }
    }

    #[test]
    fn slivers(
        points in prop::collection::vec(some(), 3..8),
        more in more(),
        thin in 0.0..6.0f64,
        turn in -3.0..3.0f64,
        at in prop::collection::vec(some().prop_map(|x| x.map(|x| 2.0 * x)), 8),
    ) {
        let turned = Pose::<2>::new(Vector::zeros(), [0.0, 0.0, turn]);
        let thin = 10f64.powf(-thin);
        let flat = |p: Vector<2>| turned.point_to_world(&Vector::<2>::new(p.x, p.y * thin));
        let points: Vec<_> = cloud::<2>(&points, &more).into_iter().map(flat).collect();
        check::<2>(&points, &at, 1e-13);
    }
}

#[test]
fn faces_of_boxes_with_points_in_them_are_whole() {
    // Points on faces and edges, exactly and nearly; above faces the derivative is theirs.
    for offset in [0.0, 1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3] {
        let mut points: Vec<Vector<3>> = (0..8)
            .map(|k| Vector::<3>::from_fn(|axis, _| if k >> axis & 1 == 0 { -1.0 } else { 1.0 }))
            .collect();
        points.insert(0, Vector::<3>::new(0.0, 0.0, 1.0 + offset));
        points.push(Vector::<3>::new(0.5, 1.0 + offset, 0.25));
        points.push(Vector::<3>::new(1.0 + offset, -1.0, 0.0));
        let at = [
            [0.3, 0.2, 2.0],
            [0.4, 1.7, 0.1],
            [0.1, -0.2, 0.3],
            [1.5, -1.5, 0.2],
            [2.0, 0.1, 0.3],
        ];
        check::<3>(&points, &at, 1e-13);
    }
}

#[test]
fn a_corner_of_a_hundred_thousandth_stays() {
    let points = [
        [-4.0, -3.0],
        [0.0, -3.00001],
        [4.0, -3.0],
        [4.0, 3.0],
        [-4.0, 3.0],
    ];
    let points = points.map(Vector::<2>::from);
    let hull = hull(&points, &Pose::<2>::new(Vector::zeros(), [0.0; 3])).expect("a hull");
    let found = hull.project(&Vector::<2>::new(4.2, -13.0));
    assert!(
        (found.distance - (0.04f64 + 100.0).sqrt()).abs() < 1e-13,
        "{found:?}"
    );
    assert_eq!(found.point, Vector::<2>::new(4.0, -3.0));
}
