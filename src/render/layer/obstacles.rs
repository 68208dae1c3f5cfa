//! Obstacles, and the shadows of all.

use crate::picture::{Color, Path};
use crate::render::Scene;
use crate::render::frame::State;
use crate::render::view::{Canvas, filled};
use crate::shape::Pose;

/// Draws what does not move.
pub(in crate::render) fn fixed<const D: usize>(scene: &Scene<'_, D>, canvas: &mut Canvas<'_, D>) {
    for (index, obstacle) in scene.world.obstacles.iter().enumerate() {
        if obstacle.motion().is_none() {
            draw(scene, index, &obstacle.pose, scene.look.theme.solid, canvas);
        }
    }
}

/// Draws what moves.
pub(in crate::render) fn moving<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    let theme = &scene.look.theme;
    let color = state.tint.unwrap_or(theme.solid.mix(theme.ink, 0.25));
    for (index, obstacle) in scene.world.obstacles.iter().enumerate() {
        if obstacle.motion().is_some() {
            let pose = state.obstacle_pose(scene, index);
            draw(scene, index, &pose, color, canvas);
        }
    }
}

fn draw<const D: usize>(
    scene: &Scene<'_, D>,
    obstacle: usize,
    pose: &Pose<D>,
    color: Color,
    canvas: &mut Canvas<'_, D>,
) {
    let parts = scene.world.obstacles[obstacle].parts();
    for (part, form) in parts.iter().zip(&scene.obstacles[obstacle]) {
        canvas.form(form, &part.world_pose(pose), color);
    }
}

/// Draws the shadows of obstacles and bodies on the ground, as one: where two overlap it is no
/// darker.
pub(in crate::render) fn shadows<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    obstacles: bool,
    bodies: bool,
    canvas: &mut Canvas<'_, D>,
) {
    let mut shadows = Path::new();
    if obstacles {
        for (index, obstacle) in scene.world.obstacles.iter().enumerate() {
            let pose = state.obstacle_pose(scene, index);
            for (part, form) in obstacle.parts().iter().zip(&scene.obstacles[index]) {
                canvas
                    .view
                    .shadow(form, &part.world_pose(&pose), &mut shadows);
            }
        }
    }
    if bodies {
        for (agent, &group) in scene.world.agents.group.iter().enumerate() {
            let form = &scene.solids[group];
            canvas.view.shadow(form, &state.pose(agent), &mut shadows);
        }
    }
    if !shadows.is_empty() {
        let color = scene
            .look
            .theme
            .ink
            .mix(scene.look.theme.solid, 0.5)
            .opacity(0.16);
        canvas.behind(filled(shadows, color));
    }
}
