//! Where velocities lie that two of them delimit: Lemma 4.

use super::spread::{largest_speed, velocity_spread};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::metric::Observation;
use crate::world::spec::LawSpec;

const ABOUT: About = About {
    name: "djokam-rathinam/velocity-hull",
    source: "Djokam & Rathinam, Lemma 4",
    reading: Reading::Printed,
    statement: "⟨v_p − v_q, v − v_q⟩ ≥ 0 for every v in the convex hull of all velocities, with p and \
                q the agents whose velocities differ most.",
    hypotheses: "Three agents or more, some alignment, and velocities that differ.",
    measured: "The least of ⟨v_p − v_q, v_i − v_q⟩/d_V² over all i but p and q, at each observation \
               in which velocities differ: where all of the v_i are on that side, so is their hull.",
    tolerance: "1e-12 of max|v_i|/d_V, for rounding.",
};

/// See the file.
pub(super) struct VelocityHull;

impl<const D: usize> Claim<D> for VelocityHull {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let aligns = |law: &LawSpec| matches!(law, LawSpec::Alignment(_));
        run.world.laws().find(|(_, law)| aligns(law))?;
        let mut judging = Judging::of_states();
        let agents = run.world.agents.len();
        judging.suppose("there are three agents or more", agents > 2);
        let differ = |seen: &&Observation<D>| velocity_spread(seen).length > 0.0;
        let seen: Vec<_> = run.observations.iter().filter(differ).collect();
        judging.suppose("velocities differ", !seen.is_empty());
        if !judging.is_supposed() {
            return Some(judging.finding());
        }
        let least = seen.iter().map(|seen| {
            let spread = velocity_spread(seen);
            let [p, q] = spread.pair;
            let apart = seen.velocities[p] - seen.velocities[q];
            let others = (0..agents).filter(|i| ![p, q].contains(i));
            others
                .map(|i| apart.dot(&(seen.velocities[i] - seen.velocities[q])))
                .fold(f64::INFINITY, f64::min)
                / (spread.length * spread.length)
        });
        let rounding =
            |seen: &&Observation<D>| 1e-12 * largest_speed(seen) / velocity_spread(seen).length;
        judging.bound(Bound {
            name: "min_i ⟨v_p − v_q, v_i − v_q⟩/d_V²",
            times: seen.iter().map(|seen| seen.time).collect(),
            values: least.collect(),
            bounds: vec![0.0; seen.len()],
            slack: seen.iter().map(rounding).collect(),
            side: Side::Above,
            scale: 1.0,
        });
        Some(judging.finding())
    }
}
