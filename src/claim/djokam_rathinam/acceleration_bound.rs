//! The a-priori bound of accelerations, (2.2).

use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::world::spec::{GainSpec, LawSpec, VaryingGainSpec};

const ABOUT: About = About {
    name: "djokam-rathinam/acceleration-bound",
    source: "Djokam & Rathinam, Assumption 1, (2.2)",
    reading: Reading::Printed,
    statement: "With gains ξ_i(u) ≤ A/|u|, such as A/√(a² + |u|²), alignment accelerates no agent \
                by more than A.",
    hypotheses: "The law's gain is that of (2.3).",
    measured: "The largest α_i |u_i| ε/A_i of all agents at each time; accelerations of forces \
               are multiplied by the mass.",
    tolerance: "1e-12, for rounding: the bound is one of the law, whatever moves the agents.",
};

/// See the file.
pub(super) struct AccelerationBound;

impl<const D: usize> Claim<D> for AccelerationBound {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let laws = run.world.laws().enumerate();
        let mut aligning = laws.filter_map(|(index, (scope, law))| match law {
            LawSpec::Alignment(law) => Some((index, scope, law)),
            _ => None,
        });
        let (index, scope, law) = aligning.next()?;
        let mut judging = Judging::of_states();
        let GainSpec::Varying(VaryingGainSpec::Bounded { bound, .. }) = &law.gain else {
            judging.suppose("the gain is bounded as in (2.3)", false);
            return Some(judging.finding());
        };
        let acted_on = run.world.acted_on(scope);
        let bounds = bound.spread(&acted_on);
        let seen = || run.observations.iter().chain(&run.after_contact);
        let largest = seen().map(|seen| {
            let Some(aligned) = &seen.alignments[index] else {
                return 0.0;
            };
            let agents = aligned.influences.agents().iter().zip(&aligned.drives);
            let shares = agents.zip(&aligned.gains).map(|((&agent, u), gain)| {
                let mass = run.world.agents.mass[agent];
                let gain = gain * law.epsilon / law.acts_as.factor(mass);
                gain * u.norm() / bounds[agent]
            });
            shares.fold(0.0, f64::max)
        });
        let values: Vec<f64> = largest.collect();
        let count = values.len();
        judging.bound(Bound {
            name: "max_i |ξ_i(u_i)u_i|/A",
            times: seen().map(|seen| seen.time).collect(),
            values,
            bounds: vec![1.0; count],
            slack: vec![1e-12; count],
            side: Side::Below,
            scale: 1.0,
        });
        Some(judging.finding())
    }
}
