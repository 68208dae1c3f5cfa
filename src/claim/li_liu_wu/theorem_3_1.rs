//! Theorem 3.1: a flock, its velocity, and its line.

use super::model::Setting;
use crate::claim::{About, Claim, Finding, Reading, Run};
use crate::math::{Vector, mean};
use crate::metric::diameter;

const FLOCK: About = About {
    name: "li-liu-wu/theorem-3-1-flock",
    source: "Li, Liu & Wu, Theorem 3.1",
    reading: Reading::Printed,
    statement: "Where ∫ I(r) dr = ∞, every solution of (3) with the force (4) converges to a flock: \
                distances stay bounded, and velocities come to agree.",
    hypotheses: "Model (3) with force (4), γ > 0, mutual influences a_ij = I(r_ij)/N, I positive and \
                 falling strictly, ∫ I = ∞, and nothing else.",
    measured: "d_X(t) and d_V(t), the largest differences of positions and of velocities.",
    tolerance: "The rules for limits; what the integration may take velocities off counts as 0.",
};

const VELOCITY: About = About {
    name: "li-liu-wu/theorem-3-1-velocity",
    source: "Li, Liu & Wu, Theorem 3.1, (13)",
    statement: "Where ∫ I(r) dr = ∞, every velocity tends to the mean of those at the start.",
    measured: "max_i |v_i(t) − v̄(0)|.",
    ..FLOCK
};

const LINE: About = About {
    name: "li-liu-wu/theorem-3-1-line",
    source: "Li, Liu & Wu, Theorem 3.1, step 2 of the proof",
    statement: "Where ∫ I(r) dr = ∞, the final pattern is a line parallel to l: every agent's distance \
                from the line through the mean tends to 0.",
    measured: "max_i s_i(t), the largest distance from that line.",
    tolerance: "The rules for limits; what the integration may take positions off counts as 0.",
    ..FLOCK
};

/// What the theorem says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Theorem31 {
    /// That there is a flock.
    Flock,
    /// How fast it is.
    Velocity,
    /// What it looks like.
    Line,
}

impl<const D: usize> Claim<D> for Theorem31 {
    fn about(&self) -> &'static About {
        match self {
            Self::Flock => &FLOCK,
            Self::Velocity => &VELOCITY,
            Self::Line => &LINE,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (setting, mut judging) = Setting::of(run)?;
        let times = run.times();
        match self {
            Self::Flock => {
                let widths = run.series(|seen| diameter(&seen.positions));
                judging.stays_bounded("d_X(t)", &times, &widths);
                let values = run.series(|seen| diameter(&seen.velocities));
                judging.tends_to_zero("d_V(t)", &times, &values, velocity_floor(run));
            }
            Self::Velocity => {
                let start = mean(&run.start().velocities);
                let values = run.series(|seen| {
                    let away = seen.velocities.iter().map(|v| (v - start).norm());
                    away.fold(0.0, f64::max)
                });
                let floor = velocity_floor(run);
                judging.tends_to_zero("max_i |v_i − v̄(0)|", &times, &values, floor);
            }
            Self::Line => {
                let values = run.series(|seen| {
                    let residuals = setting.residuals(&seen.positions);
                    residuals.fold(0.0, f64::max)
                });
                judging.tends_to_zero("max_i s_i", &times, &values, position_floor(run));
            }
        }
        Some(judging.finding())
    }
}

/// What of a velocity cannot be told from 0 at the end.
pub(super) fn velocity_floor<const D: usize>(run: &Run<'_, D>) -> f64 {
    let speeds = run.start().velocities.iter().map(Vector::norm);
    run.velocity_slack(run.last(), speeds.fold(0.0, f64::max))
}

/// What of a length cannot be told from 0 at the end.
pub(super) fn position_floor<const D: usize>(run: &Run<'_, D>) -> f64 {
    let width = diameter(&run.start().positions);
    run.position_slack(run.last(), width)
}
