//! The paper's net in a world: an (α, α) protocol, and what else acts.

use crate::claim::{Judging, Run};
use crate::math::{AlphaPair, Bump, Fade, Vector, mean};
use crate::metric::Observation;
use crate::net::{Net, link_energy, potential_gradient, structural_energy, structural_potential};
use crate::world::spec::{AlphaInteractionSpec, AlphaProtocol, LawSpec, Steered};

/// A world's (α, α) interaction.
pub(super) struct Model<'r, const D: usize> {
    pub run: &'r Run<'r, D>,
    pub spec: &'r AlphaInteractionSpec,
    /// Its place among the laws.
    pub index: usize,
    /// Forces and potentials of a pair, as the protocol has them.
    pub pair: AlphaPair,
}

/// What may act beside the protocol.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Others {
    /// Nothing.
    None,
    /// What accelerates all agents alike, and so leaves their relative motion alone.
    Common,
    /// Anything.
    Any,
}

impl<'r, const D: usize> Model<'r, D> {
    /// Nothing where the world has no (α, α) interaction.
    pub fn of(run: &'r Run<'r, D>) -> Option<Self> {
        let mut laws = run.world.laws().enumerate();
        let (index, spec) = laws.find_map(|(index, (_, law))| match law {
            LawSpec::AlphaInteraction(spec) => Some((index, spec)),
            _ => None,
        })?;
        Some(Self {
            run,
            spec,
            index,
            pair: spec.pair(),
        })
    }

    /// Supposes that the protocol acts between all agents, and what beside it.
    pub fn suppose(&self, judging: &mut Judging, others: Others) {
        let world = self.run.world;
        judging.suppose("there are two agents or more", world.agents.len() > 1);
        let mut alphas = world.laws().filter(|(_, law)| is_alpha(law));
        judging.suppose(
            "one protocol acts between all agents",
            alphas.next().is_some_and(|(scope, _)| scope.is_none()) && alphas.next().is_none(),
        );
        let still = world.gravity.norm() == 0.0;
        match others {
            Others::None => {
                let alone = world.laws().all(|(_, law)| is_alpha(law));
                judging.suppose("no other forces act", alone && still);
            }
            Others::Common => {
                let common = world.laws().all(|(scope, law)| match law {
                    LawSpec::Navigation(law) => scope.is_none() && law.steer == Steered::Mean,
                    law => is_alpha(law),
                });
                judging.suppose("other forces, if any, accelerate all agents alike", common);
            }
            Others::Any => {}
        }
    }

    /// Supposes that the protocol is one of these.
    pub fn suppose_protocol(&self, judging: &mut Judging, name: &str, of: &[AlphaProtocol]) {
        judging.suppose(
            format!("the protocol is {name}"),
            of.contains(&self.spec.protocol),
        );
    }

    /// The net of a state.
    pub fn net(&self, seen: &Observation<D>) -> Net {
        Net::new(&seen.positions, self.spec.range)
    }

    /// The same interaction that ends at once, as in (8), whose energies are the nonsmooth ones.
    pub fn sharp(&self) -> AlphaPair {
        AlphaPair {
            fade: Fade::Sharp,
            ..self.pair
        }
    }

    /// The same with the smooth weights of (17).
    pub fn smooth(&self) -> AlphaPair {
        AlphaPair {
            fade: Fade::Smooth(Bump::new(self.spec.bump_start)),
            ..self.pair
        }
    }

    /// H_s, (27), with the potential of a pair.
    pub fn energy(&self, seen: &Observation<D>, pair: &AlphaPair) -> f64 {
        structural_energy(&seen.positions, &seen.velocities, &self.net(seen), pair)
    }

    /// V, (28), with the potential of a pair.
    pub fn potential(&self, seen: &Observation<D>, pair: &AlphaPair) -> f64 {
        structural_potential(&seen.positions, &self.net(seen), pair)
    }

    /// h0, (31).
    pub fn link_energy(&self) -> f64 {
        link_energy(&self.pair)
    }

    /// dH_s/dt by velocities and some accelerations, the net held fixed, and the size of the
    /// powers that make it up.
    pub fn power(&self, seen: &Observation<D>, accelerations: &[Vector<D>]) -> (f64, f64) {
        let gradient = potential_gradient(&seen.positions, &self.net(seen), &self.pair);
        let center = mean(&seen.velocities);
        let (mut sum, mut size) = (0.0, 0.0);
        for (i, a) in accelerations.iter().enumerate() {
            let potential = gradient[i].dot(&seen.velocities[i]);
            let kinetic = (seen.velocities[i] - center).dot(a);
            sum += potential + kinetic;
            size += potential.abs() + kinetic.abs();
        }
        (sum, size)
    }

    /// −c1 Σ |p_j − p_i|² over the links, each counted once: what (61) says that dH_s/dt is. Where
    /// the damping is weighted, with these weights.
    pub fn dissipation(&self, seen: &Observation<D>) -> f64 {
        let mut sum = 0.0;
        for &[i, j] in self.net(seen).edges() {
            let weight = match self.spec.protocol {
                AlphaProtocol::SmoothWeightedDamping => self.weight(seen, [i, j]),
                _ => 1.0,
            };
            sum -= weight * (seen.velocities[j] - seen.velocities[i]).norm_squared();
        }
        self.spec.damping * sum
    }

    /// The weight a_ij of a link.
    pub fn weight(&self, seen: &Observation<D>, [i, j]: [usize; 2]) -> f64 {
        let distance = (seen.positions[j] - seen.positions[i]).norm();
        self.pair.weight(distance)
    }

    /// What H_s may be off in a state.
    pub fn energy_slack(&self, seen: &Observation<D>, energy: f64) -> f64 {
        let center = mean(&seen.velocities);
        self.run.energy_slack(seen, energy, &center, |_| 1.0)
    }
}

fn is_alpha(law: &LawSpec) -> bool {
    matches!(law, LawSpec::AlphaInteraction(_))
}
