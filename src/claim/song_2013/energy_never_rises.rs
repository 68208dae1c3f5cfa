//! The energy W never rises: the first conclusion of (13) and (20).

use super::model::Model;
use crate::claim::{About, Bound, Claim, Finding, Reading, Run, Side};

const TEN: About = About {
    name: "song-2013/theorem-10-energy-never-rises",
    source: "Song et al. (2013), Theorem 10, (13)",
    reading: Reading::Printed,
    statement: "dW/dt ≤ 0, so W(t) ≤ W(0) for all t ≥ 0, with W = ½ Σ |v̂_i|² + Σ_{i<j} k_a/2 (r_ij \
                − η)² + Σ_{i<j} Ψ(r_ij), (12).",
    hypotheses: "Model (8) and nothing else; W(0) finite, no two agents at one point.",
    measured: "dW/dt along the motion, Σ ⟨v̂_i, a_i − f_i⟩ with f the forces of the potentials; and \
               W at each time against the least W before.",
    tolerance: "Of the slope 1e-12 of the sum of its terms' sizes, for rounding: it is one of the \
                laws, whatever moves the agents. Of W what the integration may be off.",
};

const SIXTEEN: About = About {
    name: "song-2013/theorem-16-energy-never-rises",
    source: "Song et al. (2013), Theorem 16, (20)",
    statement: "dW/dt ≤ 0, so W(t) ≤ W(0) for all t ≥ 0, with W = ½ Σ |v̂_i|² + k_a/2 Σ |x̂_i|² + \
                Σ_{i<j} Ψ(r_ij), (19).",
    hypotheses: "Model (17) and nothing else; W(0) finite, no two agents at one point.",
    ..TEN
};

/// See the file.
pub(super) struct EnergyNeverRises(pub(super) Model);

impl<const D: usize> Claim<D> for EnergyNeverRises {
    fn about(&self) -> &'static About {
        match self.0 {
            Model::Bonded => &TEN,
            Model::Attracted => &SIXTEEN,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (setting, mut judging) = self.0.of(run)?;
        let slopes = run.observations.iter().map(|seen| setting.slope(seen));
        let (values, sizes): (Vec<f64>, Vec<f64>) = slopes.unzip();
        judging.bound(Bound {
            name: "dW/dt",
            times: run.times(),
            scale: values.iter().map(|it| it.abs()).fold(0.0, f64::max),
            bounds: vec![0.0; values.len()],
            slack: sizes.iter().map(|size| 1e-12 * size).collect(),
            values,
            side: Side::Below,
        });
        let slack = run.series(|seen| setting.slack(run, seen));
        judging.never_rises("W(t)", &run.times(), &setting.energies, &slack);
        Some(judging.finding())
    }
}
