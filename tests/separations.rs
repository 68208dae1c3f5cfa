//! How solids stand to each other, proven for each pair: the points lie in the solids, they are
//! as far apart as is said, and along the normal nothing is nearer. Depths are compared with
//! those along all normals that two polytopes can have.

use proptest::prelude::*;
use volary::math::{Matrix, Vector, axis, direction};
use volary::shape::{Acting, Geometry, In, Obstacle, Part, Pose, Separation, Shape, Solid};

fn point<const D: usize>(x: [f64; 3]) -> Vector<D> {
    Vector::from_fn(|k, _| x[k])
}

/// Convex shapes of every kind, the last of them thin; sizes from 0.1 to 5.
fn shapes<const D: usize>() -> Vec<Shape<D>> {
    let cloud = [
        [1.0, 0.2, 0.1],
        [-1.2, 0.4, -0.3],
        [0.3, 1.5, 0.2],
        [0.1, -1.0, 0.5],
        [0.2, 0.1, 1.4],
        [-0.1, 0.0, -1.3],
        [0.9, 0.9, 0.4],
    ];
    let cube = |k: usize| point([0, 1, 2].map(|bit| (k >> bit & 1) as f64 * 0.7));
    let mut shapes = vec![
        Shape::Ball { radius: 0.5 },
        Shape::Capsule {
            from: axis::<D>(0) * -0.7,
            to: axis::<D>(0) * 0.7,
            radius: 0.2,
        },
        Shape::Cuboid {
            half_extents: point([0.8, 0.3, 0.4]),
        },
        Shape::Cuboid {
            half_extents: point([5.0, 0.1, 3.0]),
        },
        Shape::Convex {
            points: cloud.map(point).to_vec(),
        },
        Shape::Convex {
            points: (0..8).map(cube).collect(),
        },
        Shape::HalfSpace {
            normal: direction(&point([0.3, 0.7, 0.4])),
        },
        Shape::Segment {
            from: point([-2.0, 0.3, 0.1]),
            to: point([3.0, 0.3, 0.1]),
        },
    ];
    shapes.push(Shape::Triangle {
        points: [[-1.0, -1.0, 0.3], [2.0, -0.5, 0.3], [0.4, 1.7, 0.3]].map(point),
    });
    shapes
}

/// The corners of what a shape is a rounding of, and the radius; none for a half-space.
fn corners<const D: usize>(shape: &Shape<D>) -> (Vec<Vector<D>>, f64) {
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
fn prove<const D: usize>(
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

fn size<const D: usize>(shape: &Shape<D>) -> f64 {
    let (corners, radius) = corners(shape);
    corners.iter().map(Vector::norm).fold(0.0, f64::max) + radius
}

/// Proves the answer for two shapes at some poses, and again brought so near that the gap is
/// `then`.
fn check<const D: usize>(kinds: (usize, usize), offset: [f64; 3], turns: [[f64; 3]; 2], then: f64)
where
    In<D>: Geometry<D>,
{
    let all = shapes::<D>();
    let (first, second) = (&all[kinds.0], &all[kinds.1]);
    let size = size(first) + size(second);
    let at = Pose::<D>::new(point([0.1, -0.2, 0.3]), turns[0]);
    let there = Pose::<D>::new(point(offset), turns[1]);
    let one = Solid::new(first.clone()).expect("a solid");
    let other = Solid::new(second.clone()).expect("a solid");
    let found = one.separation(&at, &other, &there);
    prove([first, second], [&at, &there], &found, size);
    if !found.gap.is_finite() {
        return;
    }
    let back = other.separation(&there, &one, &at);
    let rounding = 1e-13 * (size + there.translation.norm());
    assert!(
        (back.gap - found.gap).abs() < rounding,
        "{found:?} {back:?}"
    );
    // As a part of an obstacle that stands elsewhere.
    let frame = Pose::<D>::new(point([3.0, 1.0, -2.0]), [0.4, 0.2, 1.0]);
    let inner = Pose::from_matrix(
        frame.point_to_local(&there.translation),
        frame.rotation().tr_mul(there.rotation()),
    );
    let part = Part::new(second.clone(), Some(inner)).expect("a part");
    let again = part.separation(&frame, &one, &at);
    assert!(
        (again.gap - found.gap).abs() < rounding,
        "{found:?} {again:?}"
    );
    // Brought together, or apart.
    let near = there.at(there.translation + found.normal * (then - found.gap));
    let found = one.separation(&at, &other, &near);
    prove([first, second], [&at, &near], &found, size);
    let rounding = 1e-13 * (size + near.translation.norm());
    if then >= 0.0 {
        assert!((found.gap - then).abs() < rounding, "{then}: {found:?}");
    }
}

fn turn() -> impl Strategy<Value = [f64; 3]> {
    // Anyhow, or so that faces and edges lie along each other.
    prop_oneof![
        prop::array::uniform3(-3.0..3.0f64),
        Just([0.0; 3]),
        Just([0.0, 0.0, std::f64::consts::FRAC_PI_2]),
        Just([0.0, 0.0, 0.5]),
        (-1e-9..1e-9f64).prop_map(|x| [x, 0.5 * x, -x]),
    ]
}

fn near() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        (-17.0..0.0f64).prop_map(|x| 10f64.powf(x)),
        (-17.0..-1.0f64).prop_map(|x| -10f64.powf(x)),
    ]
}

