//! How far two bodies are from each other, as shares of their radius.

use super::gap::{gap_to, pair_gap};
use crate::dynamics::{Snapshot, Touched};
use crate::world::World;

/// The gap between an agent and what it touched or touches, over the radius of the smaller body;
/// obstacles have none.
pub fn share_apart<'a, const D: usize>(
    world: &'a World<D>,
    state: &Snapshot<'a, D>,
) -> impl Fn(usize, Touched) -> f64 + 'a {
    let (pair_gap, gap_to) = (pair_gap(world, state), gap_to(world, state));
    let (positions, obstacles) = (state.positions, state.obstacles);
    let radii = &world.agents.radius;
    move |agent, touched| match touched {
        Touched::Agent(other) => {
            let distance = (positions[agent] - positions[other]).norm();
            let between_balls = distance - radii[agent] - radii[other];
            pair_gap(agent, other, between_balls) / radii[agent].min(radii[other])
        }
        Touched::Obstacle(other) => gap_to(agent, &obstacles[other]) / radii[agent],
    }
}
