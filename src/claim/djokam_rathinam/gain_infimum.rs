//! Gains stay away from 0: Lemma 5.

use super::closed_loop::{ClosedLoop, slack};
use super::model::Model;
use super::spread::velocity_spread;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};

const ABOUT: About = About {
    name: "djokam-rathinam/gain-infimum",
    source: "Djokam & Rathinam, Lemma 5",
    reading: Reading::Printed,
    statement: "Where ∫ d_β < ∞, d_V ≤ M = d_V(0) + ∫ d_β and so α_i(t) ≥ min ξ_i over |u| ≤ M, \
                which is above 0.",
    hypotheses: "The closed loop (2.15), alignment and steering only; gains of Assumption 1; \
                 velocities that differ at the start; ∫ d_β < ∞.",
    measured: "d_V(t) against M; the least α_i(t)/min ξ_i of all agents.",
    tolerance: "The slack of velocities; 1e-12 for gains, on top of what that makes of them.",
};

/// See the file.
pub(super) struct GainInfimum;

impl<const D: usize> Claim<D> for GainInfimum {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        let closed = ClosedLoop::suppose(&mut judging, run, &model, false);
        let Some(closed) = closed else {
            return Some(judging.finding());
        };
        let steering = closed.suppose_steering_ends(&mut judging, run);
        let start = velocity_spread(run.start()).length;
        judging.suppose("velocities differ at the start", start > 0.0);
        let most = start + steering.total;
        judging.measure("M", most);
        if !judging.is_supposed() {
            return Some(judging.finding());
        }
        let off = slack(run);
        let times = run.times();
        judging.bound(Bound {
            name: "d_V(t)",
            values: run.series(|seen| velocity_spread(seen).length),
            bounds: vec![most; times.len()],
            slack: run.series(&off),
            times: times.clone(),
            side: Side::Below,
            scale: 0.0,
        });
        let ratios = closed.terms.iter().zip(&run.observations);
        let ratios = ratios.map(|(terms, seen)| {
            let within = most + off(seen);
            let gains = terms.gains.iter().enumerate();
            let ratios = gains.filter_map(|(i, gain)| Some(gain / model.gain_within(i, within)?));
            ratios.fold(f64::INFINITY, f64::min)
        });
        let values: Vec<f64> = ratios.collect();
        judging.bound(Bound {
            name: "α_i(t)/min ξ_i",
            bounds: vec![1.0; times.len()],
            slack: vec![1e-12; times.len()],
            values,
            times,
            side: Side::Above,
            scale: 1.0,
        });
        Some(judging.finding())
    }
}
