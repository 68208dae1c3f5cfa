//! The bounds of the translational controllers, below (66).

use super::separation::{is_navigation, navigation};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::world::spec::Feedback;

const BOUNDS: About = About {
    name: "olfati-saber-2003/controller-bounds",
    source: "Olfati-Saber (2003), below (66)",
    reading: Reading::Printed,
    statement: "The translational controllers are bounded: |k1| ≤ 1 + c2 to a sink and |k2| ≤ c2 to a \
                group velocity; with a gain of the position, that in place of 1.",
    hypotheses: "A navigation law with the bounded feedback of (64) and (66).",
    measured: "The largest acceleration of an agent by the law, over the bound.",
    tolerance: "1e-12, for rounding: the bound is one of the law, whatever moves the agents.",
};

/// The bounds of the controllers.
pub(super) struct ControllerBounds;

impl<const D: usize> Claim<D> for ControllerBounds {
    fn about(&self) -> &'static About {
        &BOUNDS
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let law = navigation(run)?;
        let mut judging = Judging::of_states();
        judging.suppose("the feedback is bounded", law.feedback == Feedback::Bounded);
        let position = law.destination.as_ref().map_or(0.0, |_| law.position_gain);
        let bound = position + law.velocity_gain;
        judging.suppose("some gain is above 0", bound > 0.0);
        let index = run.world.laws().position(|(_, law)| is_navigation(law))?;
        let seen = || run.observations.iter().chain(&run.after_contact);
        let largest = seen().map(|seen| {
            let controls = seen.by_law[index].iter().map(|u| u.norm());
            controls.fold(0.0, f64::max) / bound
        });
        let values: Vec<f64> = largest.collect();
        judging.bound(Bound {
            name: "max_i |k_tr|/(1 + c2)",
            times: seen().map(|seen| seen.time).collect(),
            bounds: vec![1.0; values.len()],
            slack: vec![1e-12; values.len()],
            values,
            side: Side::Below,
            scale: 1.0,
        });
        Some(judging.finding())
    }
}
