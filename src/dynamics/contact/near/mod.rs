//! Who may touch whom in a step, and who came closest so far.
//!
//! Both are lists that serve many steps. Each agent has a budget: the way that it may go before
//! its entries must be found anew. Pairs are listed whose gap is within their budgets, so no
//! other pair can have met while nobody has used up the own one. A fast or a large agent thus
//! makes its own list longer, and nobody else's. Lists decide who is looked at, never what is
//! found: results do not tell when they were made.

mod agents;
mod walls;

pub(super) use agents::Agents;
pub(super) use walls::Walls;

/// Budgets are this many times the way of the step in which lists are made.
const STEPS: f64 = 8.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vector;
    use crate::shape::{Obstacle, Pose, Shape, Solid};
    use proptest::prelude::*;

    fn walk(start: &[[f64; 2]], pushes: &[[f64; 2]], speed: f64) -> Vec<Vec<Vector<2>>> {
        let mut positions: Vec<Vector<2>> = start.iter().map(|at| Vector::from(*at)).collect();
        let mut all = vec![positions.clone()];
        for step in 0..30 {
            for (k, position) in positions.iter_mut().enumerate() {
                // One is much faster than the others.
                let fast = if k == 0 { 9.0 } else { 1.0 };
                *position += Vector::from(pushes[(k + step) % pushes.len()]) * (speed * fast);
            }
            all.push(positions.clone());
        }
        all
    }

    /// The least gap of two balls on straight ways.
    fn least(radii: f64, before: Vector<2>, after: Vector<2>) -> f64 {
        let shares = (0..=20).map(|k| f64::from(k) / 20.0);
        let gaps = shares.map(|s| (before + (after - before) * s).norm() - radii);
        gaps.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn lists_are_as_short_far_away_and_in_flight() {
        let lattice = |at: f64| -> Vec<Vector<2>> {
            let place = |k: usize| Vector::<2>::new(at + (k % 20) as f64, at + (k / 20) as f64);
            (0..400).map(place).collect()
        };
        let mut agents = Agents::new(&[0.1; 400]);
        for (from, to) in [(1e6, 1e6), (1e6, 1e6 + 50.0), (1e6 + 50.0, 1e6 + 99.0)] {
            let (from, to) = (lattice(from), lattice(to));
            agents.follow([&from, &to], &|_| 0.0, 0.8);
            let mut pairs = 0;
            agents.below(f64::INFINITY, |_, _| pairs += 1);
            // Each with the eight around it at most.
            assert!(pairs < 4 * 400, "{pairs}");
        }
    }

    #[test]
    fn who_bounces_far_is_listed_where_it_is() {
        let ball = Solid::new(Shape::Ball { radius: 0.1 }).expect("a ball");
        let wall = Shape::Cuboid {
            half_extents: Vector::<2>::new(0.1, 5.0),
        };
        let wall = Obstacle::new(String::new(), wall, Pose::new([9.0, 0.0].into(), [0.0; 3]));
        let walls_there = [wall.expect("a box")];
        let mut agents = Agents::new(&[0.1; 3]);
        let mut walls = Walls::new(vec![ball], &[0, 0, 0]);
        let stood: Vec<Vector<2>> = [[0.0, 0.0], [5.0, 0.0], [8.0, 0.0]]
            .map(Vector::<2>::from)
            .into();
        agents.follow([&stood, &stood], &|_| 0.0, 0.1);
        walls.follow([&stood, &stood], &|_| 0.0, &walls_there, &|_| 0.0);
        assert!(!agents.stray(0, 8.7) && !walls.stray(0, 8.7));
        let mut now = stood.clone();
        now[0].x = 8.795;
        agents.follow_bounces([&stood, &now], 0.1);
        walls.follow_bounces(&now, &walls_there);
        let (mut pairs, mut near) = (Vec::new(), Vec::new());
        agents.below(0.01, |one, other| pairs.push((one, other)));
        walls.below(0.01, |agent, wall, part| near.push((agent, wall, part)));
        assert!(pairs.contains(&(0, 2)), "{pairs:?}");
        assert_eq!(near, [(0, 0, 0)]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(10))]
        #[test]
        fn no_pair_and_no_wall_is_missed(
            start in prop::collection::vec(prop::array::uniform2(-9.0..9.0f64), 2..40),
            pushes in prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 1..9),
            widths in prop::collection::vec(0.01..2.0f64, 1..5),
            speed in 0.0..0.7f64,
        ) {
            let radii: Vec<f64> = (0..start.len()).map(|k| widths[k % widths.len()]).collect();
            let kinds: Vec<usize> = (0..start.len()).map(|k| k % widths.len()).collect();
            let ball = |&radius: &f64| Solid::new(Shape::Ball { radius }).expect("a ball");
            let balls: Vec<Solid<2>> = widths.iter().map(ball).collect();
            let obstacles: Vec<Obstacle<2>> = (0..12)
                .map(|k| {
                    let at = Vector::<2>::new(f64::from(k % 4) * 5.0 - 8.0, f64::from(k / 4) * 6.0);
                    let half_extents = Vector::<2>::new(0.5, 0.2 + 0.1 * f64::from(k));
                    let pose = Pose::new(at, [0.0, 0.0, f64::from(k)]);
                    let shape = Shape::Cuboid { half_extents };
                    Obstacle::new(String::new(), shape, pose).expect("a box")
                })
                .collect();
            let places = walk(&start, &pushes, speed);
            let mut agents = Agents::new(&radii);
            let mut walls = Walls::new(balls.clone(), &kinds);
            for pair in [[&places[0], &places[0]]].into_iter().chain(places.windows(2).map(|it| [&it[0], &it[1]])) {
                let ways = [&pair[0][..], &pair[1][..]];
                agents.follow(ways, &|_| 0.0, f64::INFINITY);
                walls.follow(ways, &|_| 0.0, &obstacles, &|_| 0.0);
                let mut found = std::collections::HashSet::new();
                agents.below(0.0, |one, other| { found.insert((one, other)); });
                let mut met = std::collections::HashSet::new();
                walls.below(0.0, |agent, obstacle, _| { met.insert((agent, obstacle)); });
                for i in 0..start.len() {
                    for j in i + 1..start.len() {
                        let (before, after) = (ways[0][j] - ways[0][i], ways[1][j] - ways[1][i]);
                        let gap = least(radii[i] + radii[j], before, after);
                        prop_assert!(gap >= 0.0 || found.contains(&(i, j)), "{i} and {j}");
                    }
                    for (k, obstacle) in obstacles.iter().enumerate() {
                        let gap = (0..=20)
                            .map(|s| ways[0][i] + (ways[1][i] - ways[0][i]) * (f64::from(s) / 20.0))
                            .map(|at| obstacle.project(&at).distance - radii[i])
                            .fold(f64::INFINITY, f64::min);
                        prop_assert!(gap >= 0.0 || met.contains(&(i, k)), "{i} and wall {k}");
                    }
                }
            }
        }
    }
}
