//! The mean velocity is constant, (5), for forces to a line add up to zero.

use super::model::Setting;
use crate::claim::{About, Bound, Claim, Finding, Reading, Run, Side};
use crate::math::{Vector, mean};

const ABOUT: About = About {
    name: "li-liu-wu/mean-velocity",
    source: "Li, Liu & Wu, below (4), (5)",
    reading: Reading::Printed,
    statement: "⟨F(x_i), l⟩ = 0 and Σ F(x_i) = 0, so dv̄/dt = 0 and v̄(t) = v̄(0).",
    hypotheses: "Model (3) with force (4), mutual influences, ∫ I = ∞, and nothing else.",
    measured: "max |⟨F_i, l⟩|, |Σ F_i|/N, and |v̄(t) − v̄(0)|.",
    tolerance: "Of the forces 1e-12 of the largest one and of γ times the distance from the \
                origin, for rounding; of the velocity what the integration may be off.",
};

/// See the file.
pub(super) struct MeanVelocity;

impl<const D: usize> Claim<D> for MeanVelocity {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (setting, mut judging) = Setting::of(run)?;
        let largest = |of: &[Vector<D>]| of.iter().map(Vector::norm).fold(0.0, f64::max);
        let rounding = run.series(|seen| 1e-12 * setting.strength * largest(&seen.positions));
        let zero = || vec![0.0; run.observations.len()];
        let along = run.series(|seen| {
            let forces = seen.by_law[setting.line].iter();
            let along = forces.map(|force| force.dot(&setting.along).abs());
            along.fold(0.0, f64::max)
        });
        let together = run.series(|seen| mean(&seen.by_law[setting.line]).norm());
        for (name, values) in [("max |⟨F_i, l⟩|", along), ("|Σ F_i|/N", together)] {
            judging.bound(Bound {
                name,
                times: run.times(),
                values,
                bounds: zero(),
                slack: rounding.clone(),
                side: Side::Below,
                scale: 0.0,
            });
        }
        let start = mean(&run.start().velocities);
        let fastest = largest(&run.start().velocities);
        judging.bound(Bound {
            name: "|v̄(t) − v̄(0)|",
            times: run.times(),
            values: run.series(|seen| (mean(&seen.velocities) - start).norm()),
            bounds: zero(),
            slack: run.series(|seen| run.velocity_slack(seen, fastest)),
            side: Side::Below,
            scale: 0.0,
        });
        Some(judging.finding())
    }
}
