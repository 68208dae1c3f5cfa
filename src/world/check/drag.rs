//! Checks of drag and thrust.

use super::{Check, size};
use crate::world::spec::{
    ActsAs, FrictionSpec, PerAgent, ScopeSpec, SelfPropulsionSpec, WorldSpec, acting_on,
};

impl Check {
    /// Checks friction, whose linear form is feedback on the velocity.
    pub(super) fn friction(
        &mut self,
        path: &str,
        law: &FrictionSpec,
        scope: Option<&ScopeSpec>,
        world: &WorldSpec,
    ) {
        self.friction_compensation(path, law, scope);
        // Of the agents whose friction is linear; what it is for others depends on their speed.
        let agents = (0..).map(|place| {
            let linear = law.exponent.of(place) == 0.0;
            if linear {
                law.coefficient.of(place)
            } else {
                0.0
            }
        });
        let rate = largest_rate(law.acts_as, agents, scope, world);
        self.damping(&format!("{path}.coefficient"), over_mass(law.acts_as), rate);
    }

    /// Checks what makes up for friction.
    pub(super) fn friction_compensation(
        &mut self,
        path: &str,
        law: &FrictionSpec,
        scope: Option<&ScopeSpec>,
    ) {
        for (field, values) in [
            ("coefficient", &law.coefficient),
            ("exponent", &law.exponent),
        ] {
            self.values(&format!("{path}.{field}"), values, scope);
        }
    }

    /// Near the cruising speed √(α/β), speeds go there at the rate 2α.
    pub(super) fn self_propulsion(
        &mut self,
        path: &str,
        law: &SelfPropulsionSpec,
        scope: Option<&ScopeSpec>,
        world: &WorldSpec,
    ) {
        if law.drag > 0.0 {
            let twice = std::iter::repeat(2.0 * law.propulsion);
            let rate = largest_rate(law.acts_as, twice, scope, world);
            let times = match law.acts_as {
                ActsAs::Acceleration => "times 2",
                ActsAs::Force => "times 2, over the mass,",
            };
            self.damping(&format!("{path}.propulsion"), times, rate);
        }
    }
}

fn over_mass(acts_as: ActsAs) -> &'static str {
    match acts_as {
        ActsAs::Acceleration => "",
        ActsAs::Force => "over the mass",
    }
}

/// The largest rate (1/time) of feedback with these gains, one for each agent that laws in a
/// scope act on.
pub(super) fn largest_rate(
    acts_as: ActsAs,
    gains: impl Iterator<Item = f64>,
    scope: Option<&ScopeSpec>,
    world: &WorldSpec,
) -> f64 {
    let rates = gains.zip(masses(scope, world));
    rates
        .map(|(gain, mass)| gain * acts_as.factor(mass))
        .fold(0.0, f64::max)
}

/// The mass of each agent that laws in a scope act on; infinite where only the body's shape
/// can tell, so that nothing is refused for it.
fn masses<'a>(
    scope: Option<&'a ScopeSpec>,
    world: &'a WorldSpec,
) -> impl Iterator<Item = f64> + 'a {
    let groups = world.agents.iter().zip(acting_on(scope, &world.agents));
    let groups = groups.filter_map(|(group, acts)| acts.then_some(group));
    groups.flat_map(|group| {
        let same = match (&group.mass, group.density) {
            (Some(PerAgent::All(mass)), _) => *mass,
            (None, None) => 1.0,
            _ => f64::INFINITY,
        };
        let each = match &group.mass {
            Some(PerAgent::Each(masses)) => masses.as_slice(),
            _ => &[],
        };
        (0..size(group).unwrap_or(0)).map(move |k| each.get(k).copied().unwrap_or(same))
    })
}
