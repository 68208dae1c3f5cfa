//! Gaps between solids against a brute-force search over points of their surfaces.

use proptest::prelude::*;
use volary::math::{Vector, axis, direction};
use volary::shape::{Geometry, In, Obstacle, Pose, Shape, Solid};

/// Directions that fill the circle or the sphere: a golden spiral.
fn directions<const D: usize>(count: usize) -> Vec<Vector<D>> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count)
        .map(|k| {
            let share = (k as f64 + 0.5) / count as f64;
            match D {
                2 => {
                    let angle = 2.0 * std::f64::consts::PI * share;
                    Vector::from_fn(|row, _| [angle.cos(), angle.sin()][row])
                }
                _ => {
                    let (z, angle) = (1.0 - 2.0 * share, golden * k as f64);
                    let r = (1.0 - z * z).sqrt();
                    Vector::from_fn(|row, _| [r * angle.cos(), r * angle.sin(), z][row])
                }
            }
        })
        .collect()
}

fn shapes<const D: usize>() -> Vec<Shape<D>> {
    let point = |x: [f64; 3]| Vector::<D>::from_fn(|k, _| x[k]);
    let corners = [
        [0.9, 0.1, 0.0],
        [-0.5, 0.6, 0.2],
        [-0.6, -0.4, 0.3],
        [0.1, -0.5, -0.7],
    ];
    vec![
        Shape::Ball { radius: 0.5 },
        Shape::Capsule {
            from: axis::<D>(0) * -0.7,
            to: axis::<D>(0) * 0.7,
            radius: 0.2,
        },
        Shape::Cuboid {
            half_extents: point([0.8, 0.3, 0.4]),
        },
        Shape::Convex {
            points: corners.map(point).to_vec(),
        },
    ]
}

/// The corners of a shape.
fn corners<const D: usize>(shape: &Shape<D>) -> Vec<Vector<D>> {
    match shape {
        Shape::Cuboid { half_extents } => (0..1 << D)
            .map(|signs| {
                let sign = |k: usize| if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
                Vector::from_fn(|k, _| half_extents[k] * sign(k))
            })
            .collect(),
        Shape::Convex { points } => points.clone(),
        _ => Vec::new(),
    }
}

