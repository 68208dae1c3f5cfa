//! The senses of the agents of a world.

use crate::sense::Cone;
use crate::shape::Solid;
use crate::world::World;
use crate::world::check::whole_steps;
use crate::world::spec::{BlockedBySpec, NoiseSpec, PerAgent, SensingSpec};

/// How the agents of a world perceive each other, where a group of it has `sensing`.
#[derive(Debug, Clone)]
pub struct Senses<const D: usize> {
    groups: Vec<Sense>,
    /// Radius of the spherical neighbourhood of each agent, infinite without limit.
    pub(super) reaches: Vec<f64>,
    /// The solid of each group's bodies.
    pub(super) solids: Vec<Solid<D>>,
    /// Radius of the ball that holds each agent's body, and the largest.
    pub(super) bodies: Vec<f64>,
    pub(super) largest_body: f64,
    pub(super) seed: u64,
    step: f64,
}

/// How the agents of one group perceive others.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sense {
    pub field_of_view: Option<f64>,
    pub cone: Option<Cone>,
    pub blocked_by: BlockedBySpec,
    pub noise: NoiseSpec,
    /// In steps.
    pub delay: u64,
    pub dropout: f64,
}

impl<const D: usize> Senses<D> {
    /// The senses of a world; nothing where all perceive without limits or errors.
    pub fn new(world: &World<D>) -> Option<Self> {
        let specs = &world.spec.agents;
        if specs.iter().all(|group| group.sensing.is_none()) {
            return None;
        }
        let step = world.spec.time.step;
        let plain = SensingSpec::default();
        let sensing = |group: usize| specs[group].sensing.as_ref().unwrap_or(&plain);
        let mut reaches = Vec::with_capacity(world.agents.len());
        for (agent, &group) in world.agents.group.iter().enumerate() {
            let first = world.agents.group.partition_point(|&other| other < group);
            reaches.push(match &sensing(group).radius {
                None => f64::INFINITY,
                Some(PerAgent::All(radius)) => *radius,
                Some(PerAgent::Each(radii)) => radii[agent - first],
            });
        }
        Some(Self {
            groups: (0..specs.len())
                .map(|group| Sense::new(sensing(group), step))
                .collect(),
            reaches,
            solids: world.solids.clone(),
            bodies: world.agents.radius.clone(),
            largest_body: world.agents.radius.iter().copied().fold(0.0, f64::max),
            seed: world.spec.seed,
            step,
        })
    }

    /// The senses of a group.
    pub(super) fn of_group(&self, group: u32) -> &Sense {
        &self.groups[group as usize]
    }

    /// The step that begins at a time.
    pub fn step_at(&self, time: f64) -> u64 {
        (time / self.step).round() as u64
    }

    /// The delay of each group, in steps.
    pub fn delays(&self) -> impl Iterator<Item = u64> {
        self.groups.iter().map(|sense| sense.delay)
    }

    /// The radius within which each agent sees others, infinite without limit.
    pub fn reaches(&self) -> &[f64] {
        &self.reaches
    }
}

impl Sense {
    fn new(spec: &SensingSpec, step: f64) -> Self {
        Self {
            field_of_view: spec.field_of_view.as_ref().map(|field| field.angle),
            cone: spec.cone.as_ref().map(Cone::new),
            blocked_by: spec.blocked_by,
            noise: spec.noise,
            delay: whole_steps(spec.delay, step).unwrap_or(0),
            dropout: spec.dropout,
        }
    }
}
