//! Laws that steer along given courses: their formulas, their symmetries, and that what they
//! promise is flown.

#[path = "../common/mod.rs"]
mod common;

mod flight;
mod formulas;
mod symmetry;

use common::headings;
use volary::law::{Flock, State};
use volary::math::Vector;
use volary::world::World;

/// The accelerations that a world's laws give in some state, in the order of the world.
fn accelerations<const D: usize>(
    world: &World<D>,
    time: f64,
    positions: &[Vector<D>],
    velocities: &[Vector<D>],
) -> Vec<Vector<D>> {
    let mut out = vec![Vector::zeros(); positions.len()];
    let state = State {
        time,
        positions,
        velocities,
        headings: &headings(velocities),
        groups: &world.agents.group,
        masses: &world.agents.mass,
        rotations: &world.agents.rotations,
        obstacles: &world.obstacles,
    };
    Flock::of_world(world, Vec::new()).accelerations(&state, &mut out);
    out
}
