//! Collisions by distance: who is closer than the bodies are thick.
//!
//! These look at positions alone, as the literature does. The true contacts of the bodies
//! are in the ledger: bodies push each other apart, so a pair that touches in the engine
//! may never be closer than the sum of its radii, or hardly.

use crate::dynamics::Snapshot;
use crate::math::Vector;
use crate::metric::classes::classes;
use crate::metric::gap::{gap_to, pair_gap};
use crate::sense::Cells;
use crate::world::World;

/// Collision ratio φ_coll: the share of pairs of agents that are closer than their bodies are
/// thick, 0 to 1: balls by the sum of their radii, other bodies by the gap between their surfaces.
/// G. Vásárhelyi et al., "Optimized flocking of autonomous drones in confined environments"
/// (2018), with the bodies' sizes for its collision distance. `None` for fewer than two agents.
pub fn collision_ratio<const D: usize>(world: &World<D>, state: &Snapshot<'_, D>) -> Option<f64> {
    let n = state.positions.len() as f64;
    let overlapping = || {
        overlapping_pairs(
            state.positions,
            &world.agents.radius,
            pair_gap(world, state),
        )
    };
    (state.positions.len() > 1).then(|| overlapping() as f64 / (0.5 * n * (n - 1.0)))
}

/// Safety Φ_safety = 1 − [`collision_ratio`]: E. Soria, F. Schiano & D. Floreano,
/// "SwarmLab: a Matlab drone swarm simulator" (2020). `None` for fewer than two agents,
/// where SwarmLab has 1.
pub fn safety<const D: usize>(world: &World<D>, state: &Snapshot<'_, D>) -> Option<f64> {
    collision_ratio(world, state).map(|ratio| 1.0 - ratio)
}

/// Safety from obstacles: 1 − the share of pairs of an agent and an obstacle that overlap;
/// SwarmLab, as [`safety`], which asks whether the centre is inside. `None` without obstacles.
pub fn obstacle_safety<const D: usize>(world: &World<D>, state: &Snapshot<'_, D>) -> Option<f64> {
    let (positions, radii) = (state.positions, &world.agents.radius);
    let pairs = positions.len() * state.obstacles.len();
    let gap = gap_to(world, state);
    let hits: usize = (0..positions.len())
        .map(|i| {
            let near = state.obstacles.iter();
            near.filter(|it| it.may_reach(&positions[i], radii[i]) && gap(i, it) < 0.0)
                .count()
        })
        .sum();
    (pairs > 0).then(|| 1.0 - hits as f64 / pairs as f64)
}

/// Pairs whose gap is below 0, by `exact` of their indices and the gap between the balls of
/// these radii that hold them.
fn overlapping_pairs<const D: usize>(
    positions: &[Vector<D>],
    radii: &[f64],
    exact: impl Fn(usize, usize, f64) -> f64,
) -> usize {
    let classes = classes(positions, radii);
    let mut cells = Cells::default();
    let mut pairs = 0;
    for (k, large) in classes.iter().enumerate() {
        if large.widest == 0.0 {
            continue;
        }
        large.sort(&mut cells, 2.0 * large.widest);
        // Small ones look for large ones, which are few about a place.
        for small in &classes[..=k] {
            let range = |i: usize| radii[i] + large.widest;
            small.pairs(large, &cells, range, |i, j, squared| {
                let between_balls = squared.sqrt() - (radii[i] + radii[j]);
                if between_balls < 0.0 {
                    pairs += usize::from(exact(i, j, between_balls) < 0.0);
                }
            });
        }
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
            let mut hits = 0;
            for i in 0..points.len() {
                for j in 0..i {
                    hits += usize::from((points[i] - points[j]).norm() < radii[i] + radii[j]);
                }
            }
            prop_assert_eq!(overlapping_pairs(&points, &radii, |_, _, gap| gap), hits);
        }
    }

    #[test]
    fn bodies_that_just_touch_do_not_collide() {
        let at = [Vector::<2>::zeros(), Vector::<2>::new(2.0, 0.0)];
        let pairs = |radii: [f64; 2]| overlapping_pairs(&at, &radii, |_, _, gap| gap);
        assert_eq!((pairs([1.0, 1.0]), pairs([1.0, 1.1])), (0, 1));
    }
}
