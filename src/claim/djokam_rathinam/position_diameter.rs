//! How fast the flock spreads in space: the first inequality of Theorem 1.

use super::model::Model;
use super::spread::{grows_at_most, position_spread, velocity_spread};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};

const ABOUT: About = About {
    name: "djokam-rathinam/position-diameter",
    source: "Djokam & Rathinam, Theorem 1, (3.6), first inequality; (3.7a)",
    reading: Reading::Printed,
    statement: "d/dt d_X ≤ d_V: the flock's diameter grows no faster than its velocities differ.",
    hypotheses: "The model (2.14): alignment of all agents and steering, and nothing else.",
    measured: "d/dt d_X of the pair that spans d_X, from positions and velocities, at each \
               observation; and what d_X has grown by since the last one.",
    tolerance: "1e-12 of d_V for the derivative, which any state has; between observations the \
                slack of positions.",
};

/// See the file.
pub(super) struct PositionDiameter;

impl<const D: usize> Claim<D> for PositionDiameter {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let mut judging = Judging::new(run);
        Model::of(run)?.suppose_steered(&mut judging);
        let positions: Vec<_> = run.observations.iter().map(position_spread).collect();
        let velocities = run.series(|seen| velocity_spread(seen).length);
        judging.bound(Bound {
            name: "d/dt d_X",
            times: run.times(),
            values: positions.iter().map(|it| it.rate).collect(),
            slack: velocities.iter().map(|it| 1e-12 * it).collect(),
            bounds: velocities.clone(),
            side: Side::Below,
            scale: 0.0,
        });
        let lengths: Vec<f64> = positions.iter().map(|it| it.length).collect();
        let most = lengths.iter().copied().fold(0.0, f64::max);
        grows_at_most(&mut judging, run, "d_X(t)", &lengths, &velocities, |seen| {
            run.position_slack(seen, most)
        });
        Some(judging.finding())
    }
}
