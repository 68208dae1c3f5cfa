//! Pairs that slide: the laws drive them back to a distance from both sides.
//!
//! A. F. Filippov, "Differential Equations with Discontinuous Righthand Sides", 1988. At a distance
//! where laws end at once, a pair whose distance accelerates outwards within and inwards beyond
//! cannot leave it. It comes and goes ever faster, and what is left in the limit is a motion at
//! that distance, under a mean of the accelerations of both sides: its weights are those with
//! which the distance stays. Several pairs have a weight each, and a(α) = a(0) + Σ α_k (a_k − a(0))
//! with a_k the accelerations where pair k alone is within.

use nalgebra::{DMatrix, DVector};

use super::watched::Watched;
use crate::math::Vector;

/// Rounds in which pairs that share agents are put right.
const ROUNDS: usize = 8;

/// The weights with which all these pairs keep their distances, from the accelerations with none
/// of them within and with each of them alone.
pub(super) fn weights<const D: usize>(
    pairs: &[Watched],
    [x, v]: [&[Vector<D>]; 2],
    beyond: &[Vector<D>],
    within: &[Vec<Vector<D>>],
) -> Vec<f64> {
    let size = pairs.len();
    let bend = |pair: &Watched, a: &[Vector<D>]| pair.course([x, v, a])[2];
    let base = DVector::from_fn(size, |k, _| bend(&pairs[k], beyond));
    let effects = DMatrix::from_fn(size, size, |k, l| bend(&pairs[k], &within[l]) - base[k]);
    match effects.lu().solve(&-base) {
        Some(weights) if weights.iter().all(|weight| weight.is_finite()) => {
            weights.iter().copied().collect()
        }
        // Pairs that nothing tells apart share the weight evenly.
        _ => vec![0.5; size],
    }
}

/// a(α).
pub(super) fn mixed<const D: usize>(
    beyond: &[Vector<D>],
    within: &[Vec<Vector<D>>],
    weights: &[f64],
    out: &mut [Vector<D>],
) {
    for (i, out) in out.iter_mut().enumerate() {
        *out = beyond[i];
        for (within, weight) in within.iter().zip(weights) {
            *out += (within[i] - beyond[i]) * *weight;
        }
    }
}

/// Puts pairs at their distances, and takes out the rates of these; the momentum stays.
pub(super) fn put_right<const D: usize>(
    pairs: &[Watched],
    masses: &[f64],
    x: &mut [Vector<D>],
    v: &mut [Vector<D>],
) {
    for _ in 0..if pairs.len() > 1 { ROUNDS } else { 1 } {
        for one in pairs {
            let [i, j] = one.pair.map(|agent| agent as usize);
            let way = x[j] - x[i];
            let length = way.norm();
            let along = way / length;
            let rate = (v[j] - v[i]).dot(&along);
            let share = masses[j] / (masses[i] + masses[j]);
            let excess = length - one.distance;
            x[i] += along * (excess * share);
            x[j] -= along * (excess * (1.0 - share));
            v[i] += along * (rate * share);
            v[j] -= along * (rate * (1.0 - share));
        }
    }
}
