//! Single cases with known answers.

use volary::math::{Matrix, Vector, axis};
use volary::shape::{Obstacle, Pose, Shape, Solid};

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
