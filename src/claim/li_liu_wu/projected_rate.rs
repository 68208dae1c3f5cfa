//! How fast velocities along the line come to agree: the inequality above (9).

use super::model::{Setting, spread};
use crate::claim::integral::integral;
use crate::claim::{About, Bound, Claim, Finding, Reading, Run, Side};
use crate::math::mean;
use crate::metric::diameter;

const ABOUT: About = About {
    name: "li-liu-wu/projected-rate",
    source: "Li, Liu & Wu, above (9)",
    reading: Reading::Printed,
    statement: "With ṽ_i = ⟨v_i, l⟩, d/dt Σ |ṽ_i − v̄|² ≤ −2αI(d_X) Σ |ṽ_i − v̄|² ≤ −2αI(√(d_X̃² + \
                M²)) Σ |ṽ_i − v̄|², M = √(N M*/γ).",
    hypotheses: "Model (3) with force (4), γ > 0, mutual influences a_ij = I(r_ij)/N, I positive and \
                 falling strictly, ∫ I = ∞, and nothing else.",
    measured: "The slope along the motion against both rates; and Σ |ṽ_i − v̄|² with the integral \
               of the second against its value at the start.",
    tolerance: "Of the slope 1e-12 of the sum of its terms' sizes, for rounding. Of the integral \
                what the integration may be off, and what the trapezoid rule may: twice h³/12 |f''| \
                of each stretch between observations.",
};

/// See the file.
pub(super) struct ProjectedRate;

impl<const D: usize> Claim<D> for ProjectedRate {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (setting, mut judging) = Setting::of(run)?;
        let (_, reach) = setting.reach(run);
        let energies = run.series(|seen| spread(&setting.projected(&seen.velocities)));
        let (mut slopes, mut sizes) = (Vec::new(), Vec::new());
        for seen in &run.observations {
            let velocities = setting.projected(&seen.velocities);
            let center = mean(&velocities);
            let (mut slope, mut size) = (0.0, 0.0);
            for (v, a) in velocities.iter().zip(&seen.accelerations) {
                slope += 2.0 * (v - center).x * a.dot(&setting.along);
                // The force has parts along l that rounding leaves over.
                size += 2.0 * v.norm() * a.norm();
            }
            slopes.push(slope);
            sizes.push(size);
        }
        let rates = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let energies = energies.iter().enumerate();
            let rates = energies.map(|(k, energy)| 2.0 * setting.influence(of(k)) * energy);
            rates.collect()
        };
        let seen = &run.observations;
        let first = rates(&|k| diameter(&seen[k].positions));
        let second = rates(&|k| setting.projected_diameter(&seen[k]).hypot(reach));
        let scale = slopes.iter().map(|it| it.abs()).fold(0.0, f64::max);
        for (name, rates) in [
            ("d/dt Σ |ṽ_i − v̄|², against −2αI(d_X) Σ |ṽ_i − v̄|²", &first),
            (
                "d/dt Σ |ṽ_i − v̄|², against −2αI(√(d_X̃² + M²)) Σ |ṽ_i − v̄|²",
                &second,
            ),
        ] {
            let rounding = sizes.iter().zip(rates);
            judging.bound(Bound {
                name,
                times: run.times(),
                values: slopes.clone(),
                bounds: rates.iter().map(|rate| -rate).collect(),
                slack: rounding.map(|(size, rate)| 1e-12 * (size + rate)).collect(),
                side: Side::Below,
                scale,
            });
        }
        let lost = integral(&run.times(), &second);
        let values = energies.iter().zip(&lost.values);
        let slack = seen.iter().zip(&lost.errors);
        judging.bound(Bound {
            name: "Σ |ṽ_i − v̄|² + what it had to lose",
            times: run.times(),
            values: values.map(|(energy, lost)| energy + lost).collect(),
            bounds: vec![energies[0]; energies.len()],
            slack: slack
                .map(|(seen, off)| off + setting.slack(run, seen))
                .collect(),
            side: Side::Below,
            scale: energies[0],
        });
        Some(judging.finding())
    }
}
