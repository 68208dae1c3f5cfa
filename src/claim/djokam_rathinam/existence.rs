//! Bounds of velocities and positions in a finite time: Lemma 8.

use super::model::{Model, Terms};
use super::spread::largest_speed;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::Vector;

const HYPOTHESES: &str =
    "The model (2.14): alignment of all agents and steering, and nothing else.";
const MEASURED: &str = "max|v_i(t)|, and the largest |x_i(t)| − |x_i(0)|, with the largest ᾱ = \
                        max α_i and M_β = max|β_i| seen until then.";
const TOLERANCE: &str = "The slack of velocities, and of positions: between observations M_β may \
                         be larger than seen.";

const PRINTED: About = About {
    name: "djokam-rathinam/existence-printed",
    source: "Djokam & Rathinam, Lemma 8 in App. A, the last two formulas",
    reading: Reading::Misprinted,
    statement: "|v_i(t)| ≤ E(0)^½ + 2^(−½) ᾱ M_β T and |x_i(t)| ≤ |x_i(0)| + T times that, up to any \
                T ≥ t. As |v_i| is (2E_i)^½, not E_i^½, it fails at T = 0.",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

const CORRECTED: About = About {
    name: "djokam-rathinam/existence-corrected",
    source: "Djokam & Rathinam, Lemma 8, with d/dt (2E)^½ ≤ max|β_i|",
    reading: Reading::Corrected,
    statement: "|v_i(t)| ≤ max|v_j(0)| + M_β T and |x_i(t)| ≤ |x_i(0)| + T times that, up to any \
                T ≥ t.",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

/// See the file.
pub(super) enum Existence {
    Printed,
    Corrected,
}

impl<const D: usize> Claim<D> for Existence {
    fn about(&self) -> &'static About {
        match self {
            Self::Printed => &PRINTED,
            Self::Corrected => &CORRECTED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose_steered(&mut judging);
        if !judging.is_supposed() {
            return Some(judging.finding());
        }
        let start = largest_speed(run.start());
        let half = 0.5f64.sqrt();
        let (mut gain, mut push) = (0.0f64, 0.0f64);
        let all = model.all_terms();
        let speeds = all.iter().zip(&run.observations).map(|(terms, seen)| {
            gain = gain.max(terms.largest_gain());
            push = push.max(longest(terms));
            match self {
                Self::Printed => half * (start + gain * push * seen.time),
                Self::Corrected => start + push * seen.time,
            }
        });
        let speeds: Vec<f64> = speeds.collect();
        let times = run.times();
        let ways = times.iter().zip(&speeds).map(|(t, speed)| t * speed);
        let ways: Vec<f64> = ways.collect();
        judging.measure("ᾱ", gain);
        judging.measure("M_β", push);
        judging.bound(Bound {
            name: "max|v_i(t)|",
            times: times.clone(),
            values: run.series(largest_speed),
            bounds: speeds,
            slack: run.series(|seen| run.velocity_slack(seen, start)),
            side: Side::Below,
            scale: 0.0,
        });
        let far = |x: &Vector<D>| x.norm();
        let from = &run.start().positions;
        let size = from.iter().map(far).fold(0.0, f64::max);
        judging.bound(Bound {
            name: "|x_i(t)| − |x_i(0)|",
            values: run.series(|seen| {
                let gone = seen.positions.iter().zip(from);
                let gone = gone.map(|(x, from)| far(x) - far(from));
                gone.fold(f64::NEG_INFINITY, f64::max)
            }),
            slack: run.series(|seen| run.position_slack(seen, size.max(far_out(seen)))),
            bounds: ways,
            times,
            side: Side::Below,
            scale: size,
        });
        Some(judging.finding())
    }
}

/// max|β_i|.
fn longest<const D: usize>(terms: &Terms<D>) -> f64 {
    terms.steering.iter().map(Vector::norm).fold(0.0, f64::max)
}

/// The largest distance from the origin.
fn far_out<const D: usize>(seen: &crate::metric::Observation<D>) -> f64 {
    seen.positions.iter().map(Vector::norm).fold(0.0, f64::max)
}
