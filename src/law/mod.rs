//! Laws: what accelerates the agents. One file per law.
//!
//! A law adds to the acceleration of each agent; the flock sums its laws, so their
//! order does not matter but for rounding. To add one: write its file, add its
//! parameters to [`LawSpec`] and its line to [`build`].
//!
//! On bodies a law is of second order in the step where its acceleration is continuous in time,
//! positions and velocities. Where it ends at once at a distance ([`Law::jump`]) it is of first:
//! a link that comes or goes within a step is felt from the next one on. The file of a law that may
//! be of first order says so. Points end their steps there and have no such error.

mod alignment;
mod all_pairs;
mod alpha_interaction;
mod cucker_dong;
mod field;
mod first_order_flow;
mod flatness;
mod flock;
mod friction;
mod heading_consensus;
mod navigation;
mod obstacle_avoidance;
mod pair_force;
mod pair_potential;
mod park_bonding;
mod pattern;
mod pull;
mod scoped;
mod self_propulsion;
mod stage;
mod steering;
mod targets;
mod tracking;
mod watches;

pub use alignment::Alignment;
pub use alpha_interaction::AlphaInteraction;
pub use cucker_dong::CuckerDong;
pub use field::Field;
pub use first_order_flow::FirstOrderFlow;
pub use flatness::Flatness;
pub use flock::{Flock, State};
pub use friction::Friction;
pub use heading_consensus::HeadingConsensus;
pub use navigation::Navigation;
pub use obstacle_avoidance::ObstacleAvoidance;
pub use pair_potential::PairPotential;
pub use park_bonding::ParkBonding;
pub use pattern::Pattern;
pub use pull::{Link, Pull, Pulls, Row};
pub use scoped::Scoped;
pub use self_propulsion::SelfPropulsion;
pub use steering::Steering;
pub use targets::Targets;
pub use tracking::Tracking;

use crate::math::Vector;
use crate::sense::Scene;
use crate::world::World;
use crate::world::spec::{LawSpec, ScopeSpec};

/// A law: a map from what the agents see to what they want to accelerate by.
pub trait Law<const D: usize>: Send + Sync {
    /// Name of the law, for traces and reports.
    fn name(&self) -> &str;

    /// Largest distance at which the law looks for neighbours through
    /// [`Scene::neighbours`]; 0 where it does not.
    fn range(&self) -> f64 {
        0.0
    }

    /// The distance at which the law's acceleration jumps, when another agent comes within it
    /// or leaves it; nothing where it fades out, or has no end.
    fn jump(&self) -> Option<f64> {
        None
    }

    /// Prepares what all agents share, before a scene's accelerations are asked for.
    fn prepare(&mut self, _scene: &Scene<'_, D>) {}

    /// Sums over all pairs, after [`Law::prepare`] and before accelerations are asked for,
    /// where the law acts on all agents of the scene: what it does not do here, it does where
    /// it is asked.
    fn gather(&mut self, _scene: &Scene<'_, D>) {}

    /// The law as a pull on the velocity of agent `i` of the scene, its links appended to
    /// `links`; nothing where the law is no average of velocities, or does not act on the
    /// agent. A law that has pulls has them for every state, and its acceleration is
    /// theirs: see [`Pull`].
    fn pull(&self, _scene: &Scene<'_, D>, _i: usize, _links: &mut Vec<Link<D>>) -> Option<Pull> {
        None
    }

    /// Whether the dynamics should integrate the law's pulls exactly over a step, rather
    /// than hold its acceleration fixed: for rates near or above one over the step.
    fn relaxes(&self) -> bool {
        false
    }

    /// The most by which the law's pulls may change a velocity in a step, as a share of how
    /// far it is from those that it is pulled to: rate × step. Laws whose stiffness adds up to
    /// a quarter or more relax as well. 0 where the law has no pulls, or is not to relax.
    fn stiffness(&self) -> f64 {
        0.0
    }

    /// Calls `visit` with every agent of the scene whose influence on agent `i` something in
    /// the line of sight weakens or blocks; none where the law does not look.
    fn blocked(&self, _scene: &Scene<'_, D>, _i: usize, _visit: &mut dyn FnMut(usize)) {}

    /// Adds the law's acceleration of the agents `first`, `first + 1`, … to `out`, one
    /// entry for each. Must be the same however the agents are split into calls.
    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]);
}

/// The laws of a world, in its order; those in scopes act there only.
pub fn build<const D: usize>(world: &World<D>) -> Vec<Box<dyn Law<D>>> {
    build_where(world, |_| true)
}

/// As [`build`], those only that are wanted.
pub(crate) fn build_where<const D: usize>(
    world: &World<D>,
    wanted: impl Fn(&LawSpec) -> bool,
) -> Vec<Box<dyn Law<D>>> {
    world
        .laws()
        .filter(|(_, spec)| wanted(spec))
        .filter_map(|(scope, spec)| {
            let law = one(spec, scope, world)?;
            Some(match scope {
                Some(scope) => Box::new(Scoped::new(law, scope, &world.spec.agents)),
                None => law,
            })
        })
        .collect()
}

/// A law without its scope; nothing for a scope itself, which no checked world has here.
fn one<const D: usize>(
    spec: &LawSpec,
    scope: Option<&ScopeSpec>,
    world: &World<D>,
) -> Option<Box<dyn Law<D>>> {
    Some(match spec {
        LawSpec::AlphaInteraction(spec) => Box::new(AlphaInteraction::new(spec)),
        LawSpec::ObstacleAvoidance(spec) => Box::new(ObstacleAvoidance::new(spec, world)),
        LawSpec::Navigation(spec) => Box::new(Navigation::new(spec)),
        LawSpec::HeadingConsensus(spec) => Box::new(HeadingConsensus::new(spec)),
        LawSpec::Tracking(spec) => Box::new(Tracking::new(spec, scope, world)),
        LawSpec::Steering(spec) => Box::new(Steering::new(spec, scope, world)),
        LawSpec::Flatness(spec) => Box::new(Flatness::new(spec, scope, world)),
        LawSpec::Alignment(spec) => Box::new(Alignment::new(spec, scope, world)),
        LawSpec::PairPotential(spec) => Box::new(PairPotential::new(spec)),
        LawSpec::CuckerDong(spec) => Box::new(CuckerDong::new(spec)),
        LawSpec::ParkBonding(spec) => Box::new(ParkBonding::new(spec)),
        LawSpec::FirstOrderFlow(spec) => Box::new(FirstOrderFlow::new(spec)),
        LawSpec::LinePattern(spec) => Box::new(Pattern::line(spec, world.acted_on(scope))),
        LawSpec::BallPattern(spec) => Box::new(Pattern::ball(spec, world.acted_on(scope))),
        LawSpec::Friction(spec) => Box::new(Friction::new(spec, &world.acted_on(scope))),
        LawSpec::FrictionCompensation(spec) => {
            Box::new(Friction::compensation(spec, &world.acted_on(scope)))
        }
        LawSpec::SelfPropulsion(spec) => Box::new(SelfPropulsion::new(spec)),
        LawSpec::Scope(_) => return None,
    })
}
