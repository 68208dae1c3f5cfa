//! Velocities agree on the mean of those at the start.

use super::model::{Model, mean_velocity};
use crate::claim::{About, Claim, Finding, Reading, Run};

const TEN: About = About {
    name: "song-2013/theorem-10-velocity-consensus",
    source: "Song et al. (2013), Theorem 10",
    reading: Reading::Printed,
    statement: "Every velocity tends to v_c(0), whatever β ≥ 0.",
    hypotheses: "Model (8) and nothing else; W(0) finite, no two agents at one point.",
    measured: "max_i |v_i(t) − v_c(0)|.",
    tolerance: "The rule for limits; what the integration may take velocities off counts as 0.",
};

const SIXTEEN: About = About {
    name: "song-2013/theorem-16-velocity-consensus",
    source: "Song et al. (2013), Theorem 16",
    hypotheses: "Model (17) and nothing else; W(0) finite, no two agents at one point.",
    ..TEN
};

/// See the file.
pub(super) struct VelocityConsensus(pub(super) Model);

impl<const D: usize> Claim<D> for VelocityConsensus {
    fn about(&self) -> &'static About {
        match self.0 {
            Model::Bonded => &TEN,
            Model::Attracted => &SIXTEEN,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (_, mut judging) = self.0.of(run)?;
        let start = mean_velocity(run.start());
        let values = run.series(|seen| {
            let away = seen.velocities.iter().map(|v| (v - start).norm());
            away.fold(0.0, f64::max)
        });
        let floor = run.velocity_slack(run.last(), start.norm() + values[0]);
        judging.tends_to_zero("max_i |v_i − v_c(0)|", &run.times(), &values, floor);
        Some(judging.finding())
    }
}
