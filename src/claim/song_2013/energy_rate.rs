//! How fast the energy W falls: the last line of (13) and of (20).

use super::model::Model;
use crate::claim::integral::integral;
use crate::claim::{About, Bound, Claim, Finding, Reading, Run, Side};
use crate::metric::{Aligned, relative_kinetic_energy};

const TEN: About = About {
    name: "song-2013/theorem-10-energy-rate",
    source: "Song et al. (2013), Theorem 10, (13)",
    reading: Reading::Printed,
    statement: "dW/dt ≤ −N min_{j>i} a_ij Σ |v̂_i|².",
    hypotheses: "Model (8) and nothing else; W(0) finite, no two agents at one point.",
    measured: "dW/dt + N min a_ij Σ |v̂_i|² along the motion, with the a_ij of the law; and its \
               integral, W(t) + ∫ N min a_ij Σ |v̂_i|² against W(0).",
    tolerance: "Of the slope 1e-12 of the sum of its terms' sizes, for rounding. Of the integral \
                what W may be off, and what the trapezoid rule may: twice h³/12 |f''| of each \
                stretch between observations.",
};

const SIXTEEN: About = About {
    name: "song-2013/theorem-16-energy-rate",
    source: "Song et al. (2013), Theorem 16, (20)",
    hypotheses: "Model (17) and nothing else; W(0) finite, no two agents at one point.",
    ..TEN
};

/// See the file.
pub(super) struct EnergyRate(pub(super) Model);

impl<const D: usize> Claim<D> for EnergyRate {
    fn about(&self) -> &'static About {
        match self.0 {
            Model::Bonded => &TEN,
            Model::Attracted => &SIXTEEN,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (setting, mut judging) = self.0.of(run)?;
        let rates = run.series(|seen| {
            let least = seen.alignments[setting.laws[0]].as_ref().map(least_rate);
            setting.count * least.unwrap_or(0.0) * 2.0 * relative_kinetic_energy(&seen.velocities)
        });
        let slopes = run.observations.iter().map(|seen| setting.slope(seen));
        let (slopes, sizes): (Vec<f64>, Vec<f64>) = slopes.unzip();
        let sizes = sizes.iter().zip(&rates);
        judging.bound(Bound {
            name: "dW/dt",
            times: run.times(),
            scale: slopes.iter().map(|it| it.abs()).fold(0.0, f64::max),
            bounds: rates.iter().map(|rate| -rate).collect(),
            slack: sizes.map(|(size, rate)| 1e-12 * (size + rate)).collect(),
            values: slopes,
            side: Side::Below,
        });
        let lost = integral(&run.times(), &rates);
        let slack = run.observations.iter().zip(&lost.errors);
        let energies = setting.energies.iter().zip(&lost.values);
        judging.bound(Bound {
            name: "W(t) + ∫ N min a_ij Σ |v̂_i|²",
            times: run.times(),
            bounds: vec![setting.start(); rates.len()],
            values: energies.map(|(energy, lost)| energy + lost).collect(),
            slack: slack
                .map(|(seen, off)| off + setting.slack(run, seen))
                .collect(),
            side: Side::Below,
            scale: setting.start(),
        });
        Some(judging.finding())
    }
}

/// min_{j≠i} a_ij, gains included.
fn least_rate<const D: usize>(aligned: &Aligned<D>) -> f64 {
    let matrix = aligned.matrix();
    let mut least = f64::INFINITY;
    for (i, gain) in aligned.gains.iter().enumerate() {
        for j in (0..matrix.ncols()).filter(|&j| j != i) {
            least = least.min(gain * matrix[(i, j)]);
        }
    }
    least
}
