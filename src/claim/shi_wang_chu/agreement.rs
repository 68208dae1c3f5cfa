//! Velocities agree, Theorem 1.

use super::damping::Damping;
use super::model::Model;
use crate::claim::{About, Claim, Finding, Judging, Reading, Run};
use crate::metric::diameter;

const ABOUT: About = About {
    name: "shi-wang-chu/velocity-agreement",
    source: "Shi, Wang & Chu, Theorem 1, Remarks 1, 5 and 6, Theorem 3",
    reading: Reading::Printed,
    statement: "All velocities become the same.",
    hypotheses: "Control (6) or (15), weights balanced and weakly connected, no other forces but \
                 damping, which may be compensated.",
    measured: "The largest difference of two velocities, judged as a limit.",
    tolerance: "The rule for limits; of points 100 times the integrator's accuracy, of bodies \
                step² times the jerk, cannot be told from 0.",
};

/// See the file.
pub(super) struct Agreement;

impl<const D: usize> Claim<D> for Agreement {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose(&mut judging, Damping::Any);
        model.suppose_balance(&mut judging);
        model.suppose_connection(&mut judging);
        let differences = run.series(|seen| diameter(&seen.velocities));
        judging.tends_to_zero("d_V", &run.times(), &differences, velocity_floor(run));
        Some(judging.finding())
    }
}

/// What a velocity at the end of a run cannot be told from 0 by.
pub(super) fn velocity_floor<const D: usize>(run: &Run<'_, D>) -> f64 {
    let speeds = run.start().velocities.iter().map(|v| v.norm());
    run.velocity_slack(run.last(), speeds.fold(0.0, f64::max))
}
