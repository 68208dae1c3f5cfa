//! What of a world is to be seen.

use crate::math::Vector;
use crate::render::Survey;
use crate::shape::{Bounds, Shape};
use crate::world::World;

use super::extent::{around, extent_of};

/// How far beyond all bodies obstacles count as part of the scene, as a share of the largest side
/// of the box that holds the bodies.
const REACH: f64 = 0.75;

/// How much room is left on every side, as a share of the largest side.
const ROOM: f64 = 0.03;

/// The box that holds all bodies at all times, the obstacles as far as they are near, and some
/// places besides.
pub(super) fn whole<const D: usize>(
    world: &World<D>,
    survey: &Survey<D>,
    obstacles: bool,
    places: &[Vector<D>],
) -> Bounds<D> {
    let mut bounds = survey.bodies;
    for place in places {
        bounds = around(Some(bounds), (*place, *place));
    }
    if obstacles {
        bounds = with_obstacles(world, survey, bounds);
    }
    let (min, max) = bounds;
    let largest = (max - min).amax();
    let smallest = 4.0 * world.agents.radius.iter().copied().fold(0.0, f64::max);
    // A single body at rest still has a scene around it.
    let side = (max - min).map(|side| side.max(smallest) + 2.0 * ROOM * largest.max(smallest));
    let middle = (min + max) * 0.5;
    (middle - side * 0.5, middle + side * 0.5)
}

fn with_obstacles<const D: usize>(
    world: &World<D>,
    survey: &Survey<D>,
    (min, max): Bounds<D>,
) -> Bounds<D> {
    let reach = Vector::repeat(REACH * (max - min).amax());
    let (lowest, highest) = (min - reach, max + reach);
    let fixed = world.obstacles.iter().filter(|it| it.motion().is_none());
    let extents = fixed.filter_map(|obstacle| extent_of(obstacle.parts(), &obstacle.pose));
    let mut bounds = (min, max);
    for (from, to) in extents.chain(survey.movers) {
        if (0..D).all(|k| from[k] <= highest[k] && to[k] >= lowest[k]) {
            // What is small is seen whole.
            bounds = match (0..D).all(|k| to[k] - from[k] <= reach[k]) {
                true => around(Some(bounds), (from, to)),
                false => around(Some(bounds), (from.sup(&lowest), to.inf(&highest))),
            };
        }
    }
    let middle = (min + max) * 0.5;
    for obstacle in &world.obstacles {
        for part in obstacle.parts() {
            let Shape::HalfSpace { normal } = &part.shape else {
                continue;
            };
            let pose = part.world_pose(&obstacle.pose);
            let normal = pose.vector_to_world(normal);
            // The point of its surface that is nearest to the middle.
            let foot = middle - normal * normal.dot(&(middle - pose.translation));
            if (0..D).all(|k| foot[k] <= highest[k] && foot[k] >= lowest[k]) {
                bounds = around(Some(bounds), (foot, foot));
            }
        }
    }
    bounds
}

/// Height of the ground, on which shadows fall: that of a half-space that faces upwards, or the
/// lowest part of the scene.
pub(super) fn ground<const D: usize>(world: &World<D>, bounds: &Bounds<D>) -> f64 {
    let up = D - 1;
    let parts = world
        .obstacles
        .iter()
        .flat_map(|obstacle| obstacle.parts().iter().map(move |part| (obstacle, part)));
    let heights = parts.filter_map(|(obstacle, part)| match &part.shape {
        Shape::HalfSpace { normal } => {
            let pose = part.world_pose(&obstacle.pose);
            let level = pose.vector_to_world(normal)[up] > 1.0 - 1e-9;
            level.then(|| pose.translation[up])
        }
        _ => None,
    });
    heights
        .filter(|height| (bounds.0[up]..=bounds.1[up]).contains(height))
        .fold(None, |highest: Option<f64>, height| {
            Some(highest.map_or(height, |other| other.max(height)))
        })
        .unwrap_or(bounds.0[up])
}
