//! The transient layer, in which the agents come to one velocity where they are.

use super::coupling::Coupling;
use super::{NoReduction, stationary, weighted};
use crate::law::Field;
use crate::math::{DormandPrince, Solution, Vector, mean};

/// How exactly the layer is integrated, and how near to each other velocities are the same;
/// both as a share of their largest difference from the mean at the start.
const TOLERANCE: f64 = 1e-12;
const TOGETHER: f64 = 1e-9;

/// The most steps that may take.
const MOST_STEPS: usize = 200_000;

/// The velocity that the agents with a weight come to, and all others with them, by (4.23),
/// V' = ξ(u)u with the positions held. Influences that depend on velocities follow these.
pub(super) fn limit<const D: usize>(
    aligning: &mut Field<'_, D>,
    positions: &[Vector<D>],
    velocities: &[Vector<D>],
    weights: &[f64],
) -> Result<Vector<D>, NoReduction> {
    let center = mean(velocities);
    let from_center = velocities.iter().map(|v| (v - center).norm());
    let scale = from_center.fold(0.0, f64::max);
    if scale == 0.0 {
        return Ok(center);
    }
    // V = center + scale · W, so that neither tolerance depends on how fast the flock is.
    let unpack = |w: &[f64]| -> Vec<Vector<D>> {
        let vectors = w.chunks_exact(D).map(Vector::from_column_slice);
        vectors.map(|w| center + w * scale).collect()
    };
    let state = velocities.iter().map(|v| (v - center) / scale);
    let state: Vec<f64> = state.flat_map(|w| w.as_slice().to_vec()).collect();
    let counts: Vec<usize> = (0..weights.len()).filter(|&i| weights[i] > 0.0).collect();
    let slope = |_: f64, w: &[f64], out: &mut [f64]| {
        let v = unpack(w);
        let coupling = Coupling::of(aligning, 0.0, positions, &v);
        for (i, out) in out.chunks_exact_mut(D).enumerate() {
            let slope = coupling.acceleration(i, &v) / scale;
            out.copy_from_slice(slope.as_slice());
        }
    };
    let mut solution = Solution::new(slope, DormandPrince::default(), 0.0, state, TOLERANCE);
    let mut steps = 0;
    loop {
        let v = unpack(solution.state());
        let first = v[counts[0]];
        let far = counts.iter().map(|&i| (v[i] - first).norm());
        if far.fold(0.0, f64::max) <= TOGETHER * scale {
            drop(solution);
            // Gains hardly change any more, so from here on Σπ_i V_i is conserved.
            let rates = Coupling::of(aligning, 0.0, positions, &v).rates();
            let weights = stationary(&rates).ok_or(NoReduction::Parts)?;
            return Ok(weighted(&weights, &v));
        }
        if steps == MOST_STEPS {
            return Err(NoReduction::Endless { steps });
        }
        solution.advance()?;
        steps += 1;
    }
}

impl Coupling {
    /// The acceleration of agent i, ξ_i(u_i)u_i.
    fn acceleration<const D: usize>(&self, i: usize, velocities: &[Vector<D>]) -> Vector<D> {
        let mut u = Vector::zeros();
        for (j, velocity) in velocities.iter().enumerate() {
            u += (velocity - velocities[i]) * self.influences[(i, j)];
        }
        self.gains[i].of(&u)
    }
}
