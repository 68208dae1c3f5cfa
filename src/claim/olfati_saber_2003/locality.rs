//! Nobody but neighbours matters, Lemma 1.

use super::model::{Model, Others};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::{Vector, direction};
use crate::metric::Observation;
use crate::world::spec::AlphaProtocol;

const ABOUT: About = About {
    name: "olfati-saber-2003/locality",
    source: "Olfati-Saber (2003), Lemma 1",
    reading: Reading::Printed,
    statement: "For agents j that are no neighbours of i, the smooth weight a_ij and its gradient are \
                0, so an agent's control follows from its neighbours alone.",
    hypotheses: "An (α, α) protocol with smooth weights, and agents that are no neighbours.",
    measured: "How far each agent's control by the protocol is from the sum over its neighbours, in \
               units of the largest control; 1 in place of it where weight or slope of a pair beyond \
               the range is not 0.",
    tolerance: "1e-9, for rounding: sums may be in another order.",
};

/// See the file.
pub(super) struct Locality;

impl<const D: usize> Claim<D> for Locality {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::of_states();
        let smooth = [
            AlphaProtocol::Smooth,
            AlphaProtocol::SmoothWeightedDamping,
            AlphaProtocol::Approximate,
        ];
        model.suppose_protocol(&mut judging, "one with smooth weights", &smooth);
        model.suppose(&mut judging, Others::Any);
        judging.suppose_perception(run.world);
        let pairs = run.world.agents.len() * (run.world.agents.len().max(1) - 1) / 2;
        let mut nets = run.observations.iter().map(|seen| model.net(seen));
        judging.suppose(
            "some agents are no neighbours",
            nets.any(|net| net.edges().len() < pairs),
        );
        let off = run.series(|seen| off(&model, seen));
        judging.bound(Bound {
            name: "max_i |u_i − Σ_(j ∈ N_i) u_ij|/max |u|",
            times: run.times(),
            bounds: vec![0.0; off.len()],
            slack: vec![1e-9; off.len()],
            values: off,
            side: Side::Below,
            scale: 0.0,
        });
        Some(judging.finding())
    }
}

fn off<const D: usize>(model: &Model<'_, D>, seen: &Observation<D>) -> f64 {
    let (pair, smooth) = (&model.pair, model.smooth());
    let mut sums = vec![Vector::<D>::zeros(); seen.positions.len()];
    for i in 0..seen.positions.len() {
        for j in 0..i {
            let offset = seen.positions[j] - seen.positions[i];
            let distance = offset.norm();
            if distance > model.spec.range {
                // The force of the smooth pair has the weight in one term, its slope in the other.
                if smooth.force_and_weight(distance) != (0.0, 0.0) {
                    return 1.0;
                }
                continue;
            }
            let weight = match model.spec.protocol {
                AlphaProtocol::SmoothWeightedDamping => pair.weight(distance),
                _ => 1.0,
            };
            let term = direction(&offset) * pair.force(distance)
                + (seen.velocities[j] - seen.velocities[i]) * (model.spec.damping * weight);
            sums[i] += term;
            sums[j] -= term;
        }
    }
    let controls = &seen.by_law[model.index];
    let largest = controls.iter().map(|u| u.norm()).fold(1e-300, f64::max);
    let off = controls.iter().zip(&sums).map(|(u, sum)| (u - sum).norm());
    off.fold(0.0, f64::max) / largest
}