/// Compares the gap with the smallest distance from points of the surface of the one, found
/// along rays from its centre, to the other.
fn agrees<const D: usize>(
    kinds: (usize, usize),
    offset: [f64; 3],
    turns: [[f64; 3]; 2],
    count: usize,
    coarse: f64,
) where
    In<D>: Geometry<D>,
{
    let (first, second) = (
        shapes::<D>()[kinds.0].clone(),
        shapes::<D>()[kinds.1].clone(),
    );
    let at = Pose::<D>::new(Vector::zeros(), turns[0]);
    let there = Pose::<D>::new(Vector::from_fn(|k, _| offset[k]), turns[1]);
    let one = Solid::new(first.clone()).expect("a solid");
    let other = Solid::new(second.clone()).expect("a solid");
    let gap = one.gap(&at, &other, &there);
    assert!(
        (other.gap(&there, &one, &at) - gap).abs() < 1e-6,
        "{kinds:?} {gap}"
    );
    let surface = Obstacle::new("one".into(), first, at.clone()).expect("a solid");
    let target = Obstacle::new("other".into(), second, there.clone()).expect("a solid");
    assert!((surface.gap(&other, &there) - gap).abs() < 1e-12);
    let distance = |along: Vector<D>| {
        let point = surface.interior_point(&along, 1.0).expect("a centre");
        target.project(&point).distance
    };
    let rays = directions::<D>(count).into_iter().map(distance);
    // Rays that are evenly spread miss sharp corners by far.
    let from_first = corners(one.shape())
        .into_iter()
        .map(|corner| target.project(&at.point_to_world(&corner)).distance);
    let from_second = corners(other.shape())
        .into_iter()
        .map(|corner| surface.project(&there.point_to_world(&corner)).distance);
    let nearest = rays
        .chain(from_first)
        .chain(from_second)
        .fold(f64::INFINITY, f64::min);
    if gap > 0.0 {
        assert!(
            nearest > gap - 1e-6 && nearest < gap + coarse,
            "{kinds:?} {gap} {nearest}"
        );
    } else {
        // To part them, at least the deepest point must come out.
        assert!(
            nearest < coarse && gap < nearest + 1e-6,
            "{kinds:?} {gap} {nearest}"
        );
        if kinds == (1, 1) && gap < -0.4 + 1e-9 {
            // Capsules that cross: by the sum of their radii, and no deeper.
            return;
        }
        // Moved apart by the depth along the right direction they just touch.
        let parted = |along: Vector<D>| {
            let moved = there.translation + along * -gap;
            one.gap(&at, &other, &there.at(moved))
        };
        let best = directions::<D>(count)
            .into_iter()
            .map(parted)
            .fold(f64::MIN, f64::max);
        assert!(best > -coarse && best < 1e-6, "{kinds:?} {gap}: {best}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gaps_in_the_plane_are_those_of_the_surfaces(
        kinds in (0..4usize, 0..4usize),
        along in prop::array::uniform3(-1.0..1.0f64),
        apart in 0.0..3.0f64,
        turns in prop::array::uniform2(prop::array::uniform3(-3.0..3.0f64)),
    ) {
        let along = direction(&Vector::<2>::new(along[0], along[1])) * apart;
        agrees::<2>(kinds, [along.x, along.y, 0.0], turns, 700, 0.02);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gaps_in_space_are_those_of_the_surfaces(
        kinds in (0..4usize, 0..4usize),
        along in prop::array::uniform3(-1.0..1.0f64),
        apart in 0.0..3.0f64,
        turns in prop::array::uniform2(prop::array::uniform3(-3.0..3.0f64)),
    ) {
        let along = direction(&Vector::<3>::from(along)) * apart;
        agrees::<3>(kinds, along.into(), turns, 1500, 0.12);
    }
}

/// Two rods along one line, their centres this far apart.
fn in_line<const D: usize>(apart: f64) -> f64
where
    In<D>: Geometry<D>,
{
    let rod = Shape::Capsule {
        from: axis::<D>(0) * -0.5,
        to: axis::<D>(0) * 0.5,
        radius: 0.1,
    };
    let rod = Solid::new(rod).expect("a solid");
    let at = |x: f64| Pose::new(axis::<D>(0) * x, [0.0; 3]);
    rod.gap(&at(0.0), &rod, &at(apart))
}

#[test]
fn rods_in_line_overlap_by_their_radii_at_least() {
    for apart in [0.0, 0.05, 0.1, 0.25, 0.3, 0.5, 0.75, 0.9, 1.0] {
        for gap in [in_line::<2>(apart), in_line::<3>(apart)] {
            assert!((gap + 0.2).abs() < 1e-9, "{apart}: {gap}");
        }
    }
    for gap in [in_line::<2>(1.5), in_line::<3>(1.5)] {
        assert!((gap - 0.3).abs() < 1e-9, "{gap}");
    }
}

#[test]
fn bodies_that_stand_alike_in_each_other_overlap() {
    let alike = |shape: Shape<3>| {
        let solid = Solid::new(shape).expect("a solid");
        let at = Pose::<3>::new(Vector::zeros(), [0.0; 3]);
        solid.gap(&at, &solid, &at)
    };
    for shape in shapes::<3>() {
        let gap = alike(shape.clone());
        assert!(gap < -0.1, "{shape:?}: {gap}");
    }
    let flat = |shape: Shape<2>| {
        let solid = Solid::new(shape).expect("a solid");
        let at = Pose::<2>::new(Vector::zeros(), [0.0; 3]);
        solid.gap(&at, &solid, &at)
    };
    for shape in shapes::<2>() {
        let gap = flat(shape.clone());
        assert!(gap < -0.1, "{shape:?}: {gap}");
    }
}

#[test]
fn what_lies_in_a_wall_overlaps_it() {
    let rod = Shape::Capsule {
        from: axis::<3>(0) * -0.5,
        to: axis::<3>(0) * 0.5,
        radius: 0.1,
    };
    let rod = Solid::new(rod).expect("a solid");
    let far = [[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]];
    let here = || Pose::<3>::new(Vector::zeros(), [0.0; 3]);
    for wall in [
        Shape::Triangle {
            points: far.map(Vector::<3>::from),
        },
        Shape::Segment {
            from: axis::<3>(0) * -3.0,
            to: axis::<3>(0) * 3.0,
        },
    ] {
        let wall = Obstacle::new("wall".into(), wall, here()).expect("a wall");
        let gap = wall.gap(&rod, &here());
        assert!((gap + 0.1).abs() < 1e-9, "{gap}");
    }
}
