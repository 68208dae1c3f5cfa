//! Friction in a world, and what makes up for it.

use crate::world::World;
use crate::world::spec::{FrictionSpec, LawSpec, ScopeSpec, Values};

/// What is supposed of the damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Damping {
    /// None, or compensated as in (4).
    None,
    /// That of (3), on every agent.
    All,
    /// Any that takes energy, or none.
    Any,
}

/// Friction less its compensation, each agent's rate in 1/time.
pub(super) fn damping_rates<const D: usize>(world: &World<D>) -> Vec<f64> {
    let mut rates = vec![0.0; world.agents.len()];
    for (sign, scope, law) in frictions(world) {
        let coefficients = law.coefficient.spread(&world.acted_on(scope));
        for (i, coefficient) in coefficients.into_iter().enumerate() {
            rates[i] += sign * coefficient * law.acts_as.factor(world.agents.mass[i]);
        }
    }
    rates
}

/// The size of what damping and its compensation are made of.
pub(super) fn damping_scale<const D: usize>(world: &World<D>) -> f64 {
    let largest = |law: &FrictionSpec| law.coefficient.largest();
    frictions(world)
        .map(|(_, _, law)| largest(law))
        .fold(0.0, f64::max)
}

fn frictions<const D: usize>(
    world: &World<D>,
) -> impl Iterator<Item = (f64, Option<&ScopeSpec>, &FrictionSpec)> {
    world.laws().filter_map(|(scope, law)| match law {
        LawSpec::Friction(law) => Some((1.0, scope, law)),
        LawSpec::FrictionCompensation(law) => Some((-1.0, scope, law)),
        _ => None,
    })
}

/// Whether friction is in proportion to the velocity, as in (3).
pub(super) fn is_linear(law: &FrictionSpec) -> bool {
    match &law.exponent {
        Values::All(exponent) => *exponent == 0.0,
        Values::Each(exponents) => exponents.iter().all(|exponent| *exponent == 0.0),
    }
}
