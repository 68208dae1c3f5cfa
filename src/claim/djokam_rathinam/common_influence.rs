//! What agents that are influenced in common have in common: Lemma 3.

use super::model::{Model, Terms};
use super::spread::{largest_speed, velocity_spread};
use super::velocity_diameter::strongest;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::Vector;
use crate::metric::Observation;

const ABOUT: About = About {
    name: "djokam-rathinam/common-influence",
    source: "Djokam & Rathinam, Lemma 3",
    reading: Reading::Printed,
    statement: "|⟨Su, w⟩| ≤ M Ū W̄ (1 − λ²(θ) θ²) for antisymmetric |S_ij| ≤ M, u and w ≥ 0 and every \
                θ > 0. As Theorem 1 uses it: S_ij = ⟨v_p − v_q, v_i − v_j⟩ with M = d_V², and for u \
                and w the influences on p and q, the agents whose velocities differ most.",
    hypotheses: "Alignment of all agents, who perceive each other as they are; velocities that differ.",
    measured: "|⟨v_p − v_q, v̄_p − v̄_q⟩|, which is |⟨Su, w⟩|, at each observation, against the bound \
               with the θ for which it is strongest.",
    tolerance: "1e-12 of d_V max|v_i|, for rounding.",
};

/// See the file.
pub(super) struct CommonInfluence;

impl<const D: usize> Claim<D> for CommonInfluence {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::of_states();
        judging.suppose_perception(run.world);
        model.suppose_aligned(&mut judging);
        let spreads: Vec<_> = run.observations.iter().map(velocity_spread).collect();
        let differ = spreads.iter().any(|it| it.length > 0.0);
        judging.suppose("velocities differ", differ);
        if !judging.is_supposed() {
            return Some(judging.finding());
        }
        let (mut values, mut bounds, mut slack) = (vec![], vec![], vec![]);
        let all = model.all_terms();
        for (seen, (terms, spread)) in run.observations.iter().zip(all.iter().zip(&spreads)) {
            let [p, q] = spread.pair;
            let apart = seen.velocities[p] - seen.velocities[q];
            let averages = average(terms, seen, p) - average(terms, seen, q);
            values.push(apart.dot(&averages).abs());
            let active = strongest(terms.in_common(p, q), |count, theta| {
                (count * theta) * (count * theta)
            });
            bounds.push(spread.length * spread.length * (1.0 - active));
            slack.push(1e-12 * spread.length * largest_speed(seen));
        }
        judging.bound(Bound {
            name: "|⟨Su, w⟩|",
            times: run.times(),
            values,
            bounds,
            slack,
            side: Side::Below,
            scale: 0.0,
        });
        Some(judging.finding())
    }
}

/// v̄_i.
fn average<const D: usize>(terms: &Terms<D>, seen: &Observation<D>, i: usize) -> Vector<D> {
    let weights = terms.influences.row(i);
    let each = weights.iter().zip(&seen.velocities);
    each.map(|(weight, velocity)| velocity * *weight).sum()
}
