use super::*;
use crate::math::axis;
use crate::shape::surface::{corridor, heightfield, mesh, polyline};
use crate::shape::{Acting, Easing, Geometry, In, Motion, Part, Pose, Shape, Solid};
use proptest::prelude::*;

fn point<const D: usize>(x: [f64; 3]) -> Vector<D> {
    Vector::from_fn(|k, _| x[k])
}

fn of<const D: usize>(shapes: Vec<Shape<D>>, pose: &Pose<D>) -> Obstacle<D>
where
    In<D>: Geometry<D>,
{
    let parts = shapes.into_iter();
    let parts = parts.map(|shape| Part::new(shape, None).expect("a part"));
    let name = "wall".into();
    Obstacle::of_parts(name, parts.collect(), Acting::Each, pose.clone()).expect("an obstacle")
}

/// A box from corner to corner.
fn block<const D: usize>(low: [f64; 3], high: [f64; 3]) -> Part<D>
where
    In<D>: Geometry<D>,
{
    let (low, high) = (point::<D>(low), point::<D>(high));
    let shape = Shape::Cuboid {
        half_extents: (high - low) * 0.5,
    };
    let pose = Pose::new((high + low) * 0.5, [0.0; 3]);
    Part::new(shape, Some(pose)).expect("a part")
}

/// Boxes in one obstacle, or each in one of its own.
fn blocks<const D: usize>(parts: Vec<Part<D>>, pose: &Pose<D>, single: bool) -> Vec<Obstacle<D>>
where
    In<D>: Geometry<D>,
{
    let obstacle = |parts: Vec<Part<D>>| {
        Obstacle::of_parts("wall".into(), parts, Acting::Each, pose.clone()).expect("an obstacle")
    };
    match single {
        true => vec![obstacle(parts)],
        false => parts.into_iter().map(|part| obstacle(vec![part])).collect(),
    }
}

/// The normals of a solid's exposed contacts with all parts at most `range` away, each once.
fn contacts<const D: usize>(
    walls: &[Obstacle<D>],
    solid: &Solid<D>,
    at: &Pose<D>,
    range: f64,
) -> Vec<Vector<D>> {
    let mut boxes = Boxes::default();
    boxes.about(walls);
    let mut normals: Vec<Vector<D>> = Vec::new();
    for (i, wall) in walls.iter().enumerate() {
        let half = Vector::repeat(solid.radius() + range);
        let near = (at.translation - half, at.translation + half);
        let mut parts = Vec::new();
        wall.parts_near(&near, &mut |part| parts.push(part));
        for j in parts {
            let part = &wall.parts()[j];
            let found = part.separation(&wall.pose, solid, at);
            if found.gap > range {
                continue;
            }
            let normal = -found.normal;
            if is_exposed(walls, &boxes, (i, j), &found.points[1], &normal, 0.1) {
                normals.push(normal);
            }
        }
    }
    let mut once: Vec<Vector<D>> = Vec::new();
    for normal in normals {
        if once.iter().all(|it| (it - normal).norm() > 1e-7) {
            once.push(normal);
        }
    }
    once.sort_by(|a, b| {
        let by = |k: usize| a[k].total_cmp(&b[k]);
        (0..D).fold(std::cmp::Ordering::Equal, |order, k| order.then(by(k)))
    });
    once
}

fn same<const D: usize>(one: &[Vector<D>], other: &[Vector<D>]) -> bool {
    let near = |(a, b): (&Vector<D>, &Vector<D>)| (a - b).norm() < 1e-7;
    one.len() == other.len() && one.iter().zip(other).all(near)
}

fn ball<const D: usize>() -> Solid<D>
where
    In<D>: Geometry<D>,
{
    Solid::new(Shape::Ball { radius: 0.1 }).expect("a solid")
}

fn cube<const D: usize>() -> Solid<D>
where
    In<D>: Geometry<D>,
{
    let half_extents = Vector::repeat(0.1);
    Solid::new(Shape::Cuboid { half_extents }).expect("a solid")
}

