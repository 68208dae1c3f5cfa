//! The paper's model, (2.6) and (2.14), as a world has it.
//!
//! v̇_i = α_i(v̄_i − v_i) + β_i with v̄_i = Σ_j a_ij v_j, a_ij ≥ 0 and Σ_j a_ij = 1. Every alignment
//! law is of this form: its influences on others are divided by a scale s_i that they do not
//! exceed in sum, its gain is multiplied by it, and a_ii is what is left of 1. With Motsch–Tadmor
//! s_i = 1, otherwise the sum of N influences at distance 0.

use nalgebra::DMatrix;

use crate::claim::{Judging, Run};
use crate::math::{Gain, Vector};
use crate::metric::{Observation, diameter};
use crate::world::spec::{
    AlignmentSpec, GainSpec, LawSpec, NormalisationSpec, ScopeSpec, VaryingGainSpec,
};

/// The one alignment law of a run's world.
pub(super) struct Model<'r, 'w, const D: usize> {
    run: &'r Run<'w, D>,
    index: usize,
    pub scope: Option<&'w ScopeSpec>,
    pub law: &'w AlignmentSpec,
    /// The least scale.
    scale: f64,
}

/// The model's terms in one state.
pub(super) struct Terms<const D: usize> {
    /// α_i.
    pub gains: Vec<f64>,
    /// a_ij.
    pub influences: DMatrix<f64>,
    /// β_i, gravity included.
    pub steering: Vec<Vector<D>>,
}

/// Whether a law steers: accelerates an agent by what it and the time say, not the others.
pub(super) fn steers(law: &LawSpec) -> bool {
    matches!(
        law,
        LawSpec::Navigation(_) | LawSpec::Tracking(_) | LawSpec::Steering(_) | LawSpec::Flatness(_)
    )
}

/// Supposes that, alignment apart, all laws are of some kinds.
pub(super) fn suppose_others<const D: usize>(
    judging: &mut Judging,
    run: &Run<'_, D>,
    statement: &str,
    allowed: impl Fn(&LawSpec) -> bool,
) {
    let aligns = |law: &LawSpec| matches!(law, LawSpec::Alignment(_));
    let met = run.world.laws().all(|(_, law)| aligns(law) || allowed(law));
    judging.suppose(statement, met);
}

impl<'r, 'w, const D: usize> Model<'r, 'w, D> {
    /// Of the first alignment law; nothing without any.
    pub fn of(run: &'r Run<'w, D>) -> Option<Self> {
        let mut laws = run.world.laws().enumerate();
        let (index, scope, law) = laws.find_map(|(index, (scope, law))| match law {
            LawSpec::Alignment(law) => Some((index, scope, law)),
            _ => None,
        })?;
        let nearest = law.kernel.influence().value(0.0);
        let scale = match law.normalisation {
            NormalisationSpec::MotschTadmor => 1.0,
            NormalisationSpec::MeanField => nearest,
            NormalisationSpec::None => nearest * run.world.agents.len() as f64,
        };
        Some(Self {
            run,
            index,
            scope,
            law,
            scale,
        })
    }

    /// Supposes (2.14): this alignment of all agents and steering, and nothing else. Gravity
    /// counts as steering that all have in common.
    pub fn suppose_steered(&self, judging: &mut Judging) {
        let statement = "besides alignment, only steering and gravity act";
        suppose_others(judging, self.run, statement, steers);
        self.suppose_aligned(judging);
    }

    /// Supposes (2.6): this alignment of all agents, and nothing else.
    pub fn suppose_alone(&self, judging: &mut Judging) {
        suppose_others(judging, self.run, "no law but alignment acts", |_| false);
        let weightless = self.run.world.gravity == Vector::<D>::zeros();
        judging.suppose("there is no gravity", weightless);
        self.suppose_aligned(judging);
    }

