//! Where bodies came along.

use std::collections::BTreeMap;

use crate::math::Vector;
use crate::picture::Stroke;
use crate::render::Scene;
use crate::render::frame::State;
use crate::render::view::Canvas;
use crate::world::vector;

/// Pieces of a trail, each paler than the one after it.
const PIECES: usize = 6;

/// Draws the trails, which fade with their age.
pub(in crate::render) fn draw<const D: usize>(
    _scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    let past = &state.moment.trail;
    for piece in 0..PIECES {
        let bounds = [piece, piece + 1].map(|k| k * past.len() / PIECES);
        let opacity = 0.15 + 0.55 * (piece + 1) as f64 / PIECES as f64;
        let mut lines: BTreeMap<[u8; 3], Vec<[Vector<D>; 2]>> = BTreeMap::new();
        for (agent, now) in state.positions.iter().enumerate() {
            let place = |k: usize| match past.get(k) {
                Some(past) => past.positions.get(agent).map_or(*now, |it| vector(it)),
                None => *now,
            };
            let of_color = lines.entry(state.colors[agent].rgb).or_default();
            of_color.extend((bounds[0]..bounds[1]).map(|k| [place(k), place(k + 1)]));
        }
        for (rgb, lines) in lines {
            let color = crate::picture::Color { rgb, opacity };
            canvas.lines(&lines, &Stroke::new(color, 1.2));
        }
    }
}
