//! When agents flock: Theorem 2, and the inequality that its proof rests on.
//!
//! With θ = √ψ the active set need not be full: only a_ij ≥ ψ is known, so that θ = ψ is the
//! largest that is sure. So where the paper has N²ψ, its own argument gives N²ψ², and
//! |v̄_p − v̄_q| ≤ (1 − Σ_j min(a_pj, a_qj)) d_V gives Nψ.

use super::closed_loop::{ClosedLoop, slack};
use super::model::{Model, least_gain};
use super::psi::Psi;
use super::spread::{position_spread, velocity_spread};
use super::velocity_diameter::comes_together;
use crate::claim::{About, Claim, Finding, Judging, Reading, Run};

const ASKED: &str = "The closed loop (2.15), alignment and steering only; gains of Assumption 1, \
                     influences of Assumption 2; velocities that differ at the start.";
const ALL_ASKED: &str = "The closed loop (2.15), alignment and steering only; gains of Assumption \
                         1, influences of Assumption 2; velocities that differ at the start; d_β → \
                         0 and ∫ d_β < ∞; the inequality on the initial diameters.";
const LIMITS: &str = "d_V, whether it tends to 0; d_X, whether it stays bounded. ψ in closed form; \
                      α̲ over the run and, by the last d_V, after it; ∫ d_β from above, with an \
                      exponential tail.";
const TRENDS: &str = "The rules of limits; d_V below the slack of velocities counts as 0.";
const SLOPE: &str = "d/dt d_V of the pair that spans d_V, from velocities and accelerations, at each \
                     observation, with α̲ over the run; and what d_V has grown by since the last one, \
                     against ∫ d_β.";
const ROUNDED: &str = "1e-12 of max α_i max|v_i| + d_β for the derivative, which is rounded at that \
                       size; between observations the slack of velocities.";

const PRINTED: About = About {
    name: "djokam-rathinam/flocking-printed",
    source: "Djokam & Rathinam, Theorem 2, (3.9)",
    reading: Reading::Misprinted,
    statement: "Agents flock where d_V(0) + ∫ d_β < α̲ N² ∫ ψ, over distances from d_X(0) on.",
    hypotheses: ALL_ASKED,
    measured: LIMITS,
    tolerance: TRENDS,
};

const CORRECTED: About = About {
    name: "djokam-rathinam/flocking-corrected",
    source: "Djokam & Rathinam, Theorem 2, (3.9) with the factor of its own proof",
    reading: Reading::Corrected,
    statement: "Agents flock where d_V(0) + ∫ d_β < α̲ N² ∫ ψ², over distances from d_X(0) on.",
    hypotheses: ALL_ASKED,
    measured: LIMITS,
    tolerance: TRENDS,
};

const SHARPENED: About = About {
    name: "djokam-rathinam/flocking-sharpened",
    source: "Djokam & Rathinam, Theorem 2, (3.9) with |v̄_p − v̄_q| ≤ (1 − Nψ) d_V",
    reading: Reading::Sharpened,
    statement: "Agents flock where d_V(0) + ∫ d_β < α̲ N ∫ ψ, over distances from d_X(0) on; so they \
                always do where ∫ ψ = ∞.",
    hypotheses: ALL_ASKED,
    measured: LIMITS,
    tolerance: TRENDS,
};

const RATE_PRINTED: About = About {
    name: "djokam-rathinam/flocking-rate-printed",
    source: "Djokam & Rathinam, proof of Theorem 2, first formula",
    reading: Reading::Misprinted,
    statement: "d/dt d_V ≤ −α̲ N² ψ(d_X) d_V + d_β.",
    hypotheses: ASKED,
    measured: SLOPE,
    tolerance: ROUNDED,
};

const RATE_CORRECTED: About = About {
    name: "djokam-rathinam/flocking-rate-corrected",
    source: "Djokam & Rathinam, proof of Theorem 2, first formula with θ = ψ",
    reading: Reading::Corrected,
    statement: "d/dt d_V ≤ −α̲ N² ψ²(d_X) d_V + d_β.",
    hypotheses: ASKED,
    measured: SLOPE,
    tolerance: ROUNDED,
};

