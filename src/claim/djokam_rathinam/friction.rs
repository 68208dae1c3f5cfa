//! Friction brings all agents to rest: Lemma 1, and the rate in its proof.

use super::damped::{Damped, energy, energy_slack};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};

const REST: About = About {
    name: "djokam-rathinam/friction-rest",
    source: "Djokam & Rathinam, Lemma 1",
    reading: Reading::Printed,
    statement: "Under friction −c_i|v_i|^r v_i all velocities tend to 0.",
    hypotheses: "The model (2.8): alignment and friction, and nothing else; c_i > 0, r ≥ 0.",
    measured: "E = max ½|v_i|², whether it tends to 0.",
    tolerance: "Above the slack of E, the rule of limits: at most a hundredth of E is left in the \
                last half, and it goes on falling.",
};

const DECAY: About = About {
    name: "djokam-rathinam/friction-decay-printed",
    source: "Djokam & Rathinam, proof of Lemma 1, last formula",
    reading: Reading::Printed,
    statement: "E(t) ≤ (E(0)^(−r/2) + 2^(r/2) r c̲ t)^(−2/r), with E = max ½|v_i|². Of r = 0 it \
                says nothing, though the lemma has r ≥ 0.",
    hypotheses: "The model (2.8): alignment and friction, and nothing else; c_i > 0, r > 0.",
    measured: "E(t) against the formula.",
    tolerance: "The slack of E: the largest speed times that of velocities.",
};

const LINEAR: About = About {
    name: "djokam-rathinam/friction-decay-corrected",
    source: "Djokam & Rathinam, proof of Lemma 1, (2.9) integrated for r = 0 as well",
    reading: Reading::Corrected,
    statement: "E(t) ≤ E(0)e^(−2c̲t) where r = 0, and otherwise the printed formula.",
    hypotheses: "The model (2.8): alignment and friction, and nothing else; c_i > 0, r ≥ 0.",
    measured: "E(t) against the formula.",
    tolerance: "The slack of E: the largest speed times that of velocities.",
};

/// See the file.
pub(super) enum Friction {
    Rest,
    DecayPrinted,
    DecayCorrected,
}

impl<const D: usize> Claim<D> for Friction {
    fn about(&self) -> &'static About {
        match self {
            Self::Rest => &REST,
            Self::DecayPrinted => &DECAY,
            Self::DecayCorrected => &LINEAR,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let damped = Damped::of(run)?;
        let mut judging = Judging::new(run);
        damped.suppose(&mut judging, run);
        let r = damped.exponent.unwrap_or(0.0);
        if matches!(self, Self::DecayPrinted) {
            judging.suppose("r > 0", r > 0.0);
        }
        if !judging.is_supposed() {
            return Some(judging.finding());
        }
        let (times, values) = (run.times(), run.series(energy));
        if matches!(self, Self::Rest) {
            let floor = energy_slack(run, run.last());
            judging.tends_to_zero("E(t)", &times, &values, floor);
            return Some(judging.finding());
        }
        let bounds = times
            .iter()
            .map(|t| bound(values[0], damped.least, r, *t))
            .collect();
        judging.bound(Bound {
            name: "E(t)",
            slack: run.series(|seen| energy_slack(run, seen)),
            times,
            values,
            bounds,
            side: Side::Below,
            scale: 0.0,
        });
        Some(judging.finding())
    }
}

/// (2.9) integrated: what is left of an energy at most.
fn bound(energy: f64, c: f64, r: f64, time: f64) -> f64 {
    if r == 0.0 {
        return energy * libm::exp(-2.0 * c * time);
    }
    // E(0)^(−r/2) taken out, so that nothing overflows.
    let growth = r * c * time * libm::pow(2.0 * energy, 0.5 * r);
    energy * libm::pow(1.0 + growth, -2.0 / r)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_is_that_of_the_paper_and_solves_its_equation() {
        let (e, c) = (7.7f64, 0.1);
        for r in [0.25, 1.0, 2.0, 3.5] {
            for t in [0.0, 0.3, 10.0] {
                let printed = (e.powf(-r / 2.0) + 2f64.powf(r / 2.0) * r * c * t).powf(-2.0 / r);
                let found = bound(e, c, r, t);
                assert!((found - printed).abs() < 1e-12 * printed, "{r} {t}");
                let slope = (bound(e, c, r, t + 1e-5) - bound(e, c, r, t)) / 1e-5;
                let asked = -2f64.powf(r / 2.0 + 1.0) * c * found.powf(r / 2.0 + 1.0);
                assert!((slope - asked).abs() < 1e-3 * asked.abs(), "{r} {t}");
            }
        }
        // As r tends to 0 one formula becomes the other.
        let near = bound(e, c, 1e-9, 3.0);
        assert!((near - bound(e, c, 0.0, 3.0)).abs() < 1e-6);
    }
}
