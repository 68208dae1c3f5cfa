//! Gaps between surfaces.

use crate::math::Vector;
use crate::sense::Cells;
use crate::shape::Obstacle;

/// The smallest gap between the surfaces of two agents, negative where they overlap;
/// `None` for fewer than two.
pub fn agent_gap<const D: usize>(positions: &[Vector<D>], radii: &[f64]) -> Option<f64> {
    if positions.len() < 2 {
        return None;
    }
    let widest = radii.iter().copied().fold(0.0, f64::max);
    let mut cells = Cells::default();
    // A short range first, so that one far agent does not make neighbours of all others;
    // doubled until a pair is found that none outside the range can beat.
    let spread = positions
        .iter()
        .fold(0.0, |far, p| f64::max(far, (p - positions[0]).norm()));
    let mut range = f64::max(4.0 * widest, 1e-6 * spread);
    loop {
        cells.rebuild(positions, range);
        let mut gap = f64::INFINITY;
        for (i, position) in positions.iter().enumerate() {
            cells.for_each_within(position, range, |place, _, squared| {
                let j = cells.order()[place] as usize;
                if i < j {
                    gap = gap.min(squared.sqrt() - radii[i] - radii[j]);
                }
            });
        }
        // A pair beyond the range has a gap of at least range − 2 widest.
        if gap <= range - 2.0 * widest || range > 2.0 * spread {
            return gap.is_finite().then_some(gap);
        }
        range *= 2.0;
    }
}

/// The smallest gap between the surfaces of an agent and an obstacle, negative where
/// they overlap; `None` without obstacles.
pub fn obstacle_gap<const D: usize>(
    positions: &[Vector<D>],
    radii: &[f64],
    obstacles: &[Obstacle<D>],
) -> Option<f64> {
    let mut smallest = f64::INFINITY;
    for (position, radius) in positions.iter().zip(radii) {
        for obstacle in obstacles {
            if obstacle.may_reach(position, smallest + radius) {
                smallest = smallest.min(obstacle.project(position).distance - radius);
            }
        }
    }
    smallest.is_finite().then_some(smallest)
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
        ) {
            let points: Vec<Vector<2>> = points.into_iter().map(Vector::from).collect();
            let radii: Vec<f64> = (0..points.len()).map(|k| radius * (1.0 + (k % 3) as f64)).collect();
            let mut smallest = f64::INFINITY;
            for i in 0..points.len() {
                for j in 0..i {
                    smallest = smallest.min((points[i] - points[j]).norm() - radii[i] - radii[j]);
                }
            }
            let gap = agent_gap(&points, &radii).expect("there are pairs");
            prop_assert!((gap - smallest).abs() < 1e-12);
        }
    }

    #[test]
    fn one_agent_has_no_gap() {
        assert_eq!(agent_gap(&[Vector::<2>::zeros()], &[1.0]), None);
    }
}
