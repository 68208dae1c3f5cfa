//! Contacts: flashes while they last, marks afterwards.

use std::collections::BTreeSet;

use crate::picture::{Path, Stroke};
use crate::render::Scene;
use crate::render::frame::State;
use crate::render::view::{Canvas, circle, stroked};

/// How long a flash goes on after its contact, as a share of the run.
const AFTERGLOW: f64 = 0.02;

/// Half the width in pixels of the mark that a contact leaves.
const HALF: f64 = 2.5;

/// Draws the contacts that have begun: a circle about each agent while it touches, which widens
/// and fades afterwards where it began to touch; a cross stays there. Crosses on one place are
/// one.
pub(in crate::render) fn draw<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    let now = state.frame.time;
    let [first, last] = scene.survey.span();
    let glow = AFTERGLOW * (last - first);
    let alarm = scene.look.theme.alarm;
    let mut marked = BTreeSet::new();
    for touch in scene.survey.touches.iter().filter(|it| it.begin <= now) {
        let age = now - touch.end;
        let radius = scene.world.agents.radius[touch.agent];
        if age <= 0.0 {
            for agent in [Some(touch.agent), touch.other].into_iter().flatten() {
                let (place, radius) = (state.positions[agent], scene.world.agents.radius[agent]);
                canvas.mark_at(&place, 2.0 * radius, |sight| {
                    let radius = (radius * sight.scale).max(2.0) + 1.0;
                    Some(circle(sight.at, radius, Stroke::new(alarm, 1.5)))
                });
            }
        } else if age <= glow {
            let share = age / glow;
            canvas.mark_at(&touch.position, 2.0 * radius, |sight| {
                let radius = (radius * sight.scale).max(2.0) + 1.0 + 9.0 * share;
                let stroke = Stroke::new(alarm.opacity(1.0 - 0.8 * share), 1.5);
                Some(circle(sight.at, radius, stroke))
            });
        }
        canvas.mark_at(&touch.position, 0.0, |sight| {
            let cell = sight.at.map(|x| (x / 3.0).floor() as i64);
            marked
                .insert(cell)
                .then(|| cross(sight.at, alarm.opacity(0.6)))
        });
    }
}

/// The mark that a contact leaves.
pub(in crate::render) fn cross(at: [f64; 2], color: crate::picture::Color) -> crate::picture::Mark {
    let [x, y] = at;
    let mut path = Path::polyline([[x - HALF, y - HALF], [x + HALF, y + HALF]]);
    path.begin([x - HALF, y + HALF]);
    path.line([x + HALF, y - HALF]);
    stroked(path, Stroke::new(color, 1.2))
}
