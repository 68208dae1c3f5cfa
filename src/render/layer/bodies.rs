//! Bodies, which way they head and how fast they go.

use crate::picture::{Path, Stroke};
use crate::render::Scene;
use crate::render::frame::State;
use crate::render::view::{Canvas, disk, filled};

/// Radius in pixels below which no body is drawn: a smaller one would not be seen.
const SMALLEST: f64 = 1.5;

/// Draws the bodies at true size, but for those too small to be seen.
pub(in crate::render) fn bodies<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    for (agent, &group) in scene.world.agents.group.iter().enumerate() {
        let (position, color) = (&state.positions[agent], state.colors[agent]);
        let Some(sight) = canvas.view.see(position) else {
            continue;
        };
        if scene.world.agents.radius[agent] * sight.scale < SMALLEST {
            let color = canvas.view.through_air(color, sight.distance);
            canvas.mark_at(position, 0.0, |sight| Some(disk(sight.at, SMALLEST, color)));
        } else {
            canvas.form(&scene.solids[group], &state.pose(agent), color);
        }
    }
}

/// Radius in pixels below which a body is pointed where it heads: a line would look like a tail.
const POINTED: f64 = 4.0;

/// Draws a line from the middle of each body to where it heads: in the plane up to its rim, in
/// space out of it. A small body gets a point there instead.
pub(in crate::render) fn headings<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    for agent in 0..state.positions.len() {
        let position = state.positions[agent];
        let heading = state.heading(scene, agent);
        let Some(sight) = canvas.view.see(&position) else {
            continue;
        };
        if heading.norm_squared() == 0.0 {
            continue;
        }
        let radius = scene.world.agents.radius[agent];
        let seen = radius * sight.scale;
        let color = state.colors[agent];
        let beyond = radius + (0.8 * seen).clamp(3.0, 8.0) / sight.scale;
        if seen < POINTED {
            let color = canvas.view.through_air(color, sight.distance);
            let tip = canvas.view.see(&(position + heading * beyond));
            let point = tip.and_then(|tip| point(sight.at, tip.at, seen.max(SMALLEST)));
            canvas.mark_at(&position, 0.0, |_| Some(filled(point?, color)));
            continue;
        }
        let (color, length) = match D {
            2 => (scene.look.theme.page, 0.9 * radius),
            _ => (color, beyond),
        };
        let width = (0.3 * seen).clamp(1.0, 2.0);
        canvas.lines(
            &[[position, position + heading * length]],
            &Stroke::new(color, width),
        );
    }
}

/// What makes a disk end in a point at `tip`; nothing where that is above its middle.
fn point(middle: [f64; 2], tip: [f64; 2], radius: f64) -> Option<Path> {
    let [x, y] = [tip[0] - middle[0], tip[1] - middle[1]];
    let length = x.hypot(y);
    let [across, along] = [-y, x].map(|part| part / length * radius);
    let side = |sign: f64| [middle[0] + sign * across, middle[1] + sign * along];
    (length > 0.0).then(|| Path::polygon([side(1.0), tip, side(-1.0)]))
}

/// Draws velocities as arrows, the largest of the run as long as [`LONGEST`].
pub(in crate::render) fn velocities<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    if scene.survey.speed == 0.0 {
        return;
    }
    let time = LONGEST / canvas.view.scale() / scene.survey.speed;
    let color = |agent: usize| state.colors[agent].mix(scene.look.theme.ink, 0.35);
    for (agent, position) in state.positions.iter().enumerate() {
        let tip = position + state.velocities[agent] * time;
        canvas.arrow(position, &tip, &Stroke::new(color(agent), 1.2), 5.0);
    }
}

/// Length in pixels of the arrow of the largest velocity.
const LONGEST: f64 = 32.0;
