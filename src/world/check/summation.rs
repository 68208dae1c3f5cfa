//! Checks of how sums over all pairs are taken.

use super::Check;
use crate::sum::fast::Kernel;
use crate::world::spec::{
    AlignmentSpec, NormalisationSpec, PairPotentialSpec, ScopeSpec, SummationSpec, WorldSpec,
};

impl Check {
    /// Fast sums of an alignment law must be possible.
    pub(super) fn alignment_summation(
        &mut self,
        path: &str,
        law: &AlignmentSpec,
        scope: Option<&ScopeSpec>,
        world: &WorldSpec,
    ) {
        let whole = law.self_influence || law.normalisation != NormalisationSpec::MotschTadmor;
        let reasons = [
            (law.range.is_some(), "a range"),
            (law.graph.is_some(), "a graph"),
            (law.orientation.is_some(), "orientation"),
            (law.masking.is_some(), "masking"),
            (law.line_of_sight.is_some(), "a line of sight"),
            (!whole, "motsch_tadmor without self_influence"),
        ];
        let kernel = Kernel::Influence(law.kernel.influence());
        self.fast_sums(path, law.summation, &reasons, &kernel, scope, world);
    }

    /// Fast sums of the forces of a potential must be possible.
    pub(super) fn potential_summation(
        &mut self,
        path: &str,
        law: &PairPotentialSpec,
        scope: Option<&ScopeSpec>,
        world: &WorldSpec,
    ) {
        let reasons = [(law.range.is_some(), "a range")];
        let kernel = Kernel::Force(law.potential);
        self.fast_sums(path, law.summation, &reasons, &kernel, scope, world);
    }

    fn fast_sums(
        &mut self,
        path: &str,
        summation: SummationSpec,
        reasons: &[(bool, &str)],
        kernel: &Kernel,
        scope: Option<&ScopeSpec>,
        world: &WorldSpec,
    ) {
        if !matches!(summation, SummationSpec::Fast(_)) {
            return;
        }
        let senses = world.agents.iter().any(|group| group.sensing.is_some());
        let more = [
            (scope.is_some(), "a scope"),
            (senses, "agents that have senses"),
            (
                !kernel.is_smooth(),
                "a kernel that is not known to be smooth",
            ),
        ];
        let mut reasons = reasons.iter().chain(&more).filter(|(holds, _)| *holds);
        if let Some((_, reason)) = reasons.next() {
            let what = format!("cannot be had with {reason}: must be `direct` or `auto`");
            self.add(format!("{path}.summation"), what);
        }
    }
}
