//! β-agents, the projections of agents on obstacles, and γ-agents, which draw them past.

use crate::law::ObstacleAvoidance;
use crate::math::Vector;
use crate::picture::{Mark, Paint, Stroke};
use crate::render::Scene;
use crate::render::frame::State;
use crate::render::view::{Canvas, disk};
use crate::world::World;
use crate::world::spec::LawSpec;
use crate::world::vector;

/// Draws β-agents as dots, each with a line from its agent.
pub(in crate::render) fn beta<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    let color = scene.look.theme.ink;
    for beta in state.frame.beta_agents.iter().flatten() {
        let place: Vector<D> = vector(&beta.position);
        let line = Stroke::new(color.opacity(0.35), 0.7);
        canvas.lines(&[[state.positions[beta.agent], place]], &line);
        canvas.mark_at(&place, 0.0, |sight| Some(disk(sight.at, 1.8, color)));
    }
}

/// The laws of a world that may have γ-agents.
pub(in crate::render) fn laws<const D: usize>(world: &World<D>) -> Vec<ObstacleAvoidance<D>> {
    let laws = world.laws().filter_map(|(_, law)| match law {
        LawSpec::ObstacleAvoidance(spec) => Some(ObstacleAvoidance::new(spec, world)),
        _ => None,
    });
    laws.collect()
}

/// Where the γ-agents are, those of moving obstacles where these are now.
pub(in crate::render) fn gamma_agents<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
) -> Vec<Vector<D>> {
    let mut places = Vec::new();
    for law in &scene.avoidance {
        for (index, obstacle) in scene.world.obstacles.iter().enumerate() {
            match obstacle.motion() {
                None => places.extend(law.gamma_agents(obstacle).into_iter().flatten()),
                Some(_) => {
                    let mut here = obstacle.clone();
                    here.pose = state.obstacle_pose(scene, index);
                    places.extend(law.gamma_agents(&here).into_iter().flatten());
                }
            }
        }
    }
    places
}

/// Draws γ-agents as rings with a point.
pub(in crate::render) fn gamma<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    for place in gamma_agents(scene, state) {
        canvas.mark_at(&place, f64::INFINITY, |sight| Some(ring(scene, sight.at)));
    }
}

/// A γ-agent.
pub(in crate::render) fn ring<const D: usize>(scene: &Scene<'_, D>, center: [f64; 2]) -> Mark {
    let theme = &scene.look.theme;
    Mark::Disk {
        center,
        radius: 3.0,
        fill: Some(Paint::Flat(theme.page)),
        stroke: Some(Stroke::new(theme.ink, 1.5)),
    }
}
