//! Collisions by distance: who is closer than the bodies are thick.
//!
//! These look at positions alone, as the literature does. The true contacts of the bodies
//! are in the ledger: bodies push each other apart, so a pair that touches in the engine
//! may never be closer than the sum of its radii, or hardly.

use crate::math::Vector;
use crate::sense::Cells;
use crate::shape::Obstacle;

/// Collision ratio φ_coll: the share of pairs of agents that are closer than the sum of
/// their radii, 0 to 1. G. Vásárhelyi et al., "Optimized flocking of autonomous drones in
/// confined environments" (2018), with the bodies' sizes for its collision distance.
/// `None` for fewer than two agents.
pub fn collision_ratio<const D: usize>(positions: &[Vector<D>], radii: &[f64]) -> Option<f64> {
    let n = positions.len() as f64;
    (positions.len() > 1)
        .then(|| overlapping_pairs(positions, radii) as f64 / (0.5 * n * (n - 1.0)))
}

/// Safety Φ_safety = 1 − [`collision_ratio`]: E. Soria, F. Schiano & D. Floreano,
/// "SwarmLab: a Matlab drone swarm simulator" (2020). `None` for fewer than two agents,
/// where SwarmLab has 1.
pub fn safety<const D: usize>(positions: &[Vector<D>], radii: &[f64]) -> Option<f64> {
    collision_ratio(positions, radii).map(|ratio| 1.0 - ratio)
}

/// Safety from obstacles: 1 − the share of pairs of an agent and an obstacle in which the
/// agent's centre is closer to the surface than its radius, or inside; SwarmLab, as
/// [`safety`], which asks whether the centre is inside. `None` without obstacles.
pub fn obstacle_safety<const D: usize>(
    positions: &[Vector<D>],
    radii: &[f64],
    obstacles: &[Obstacle<D>],
) -> Option<f64> {
    let pairs = positions.len() * obstacles.len();
    let hit = |(position, &radius): (&Vector<D>, &f64)| {
        obstacles
            .iter()
            .filter(|obstacle| {
                obstacle.may_reach(position, radius) && obstacle.project(position).distance < radius
            })
            .count()
    };
    let hits: usize = positions.iter().zip(radii).map(hit).sum();
    (pairs > 0).then(|| 1.0 - hits as f64 / pairs as f64)
}

fn overlapping_pairs<const D: usize>(positions: &[Vector<D>], radii: &[f64]) -> usize {
    let widest = radii.iter().copied().fold(0.0, f64::max);
    if widest == 0.0 {
        return 0;
    }
    let mut cells = Cells::default();
    cells.rebuild(positions, 2.0 * widest);
    let mut pairs = 0;
    for (i, position) in positions.iter().enumerate() {
        cells.for_each_within(position, radii[i] + widest, |place, _, squared| {
            let j = cells.order()[place] as usize;
            pairs += usize::from(i < j && squared.sqrt() < radii[i] + radii[j]);
        });
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn counts_the_pairs_that_overlap(
            points in prop::collection::vec(prop::array::uniform3(-4.0..4.0f64), 2..50),
            radius in 0.05..1.5f64,
        ) {
            let points: Vec<Vector<3>> = points.into_iter().map(Vector::from).collect();
            let radii: Vec<f64> =
                (0..points.len()).map(|k| radius * (1.0 + (k % 3) as f64)).collect();
            let (mut hits, mut pairs) = (0, 0);
            for i in 0..points.len() {
                for j in 0..i {
                    pairs += 1;
                    hits += usize::from((points[i] - points[j]).norm() < radii[i] + radii[j]);
                }
            }
            let ratio = hits as f64 / f64::from(pairs);
            prop_assert!((collision_ratio(&points, &radii).unwrap() - ratio).abs() < 1e-15);
            prop_assert!((safety(&points, &radii).unwrap() - (1.0 - ratio)).abs() < 1e-15);
        }
    }

    #[test]
    fn bodies_that_just_touch_do_not_collide() {
        let at = [Vector::<2>::zeros(), Vector::<2>::new(2.0, 0.0)];
        assert_eq!(collision_ratio(&at, &[1.0, 1.0]), Some(0.0));
        assert_eq!(collision_ratio(&at, &[1.0, 1.1]), Some(1.0));
        assert_eq!(collision_ratio(&at[..1], &[1.0]), None);
    }
}