    /// Supposes that one alignment law acts on all agents.
    pub fn suppose_aligned(&self, judging: &mut Judging) {
        let aligns = |law: &LawSpec| matches!(law, LawSpec::Alignment(_));
        let laws = self.run.world.laws();
        let one = laws.filter(|(_, law)| aligns(law)).count() == 1;
        judging.suppose("there is one alignment law", one);
        let acted_on = self.run.world.acted_on(self.scope);
        judging.suppose("all agents align", !acted_on.contains(&false));
        judging.suppose("there are two agents or more", acted_on.len() > 1);
    }

    /// The number of agents, N.
    pub fn count(&self) -> usize {
        self.run.world.agents.len()
    }

    /// The terms in a state; nothing where the law acts on none.
    pub fn terms(&self, seen: &Observation<D>) -> Option<Terms<D>> {
        let aligned = seen.alignments[self.index].as_ref()?;
        let mut influences = aligned.matrix().clone();
        let mut gains = aligned.gains.clone();
        for (i, gain) in gains.iter_mut().enumerate() {
            influences[(i, i)] = 0.0;
            let sum: f64 = influences.row(i).iter().sum();
            let scale = self.scale.max(sum);
            if scale > 0.0 {
                *gain *= scale;
                influences.row_mut(i).unscale_mut(scale);
                influences[(i, i)] = (1.0 - sum / scale).max(0.0);
            } else {
                influences[(i, i)] = 1.0;
            }
        }
        let accelerations = seen.accelerations.iter().zip(&seen.by_law[self.index]);
        let steering = accelerations.map(|(all, aligning)| all - aligning);
        Some(Terms {
            gains,
            influences,
            steering: steering.collect(),
        })
    }

    /// The terms in all states.
    pub fn all_terms(&self) -> Vec<Terms<D>> {
        let seen = self.run.observations.iter();
        seen.filter_map(|seen| self.terms(seen)).collect()
    }

    /// α_i(t) or ξ_i(u), which the law gives agent i where |v̄_i − v_i| is at most this much;
    /// nothing where the gain is no function of that alone.
    pub fn gain_within(&self, agent: usize, size: f64) -> Option<f64> {
        let world = self.run.world;
        let acted_on = world.acted_on(self.scope);
        let mass = world.agents.mass[agent];
        let over = self.law.acts_as.factor(mass) / self.law.epsilon;
        let gain = match &self.law.gain {
            GainSpec::Constant(gains) => Gain::Constant(gains.spread(&acted_on)[agent]),
            GainSpec::Varying(VaryingGainSpec::Bounded { bound, scale }) => Gain::Bounded {
                bound: bound.spread(&acted_on)[agent],
                scale: scale.spread(&acted_on)[agent],
            },
            GainSpec::Varying(VaryingGainSpec::OpenLoop(_)) => return None,
        };
        Some(self.scale * gain.scaled(over).at(self.scale * size))
    }
}

impl<const D: usize> Terms<D> {
    /// α_0 = min α_i.
    pub fn least_gain(&self) -> f64 {
        self.gains.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// max α_i.
    pub fn largest_gain(&self) -> f64 {
        self.gains.iter().copied().fold(0.0, f64::max)
    }

    /// d_β, (3.3).
    pub fn steering_diameter(&self) -> f64 {
        diameter(&self.steering)
    }

    /// min(a_pj, a_qj) for each j.
    pub fn in_common(&self, p: usize, q: usize) -> Vec<f64> {
        let (p, q) = (self.influences.row(p), self.influences.row(q));
        p.iter().zip(q.iter()).map(|(a, b)| a.min(*b)).collect()
    }

    /// min_p a_pj for each j.
    pub fn in_common_of_all(&self) -> Vec<f64> {
        let least = |column: nalgebra::DVectorView<'_, f64>| column.min();
        self.influences.column_iter().map(least).collect()
    }
}

/// α̲ over what was seen.
pub(super) fn least_gain<const D: usize>(terms: &[Terms<D>]) -> f64 {
    let gains = terms.iter().map(Terms::least_gain);
    gains.fold(f64::INFINITY, f64::min)
}