fn offset() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![
        prop::array::uniform3(-4.0..4.0f64),
        (-3i32..4, -3i32..4, -3i32..4).prop_map(|(x, y, z)| [x, y, z].map(f64::from)),
        Just([0.1, -0.2, 0.3]),
    ]
}

fn cases(standard: u32) -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").ok();
    ProptestConfig {
        cases: asked.and_then(|it| it.parse().ok()).unwrap_or(standard),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn separations_in_the_plane_are_proven(
        // Two that are thin never meet.
        kinds in (0..7usize, 0..9usize),
        offset in offset(),
        turns in (turn(), turn()),
        near in near(),
    ) {
        check::<2>(kinds, offset, [turns.0, turns.1], near);
    }
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn separations_in_space_are_proven(
        // Two that are thin never meet.
        kinds in (0..7usize, 0..9usize),
        offset in offset(),
        turns in (turn(), turn()),
        near in near(),
    ) {
        check::<3>(kinds, offset, [turns.0, turns.1], near);
    }
}

fn keeps_its_bits<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let all = shapes::<D>();
    let mut turned: f64 = 0.1;
    for first in &all {
        for second in &all {
            turned += 0.37;
            let reach = 0.7 * turned % 3.0;
            let at = |scale: f64| Pose::<D>::new(point([0.1, 0.2, -0.3]) * scale, [0.3, 0.1, 0.7]);
            let there = |scale: f64| {
                let along = direction(&point([turned.sin(), turned.cos(), 0.3]));
                Pose::<D>::new(along * (reach * scale), [turned, 0.2, -turned])
            };
            let solve = |scale: f64| {
                let one = Solid::new(first.scaled(scale)).expect("a solid");
                let other = Solid::new(second.scaled(scale)).expect("a solid");
                one.separation(&at(scale), &other, &there(scale))
            };
            let one = solve(1.0);
            for power in -40..=30 {
                let scale = 2f64.powi(power);
                let found = solve(scale);
                let expected = Separation {
                    gap: one.gap * scale,
                    normal: one.normal,
                    points: one.points.map(|p| p * scale),
                };
                assert_eq!(found, expected, "{first:?} {second:?} at 2^{power}");
            }
        }
    }
}

