//! The edges of the proximity net, and blocked lines of sight.

use crate::math::Vector;
use crate::picture::Stroke;
use crate::render::Scene;
use crate::render::frame::State;
use crate::render::view::Canvas;

/// Draws the edges of the net.
pub(in crate::render) fn edges<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    let lines = between(state, &state.edges(scene));
    canvas.lines(&lines, &edge(scene, state.tint));
}

/// What edges are drawn with.
pub(in crate::render) fn edge<const D: usize>(
    scene: &Scene<'_, D>,
    tint: Option<crate::picture::Color>,
) -> Stroke {
    Stroke::new(tint.unwrap_or(scene.look.theme.faint).opacity(0.5), 0.9)
}

/// Draws the blocked lines of sight.
pub(in crate::render) fn blocked<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    let pairs: Vec<[usize; 2]> = state.frame.blocked.iter().flatten().copied().collect();
    canvas.lines(&between(state, &pairs), &hidden(scene));
}

/// What blocked lines of sight are drawn with.
pub(in crate::render) fn hidden<const D: usize>(scene: &Scene<'_, D>) -> Stroke {
    Stroke::dashed(scene.look.theme.alarm.opacity(0.35), 0.8, 2.0, 3.0)
}

fn between<const D: usize>(state: &State<'_, D>, pairs: &[[usize; 2]]) -> Vec<[Vector<D>; 2]> {
    pairs
        .iter()
        .map(|pair| pair.map(|agent| state.positions[agent]))
        .collect()
}
