//! The model with friction, (2.8), as a world has it.

use super::model::suppose_others;
use crate::claim::{Judging, Run};
use crate::math::Vector;
use crate::metric::Observation;
use crate::world::spec::LawSpec;

/// Friction −c_i |v_i|^r v_i.
pub(super) struct Damped {
    /// c̲ = min c_i, 0 where it does not act on all.
    pub least: f64,
    /// r; nothing where it is not the same for all.
    pub exponent: Option<f64>,
}

impl Damped {
    /// Of the first friction law; nothing without any.
    pub fn of<const D: usize>(run: &Run<'_, D>) -> Option<Self> {
        let world = run.world;
        let (scope, law) = world.laws().find_map(|(scope, law)| match law {
            LawSpec::Friction(law) => Some((scope, law)),
            _ => None,
        })?;
        let acted_on = world.acted_on(scope);
        let masses = world.agents.mass.iter();
        let coefficients = law.coefficient.spread(&acted_on).into_iter().zip(masses);
        let rates = coefficients.map(|(c, &mass)| c * law.acts_as.factor(mass));
        let exponents = law.exponent.spread(&acted_on);
        let first = exponents[0];
        Some(Self {
            least: rates.fold(f64::INFINITY, f64::min),
            exponent: exponents.iter().all(|it| *it == first).then_some(first),
        })
    }

    /// Supposes (2.8): alignment, this friction, and nothing else. As many alignment laws as
    /// there may be add up to one of the form (2.6).
    pub fn suppose<const D: usize>(&self, judging: &mut Judging, run: &Run<'_, D>) {
        let frictions = run.world.laws();
        let frictions = frictions.filter(|(_, law)| matches!(law, LawSpec::Friction(_)));
        judging.suppose("there is one friction law", frictions.count() == 1);
        let statement = "no law but alignment and friction acts";
        suppose_others(judging, run, statement, |law| {
            matches!(law, LawSpec::Friction(_))
        });
        let weightless = run.world.gravity == Vector::<D>::zeros();
        judging.suppose("there is no gravity", weightless);
        judging.suppose("r is the same for all agents", self.exponent.is_some());
        judging.suppose("c_i > 0 for all agents", self.least > 0.0);
        let moves = energy(run.start()) > 0.0;
        judging.suppose("some agent moves at the start", moves);
    }
}

/// E = max ½|v_i|².
pub(super) fn energy<const D: usize>(seen: &Observation<D>) -> f64 {
    seen.laws.largest_kinetic_energy
}

/// What E may be off: the speed times what a velocity may be off.
pub(super) fn energy_slack<const D: usize>(run: &Run<'_, D>, seen: &Observation<D>) -> f64 {
    let most = (2.0 * energy(run.start())).sqrt();
    most * run.velocity_slack(seen, most)
}
