//! Convex shapes, against brute force and central differences.

use proptest::prelude::*;
use volary::math::Vector;
use volary::shape::{Geometry, In, Obstacle, Pose, Shape};

const SEEDS: u32 = 64;

/// One obstacle of each shape, all with the same pose.
fn obstacles<const D: usize>(turn: [f64; 3]) -> Vec<Obstacle<D>>
where
    In<D>: Geometry<D>,
{
    let along = |numbers: [f64; 3]| Vector::<D>::from_fn(|k, _| numbers[k]);
    let corners = [
        [1.0, 0.2, 0.1],
        [-1.2, 0.4, -0.3],
        [0.3, 1.5, 0.2],
        [0.1, -1.0, 0.5],
        [0.2, 0.1, 1.4],
        [-0.1, 0.0, -1.3],
        [0.9, 0.9, 0.4],
    ];
    let shapes = [
        Shape::Ball { radius: 1.3 },
        Shape::Cuboid {
            half_extents: along([1.0, 0.6, 1.7]),
        },
        Shape::Capsule {
            from: along([-1.0, -0.4, 0.2]),
            to: along([0.8, 0.7, -0.5]),
            radius: 0.5,
        },
        Shape::HalfSpace {
            normal: along([0.6, 0.8, 0.0]).normalize(),
        },
        Shape::Convex {
            points: corners.iter().map(|corner| along(*corner)).collect(),
        },
    ];
    let pose = Pose::new(along([0.3, -0.2, 0.5]), turn);
    shapes
        .into_iter()
        .map(|shape| Obstacle::new("test".into(), shape, pose.clone()).expect("a solid"))
        .collect()
}

/// Whether a world point lies in the solid, from the shape's definition alone.
fn contains<const D: usize>(obstacle: &Obstacle<D>, point: &Vector<D>) -> bool {
    let q = obstacle.pose.point_to_local(point);
    match &obstacle.parts()[0].shape {
        Shape::Ball { radius } => q.norm() <= *radius,
        Shape::Cuboid { half_extents } => (0..D).all(|k| q[k].abs() <= half_extents[k]),
        Shape::Capsule { from, to, radius } => {
            let axis = to - from;
            let t = ((q - from).dot(&axis) / axis.norm_squared()).clamp(0.0, 1.0);
            (q - (from + axis * t)).norm() <= *radius
        }
        Shape::HalfSpace { normal } => normal.dot(&q) <= 0.0,
        Shape::Convex { points } => in_hull(points, &q),
        Shape::Segment { .. } | Shape::Triangle { .. } => unreachable!("not in this list"),
    }
}

/// Whether `q` is in the hull: no plane through D of the points has all points on one side
/// and `q` on the other.
pub fn in_hull<const D: usize>(points: &[Vector<D>], q: &Vector<D>) -> bool {
    let outside = |normal: Vector<D>, on: &Vector<D>| {
        let side = |p: &Vector<D>| normal.dot(&(p - on));
        let above = points.iter().all(|p| side(p) <= 1e-12) && side(q) > 1e-12;
        let below = points.iter().all(|p| side(p) >= -1e-12) && side(q) < -1e-12;
        above || below
    };
    for a in points {
        for b in points {
            let e = b - a;
            if D == 2 {
                if outside(Vector::from_fn(|k, _| if k == 0 { -e[1] } else { e[0] }), a) {
                    return false;
                }
                continue;
            }
            for c in points {
                let f = c - a;
                let cross =
                    |k: usize| e[(k + 1) % D] * f[(k + 2) % D] - e[(k + 2) % D] * f[(k + 1) % D];
                if outside(Vector::from_fn(|k, _| cross(k)), a) {
                    return false;
                }
            }
        }
    }
    true
}

/// The distance along `direction` at which the ray from `from` changes sides, by bisection.
fn crossing<const D: usize>(
    obstacle: &Obstacle<D>,
    from: &Vector<D>,
    direction: &Vector<D>,
    far: f64,
) -> Option<f64> {
    let inside = contains(obstacle, from);
    if contains(obstacle, &(from + direction * far)) == inside {
        return None;
    }
    let (mut near, mut far) = (0.0, far);
    for _ in 0..60 {
        let middle = 0.5 * (near + far);
        if contains(obstacle, &(from + direction * middle)) == inside {
            near = middle;
        } else {
            far = middle;
        }
    }
    Some(near)
}

