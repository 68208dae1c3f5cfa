//! What stands between two agents.

use crate::law::alignment::crowd::{Crowd, Stretch};
use crate::sense::{Scene, body_blocks};
use crate::shape::Solid;
use crate::world::World;
use crate::world::spec::LineOfSightSpec;

/// Bodies of third agents and obstacles on the straight line between the centres of two
/// agents, each of which multiplies the influence by its factor.
#[derive(Debug, Clone)]
pub(super) struct LineOfSight<const D: usize> {
    /// Factor of each body.
    agents: f64,
    /// Factor of each obstacle.
    obstacles: f64,
    /// The solid of each group's bodies.
    solids: Vec<Solid<D>>,
    /// Radius of the ball that holds each agent's body, in the order of the world.
    radii: Vec<f64>,
    largest: f64,
}

impl<const D: usize> LineOfSight<D> {
    pub(super) fn new(spec: &LineOfSightSpec, world: &World<D>) -> Self {
        Self {
            agents: spec.agents,
            obstacles: spec.obstacles,
            solids: world.solids.clone(),
            radii: world.agents.radius.clone(),
            largest: world.agents.radius.iter().copied().fold(0.0, f64::max),
        }
    }

    /// The radius of the largest body, where bodies matter.
    pub(super) fn largest_body(&self) -> Option<f64> {
        (self.agents < 1.0).then_some(self.largest)
    }

    /// The factor by which what stands between weakens the influence of agent `j` of the
    /// scene on agent `i`.
    pub(super) fn factor(&self, crowd: &Crowd<D>, scene: &Scene<'_, D>, i: usize, j: usize) -> f64 {
        let [bodies, obstacles] = self.blockers(crowd, scene, i, j);
        let power = |factor: f64, times: usize| (0..times).fold(1.0, |product, _| product * factor);
        power(self.agents, bodies) * power(self.obstacles, obstacles)
    }

    /// How many bodies and obstacles stand between two agents of the scene; those that change
    /// nothing are not counted. The same both ways.
    pub(super) fn blockers(
        &self,
        crowd: &Crowd<D>,
        scene: &Scene<'_, D>,
        i: usize,
        j: usize,
    ) -> [usize; 2] {
        let (i, j) = match scene.agents[i] < scene.agents[j] {
            true => (i, j),
            false => (j, i),
        };
        let (from, to) = (&scene.positions[i], &scene.positions[j]);
        let way = to - from;
        let mut bodies = 0;
        if self.agents < 1.0 {
            // A body may reach over an end of the line.
            let stretch = Stretch {
                from: -self.largest,
                to: way.norm() + self.largest,
            };
            crowd.between(
                from,
                to,
                stretch,
                |_| self.largest,
                |l, offset| {
                    let agent = scene.agents[l] as usize;
                    let solid = &self.solids[scene.groups[l] as usize];
                    let rotation = || scene.rotations[agent];
                    let blocks = l != i
                        && l != j
                        && body_blocks(solid, self.radii[agent], rotation, from, offset, &way);
                    bodies += usize::from(blocks);
                },
            );
        }
        let obstacles = match self.obstacles < 1.0 {
            true => scene.obstacles_between(from, to).count(),
            false => 0,
        };
        [bodies, obstacles]
    }
}
