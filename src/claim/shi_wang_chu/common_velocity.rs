//! Which velocity they agree on, Theorem 2 and Remark 5.

use super::agreement::velocity_floor;
use super::damping::Damping;
use super::model::Model;
use crate::claim::{About, Claim, Finding, Judging, Reading, Run};

const ABOUT: About = About {
    name: "shi-wang-chu/common-velocity",
    source: "Shi, Wang & Chu, Theorem 2; Remark 5 for (15); the last paragraph of 3.2 for (4)",
    reading: Reading::Printed,
    statement: "The final common velocity is the initial velocity of the centre of mass; with (15) \
                it is the average of the initial velocities.",
    hypotheses: "Control (6) or (15), weights balanced and weakly connected, no other forces; \
                 damping only where it is compensated.",
    measured: "The largest difference between an agent's velocity and that one, judged as a limit.",
    tolerance: "The rule for limits; of points 100 times the integrator's accuracy, of bodies \
                step² times the jerk, cannot be told from 0.",
};

/// See the file.
pub(super) struct CommonVelocity;

impl<const D: usize> Claim<D> for CommonVelocity {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose(&mut judging, Damping::None);
        model.suppose_balance(&mut judging);
        model.suppose_connection(&mut judging);
        let expected = model.kept_velocity(run.start());
        let off = run.series(|seen| {
            let off = seen.velocities.iter().map(|v| (v - expected).norm());
            off.fold(0.0, f64::max)
        });
        judging.tends_to_zero(
            "max_i |v_i − v*(0)|",
            &run.times(),
            &off,
            velocity_floor(run),
        );
        Some(judging.finding())
    }
}
