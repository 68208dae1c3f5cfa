//! The same shapes at another scale: the same bits.

use volary::math::direction;
use volary::shape::{Acting, Geometry, In, Obstacle, Part, Pose, Separation, Shape, Solid};

use crate::{point, shapes};

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
