//! Which obstacles are near.

use crate::math::Vector;
use crate::shape::{Boxes, Obstacle, Projection, Reach};

/// An obstacle, or one part of it, near enough to act on an agent, with the agent's
/// projection on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Active<const D: usize> {
    /// Index of the obstacle.
    pub obstacle: usize,
    /// Index of the part that the agent is projected on.
    pub part: usize,
    /// The β-agent.
    pub projection: Projection<D>,
}

/// Where some obstacles are, so that those that matter are found without looking at the others.
/// What is found is what a look at all of them finds, to the bit, in the order of the world.
#[derive(Debug, Default)]
pub struct Surroundings<const D: usize> {
    boxes: Boxes<D>,
}

impl<const D: usize> Surroundings<D> {
    /// Of some obstacles, where they are now.
    pub fn new(obstacles: &[Obstacle<D>]) -> Self {
        let mut surroundings = Self::default();
        surroundings.follow(obstacles);
        surroundings
    }

    /// Takes note of where obstacles are now; in little time where they are those before.
    pub fn follow(&mut self, obstacles: &[Obstacle<D>]) {
        self.boxes.about(obstacles);
    }

    /// Which of those obstacles may have a surface at most `range` from `point`, by index: all
    /// that [may](Obstacle::may_reach).
    pub fn near(&self, point: &Vector<D>, range: f64) -> impl Iterator<Item = usize> {
        let point = *point;
        self.boxes.reached(Reach::Around { point, range })
    }

    /// Those of those obstacles whose surface is at most `range` from `point`, or that contain
    /// it: the active obstacles of Olfati-Saber (2003), §11, in the order of the world. Of an
    /// obstacle of several parts that act each on its own, all those parts, in their order.
    pub fn active(
        &self,
        obstacles: &[Obstacle<D>],
        point: &Vector<D>,
        range: f64,
    ) -> impl Iterator<Item = Active<D>> {
        self.near(point, range).flat_map(move |obstacle| {
            let projections = obstacles[obstacle].projections(point, range);
            projections.map(move |(part, projection)| Active {
                obstacle,
                part,
                projection,
            })
        })
    }

    /// Which of those obstacles [block](Obstacle::blocks) the way between two points, by index,
    /// in the order of the world.
    pub fn between(
        &self,
        obstacles: &[Obstacle<D>],
        from: &Vector<D>,
        to: &Vector<D>,
    ) -> impl Iterator<Item = usize> {
        let near = self.boxes.reached(Reach::along(from, to));
        near.filter(move |&index| obstacles[index].blocks(from, to))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Acting, Geometry, In, Motion, Part, Pose, Shape};
    use proptest::prelude::*;
    use proptest::test_runner::TestCaseResult;

    /// One of all shapes, by number.
    fn shape<const D: usize>(kind: usize, a: [f64; 3], size: f64) -> Shape<D> {
        let corner = |k: usize| Vector::<D>::from_fn(|axis, _| a[(axis + k) % 3] * size);
        let along = |axis: usize| crate::math::axis::<D>(axis) * size;
        match kind % 7 {
            0 => Shape::Ball { radius: size },
            1 => Shape::Cuboid {
                half_extents: Vector::from_fn(|axis, _| size * (0.3 + a[axis].abs())),
            },
            2 => Shape::Capsule {
                from: corner(0),
                to: corner(1) + along(0),
                radius: 0.5 * size,
            },
            3 => Shape::HalfSpace {
                normal: crate::math::axis(0),
            },
            4 => Shape::Convex {
                points: (0..=D)
                    .map(|k| if k < D { along(k) } else { Vector::zeros() })
                    .collect(),
            },
            5 => Shape::Segment {
                from: corner(0),
                to: corner(1) + along(1),
            },
            _ => Shape::Triangle {
                points: [Vector::zeros(), along(0), along(1)],
            },
        }
    }

    type Dice = (usize, [f64; 3], [f64; 3], f64);

    fn obstacle<const D: usize>(&(kind, at, turn, size): &Dice) -> Obstacle<D>
    where
        In<D>: Geometry<D>,
    {
        let at = Vector::<D>::from_fn(|axis, _| 12.0 * at[axis]);
        // Half-spaces are rare and far out, or nothing would be in the open.
        let (kind, at) = match kind {
            3 => (3, at - crate::math::axis::<D>(0) * 14.0),
            _ if kind % 7 == 3 => (0, at),
            _ => (kind, at),
        };
        let turn = if kind == 3 { [0.0; 3] } else { turn };
        let pose = Pose::new(at, turn);
        let part = |k: usize| {
            let there = Vector::<D>::repeat(0.7 * k as f64);
            let part = Part::new(shape(kind + k, turn, size), Some(Pose::new(there, turn)));
            part.expect("a solid")
        };
        let obstacle = match kind {
            20.. => Obstacle::of_parts(
                String::new(),
                (0..kind - 8)
                    .filter(|k| (kind + k) % 7 != 3)
                    .map(part)
                    .collect(),
                if kind % 2 == 0 {
                    Acting::Each
                } else {
                    Acting::Nearest
                },
                pose,
            ),
            _ => Obstacle::new(String::new(), shape(kind, turn, size), pose),
        };
        let obstacle = obstacle.expect("a solid");
        match kind % 5 {
            0 if kind > 0 => obstacle.moving(Motion::Drift {
                velocity: Vector::repeat(turn[0]),
            }),
            _ => obstacle,
        }
    }

