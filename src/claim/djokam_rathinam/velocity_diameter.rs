//! How fast velocities come together: the second inequality of Theorem 1, and Corollary 1.

use super::model::{Model, Terms, least_gain};
use super::spread::{Spread, grows_at_most, largest_speed, velocity_spread};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};

const HYPOTHESES: &str = "The model (2.14): alignment of all agents and steering, and nothing else; \
                          velocities that differ at the start.";
const MEASURED: &str = "d/dt d_V of the pair that spans d_V, from velocities and accelerations, at \
                        each observation, against the bound with the θ for which it is \
                        strongest; and what d_V has grown by since the last one, against ∫ d_β.";
const TOLERANCE: &str = "1e-12 of max α_i max|v_i| + d_β for the derivative, which is rounded at \
                         that size; between observations the slack of velocities.";

const THEOREM: About = About {
    name: "djokam-rathinam/velocity-diameter",
    source: "Djokam & Rathinam, Theorem 1, (3.6), second inequality",
    reading: Reading::Printed,
    statement: "d/dt d_V ≤ −α_0 λ_pq²(θ) θ² d_V + d_β for every θ > 0, with p and q the agents \
                whose velocities differ most.",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

const SHARPENED: About = About {
    name: "djokam-rathinam/velocity-diameter-sharpened",
    source: "Djokam & Rathinam, Theorem 1, with |v̄_p − v̄_q| ≤ (1 − Σ_j min(a_pj, a_qj)) d_V in \
             the place of Lemma 3",
    reading: Reading::Sharpened,
    statement: "d/dt d_V ≤ −α_0 Σ_j min(a_pj, a_qj) d_V + d_β.",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

const COROLLARY: About = About {
    name: "djokam-rathinam/active-set-printed",
    source: "Djokam & Rathinam, Corollary 1, (3.7b)",
    reading: Reading::Printed,
    statement: "d/dt d_V ≤ −α̲ λ(θ) θ² d_V + d_β, with λ(θ) the size of the global active set. \
                True, and weaker than what the proof gives.",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

const CORRECTED: About = About {
    name: "djokam-rathinam/active-set-corrected",
    source: "Djokam & Rathinam, Corollary 1, (3.7b), with the λ² of Theorem 1",
    reading: Reading::Corrected,
    statement: "d/dt d_V ≤ −α̲ λ²(θ) θ² d_V + d_β, with λ(θ) the size of the global active set.",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

/// See the file.
pub(super) enum VelocityDiameter {
    Theorem,
    Sharpened,
    Corollary,
    Corrected,
}

impl VelocityDiameter {
    /// What multiplies d_V: the rate at which velocities come together at least.
    fn rate<const D: usize>(&self, terms: &Terms<D>, spread: &Spread, least: f64) -> f64 {
        let [p, q] = spread.pair;
        let common = || terms.in_common(p, q);
        let squared = |count: f64, theta: f64| (count * theta) * (count * theta);
        match self {
            Self::Theorem => terms.least_gain() * strongest(common(), squared),
            Self::Sharpened => terms.least_gain() * common().iter().sum::<f64>(),
            Self::Corollary => {
                least
                    * strongest(terms.in_common_of_all(), |count, theta| {
                        count * theta * theta
                    })
            }
            Self::Corrected => least * strongest(terms.in_common_of_all(), squared),
        }
    }
}

impl<const D: usize> Claim<D> for VelocityDiameter {
    fn about(&self) -> &'static About {
        match self {
            Self::Theorem => &THEOREM,
            Self::Sharpened => &SHARPENED,
            Self::Corollary => &COROLLARY,
            Self::Corrected => &CORRECTED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose_steered(&mut judging);
        let start = velocity_spread(run.start()).length;
        judging.suppose("velocities differ at the start", start > 0.0);
        if !judging.is_supposed() {
            return Some(judging.finding());
        }
        let all = model.all_terms();
        let least = least_gain(&all);
        judging.measure("α̲", least);
        comes_together(&mut judging, run, &all, |terms, spread, _| {
            self.rate(terms, spread, least)
        });
        Some(judging.finding())
    }
}

/// The conclusions that d/dt d_V ≤ −ρ d_V + d_β, with ρ a function of the terms, d_V and the
/// number of the observation, and that between observations d_V grows by no more than ∫ d_β.
pub(super) fn comes_together<const D: usize>(
    judging: &mut Judging,
    run: &Run<'_, D>,
    all: &[Terms<D>],
    rate: impl Fn(&Terms<D>, &Spread, usize) -> f64,
) {
    let spreads: Vec<_> = run.observations.iter().map(velocity_spread).collect();
    let steering: Vec<f64> = all.iter().map(Terms::steering_diameter).collect();
    let terms = || all.iter().zip(&spreads).zip(&steering).enumerate();
    let bounds = terms().map(|(k, ((terms, it), d))| d - rate(terms, it, k) * it.length);
    let size = |k: usize| largest_speed(&run.observations[k]);
    let slack = terms().map(|(k, ((terms, _), d))| 1e-12 * (terms.largest_gain() * size(k) + d));
    judging.bound(Bound {
        name: "d/dt d_V",
        times: run.times(),
        values: spreads.iter().map(|it| it.rate).collect(),
        bounds: bounds.collect(),
        slack: slack.collect(),
        side: Side::Below,
        scale: 0.0,
    });
    let lengths: Vec<f64> = spreads.iter().map(|it| it.length).collect();
    let fastest = (0..lengths.len()).map(size).fold(0.0, f64::max);
    grows_at_most(judging, run, "d_V(t)", &lengths, &steering, |seen| {
        run.velocity_slack(seen, fastest)
    });
}

/// The largest value of a function of λ(θ) and θ over all θ > 0, where λ(θ) is the number of
/// these influences that are at least θ: it is taken at one of them.
pub(super) fn strongest(mut influences: Vec<f64>, of: impl Fn(f64, f64) -> f64) -> f64 {
    influences.sort_by(|a, b| b.total_cmp(a));
    let counts = influences.iter().zip(1..);
    let values = counts.map(|(theta, count)| of(f64::from(count), *theta));
    values.fold(0.0, f64::max)
}