proptest! {
    #![proptest_config(cases(300))]

    /// Hulls with corners nearly in line, and thin ones.
    #[test]
    fn separations_of_odd_hulls_are_proven(
        cloud in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 4..7),
        kind in 0..9usize,
        thin in 0.0..5.0f64,
        middle in (0.0..1.0f64, -30.0..-6.0f64),
        offset in offset(),
        turns in (turn(), turn()),
        near in near(),
    ) {
        fn odd<const D: usize>(
            points: Vec<Vector<D>>, kind: usize, offset: [f64; 3], turns: [[f64; 3]; 2], near: f64,
        ) where In<D>: Geometry<D> {
            let first = Shape::Convex { points };
            let second = &shapes::<D>()[kind];
            // In space what is too thin is refused.
            let Some(one) = Solid::new(first.clone()) else { return };
            let other = Solid::new(second.clone()).expect("a solid");
            let at = Pose::<D>::new(point([0.1, -0.2, 0.3]), turns[0]);
            let there = Pose::<D>::new(point(offset), turns[1]);
            let size = size(&first) + size(second);
            let found = one.separation(&at, &other, &there);
            prove([&first, second], [&at, &there], &found, size);
            let there = there.at(there.translation + found.normal * (near - found.gap));
            let found = one.separation(&at, &other, &there);
            prove([&first, second], [&at, &there], &found, size);
        }
        let mut cloud = cloud;
        let mixed = [0, 1, 2].map(|k| cloud[0][k] + (cloud[1][k] - cloud[0][k]) * middle.0);
        cloud.push([mixed[0], mixed[1] + middle.1.exp2(), mixed[2]]);
        let thin = 10f64.powf(-thin);
        let flat = cloud.iter().map(|x| point([x[0], x[1] * thin, 0.0])).collect();
        odd::<2>(flat, kind, offset, [turns.0, turns.1], near);
        let full = cloud.iter().map(|x| point([x[0], x[1], x[2] * thin.sqrt()])).collect();
        odd::<3>(full, kind, offset, [turns.0, turns.1], near);
    }
}

/// Gaps and projections of obstacles at another scale.
fn obstacles_keep_their_bits<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let all = shapes::<D>();
    let rod = &all[1];
    let inner = |scale: f64| Pose::<D>::new(point([0.3, 0.4, -0.1]) * scale, [0.2, 0.0, 0.3]);
    let at = |scale: f64| Pose::<D>::new(point([0.1, 0.2, -0.3]) * scale, [0.3, 0.1, 0.7]);
    let obstacle = |first: usize, scale: f64| {
        let part = |shape: &Shape<D>, pose| Part::new(shape.scaled(scale), pose).expect("a part");
        let parts = vec![part(&all[first], None), part(&all[4], Some(inner(scale)))];
        Obstacle::of_parts("O".into(), parts, Acting::Each, at(scale)).expect("an obstacle")
    };
    for (first, shape) in all.iter().enumerate() {
        for k in 0..12 {
            let turned = 0.53 * f64::from(k);
            let along = point::<D>([turned.sin(), turned.cos(), 0.3]) * (0.3 * turned);
            let solve = |scale: f64| {
                let obstacle = obstacle(first, scale);
                let there = Pose::<D>::new(along * scale, [turned, 0.2, -turned]);
                let body = Solid::new(rod.scaled(scale)).expect("a solid");
                let found = obstacle.project(&there.translation);
                let velocity = found.velocity(&point([0.2, -0.3, 0.7]));
                let gap = obstacle.gap(&body, &there) / scale;
                let sight = obstacle.blocks(&there.translation, &(point([1.0, 1.0, 1.0]) * scale));
                let numbers = (gap, found.distance / scale, sight);
                (numbers, found.point / scale, found.normal, velocity)
            };
            let one = solve(1.0);
            for power in -40..=30 {
                assert_eq!(solve(2f64.powi(power)), one, "{shape:?} at 2^{power}");
            }
        }
    }
}

#[test]
fn another_scale_keeps_all_bits() {
    obstacles_keep_their_bits::<2>();
    obstacles_keep_their_bits::<3>();
    keeps_its_bits::<2>();
    keeps_its_bits::<3>();
}

