//! Diameters of sets of points.

use crate::math::{Vector, mean};

/// The largest distance between two of the points, 0 for fewer than two: the position
/// diameter d_X and the velocity diameter d_V.
///
/// Exact. Points are taken in the order of their distance from the mean, farthest
/// first; no pair can be farther apart than its two distances add up to, which leaves
/// few pairs to look at.
pub fn diameter<const D: usize>(points: &[Vector<D>]) -> f64 {
    let center = mean(points);
    let mut by_distance: Vec<(f64, &Vector<D>)> = points
        .iter()
        .map(|point| ((point - center).norm(), point))
        .collect();
    by_distance.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut largest = 0.0;
    for (k, (far, point)) in by_distance.iter().enumerate() {
        if 2.0 * far <= largest {
            break;
        }
        for (near, other) in &by_distance[k + 1..] {
            if far + near <= largest {
                break;
            }
            largest = f64::max(largest, (*point - *other).norm());
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn equals_the_largest_of_all_distances(
            points in prop::collection::vec(prop::array::uniform3(-9.0..9.0f64), 0..60),
        ) {
            let points: Vec<Vector<3>> = points.into_iter().map(Vector::from).collect();
            let mut largest = 0.0f64;
            for a in &points {
                for b in &points {
                    largest = largest.max((a - b).norm());
                }
            }
            prop_assert!((diameter(&points) - largest).abs() <= 1e-12 * largest);
        }
    }
}
