//! Gaps between surfaces.

use crate::dynamics::Snapshot;
use crate::math::Vector;
use crate::metric::classes::{Class, classes};
use crate::sense::Cells;
use crate::shape::{Obstacle, Pose, Solid};
use crate::world::World;

/// The smallest gap between the surfaces of two agents, negative where they overlap (by
/// the depth of penetration); `None` for fewer than two.
pub fn agent_gap<const D: usize>(world: &World<D>, state: &Snapshot<'_, D>) -> Option<f64> {
    smallest_gap(
        state.positions,
        &world.agents.radius,
        pair_gap(world, state),
    )
}

/// The smallest gap between the surfaces of an agent and an obstacle, negative where
/// they overlap (by the depth of penetration); `None` without obstacles.
pub fn obstacle_gap<const D: usize>(world: &World<D>, state: &Snapshot<'_, D>) -> Option<f64> {
    let gap = gap_to(world, state);
    let mut smallest = f64::INFINITY;
    for (i, (position, radius)) in state.positions.iter().zip(&world.agents.radius).enumerate() {
        for obstacle in state.obstacles {
            if obstacle.may_reach(position, smallest + radius) {
                smallest = smallest.min(gap(i, obstacle));
            }
        }
    }
    smallest.is_finite().then_some(smallest)
}

/// The gap between two bodies, by their indices and the gap between the balls that hold them,
/// which is the answer for balls.
pub(super) fn pair_gap<'a, const D: usize>(
    world: &'a World<D>,
    state: &Snapshot<'a, D>,
) -> impl Fn(usize, usize, f64) -> f64 + 'a {
    let pose = poses(state);
    move |i, j, between_balls| {
        let (one, other) = (solid(world, i), solid(world, j));
        match &pose {
            Some(pose) if !(one.is_ball() && other.is_ball()) => one.gap(&pose(i), other, &pose(j)),
            _ => between_balls,
        }
    }
}

/// The gap between a body, by its index, and an obstacle.
pub(super) fn gap_to<'a, const D: usize>(
    world: &'a World<D>,
    state: &Snapshot<'a, D>,
) -> impl Fn(usize, &Obstacle<D>) -> f64 + 'a {
    let (pose, positions) = (poses(state), state.positions);
    move |i, obstacle| match &pose {
        Some(pose) if !solid(world, i).is_ball() => obstacle.gap(solid(world, i), &pose(i)),
        _ => obstacle.project(&positions[i]).distance - world.agents.radius[i],
    }
}

fn solid<const D: usize>(world: &World<D>, i: usize) -> &Solid<D> {
    &world.solids[world.agents.group[i]]
}

/// Where the bodies stand; `None` in worlds of balls alone.
fn poses<'a, const D: usize>(state: &Snapshot<'a, D>) -> Option<impl Fn(usize) -> Pose<D> + 'a> {
    let (positions, rotations) = (state.positions, state.rotations?);
    Some(move |i: usize| Pose::from_matrix(positions[i], rotations[i]))
}

/// The smallest gap of two bodies, by `exact` of their indices and the gap between the balls
/// of these radii that hold them, which is never more.
fn smallest_gap<const D: usize>(
    positions: &[Vector<D>],
    radii: &[f64],
    exact: impl Fn(usize, usize, f64) -> f64,
) -> Option<f64> {
    if positions.len() < 2 {
        return None;
    }
    let spread = positions
        .iter()
        .fold(0.0, |far, p| f64::max(far, (p - positions[0]).norm()));
    let classes = classes(positions, radii);
    let mut cells = Cells::default();
    let mut least = f64::INFINITY;
    let mut search = |small: &Class<D>, large: &Class<D>| {
        if std::ptr::eq(small, large) && small.len() < 2 {
            return;
        }
        let both = small.widest + large.widest;
        // A short range first, so that one far agent does not make neighbours of all others;
        // doubled until a pair is known that none outside the range can beat.
        let enough = |gap: f64| (both + gap) * (1.0 + 1e-12);
        let mut range = f64::max(2.0 * both, 1e-6 * spread).min(enough(least));
        while range > 0.0 {
            large.sort(&mut cells, range);
            let mut gap = least;
            small.pairs(
                large,
                &cells,
                |_| range,
                |i, j, squared| {
                    let between_balls = squared.sqrt() - radii[i] - radii[j];
                    if between_balls < gap {
                        gap = gap.min(exact(i, j, between_balls));
                    }
                },
            );
            least = gap;
            if enough(least) <= range || range > 2.0 * spread {
                return;
            }
            range = (2.0 * range).min(enough(least));
        }
    };
    // What is as large first: most often that bounds the rest.
    for class in &classes {
        search(class, class);
    }
    for (k, large) in classes.iter().enumerate() {
        for small in &classes[..k] {
            search(small, large);
        }
    }
    least.is_finite().then_some(least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn agent_gap_is_the_smallest_of_all(
            points in prop::collection::vec(prop::array::uniform2(-50.0..50.0f64), 2..40),
            radius in 0.01..3.0f64,
            spread in 0.1..3.0f64,
        ) {
            let points: Vec<Vector<2>> = points.into_iter().map(Vector::from).collect();
            let radii: Vec<f64> = (0..points.len()).map(|k| radius * spread.powi((k % 5) as i32)).collect();
            let mut smallest = f64::INFINITY;
            for i in 0..points.len() {
                for j in 0..i {
                    smallest = smallest.min((points[i] - points[j]).norm() - radii[i] - radii[j]);
                }
            }
            let gap = smallest_gap(&points, &radii, |_, _, gap| gap).expect("there are pairs");
            prop_assert!((gap - smallest).abs() < 1e-12);
        }
    }

    #[test]
    fn one_agent_has_no_gap() {
        assert_eq!(
            smallest_gap(&[Vector::<2>::zeros()], &[1.0], |_, _, gap| gap),
            None
        );
    }
}