fn rod<const D: usize>() -> Solid<D>
where
    In<D>: Geometry<D>,
{
    let to = axis::<D>(0) * 0.2;
    Solid::new(Shape::Capsule {
        from: -to,
        to,
        radius: 0.05,
    })
    .expect("a solid")
}

/// Points along a straight line, not evenly.
fn along(pieces: usize, from: [f64; 2], to: [f64; 2]) -> Vec<Vector<2>> {
    let share = |k: usize| {
        let x = k as f64 / pieces as f64;
        x + 0.3 / pieces as f64 * (x * 9.0).sin() * (1.0 - x)
    };
    let at = |k: usize, axis: usize| from[axis] + (to[axis] - from[axis]) * share(k);
    (0..=pieces).map(|k| [at(k, 0), at(k, 1)].into()).collect()
}

/// Where bodies meet a wall along the first axis: anywhere, at joints and near them.
fn places() -> impl Iterator<Item = f64> {
    let even = (-30..=30).map(|k| 0.1 * f64::from(k));
    let seam = [
        0.0, 1e-12, -1e-10, 1e-8, -1e-6, 1e-4, 0.01, -0.05, 0.0999, 0.1,
    ];
    even.chain(seam)
}

fn turns() -> [f64; 5] {
    [0.0, 0.3, std::f64::consts::FRAC_PI_2, 2.0, -0.7]
}

/// A wall in pieces has the contacts of the wall in one: for bodies that touch it, are sunk in a
/// little or hover.
fn check<const D: usize>(
    one: &[Obstacle<D>],
    many: &[Obstacle<D>],
    pose: &Pose<D>,
    sides: &[f64],
    height: f64,
) where
    In<D>: Geometry<D>,
{
    let bodies = [(ball::<D>(), 0.1), (cube::<D>(), 0.1), (rod::<D>(), 0.05)];
    for (solid, reach) in &bodies {
        for x in places() {
            for gap in [0.0, -1e-5, 1e-6, 0.01, 0.03] {
                for side in sides {
                    let mut at = axis::<D>(0) * x;
                    at[D - 1] = side * (height + reach + gap);
                    let at = pose.then(&Pose::new(at, [0.0; 3]));
                    let (first, second) = (
                        contacts(one, solid, &at, 0.035),
                        contacts(many, solid, &at, 0.035),
                    );
                    assert!(!first.is_empty(), "{x} {gap}");
                    assert!(same(&first, &second), "{x} {gap}: {first:?} {second:?}");
                }
            }
        }
    }
}

#[test]
fn lines_in_pieces_are_lines() {
    for turn in turns() {
        let pose = Pose::<2>::new(Vector::<2>::new(0.7, -20.1), [0.0, 0.0, turn]);
        let wall = |pieces| {
            let points = along(pieces, [-4.0, 0.0], [4.0, 0.0]);
            vec![of(polyline(&points, false), &pose)]
        };
        for pieces in [2, 5, 24, 480] {
            check(&wall(1), &wall(pieces), &pose, &[1.0, -1.0], 0.0);
        }
    }
}

#[test]
fn rows_of_boxes_are_one_box() {
    fn row<const D: usize>(pieces: usize) -> Vec<Part<D>>
    where
        In<D>: Geometry<D>,
    {
        let at = |k: usize| -4.0 + 8.0 * k as f64 / pieces as f64;
        (0..pieces)
            .map(|k| block([at(k), -1.0, -1.0], [at(k + 1), 1.0, 1.0]))
            .collect()
    }
    fn all<const D: usize>(pose: &Pose<D>, pieces: usize, single: bool)
    where
        In<D>: Geometry<D>,
    {
        let (one, many) = (row::<D>(1), row::<D>(pieces));
        let one = blocks(one, pose, true);
        check(&one, &blocks(many, pose, single), pose, &[1.0, -1.0], 1.0);
    }
    for turn in turns() {
        for pieces in [2, 16] {
            for single in [true, false] {
                let pose = Pose::new(Vector::<2>::new(0.7, -20.1), [0.0, 0.0, turn]);
                all::<2>(&pose, pieces, single);
                let pose = Pose::new(Vector::<3>::new(0.7, -2.1, 9.0), [turn, 0.3, -turn]);
                all::<3>(&pose, pieces, single);
            }
        }
    }
}