fn check<const D: usize>(turn: [f64; 3], at: [f64; 3], directions: &[[f64; 3]])
where
    In<D>: Geometry<D>,
{
    let at = Vector::<D>::from_fn(|k, _| at[k]);
    for obstacle in obstacles::<D>(turn) {
        let projection = obstacle.project(&at);
        let inside = contains(&obstacle, &at);
        let shape = &obstacle.parts()[0].shape;

        // The parts fit together.
        assert_eq!(projection.distance < 0.0, inside, "{shape:?}");
        assert!((projection.normal.norm() - 1.0).abs() < 1e-9, "{shape:?}");
        let back = projection.point + projection.normal * projection.distance;
        assert!((back - at).norm() < 1e-7, "{shape:?}: {back} is not {at}");

        // The point is on the surface: out along the normal, in towards the centre.
        let inward = match obstacle.center() {
            Some(center) => center - projection.point,
            None => -projection.normal,
        };
        assert!(
            contains(&obstacle, &(projection.point + inward * 1e-6)),
            "{shape:?}"
        );
        let outward = projection.normal * 1e-6;
        assert!(
            !contains(&obstacle, &(projection.point + outward)),
            "{shape:?}"
        );

        // No sampled direction reaches the surface sooner. Outside, straight towards the
        // found point is the shortest way; inside, any way out is at least as long.
        for direction in directions {
            let direction = Vector::<D>::from_fn(|k, _| direction[k]);
            if direction.norm() < 0.1 {
                continue;
            }
            if let Some(way) = crossing(&obstacle, &at, &direction.normalize(), 3.0) {
                assert!(way >= projection.distance.abs() - 1e-6, "{shape:?}: {way}");
            }
        }

        // The bounding-box test never misses an obstacle in range.
        assert!(
            obstacle.may_reach(&at, projection.distance.max(0.0) + 1e-9),
            "{shape:?}"
        );
    }
}

/// Compares p̂ with a central difference of the closest point, away from the places where the
/// map has a kink.
fn check_velocity<const D: usize>(turn: [f64; 3], at: [f64; 3], velocity: [f64; 3]) -> usize
where
    In<D>: Geometry<D>,
{
    let at = Vector::<D>::from_fn(|k, _| at[k]);
    let velocity = Vector::<D>::from_fn(|k, _| velocity[k]);
    let mut compared = 0;
    for obstacle in obstacles::<D>(turn) {
        let h = 1e-6;
        let point = |s: f64| obstacle.project(&(at + velocity * s)).point;
        let central = (point(h) - point(-h)) / (2.0 * h);
        let one_sided = (point(h) - point(0.0)) / h;
        if (central - one_sided).norm() > 1e-3 {
            continue; // The feature changes right here.
        }
        compared += 1;
        let exact = obstacle.project(&at).velocity(&velocity);
        let error = (central - exact).norm();
        assert!(
            error < 1e-5,
            "{:?}: {exact} is not {central}",
            obstacle.parts()[0].shape
        );
    }
    compared
}

fn vector() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-3.0..3.0f64)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(SEEDS))]

    #[test]
    fn projection_is_the_nearest_surface_point(
        turn in vector(),
        at in vector(),
        directions in prop::collection::vec(vector(), 60),
    ) {
        check::<2>(turn, at, &directions);
        check::<3>(turn, at, &directions);
    }

    #[test]
    fn velocity_is_the_derivative_of_the_projection(
        turn in vector(),
        at in vector(),
        velocity in vector(),
    ) {
        // Kinks are rare, so nearly all of the five shapes must have been compared.
        prop_assert!(check_velocity::<2>(turn, at, velocity) >= 3);
        prop_assert!(check_velocity::<3>(turn, at, velocity) >= 3);
    }
}

