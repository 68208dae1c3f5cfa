//! What keeps agents apart under (35): the energy that they would have to have.

use super::model::{Model, Others};
use crate::claim::{About, Bound, Claim, Exclusion, Finding, Judging, Reading, Run, Side};
use crate::world::spec::AlphaProtocol;

const ABOUT: About = About {
    name: "olfati-saber-2003/no-contact-sharpened",
    source: "Olfati-Saber (2003), consequence of Propositions 5 and 6 i with (29)",
    reading: Reading::Sharpened,
    statement: "Under (35), where the smooth H_s(0) < ψ_α(−d_α), no two agents ever come nearer than \
                the r below d_α with a(r) ψ_α(r − d_α) = H_s(0). Bodies whose radius is less than \
                r/2 never touch. Repulsion is bounded, so more energy than that may bring them \
                together.",
    hypotheses: "Protocol (35), its damping weighted or not; other forces, if any, accelerate all \
                 agents alike, which leaves H_s alone; H_s(0) < ψ_α(−d_α).",
    measured: "The smallest distance of two agents, at all times, against r.",
    tolerance: "Of points 100 times the integrator's accuracy, of bodies step² times accelerations.",
};

/// See the file.
pub(super) struct NoContact;

impl<const D: usize> Claim<D> for NoContact {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = supposed(&model);
        let Some(closest) = run.closest.filter(|_| judging.is_supposed()) else {
            return Some(judging.finding());
        };
        let nearest = model.nearest();
        judging.measure("r", nearest);
        judging.bound(Bound {
            name: "min_ij |q_j − q_i|",
            times: vec![closest.time],
            values: vec![closest.distance],
            bounds: vec![nearest],
            slack: vec![run.position_slack(run.last(), nearest)],
            side: Side::Above,
            scale: closest.distance,
        });
        Some(judging.finding())
    }

    fn exclusion(&self, run: &Run<'_, D>) -> Option<Exclusion> {
        let model = Model::of(run)?;
        let supposed = supposed(&model).is_supposed();
        supposed.then(|| Exclusion {
            distance: model.nearest(),
            formula: "a(r) ψ_α(r − d_α) = H_s(0)",
        })
    }
}

fn supposed<const D: usize>(model: &Model<'_, D>) -> Judging {
    let run = model.run;
    let mut judging = Judging::new(run);
    let smooth = [AlphaProtocol::Smooth, AlphaProtocol::SmoothWeightedDamping];
    model.suppose_protocol(&mut judging, "(35)", &smooth);
    model.suppose(&mut judging, Others::Common);
    let energy = model.energy(run.start(), &model.pair);
    let contact = model.pair.action.potential(-model.spec.spacing);
    judging.suppose_less("H_s(0) < ψ_α(−d_α)", energy, contact);
    judging
}

impl<const D: usize> Model<'_, D> {
    /// How near two agents can come with all of H_s(0) between them. The pair potential falls all
    /// the way from contact to d_α, for ρ does not rise.
    fn nearest(&self) -> f64 {
        let energy = self.energy(self.run.start(), &self.pair);
        let (mut near, mut far) = (0.0, self.spec.spacing);
        // Twice as often as a number has digits.
        for _ in 0..100 {
            let middle = 0.5 * (near + far);
            match self.pair.potential(middle) > energy {
                true => near = middle,
                false => far = middle,
            }
        }
        near
    }
}
