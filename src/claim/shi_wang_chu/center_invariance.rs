//! The velocity that is kept, 3.1.2.

use super::damping::Damping;
use super::model::Model;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::metric::center_of_mass;

const ABOUT: About = About {
    name: "shi-wang-chu/center-invariance",
    source: "Shi, Wang & Chu, 3.1.2 before Theorem 2, Remarks 3 and 5",
    reading: Reading::Printed,
    statement: "The velocity of the centre of mass never changes; with (15) that is the average \
                velocity. This needs balance, and no connection.",
    hypotheses: "Control (6) or (15) with balanced weights, no other forces; damping only where \
                 it is compensated.",
    measured: "How far that velocity is from the one at the start, and its rate of change, both as \
               shares of the largest that they are means of.",
    tolerance: "1e-9, for rounding: every step of every integrator here keeps what the laws keep.",
};

/// See the file.
pub(super) struct CenterInvariance;

impl<const D: usize> Claim<D> for CenterInvariance {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose(&mut judging, Damping::None);
        model.suppose_balance(&mut judging);
        if run.observations.len() < 2 {
            return Some(judging.finding());
        }
        let start = model.kept_velocity(run.start());
        let fastest = run.start().velocities.iter().map(|v| v.norm());
        let fastest = fastest.fold(f64::MIN_POSITIVE, f64::max);
        let drift = run.series(|seen| (model.kept_velocity(seen) - start).norm() / fastest);
        let controls = run
            .observations
            .iter()
            .flat_map(|seen| seen.by_law.iter().flatten());
        let largest = controls.map(|a| a.norm()).fold(f64::MIN_POSITIVE, f64::max);
        let rate =
            run.series(|seen| center_of_mass(&model.inertia, &seen.accelerations).norm() / largest);
        let count = drift.len();
        for (name, values) in [
            ("|v*(t) − v*(0)|/max|v(0)|", drift),
            ("|dv*/dt|/max|a|", rate),
        ] {
            judging.bound(Bound {
                name,
                times: run.times(),
                values,
                bounds: vec![0.0; count],
                slack: vec![1e-9; count],
                side: Side::Below,
                scale: 0.0,
            });
        }
        Some(judging.finding())
    }
}
