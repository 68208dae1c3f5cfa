//! The trajectories that a law's agents are to follow.

use crate::math::{Moment, Trajectory, Vector};
use crate::world::World;
use crate::world::spec::{ScopeSpec, TrajectoriesSpec, spread};

/// Where the agents are to be: one trajectory for all, or one for each agent of the world.
#[derive(Debug, Clone)]
pub enum Targets<const D: usize> {
    /// One for all.
    Shared(Trajectory<D>),
    /// One for each agent, in the order of the world.
    Each(Vec<Trajectory<D>>),
}

impl<const D: usize> Targets<D> {
    /// One for each agent that a law in this scope acts on; the others, which the law is not
    /// asked for, are to rest at the origin.
    pub fn of_agents(spec: &TrajectoriesSpec, scope: Option<&ScopeSpec>, world: &World<D>) -> Self {
        let acted_on = world.acted_on(scope);
        let count = acted_on.iter().filter(|&&acts| acts).count();
        let rest = Trajectory::rest(Vector::zeros());
        Self::Each(spread(spec.trajectories(count), rest, &acted_on))
    }

    /// The targets at a time: one for all, or one for each agent.
    pub fn at(&self, time: f64) -> Vec<Moment<D>> {
        match self {
            Self::Shared(trajectory) => vec![trajectory.at(time)],
            Self::Each(trajectories) => trajectories.iter().map(|it| it.at(time)).collect(),
        }
    }
}

/// What is the agent's among entries that are one for each agent of the world, or one that
/// all share.
pub(super) fn own<T>(entries: &[T], agent: u32) -> &T {
    match entries {
        [shared] => shared,
        each => &each[agent as usize],
    }
}