#[test]
fn meshes_and_height_fields_are_the_floor_they_form() {
    for turn in turns() {
        let pose = Pose::new(Vector::<3>::new(0.7, -2.1, 9.0), [turn, 0.3, -turn]);
        // Thin on both sides; the one it is compared with is a slab whose top and bottom are here.
        let slab = |side: f64| {
            let (low, high) = (side.min(0.0), side.max(0.0));
            blocks(
                vec![block([-4.0, -4.0, -low.abs()], [4.0, 4.0, high])],
                &pose,
                true,
            )
        };
        let field = of(heightfield(&vec![vec![0.0; 9]; 17], [8.0, 8.0]), &pose);
        let corner = |x: f64, y: f64| point([x, y, 0.0]);
        let fan = [
            corner(0.0, 0.0),
            corner(4.0, 0.0),
            corner(4.0, 4.0),
            corner(-4.0, 4.0),
            corner(-4.0, -4.0),
            corner(4.0, -4.0),
        ];
        let triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1]];
        let fan = of(mesh(&fan, &triangles), &pose);
        for wall in [field, fan] {
            for side in [1.0, -1.0] {
                check(
                    &slab(-side),
                    std::slice::from_ref(&wall),
                    &pose,
                    &[side],
                    0.0,
                );
            }
        }
    }
}

#[test]
fn moving_walls_are_walls() {
    let pose = Pose::<2>::new(Vector::<2>::new(1.0, 2.0), [0.0, 0.0, 0.4]);
    let wall = |pieces| {
        of(
            polyline(&along(pieces, [-4.0, 0.0], [4.0, 0.0]), false),
            &pose,
        )
    };
    let motion = || Motion::Rotation {
        about: Some(Vector::<2>::new(-3.0, 0.0)),
        rate: [0.0, 0.0, 1.3],
    };
    let drift = || Motion::Waypoints {
        points: vec![Vector::<2>::zeros(), Vector::<2>::new(3.0, 1.0)],
        dwell: 0.0,
        period: 7.0,
        easing: Easing::Smooth,
    };
    for motion in [motion(), drift()] {
        for time in [0.0, 1.7, 100.3] {
            let at = |mut wall: Obstacle<2>| {
                wall = wall.moving(motion.clone());
                wall.move_to(time);
                vec![wall]
            };
            let one = at(wall(1));
            let pose = one[0].pose.clone();
            check(&one, &at(wall(24)), &pose, &[1.0, -1.0], 0.0);
        }
    }
}

#[test]
fn corners_that_stick_out_push() {
    // A ball about the corner of two lines, in many pieces: every normal between theirs.
    for bend in [0.3, 1.0, 2.0, 1e-3] {
        let (sin, cos) = f64::sin_cos(-bend);
        let mut points = along(7, [-4.0, 0.0], [0.0, 0.0]);
        points.extend(&along(7, [0.0, 0.0], [4.0 * cos, 4.0 * sin])[1..]);
        let pose = Pose::<2>::new(Vector::<2>::new(0.7, -20.1), [0.0, 0.0, 0.3]);
        let wall = [of(polyline(&points, false), &pose)];
        for share in [0.0, 0.01, 0.5, 0.99, 1.0] {
            let normal = Vector::<2>::new(f64::sin(share * bend), f64::cos(share * bend));
            for gap in [0.0, 0.01, -1e-6] {
                let at = pose.point_to_world(&(normal * (0.1 + gap)));
                let at = Pose::new(at, [0.0; 3]);
                let found = contacts(&wall, &ball(), &at, 0.02);
                let expected = pose.vector_to_world(&normal);
                assert!(same(&found, &[expected]), "{bend} {share} {gap}: {found:?}");
            }
        }
    }
}

