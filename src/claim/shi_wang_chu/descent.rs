//! Going down the potential of all pairs from a configuration, to a minimum near by.

use super::model::gradient;
use crate::math::{Potential, Vector};

/// How often a descent may ask for the potential of a pair.
pub(super) const BUDGET: usize = 400_000;

/// The sum of the potentials of all pairs.
pub(super) fn total<const D: usize>(potential: Potential, positions: &[Vector<D>]) -> f64 {
    let mut sum = 0.0;
    for (i, x) in positions.iter().enumerate() {
        for y in &positions[i + 1..] {
            sum += potential.value((x - y).norm());
        }
    }
    sum
}

/// What is left of [`total`] at the end of a descent by steepest slope, its steps those of
/// Barzilai and Borwein, halved where they do not lead down.
pub(super) fn descend<const D: usize>(potential: Potential, start: &[Vector<D>]) -> f64 {
    let squared = |vectors: &[Vector<D>]| -> f64 { vectors.iter().map(Vector::norm_squared).sum() };
    let mut at = start.to_vec();
    let mut value = total(potential, &at);
    let mut slope = gradient(potential, &at);
    let mut step = 1e-2;
    // A round takes a value and a gradient.
    let rounds = BUDGET / (at.len() * at.len()).max(1);
    for _ in 0..rounds {
        let steepness = squared(&slope);
        // Below this, a descent of a length of 1 changes less than rounding does.
        if steepness < 1e-24 * value * value {
            break;
        }
        let moves = at.iter().zip(&slope);
        let next: Vec<Vector<D>> = moves.map(|(x, g)| x - g * step).collect();
        let lower = total(potential, &next);
        if lower > value - 0.3 * step * steepness {
            step *= 0.5;
            continue;
        }
        let turned = gradient(potential, &next);
        let change: Vec<Vector<D>> = turned.iter().zip(&slope).map(|(a, b)| a - b).collect();
        let along = change.iter().zip(&slope).map(|(y, g)| -step * y.dot(g));
        let along: f64 = along.sum();
        let length = step * step * steepness;
        step = if along > 0.0 {
            length / along
        } else {
            2.0 * step
        };
        (at, value, slope) = (next, lower, turned);
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_agents_come_to_an_equilateral_triangle() {
        let potential = Potential::Logarithmic {
            attraction: 0.5,
            repulsion: 2.5,
        };
        let at = [(0.0, 0.0), (9.0, 1.0), (2.0, 4.0)];
        let at = at.map(|(x, y)| Vector::<2>::new(x, y));
        let least = 3.0 * potential.value(5f64.sqrt());
        assert!((descend(potential, &at) - least).abs() < 1e-12);
        assert!(total(potential, &at) > least + 1.0);
    }
}
