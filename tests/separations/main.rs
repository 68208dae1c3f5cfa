//! How solids stand to each other, proven for each pair: the points lie in the solids, they are
//! as far apart as is said, and along the normal nothing is nearer. Depths are compared with
//! those along all normals that two polytopes can have.

mod known;
mod proof;
mod scales;

use proof::{corners, prove};
use proptest::prelude::*;
use volary::math::{Vector, axis, direction};
use volary::shape::{Geometry, In, Part, Pose, Shape, Solid};

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