#[test]
fn corners_that_bodies_fit_into_push_on_both_sides() {
    // The floor and a wall at an angle above it, in pieces, as lines and as blocks.
    for angle in [0.2, 1.0, std::f64::consts::FRAC_PI_2, 2.5] {
        let (sin, cos) = f64::sin_cos(angle);
        let mut points = along(5, [4.0 * cos, 4.0 * sin], [0.0, 0.0]);
        points.extend(&along(5, [0.0, 0.0], [4.0, 0.0])[1..]);
        let pose = Pose::<2>::new(Vector::<2>::new(0.7, -20.1), [0.0, 0.0, 0.3]);
        let wall = [of(polyline(&points, false), &pose)];
        let normals = [Vector::<2>::new(0.0, 1.0), Vector::<2>::new(sin, -cos)];
        let mut expected = normals.map(|n| pose.vector_to_world(&n));
        expected.sort_by(|a, b| a[0].total_cmp(&b[0]));
        // A ball in the corner touches both.
        let away = 0.1 / (0.5 * angle).tan();
        let at = Pose::new(pose.point_to_world(&Vector::<2>::new(away, 0.1)), [0.0; 3]);
        let found = contacts(&wall, &ball(), &at, 1e-6);
        assert!(same(&found, &expected), "{angle}: {found:?}");
        // A body whose corner fills it touches both too, sunk in a little or not.
        let tip = [0.0, 0.0, 0.0];
        let wedge = [tip, [0.3, 0.0, 0.0], [0.3 * cos, 0.3 * sin, 0.0]].map(point);
        let wedge = Solid::new(Shape::<2>::Triangle { points: wedge }).expect("a solid");
        for sunk in [0.0, 1e-9, 1e-6, 9e-6] {
            let inwards = (normals[0] + normals[1]) * -sunk;
            let at = pose.then(&Pose::new(inwards, [0.0; 3]));
            let found = contacts(&wall, &wedge, &at, 1e-7);
            assert!(same(&found, &expected), "{angle} {sunk}: {found:?}");
        }
    }
}

#[test]
fn a_box_in_the_corner_of_a_room_is_pushed_by_three_sides() {
    let room = || {
        let walls = vec![
            block([-1.0, -1.0, -1.0], [2.0, 2.0, 0.0]),
            block([-1.0, -1.0, 0.0], [0.0, 2.0, 2.0]),
            block([0.0, -1.0, 0.0], [2.0, 0.0, 2.0]),
        ];
        blocks::<3>(
            walls,
            &Pose::new(Vector::<3>::new(3.0, 1.0, 0.2), [0.2, 0.5, 0.1]),
            false,
        )
    };
    let walls = room();
    for sunk in [0.0, 1e-6, -1e-6] {
        let at = walls[0]
            .pose
            .then(&Pose::new(Vector::repeat(0.1 - sunk), [0.0; 3]));
        let found = contacts(&walls, &cube(), &at, 1e-5);
        let mut expected = [0, 1, 2].map(|k| walls[0].pose.vector_to_world(&axis(k)));
        expected.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert!(same(&found, &expected), "{sunk}: {found:?}");
    }
}

