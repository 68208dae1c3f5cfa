//! Damped agents come to rest, Theorem 3.

use super::agreement::velocity_floor;
use super::damping::Damping;
use super::model::Model;
use crate::claim::{About, Claim, Finding, Judging, Reading, Run};

const ABOUT: About = About {
    name: "shi-wang-chu/damped-rest",
    source: "Shi, Wang & Chu, Theorem 3, Remark 6",
    reading: Reading::Printed,
    statement: "Where all agents are damped, as in (3), all finally stop.",
    hypotheses: "Control (6) or (15), weights balanced and weakly connected, damping of every \
                 agent, no other forces.",
    measured: "The largest speed, judged as a limit.",
    tolerance: "The rule for limits; of points 100 times the integrator's accuracy, of bodies \
                step² times the jerk, cannot be told from 0.",
};

/// See the file.
pub(super) struct DampedRest;

impl<const D: usize> Claim<D> for DampedRest {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose(&mut judging, Damping::All);
        model.suppose_balance(&mut judging);
        model.suppose_connection(&mut judging);
        let speeds = run.series(|seen| {
            let speeds = seen.velocities.iter().map(|v| v.norm());
            speeds.fold(0.0, f64::max)
        });
        judging.tends_to_zero("max_i |v_i|", &run.times(), &speeds, velocity_floor(run));
        Some(judging.finding())
    }
}
