//! The energy falls: (9), and the proofs of Theorems 1 and 3.

use super::damping::Damping;
use super::model::Model;
use crate::claim::falling::rounding;
use crate::claim::{About, Claim, Falling, Finding, Judging, Reading, Run};
use crate::math::Vector;

const ABOUT: About = About {
    name: "shi-wang-chu/energy-falls",
    source: "Shi, Wang & Chu, Theorem 1 with (9), Theorem 3, Remarks 5 and 6",
    reading: Reading::Printed,
    statement: "J = ½ Σ m_i |v_i|² + ½ Σ V^i never rises: \
                dJ/dt = −½ vᵀ((L + Lᵀ) ⊗ I)v − Σ k_i |v_i|² ≤ 0. With (15), masses count as 1.",
    hypotheses: "Control (6) or (15) with balanced weights, no other forces but damping.",
    measured: "J in every observation; its rate by velocities and accelerations, which is to be \
               the dissipation of the formula too.",
    tolerance: "Of J: of points 100 times the integrator's accuracy, of bodies step² times masses, \
                speeds and jerks. Of rates 1e-9 of the powers they are the sums of and 1e-12 of the largest, for rounding.",
};

/// See the file.
pub(super) struct EnergyFalls;

impl<const D: usize> Claim<D> for EnergyFalls {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose(&mut judging, Damping::Any);
        model.suppose_balance(&mut judging);
        let laplacian = model.laplacian();
        let energy = run.series(|seen| model.energy(seen, &seen.velocities));
        let slack = run.observations.iter().zip(&energy);
        let slack = slack.map(|(seen, energy)| model.energy_slack(seen, *energy, &Vector::zeros()));
        let slack: Vec<f64> = slack.collect();
        let powers = run.observations.iter();
        let powers = powers.map(|seen| model.power(seen, &seen.velocities));
        let powers: Vec<(f64, f64)> = powers.collect();
        let off = run.observations.iter().zip(&powers);
        let off = off.map(|(seen, (rate, _))| {
            let claimed = model.dissipation(&laplacian, &seen.velocities);
            (rate - claimed).abs()
        });
        let sizes: Vec<f64> = powers.iter().map(|(_, size)| *size).collect();
        let largest = sizes.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let off = off.fold(0.0, f64::max) / largest;
        judging.falls(Falling {
            name: "J",
            times: run.times(),
            values: energy,
            slack,
            rates: powers.iter().map(|(rate, _)| *rate).collect(),
            rate_slack: rounding(&sizes),
        });
        if run.observations.len() > 1 {
            judging.equal(
                "max |dJ/dt + ½vᵀ((L + Lᵀ) ⊗ I)v + Σ k_i|v_i|²|, a share",
                off,
                0.0,
                1e-9,
                1.0,
            );
        }
        Some(judging.finding())
    }
}
