//! What Lemma 5 and Theorem 2 ask of the closed loop (2.15), and the numbers in (3.9).

use super::model::{Model, Terms, least_gain};
use super::psi::Psi;
use super::spread::{largest_speed, velocity_spread};
use crate::claim::{Judging, Run, vanishes};
use crate::math::Vector;

/// How much d_β must fall over the last half of a run, as a power of e, for its integral to be
/// seen to end: faster than t^(−2).
const FALL: f64 = 2.0;

/// The closed loop of a run.
pub(super) struct ClosedLoop<const D: usize> {
    pub terms: Vec<Terms<D>>,
    pub psi: Option<Psi>,
}

/// d_β along a run, and beyond it.
pub(super) struct Steering {
    /// ∫ d_β dt, from above; infinite where it is not seen to end.
    pub total: f64,
    /// What of it comes after the run.
    rest: f64,
}

impl<const D: usize> ClosedLoop<D> {
    /// Supposes (2.15) with gains as in Assumption 1 and, where `positive`, influences as in
    /// Assumption 2; nothing where they are not.
    pub fn suppose(
        judging: &mut Judging,
        run: &Run<'_, D>,
        model: &Model<'_, '_, D>,
        positive: bool,
    ) -> Option<Self> {
        model.suppose_steered(judging);
        // A constant gain is one of Assumption 1 as far as velocities go.
        let gains = (0..model.count()).map(|i| model.gain_within(i, 0.0));
        let feedback = gains
            .into_iter()
            .all(|gain| gain.is_some_and(|it| it > 0.0));
        judging.suppose("gains are functions ξ_i(u) > 0: Assumption 1", feedback);
        let groups = &run.world.spec.agents;
        let sees = |it: &crate::world::spec::ScopeSpec| groups.iter().all(|group| it.sees(group));
        let psi = Psi::of(model, model.scope.is_none_or(sees));
        if positive {
            judging.suppose(
                "influences are above 0 however far agents are, and never jump: Assumption 2",
                psi.is_some(),
            );
        }
        judging.is_supposed().then(|| Self {
            terms: model.all_terms(),
            psi,
        })
    }

    /// d_β, supposing that it tends to 0 and has a finite integral.
    pub fn suppose_steering_ends(&self, judging: &mut Judging, run: &Run<'_, D>) -> Steering {
        let times = run.times();
        let values: Vec<f64> = self.terms.iter().map(Terms::steering_diameter).collect();
        let size = |terms: &Terms<D>| terms.steering.iter().map(Vector::norm).fold(0.0, f64::max);
        let floor = 1e-12 * self.terms.iter().map(size).fold(0.0, f64::max);
        let trend = vanishes(&times, &values, floor);
        let steps = times.windows(2).zip(values.windows(2));
        let seen: f64 = steps.map(|(t, d)| (t[1] - t[0]) * d[0].max(d[1])).sum();
        let (end, last) = (run.last().time, values[values.len() - 1]);
        let rest = match trend.seen {
            Some(true) if last <= floor => 0.0,
            Some(true) if 0.5 * trend.rate * end >= FALL => last / trend.rate,
            _ => f64::INFINITY,
        };
        judging.plot("d_β(t)", &times, &values);
        judging.measure("∫ d_β dt", seen + rest);
        judging.suppose("d_β tends to 0", trend.seen == Some(true));
        judging.suppose("∫ d_β dt < ∞", rest.is_finite());
        Steering {
            total: seen + rest,
            rest,
        }
    }

    /// α̲: the least gain of the run, and after it, where d_V is at most its last value and what
    /// steering can still add.
    pub fn least_gain(
        &self,
        run: &Run<'_, D>,
        model: &Model<'_, '_, D>,
        steering: &Steering,
    ) -> f64 {
        let within = velocity_spread(run.last()).length + steering.rest;
        let later = (0..model.count()).filter_map(|i| model.gain_within(i, within));
        later.fold(least_gain(&self.terms), f64::min)
    }
}

/// What d_V may be off.
pub(super) fn slack<const D: usize>(
    run: &Run<'_, D>,
) -> impl Fn(&crate::metric::Observation<D>) -> f64 {
    let fastest = run.observations.iter().map(largest_speed);
    let fastest = fastest.fold(0.0, f64::max);
    move |seen| run.velocity_slack(seen, fastest)
}