#[test]
fn a_ball_s_beta_agent_moves_as_in_equation_56() {
    let ball = Shape::<2>::Ball { radius: 2.0 };
    let obstacle = Obstacle::new("O".into(), ball, Pose::new(Vector::<2>::zeros(), [0.0; 3]))
        .expect("a ball is solid");
    let projection = obstacle.project(&Vector::<2>::new(5.0, 0.0));
    // s = l/(l + d) = 2/5; the part of p along n drops out.
    let velocity = projection.velocity(&Vector::<2>::new(7.0, 10.0));
    assert!((velocity - Vector::<2>::new(0.0, 4.0)).norm() < 1e-14);
}

#[test]
fn centres_and_surfaces_are_no_special_places() {
    for obstacle in obstacles::<3>([0.4, 0.2, -0.1]) {
        let center = obstacle.center().unwrap_or(obstacle.pose.translation);
        let surface = obstacle.project(&Vector::<3>::new(3.0, 2.0, -2.5)).point;
        for at in [center, surface] {
            let projection = obstacle.project(&at);
            let velocity = projection.velocity(&Vector::<3>::new(1.0, 2.0, 3.0));
            let all = [projection.point, projection.normal, velocity];
            assert!(
                all.iter().all(|v| v.iter().all(|x| x.is_finite())),
                "{:?}",
                obstacle.parts()[0].shape
            );
            assert!(
                (projection.normal.norm() - 1.0).abs() < 1e-9,
                "{:?}",
                obstacle.parts()[0].shape
            );
        }
        assert!(obstacle.project(&surface).distance.abs() < 1e-7);
    }
}

#[test]
fn gamma_agents_sit_between_centre_and_surface() {
    for obstacle in obstacles::<3>([0.4, 0.2, -0.1]) {
        let along = Vector::<3>::new(2.0, -1.0, 0.5).normalize();
        let Some(center) = obstacle.center() else {
            assert!(matches!(obstacle.parts()[0].shape, Shape::HalfSpace { .. }));
            assert!(obstacle.interior_point(&along, 1.0).is_none());
            continue;
        };
        let surface = obstacle
            .interior_point(&along, 1.0)
            .expect("it has a centre");
        assert!(obstacle.project(&surface).distance.abs() < 1e-7);
        let half = obstacle
            .interior_point(&along, 0.5)
            .expect("it has a centre");
        assert!((half - (center + surface) / 2.0).norm() < 1e-12);
    }
}

#[test]
fn hulls_too_thin_for_the_engine_are_refused_and_others_are_right() {
    let slab = |half: f64| {
        let corner = |k: usize| {
            let sign = |bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
            Vector::<3>::new(2.0 + 2.0 * sign(0), 4.0 * sign(1), half * sign(2))
        };
        let shape = Shape::Convex {
            points: (0..8).map(corner).collect(),
        };
        let pose = Pose::new(Vector::<3>::zeros(), [0.0; 3]);
        Obstacle::new("slab".into(), shape, pose)
    };
    let beside = Vector::<3>::new(10.0, 0.1, 0.1);
    for half in [0.5, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 1e-3, 1e-4, 1e-6] {
        match slab(half) {
            Some(slab) => {
                let distance = slab.project(&beside).distance;
                let exact = (36.0 + (0.1 - half).max(0.0).powi(2)).sqrt();
                assert!((distance - exact).abs() < 1e-6, "{half}: {distance}");
            }
            None => assert!(half < 0.005, "{half} is thick enough"),
        }
    }
    assert!(slab(1e-4).is_none());
}

#[test]
fn hulls_far_from_their_origin_stay_sharp() {
    for (size, at) in [(0.01, 1e6), (1.0, 1e8), (1.0, 0.0)] {
        let corner = |k: usize| {
            let side = |bit: usize| at + size * (k >> bit & 1) as f64;
            Vector::<2>::new(side(0), side(1))
        };
        let shape = Shape::Convex {
            points: (0..4).map(corner).collect(),
        };
        let pose = Pose::new(Vector::<2>::zeros(), [0.0; 3]);
        let square = Obstacle::new("square".into(), shape, pose).expect("a solid");
        let beyond = Vector::<2>::repeat(at + 3.0 * size);
        let distance = square.project(&beyond).distance;
        let exact = 2.0 * size * 2.0f64.sqrt();
        assert!(
            (distance - exact).abs() < 1e-6 * size.max(1e-3),
            "{at}: {distance} {exact}"
        );
    }
}
