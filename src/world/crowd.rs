//! Obstacles so crowded that the engine would drown in them.
//!
//! Before the first step it lists all pairs of parts whose boxes overlap, those of obstacles that
//! cannot move included: a hundred thousand obstacles at one place are five thousand million
//! pairs, some dozens of gigabytes.

use crate::shape::{Bounds, Obstacle};
use crate::world::limits::MOST_OVERLAPS;
use crate::world::problem::Problem;

/// What is wrong where too many parts of obstacles overlap one another, if so.
pub(super) fn problem<const D: usize>(obstacles: &[Obstacle<D>]) -> Option<Problem> {
    let boxes = obstacles.iter().enumerate().flat_map(|(index, obstacle)| {
        let boxes = obstacle.boxes_of_parts();
        boxes.map(move |bounds| (bounds, index))
    });
    let (boxes, owners): (Vec<Bounds<D>>, Vec<usize>) = boxes.unzip();
    let most = first_beyond(&boxes, MOST_OVERLAPS)?;
    let what = "overlaps others, as too many obstacles or parts of them do: the boxes about them \
                make more pairs";
    let problem = Problem::new(format!("obstacles[{}]", owners[most]), what);
    Some(problem.allowed(format!("at most {MOST_OVERLAPS} pairs")))
}

/// The box with which the pairs of overlapping boxes become more than `most`, in the order of a
/// sweep; nothing where they do not.
fn first_beyond<const D: usize>(boxes: &[Bounds<D>], most: usize) -> Option<usize> {
    let axis = (0..D).min_by_key(|&axis| side_by_side(boxes, axis))?;
    if side_by_side(boxes, axis) <= most {
        return None;
    }
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&a, &b| boxes[a].0[axis].total_cmp(&boxes[b].0[axis]));
    let mut pairs = 0;
    for (rank, &a) in order.iter().enumerate() {
        let (low, high) = &boxes[a];
        for &b in &order[rank + 1..] {
            let (other_low, other_high) = &boxes[b];
            if other_low[axis] > high[axis] {
                break;
            }
            let overlap = |k: usize| low[k] <= other_high[k] && other_low[k] <= high[k];
            pairs += usize::from((0..D).all(overlap));
            if pairs > most {
                return Some(b);
            }
        }
    }
    None
}

/// How many pairs of boxes overlap as seen along an axis.
fn side_by_side<const D: usize>(boxes: &[Bounds<D>], axis: usize) -> usize {
    let mut lows: Vec<f64> = boxes.iter().map(|(low, _)| low[axis]).collect();
    let mut highs: Vec<f64> = boxes.iter().map(|(_, high)| high[axis]).collect();
    lows.sort_unstable_by(f64::total_cmp);
    highs.sort_unstable_by(f64::total_cmp);
    // For each that begins, those that have begun before it and not ended yet.
    let mut ended = 0;
    let mut pairs = 0usize;
    for (begun, low) in lows.iter().enumerate() {
        while highs[ended] < *low {
            ended += 1;
        }
        pairs += begun - ended;
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vector;

    fn at(x: f64, y: f64, half: [f64; 2]) -> Bounds<2> {
        let half = Vector::from(half);
        (Vector::from([x, y]) - half, Vector::from([x, y]) + half)
    }

    #[test]
    fn counts_pairs_that_overlap() {
        // Long walls above one another, all as wide: no two overlap.
        let walls: Vec<_> = (0..50)
            .map(|k| at(0.0, f64::from(k), [90.0, 0.4]))
            .collect();
        assert_eq!(side_by_side(&walls, 0), 50 * 49 / 2);
        assert_eq!(side_by_side(&walls, 1), 0);
        assert_eq!(first_beyond(&walls, 0), None);
        // Each touches the next one.
        let row: Vec<_> = (0..50).map(|k| at(f64::from(k), 0.0, [0.5, 0.5])).collect();
        assert_eq!(first_beyond(&row, 49), None);
        assert_eq!(first_beyond(&row, 48), Some(49));
        let heap = vec![at(3.0, 4.0, [1.0, 1.0]); 20];
        assert_eq!(first_beyond(&heap, 190), None);
        assert_eq!(first_beyond(&heap, 189), Some(19));
        // Whole planes overlap everything.
        let all = (
            Vector::repeat(f64::NEG_INFINITY),
            Vector::repeat(f64::INFINITY),
        );
        assert_eq!(first_beyond(&[walls, vec![all]].concat(), 50), None);
        assert_eq!(first_beyond::<2>(&[], 0), None);
    }
}
