//! The mean velocity is constant: below (9), and below (17).

use super::model::{Model, mean_velocity};
use crate::claim::{About, Bound, Claim, Finding, Reading, Run, Side};
use crate::math::{Vector, mean};

const TEN: About = About {
    name: "song-2013/theorem-10-mean-velocity",
    source: "Song et al. (2013), Theorem 10, below (9)",
    reading: Reading::Printed,
    statement: "The mean velocity is constant, v_c(t) = v_c(0).",
    hypotheses: "Model (8) and nothing else; W(0) finite, no two agents at one point.",
    measured: "|v_c(t) − v_c(0)|, and the mean of the accelerations.",
    tolerance: "Of the velocity what the integration may be off; of the acceleration 1e-12 of the \
                largest one, for rounding.",
};

const SIXTEEN: About = About {
    name: "song-2013/theorem-16-mean-velocity",
    source: "Song et al. (2013), Theorem 16, below (17)",
    hypotheses: "Model (17) and nothing else; W(0) finite, no two agents at one point.",
    ..TEN
};

/// See the file.
pub(super) struct MeanVelocity(pub(super) Model);

impl<const D: usize> Claim<D> for MeanVelocity {
    fn about(&self) -> &'static About {
        match self.0 {
            Model::Bonded => &TEN,
            Model::Attracted => &SIXTEEN,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (_, mut judging) = self.0.of(run)?;
        let start = mean_velocity(run.start());
        let largest = |of: &[Vector<D>]| of.iter().map(Vector::norm).fold(0.0, f64::max);
        let fastest = largest(&run.start().velocities);
        judging.bound(Bound {
            name: "|v_c(t) − v_c(0)|",
            times: run.times(),
            values: run.series(|seen| (mean_velocity(seen) - start).norm()),
            bounds: vec![0.0; run.observations.len()],
            slack: run.series(|seen| run.velocity_slack(seen, fastest)),
            side: Side::Below,
            scale: 0.0,
        });
        judging.bound(Bound {
            name: "|Σ a_i|/N",
            times: run.times(),
            values: run.series(|seen| mean(&seen.accelerations).norm()),
            bounds: vec![0.0; run.observations.len()],
            slack: run.series(|seen| {
                let terms = seen.by_law.iter().map(|of_law| largest(of_law));
                1e-12 * terms.sum::<f64>()
            }),
            side: Side::Below,
            scale: 0.0,
        });
        Some(judging.finding())
    }
}
