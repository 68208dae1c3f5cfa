//! Checks of forces between pairs.

use super::Check;
use super::drag::largest_rate;
use crate::world::problem::Problem;
use crate::world::spec::{
    ActsAs, CuckerDongSpec, FirstOrderFlowSpec, PairPotentialSpec, ParkBondingSpec, ScopeSpec,
    WorldSpec,
};

impl Check {
    pub(super) fn pair_potential(
        &mut self,
        path: &str,
        law: &PairPotentialSpec,
        scope: Option<&ScopeSpec>,
        world: &WorldSpec,
    ) {
        self.finite(&format!("{path}.range"), law.range);
        self.potential_summation(path, law, scope, world);
    }

    pub(super) fn cucker_dong(&mut self, path: &str, law: &CuckerDongSpec) {
        self.finite(&format!("{path}.range"), law.range);
        let floor = libm::pow(law.floor, law.exponent);
        if !(law.strength / floor).is_finite() {
            let what = "makes an infinite force of the strength and the exponent";
            let problem = Problem::new(format!("{path}.floor"), what);
            self.problems.push(problem.hint("a larger one"));
        }
    }

    /// With all bonds in one line, relative velocities fall at the rate σ K1/2.
    pub(super) fn park_bonding(
        &mut self,
        path: &str,
        law: &ParkBondingSpec,
        scope: Option<&ScopeSpec>,
        world: &WorldSpec,
    ) {
        self.finite(&format!("{path}.range"), law.range);
        let gain = std::iter::repeat(0.5 * law.strength * law.velocity_gain);
        let rate = largest_rate(law.acts_as, gain, scope, world);
        let times = match law.acts_as {
            ActsAs::Acceleration => "times half the strength",
            ActsAs::Force => "times half the strength, over the mass,",
        };
        self.damping(&format!("{path}.velocity_gain"), times, rate);
    }

    pub(super) fn first_order_flow(&mut self, path: &str, law: &FirstOrderFlowSpec) {
        self.finite(&format!("{path}.range"), law.range);
        self.damping(&format!("{path}.rate"), "", law.rate);
    }
}