#[test]
fn what_lands_flat_is_met_in_the_middle() {
    let cuboid = |x: f64, y: f64, z: f64| {
        Solid::new(Shape::<3>::Cuboid {
            half_extents: [x, y, z].into(),
        })
        .expect("a solid")
    };
    let at = |x: f64, y: f64, z: f64| Pose::<3>::new([x, y, z].into(), [0.0; 3]);
    // Overlapping from 0.5 to 1 and from −0.25 to 0.25; apart, touching and sunk in.
    for gap in [0.5, 0.0, -0.01] {
        let found = cuboid(1.0, 1.0, 1.0).separation(
            &at(0.0, 0.0, 0.0),
            &cuboid(0.5, 0.25, 0.5),
            &at(1.0, 0.0, 1.5 + gap),
        );
        assert!((found.gap - gap).abs() < 1e-15, "{found:?}");
        assert_eq!(found.normal, axis::<3>(2));
        let middle = Vector::<3>::new(0.75, 0.0, 1.0);
        assert!((found.points[0] - middle).norm() < 1e-15, "{found:?}");
    }
    // A rod on a box, and on another rod.
    let rod = Solid::new(Shape::<3>::Capsule {
        from: axis::<3>(0) * -1.0,
        to: axis::<3>(0),
        radius: 0.1,
    })
    .expect("a solid");
    for (other, height) in [(&cuboid(1.0, 1.0, 1.0), 1.1), (&rod, 0.2)] {
        let found = other.separation(&at(0.0, 0.0, 0.0), &rod, &at(0.5, 0.0, height));
        assert!(found.gap.abs() < 1e-15, "{found:?}");
        assert!((found.points[0].x - 0.25).abs() < 1e-15, "{found:?}");
        assert!((found.points[0].y).abs() < 1e-15, "{found:?}");
    }
    let square = Solid::new(Shape::<2>::Cuboid {
        half_extents: [1.0, 1.0].into(),
    })
    .expect("a solid");
    let floor = Solid::new(Shape::<2>::HalfSpace { normal: axis(1) }).expect("a solid");
    let above = |y: f64| Pose::<2>::new([3.0, y].into(), [0.0; 3]);
    let found = floor.separation(&above(0.0).at(Vector::<2>::zeros()), &square, &above(1.5));
    assert_eq!((found.gap, found.normal), (0.5, axis::<2>(1)));
    assert_eq!(
        found.points,
        [Vector::<2>::new(3.0, 0.0), Vector::<2>::new(3.0, 0.5)]
    );
}

#[test]
fn far_from_the_origin_only_the_way_between_counts() {
    let square = Solid::new(Shape::<2>::Cuboid {
        half_extents: [0.5, 0.5].into(),
    })
    .expect("a solid");
    let at = |x: f64| Pose::<2>::from_matrix([x, 1e6].into(), Matrix::<2>::identity());
    let found = square.separation(&at(2f64.powi(20)), &square, &at(2f64.powi(20) + 1.25));
    assert_eq!(found.gap, 0.25);
}

#[test]
fn a_box_beside_a_long_turned_wall_is_beside_it() {
    let cuboid = Shape::<2>::Cuboid {
        half_extents: [0.5, 0.5].into(),
    };
    let cuboid = Solid::new(cuboid).expect("a solid");
    for length in [1.0, 1e3, 1e5] {
        for clear in [1e-9, 0.0, -1e-9] {
            let turn = [0.0, 0.0, 0.5];
            let wall = Shape::Segment {
                from: axis::<2>(0) * -length,
                to: axis::<2>(0) * length,
            };
            let here = Pose::<2>::new(Vector::zeros(), turn);
            let wall = Obstacle::new("wall".into(), wall, here.clone()).expect("a wall");
            let at = here.then(&Pose::new([0.3, 0.5 + clear].into(), [0.0; 3]));
            let gap = wall.gap(&cuboid, &at);
            assert!(
                (gap - clear).abs() < 2e-16 * length + 1e-15,
                "{length} {gap}"
            );
        }
    }
}

#[test]
fn the_tip_of_a_small_rod_has_a_gap() {
    let rod = Shape::<2>::Capsule {
        from: axis::<2>(0) * -1e-5,
        to: axis::<2>(0) * 1e-5,
        radius: 1e-6,
    };
    let rod = Solid::new(rod).expect("a solid");
    let lying = Pose::<2>::new([-1.4e-5, 0.0].into(), [0.0; 3]);
    let upright = Pose::<2>::new(Vector::zeros(), [0.0, 0.0, std::f64::consts::FRAC_PI_2]);
    let gap = rod.gap(&lying, &rod, &upright);
    assert!((gap - 2e-6).abs() < 1e-20, "{gap}");
}