const RATE_SHARPENED: About = About {
    name: "djokam-rathinam/flocking-rate-sharpened",
    source: "Djokam & Rathinam, proof of Theorem 2, with |v̄_p − v̄_q| ≤ (1 − Nψ) d_V",
    reading: Reading::Sharpened,
    statement: "d/dt d_V ≤ −α̲ N ψ(d_X) d_V + d_β.",
    hypotheses: ASKED,
    measured: SLOPE,
    tolerance: ROUNDED,
};

/// What stands with α̲ in (3.9).
#[derive(Clone, Copy)]
pub(super) enum Factor {
    /// N²ψ.
    Printed,
    /// N²ψ².
    Corrected,
    /// Nψ.
    Sharpened,
}

impl Factor {
    fn at(self, psi: &Psi, agents: f64, r: f64) -> f64 {
        let psi = psi.at(r);
        match self {
            Self::Printed => agents * agents * psi,
            Self::Corrected => agents * agents * psi * psi,
            Self::Sharpened => agents * psi,
        }
    }

    /// From r to infinity.
    fn integral(self, psi: &Psi, agents: f64, r: f64) -> f64 {
        match self {
            Self::Printed => agents * agents * psi.integral(r, 1),
            Self::Corrected => agents * agents * psi.integral(r, 2),
            Self::Sharpened => agents * psi.integral(r, 1),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Printed => "N² ∫ ψ",
            Self::Corrected => "N² ∫ ψ²",
            Self::Sharpened => "N ∫ ψ",
        }
    }
}

/// Theorem 2.
pub(super) struct Flocking(pub Factor);

impl<const D: usize> Claim<D> for Flocking {
    fn about(&self) -> &'static About {
        match self.0 {
            Factor::Printed => &PRINTED,
            Factor::Corrected => &CORRECTED,
            Factor::Sharpened => &SHARPENED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        let closed = ClosedLoop::suppose(&mut judging, run, &model, true);
        let Some((closed, psi)) = closed.as_ref().and_then(|it| Some((it, it.psi.as_ref()?)))
        else {
            return Some(judging.finding());
        };
        let steering = closed.suppose_steering_ends(&mut judging, run);
        let least = closed.least_gain(run, &model, &steering);
        let [across, differ] =
            [position_spread(run.start()), velocity_spread(run.start())].map(|it| it.length);
        judging.suppose("velocities differ at the start", differ > 0.0);
        let integral = self.0.integral(psi, model.count() as f64, across);
        judging.measure("α̲", least);
        judging.measure(self.0.name(), integral);
        judging.measure("d_V(0)", differ);
        let name = format!("d_V(0) + ∫ d_β < α̲ {}", self.0.name());
        judging.suppose_less(name, differ + steering.total, least * integral);
        let times = run.times();
        judging.stays_bounded(
            "d_X(t)",
            &times,
            &run.series(|it| position_spread(it).length),
        );
        let values = run.series(|it| velocity_spread(it).length);
        judging.tends_to_zero("d_V(t)", &times, &values, slack(run)(run.last()));
        Some(judging.finding())
    }
}

/// The inequality in its proof.
pub(super) struct FlockingRate(pub Factor);

impl<const D: usize> Claim<D> for FlockingRate {
    fn about(&self) -> &'static About {
        match self.0 {
            Factor::Printed => &RATE_PRINTED,
            Factor::Corrected => &RATE_CORRECTED,
            Factor::Sharpened => &RATE_SHARPENED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        let closed = ClosedLoop::suppose(&mut judging, run, &model, true);
        let start = velocity_spread(run.start()).length;
        judging.suppose("velocities differ at the start", start > 0.0);
        let closed = closed.as_ref().filter(|_| judging.is_supposed());
        let Some((closed, psi)) = closed.and_then(|it| Some((it, it.psi.as_ref()?))) else {
            return Some(judging.finding());
        };
        let least = least_gain(&closed.terms);
        judging.measure("α̲", least);
        comes_together(&mut judging, run, &closed.terms, |_, _, k| {
            let across = position_spread(&run.observations[k]).length;
            least * self.0.at(psi, model.count() as f64, across)
        });
        Some(judging.finding())
    }
}
