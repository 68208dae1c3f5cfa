//! The targets that a world's laws give its agents.

use super::Motion;
use crate::law::Targets;
use crate::math::Moment;
use crate::trace::record::Header;
use crate::world::spec::LawSpec;
use crate::world::{AnyWorld, World};

/// The world that ran; nothing where this program cannot make it from the header.
pub(super) fn world_of(header: &Header) -> Option<AnyWorld> {
    AnyWorld::of_points(&header.name, header.world.clone()).ok()
}

/// A target at a time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Aim {
    pub(super) position: Vec<f64>,
    pub(super) velocity: Vec<f64>,
}

impl Aim {
    /// The target's position or velocity.
    pub(super) fn of(&self, motion: Motion) -> &[f64] {
        match motion {
            Motion::Positions => &self.position,
            Motion::Velocities => &self.velocity,
        }
    }
}

/// The targets of the tracking and flatness laws of a world.
#[derive(Debug, Default)]
pub(super) struct Goals(Vec<Goal>);

#[derive(Debug)]
struct Goal {
    targets: AnyTargets,
    acted_on: Vec<bool>,
}

#[derive(Debug)]
enum AnyTargets {
    Plane(Targets<2>),
    Space(Targets<3>),
}

impl Goals {
    /// The targets of a world; none without one.
    pub(super) fn of(world: Option<&AnyWorld>) -> Self {
        Self(match world {
            Some(AnyWorld::Plane(world)) => goals(world, AnyTargets::Plane),
            Some(AnyWorld::Space(world)) => goals(world, AnyTargets::Space),
            None => Vec::new(),
        })
    }

    /// The targets of an agent at a time.
    pub(super) fn of_agent(&self, agent: usize, time: f64) -> Vec<Aim> {
        let own = self.0.iter();
        let own = own.filter(|goal| goal.acted_on.get(agent) == Some(&true));
        own.filter_map(|goal| goal.targets.at(agent, time))
            .collect()
    }

    /// The courses of all different targets of these agents, each as a function of time: those
    /// that all share once.
    pub(super) fn courses(&self, agents: &[usize]) -> Vec<impl Fn(f64) -> Option<Aim>> {
        let mut courses = Vec::new();
        for goal in &self.0 {
            let mut own = agents
                .iter()
                .filter(|&&agent| goal.acted_on.get(agent) == Some(&true));
            let chosen: Vec<usize> = match goal.targets.shared() {
                true => own.next().copied().into_iter().collect(),
                false => own.copied().collect(),
            };
            courses.extend(
                chosen
                    .into_iter()
                    .map(|agent| move |time| goal.targets.at(agent, time)),
            );
        }
        courses
    }
}

impl AnyTargets {
    fn shared(&self) -> bool {
        matches!(
            self,
            Self::Plane(Targets::Shared(_)) | Self::Space(Targets::Shared(_))
        )
    }

    fn at(&self, agent: usize, time: f64) -> Option<Aim> {
        match self {
            Self::Plane(targets) => aim(targets, agent, time),
            Self::Space(targets) => aim(targets, agent, time),
        }
    }
}

fn aim<const D: usize>(targets: &Targets<D>, agent: usize, time: f64) -> Option<Aim> {
    let moment: Moment<D> = match targets {
        Targets::Shared(trajectory) => trajectory.at(time),
        Targets::Each(trajectories) => trajectories.get(agent)?.at(time),
    };
    Some(Aim {
        position: moment.position.as_slice().to_vec(),
        velocity: moment.velocity.as_slice().to_vec(),
    })
}

fn goals<const D: usize>(world: &World<D>, any: fn(Targets<D>) -> AnyTargets) -> Vec<Goal> {
    let laws = world.laws().filter_map(|(scope, law)| {
        let targets = match law {
            LawSpec::Tracking(law) => Targets::of_tracking(law, scope, world),
            LawSpec::Flatness(law) => Targets::of_agents(&law.trajectories, scope, world),
            _ => return None,
        };
        Some(Goal {
            targets: any(targets),
            acted_on: world.acted_on(scope),
        })
    });
    laws.collect()
}
