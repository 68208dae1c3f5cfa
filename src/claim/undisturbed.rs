//! What theorems on flocks suppose without saying it: that nothing else is there, and that
//! velocities align alike between all pairs.

use super::Judging;
use crate::world::World;
use crate::world::spec::{ActsAs, AlignmentSpec, GainSpec, KernelSpec, NormalisationSpec, Values};

/// Supposes that there is nothing but agents, and that their laws are for all alike.
pub(super) fn suppose_undisturbed<const D: usize>(judging: &mut Judging, world: &World<D>) {
    judging.suppose(
        "there are no obstacles, and there is no gravity",
        world.obstacles.is_empty() && world.gravity.norm_squared() == 0.0,
    );
    judging.suppose(
        "the laws are for all agents alike, without scopes",
        world.laws().all(|(scope, _)| scope.is_none()),
    );
}

/// Whether what a law's formula gives is an acceleration in a world.
pub(super) fn accelerates<const D: usize>(acts_as: ActsAs, world: &World<D>) -> bool {
    world
        .agents
        .mass
        .iter()
        .all(|mass| acts_as.factor(*mass) == 1.0)
}

/// Alignment v̇_i = Σ_j a(r_ij)(v_j − v_i), the same between all pairs.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MutualAlignment {
    /// a(r) over the factor.
    pub(super) kernel: KernelSpec,
    /// What a is multiplied by.
    pub(super) factor: f64,
}

impl MutualAlignment {
    /// What a law is, where it is that.
    pub(super) fn of<const D: usize>(law: &AlignmentSpec, world: &World<D>) -> Option<Self> {
        let everywhere = law.range.is_none()
            && law.orientation.is_none()
            && law.masking.is_none()
            && law.line_of_sight.is_none()
            && law.graph.is_none();
        let count = world.agents.len() as f64;
        let share = match law.normalisation {
            NormalisationSpec::None => 1.0,
            NormalisationSpec::MeanField => 1.0 / count,
            NormalisationSpec::MotschTadmor => return None,
        };
        let GainSpec::Constant(Values::All(gain)) = law.gain else {
            return None;
        };
        (everywhere && accelerates(law.acts_as, world)).then(|| Self {
            kernel: law.kernel.clone(),
            factor: share * gain / law.epsilon,
        })
    }

    /// a at a distance.
    pub(super) fn rate(&self, distance: f64) -> f64 {
        self.factor * self.kernel.influence().value(distance * distance)
    }

    /// β, where a(r) = H/(1 + r²)^β with H > 0 and β ≥ 0: Song et al. (2013), (2).
    pub(super) fn decay(&self) -> Option<f64> {
        let (strength, exponent) = match self.kernel {
            KernelSpec::CuckerSmale {
                strength,
                length: 1.0,
                exponent,
            } => (strength, exponent),
            KernelSpec::Constant { strength } => (strength, 0.0),
            _ => return None,
        };
        (self.factor * strength > 0.0).then_some(exponent)
    }
}