    fn equals_a_look_at_all<const D: usize>(dice: &[Dice], points: &[[f64; 3]]) -> TestCaseResult
    where
        In<D>: Geometry<D>,
    {
        let mut obstacles: Vec<Obstacle<D>> = dice.iter().map(obstacle).collect();
        let mut surroundings = Surroundings::default();
        for time in [0.0, 0.0, 0.5, 8.0] {
            obstacles.iter_mut().for_each(|it| it.move_to(time));
            surroundings.follow(&obstacles);
            for ends in points.windows(2) {
                let [from, to] =
                    [0, 1].map(|k| Vector::<D>::from_fn(|axis, _| 14.0 * ends[k][axis]));
                let range = 6.0 * ends[0][2].abs();
                let all = obstacles.iter().enumerate();
                let near = all.clone().filter(|(_, it)| it.may_reach(&from, range));
                let near: Vec<usize> = near.map(|(index, _)| index).collect();
                prop_assert_eq!(surroundings.near(&from, range).collect::<Vec<_>>(), near);
                let active = all.clone().flat_map(|(obstacle, it)| {
                    let each = it.projections(&from, range);
                    each.map(move |(part, projection)| (obstacle, part, projection))
                });
                let active: Vec<_> = active.collect();
                let found = surroundings.active(&obstacles, &from, range);
                let found: Vec<_> = found
                    .map(|it| (it.obstacle, it.part, it.projection))
                    .collect();
                prop_assert_eq!(found, active);
                // Without any look at boxes.
                let meets = |it: &Obstacle<D>| {
                    let [a, b] = [&from, &to].map(|end| it.pose.point_to_local(end));
                    it.meets_any(&a, &b)
                };
                let blocking: Vec<usize> = all
                    .filter(|(_, it)| meets(it))
                    .map(|(index, _)| index)
                    .collect();
                let found = surroundings.between(&obstacles, &from, &to);
                prop_assert_eq!(found.collect::<Vec<_>>(), blocking);
            }
        }
        Ok(())
    }

    fn dice() -> impl Strategy<Value = Vec<Dice>> {
        let unit = || prop::array::uniform3(-1.0..1.0f64);
        prop::collection::vec((0..24usize, unit(), unit(), 0.1..1.5f64), 0..70)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn nothing_is_missed_in_the_plane(
            dice in dice(),
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 12),
        ) {
            equals_a_look_at_all::<2>(&dice, &points)?;
        }

        #[test]
        fn nothing_is_missed_in_space(
            dice in dice(),
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 12),
        ) {
            equals_a_look_at_all::<3>(&dice, &points)?;
        }
    }

    #[test]
    fn any_number_is_found_in_order() {
        let ball = Shape::Ball { radius: 1.0 };
        let at = |k: usize| Pose::new(Vector::<2>::new((k * 37 % 200) as f64, 0.0), [0.0; 3]);
        let obstacles: Vec<_> = (0..200)
            .map(|k| Obstacle::new(String::new(), ball.clone(), at(k)).expect("a solid"))
            .collect();
        let surroundings = Surroundings::new(&obstacles);
        let all: Vec<usize> = surroundings.near(&Vector::<2>::zeros(), 1e3).collect();
        assert!(all.into_iter().eq(0..200));
        let through = [-5.0, 500.0].map(|x| Vector::<2>::new(x, 0.5));
        let blocked = surroundings.between(&obstacles, &through[0], &through[1]);
        assert!(blocked.eq(0..200));
        let beside = through.map(|end| end + Vector::<2>::new(0.0, 1.0));
        assert_eq!(
            surroundings
                .between(&obstacles, &beside[0], &beside[1])
                .count(),
            0
        );
    }

    #[test]
    fn nothing_stands_around_without_obstacles() {
        let surroundings = Surroundings::<3>::new(&[]);
        assert_eq!(
            surroundings
                .near(&Vector::<3>::zeros(), f64::INFINITY)
                .count(),
            0
        );
    }
}
