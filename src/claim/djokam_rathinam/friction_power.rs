//! What friction takes from the fastest agent: (2.9).

use super::damped::{Damped, energy, energy_slack};
use super::spread::{grows_at_most, largest_speed};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::metric::Observation;

const ABOUT: About = About {
    name: "djokam-rathinam/friction-power",
    source: "Djokam & Rathinam, proof of Lemma 1, (2.9)",
    reading: Reading::Printed,
    statement: "dE/dt ≤ −2^(r/2 + 1) c̲ E^(r/2 + 1) with E = max ½|v_i|²: alignment never makes \
                the fastest agent faster.",
    hypotheses: "The model (2.8): alignment and friction, and nothing else; c_i > 0, r ≥ 0.",
    measured: "dE/dt of the fastest agent, from velocities and accelerations, at each \
               observation; and that E does not rise from one to the next.",
    tolerance: "1e-12 of the fastest agent's speed times the largest acceleration for the \
                derivative, which is rounded at that size; between observations the slack of E.",
};

/// See the file.
pub(super) struct FrictionPower;

/// dE/dt, of the fastest agent.
pub(super) fn power<const D: usize>(seen: &Observation<D>) -> f64 {
    let square = |i: &usize| seen.velocities[*i].norm_squared();
    let fastest = (0..seen.velocities.len()).max_by(|i, j| square(i).total_cmp(&square(j)));
    fastest.map_or(0.0, |i| seen.velocities[i].dot(&seen.accelerations[i]))
}

/// How that is rounded.
pub(super) fn rounding<const D: usize>(seen: &Observation<D>) -> f64 {
    let terms = seen.by_law.iter().flatten().map(|it| it.norm());
    1e-12 * largest_speed(seen) * terms.fold(0.0, f64::max)
}

impl<const D: usize> Claim<D> for FrictionPower {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let damped = Damped::of(run)?;
        let mut judging = Judging::new(run);
        damped.suppose(&mut judging, run);
        let r = damped.exponent.unwrap_or(0.0);
        let lost =
            |seen: &Observation<D>| -damped.least * libm::pow(2.0 * energy(seen), 0.5 * r + 1.0);
        judging.bound(Bound {
            name: "dE/dt",
            times: run.times(),
            values: run.series(power),
            bounds: run.series(lost),
            slack: run.series(rounding),
            side: Side::Below,
            scale: 0.0,
        });
        let values = run.series(energy);
        let none = vec![0.0; values.len()];
        grows_at_most(&mut judging, run, "E(t)", &values, &none, |seen| {
            energy_slack(run, seen)
        });
        Some(judging.finding())
    }
}