#[test]
fn shared_sides_push_nobody() {
    // Contacts on the side that two blocks share, at every height up to the top edge.
    let pose = Pose::<2>::new(Vector::<2>::new(0.7, -20.1), [0.0, 0.0, 0.3]);
    let row = vec![
        block([-1.0, -1.0, 0.0], [0.0, 0.0, 0.0]),
        block([0.0, -1.0, 0.0], [1.0, 0.0, 0.0]),
    ];
    for single in [true, false] {
        let walls = blocks::<2>(row.clone(), &pose, single);
        let mut boxes = Boxes::default();
        boxes.about(&walls);
        for height in [-0.5, -0.01, -1e-4, -1e-6, -1e-9, 0.0] {
            let at = pose.point_to_world(&Vector::<2>::new(0.0, height));
            for tilt in [0.0, 0.3, 1.0, 1.56, 1.5703, 1.570792, 1.5707962] {
                let (sin, cos) = f64::sin_cos(tilt);
                let normal = pose.vector_to_world(&Vector::<2>::new(cos, sin));
                if height < 0.0 && tilt > 0.0 {
                    continue;
                }
                let exposed = is_exposed(&walls, &boxes, (0, 0), &at, &normal, 0.1);
                assert!(!exposed, "{height} {tilt}");
            }
        }
        let up = pose.vector_to_world(&axis(1));
        let top = pose.translation;
        assert!(is_exposed(&walls, &boxes, (0, 0), &top, &up, 0.1));
    }
}

#[test]
fn corridors_push_from_their_walls_alone() {
    let points = [[-3.0, 0.0], [0.0, 0.0], [3.0, 2.0], [6.0, 2.0]].map(Vector::<2>::from);
    let mut fine: Vec<Vector<2>> = Vec::new();
    for pair in points.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        fine.extend(&along(24, a.into(), b.into())[..24]);
    }
    fine.push(points[3]);
    let pose = Pose::<2>::new(Vector::<2>::zeros(), [0.0; 3]);
    let walls = |points: &[Vector<2>]| {
        let shapes = corridor(points, 0.5, false).expect("a corridor");
        [of(shapes, &pose)]
    };
    let (coarse, fine) = (walls(&points), walls(&fine));
    let mut met = 0;
    for k in 0..2000 {
        let x = -2.9 + 0.0043 * f64::from(k);
        let middle = if x < 0.0 { 0.0 } else { (x / 1.5).min(2.0) };
        let at = Vector::<2>::new(x, middle + 0.17 * (f64::from(k) * 0.7).sin());
        let at = Pose::new(at, [0.0; 3]);
        let one = contacts(&coarse, &ball(), &at, 0.03);
        let many = contacts(&fine, &ball(), &at, 0.03);
        assert!(same(&one, &many), "{x}: {one:?} {many:?}");
        met += one.len();
    }
    assert!(met > 200, "{met}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever is nearest to a ball pushes it, however pieces stand.
    #[test]
    fn the_nearest_point_always_pushes(
        points in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 4..12),
        at in prop::array::uniform3(-1.5..1.5f64),
    ) {
        fn nearest<const D: usize>(shapes: Vec<Shape<D>>, at: [f64; 3]) where In<D>: Geometry<D> {
            let walls = [of(shapes, &Pose::new(point([0.3, 0.1, -0.2]), [0.2, 0.1, 0.4]))];
            let mut boxes = Boxes::default();
            boxes.about(&walls);
            let tiny = Solid::new(Shape::Ball { radius: 1e-3 }).expect("a solid");
            let at = Pose::new(point(at), [0.0; 3]);
            let parts = walls[0].parts().iter().enumerate();
            let found = parts.map(|(j, part)| (j, part.separation(&walls[0].pose, &tiny, &at)));
            let (part, found) = found.min_by(|(_, a), (_, b)| a.gap.total_cmp(&b.gap)).expect("parts");
            if found.gap > 0.0 {
                let normal = -found.normal;
                assert!(is_exposed(&walls, &boxes, (0, part), &found.points[1], &normal, 2e-3));
            }
        }
        let flat: Vec<Vector<2>> = points.iter().map(|&x| point(x)).collect();
        nearest::<2>(polyline(&flat, true), at);
        let space: Vec<Vector<3>> = points.iter().map(|&x| point(x)).collect();
        let triangles: Vec<[usize; 3]> = (2..points.len()).map(|k| [k - 2, k - 1, k]).collect();
        nearest::<3>(mesh(&space, &triangles), at);
    }
}
