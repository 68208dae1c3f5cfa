//! The models of Theorems 10 and 16, and their energy.

use super::pair_energy::PairEnergy;
use crate::claim::undisturbed::{MutualAlignment, accelerates, suppose_undisturbed};
use crate::claim::{Judging, Run};
use crate::math::{Potential, Vector};
use crate::metric::Observation;
use crate::world::spec::{LawSpec, PairPotentialSpec, Share};
use crate::world::vector;

/// A model that the paper proposes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Model {
    /// (8), with bonds: Theorem 10.
    Bonded,
    /// (17), with attraction to the mean: Theorem 16.
    Attracted,
}

/// A model with its parameters, as a world has them, and its energy along a run.
pub(super) struct Setting {
    /// Number of agents, N.
    pub(super) count: f64,
    /// k_a.
    pub(super) stiffness: f64,
    /// η; 0 in (17).
    pub(super) length: f64,
    /// Q = Ψ(0).
    pub(super) height: f64,
    /// μ.
    pub(super) decay: f64,
    /// The energy of a pair.
    pub(super) pair: PairEnergy,
    /// Places of the three laws: alignment, bonds or attraction, repulsion.
    pub(super) laws: [usize; 3],
    /// W at each observation, (12) or (19).
    pub(super) energies: Vec<f64>,
}

impl Model {
    /// The model as a run's world has it, its hypotheses supposed; nothing where the world lacks
    /// one of its three laws.
    pub(super) fn of<const D: usize>(self, run: &Run<'_, D>) -> Option<(Setting, Judging)> {
        let world = run.world;
        let laws: Vec<&LawSpec> = world.laws().map(|(_, law)| law).collect();
        let place = |is: &dyn Fn(&Potential) -> bool| {
            laws.iter().enumerate().find_map(|(index, law)| match law {
                LawSpec::PairPotential(law) if is(&law.potential) => Some((index, law)),
                _ => None,
            })
        };
        let aligning = laws.iter().enumerate();
        let (alignment, aligned) = aligning.into_iter().find_map(|(index, law)| match law {
            LawSpec::Alignment(law) => Some((index, law)),
            _ => None,
        })?;
        let (repulsion, repelling) = place(&|it| matches!(it, Potential::Gaussian { .. }))?;
        let (cohesion, cohering) = place(&|it| match self {
            Self::Bonded => matches!(it, Potential::Bond { .. }),
            Self::Attracted => matches!(it, Potential::Attraction { .. }),
        })?;
        let count = world.agents.len() as f64;
        let share = |law: &PairPotentialSpec| match law.share {
            Share::Sum => 1.0,
            Share::Mean => 1.0 / count,
        };
        let (stiffness, length) = match cohering.potential {
            Potential::Bond { stiffness, length } => (share(cohering) * stiffness, length),
            // (17) divides k_a by N.
            Potential::Attraction { stiffness } => (share(cohering) * stiffness * count, 0.0),
            _ => return None,
        };
        let Potential::Gaussian { height, decay } = repelling.potential else {
            return None;
        };
        let height = share(repelling) * height;

        let mut judging = Judging::new(run);
        let number = match self {
            Self::Bonded => "(8)",
            Self::Attracted => "(17)",
        };
        judging.suppose(
            format!("the laws are those of {number}, and no others act"),
            laws.len() == 3,
        );
        let mutual = MutualAlignment::of(aligned, world);
        judging.suppose(
            "velocities align at the rates (2), H/(1 + r²)^β, between all pairs",
            mutual.is_some_and(|it| it.decay().is_some()),
        );
        judging.suppose(
            "the forces are accelerations, and act between all pairs",
            [cohering, repelling]
                .iter()
                .all(|law| law.range.is_none() && accelerates(law.acts_as, world)),
        );
        let positive = stiffness > 0.0 && height > 0.0 && decay > 0.0;
        judging.suppose(
            "k_a, η, Q and μ are above 0",
            positive && (length > 0.0 || self == Self::Attracted),
        );
        suppose_undisturbed(&mut judging, world);
        let start = super::smallest_distance(&run.start().positions);
        judging.suppose(
            "there are two agents or more, and no two start at one point",
            start > 0.0 && start.is_finite(),
        );
        let pair = PairEnergy {
            cohesion: match self {
                Self::Bonded => Potential::Bond { stiffness, length },
                Self::Attracted => Potential::Attraction {
                    stiffness: stiffness / count,
                },
            },
            repulsion: Potential::Gaussian { height, decay },
        };
        let setting = Setting {
            count,
            stiffness,
            length,
            height,
            decay,
            pair,
            laws: [alignment, cohesion, repulsion],
            energies: run.series(|seen| seen.laws.energy.unwrap_or(f64::INFINITY)),
        };
        judging.measure("W(0)", setting.start());
        Some((setting, judging))
    }
}

impl Setting {
    /// W(0).
    pub(super) fn start(&self) -> f64 {
        self.energies[0]
    }

    /// What W may be off in an observation.
    pub(super) fn slack<const D: usize>(&self, run: &Run<'_, D>, seen: &Observation<D>) -> f64 {
        run.energy_slack(seen, self.start(), &mean_velocity(seen), |_| 1.0)
    }

    /// dW/dt along the motion, Σ ⟨v̂_i, a_i⟩ − Σ ⟨v̂_i, f_i⟩ with f the forces of the potentials,
    /// and what its rounding goes with: the sizes of its terms, were velocities not centred.
    pub(super) fn slope<const D: usize>(&self, seen: &Observation<D>) -> (f64, f64) {
        let center = mean_velocity(seen);
        let (mut slope, mut size) = (0.0, 0.0);
        for (i, velocity) in seen.velocities.iter().enumerate() {
            let forces = self.laws[1..].iter().map(|law| seen.by_law[*law][i]);
            let force: Vector<D> = forces.sum();
            slope += (velocity - center).dot(&(seen.accelerations[i] - force));
            size += velocity.norm() * (seen.accelerations[i].norm() + force.norm());
        }
        (slope, size)
    }
}

/// v_c, (9).
pub(super) fn mean_velocity<const D: usize>(seen: &Observation<D>) -> Vector<D> {
    vector(&seen.laws.mean_velocity)
}

/// x_c, (9).
pub(super) fn mean_position<const D: usize>(seen: &Observation<D>) -> Vector<D> {
    vector(&seen.laws.mean_position)
}
