//! Fields of view.

use std::f64::consts::{PI, TAU};

use crate::math::{Vector, direction, plane_across};
use crate::picture::{Path, Stroke};
use crate::render::Scene;
use crate::render::frame::State;
use crate::render::view::{Canvas, filled};
use crate::world::World;
use crate::world::spec::PerAgent;

/// Half the width and the radius of the field of view of each agent that has one.
pub(in crate::render) fn fields<const D: usize>(world: &World<D>) -> Vec<Option<[f64; 2]>> {
    let range = crate::law::build(world)
        .iter()
        .map(|law| law.range())
        .fold(0.0, f64::max);
    let mut place = vec![0; world.spec.agents.len()];
    let groups = world.agents.group.iter();
    groups
        .enumerate()
        .map(|(agent, &group)| {
            let within = place[group];
            place[group] += 1;
            let sensing = world.spec.agents.get(group)?.sensing.as_ref()?;
            let angle = sensing.field_of_view.as_ref()?.angle.min(PI);
            let radius = match &sensing.radius {
                Some(PerAgent::All(radius)) => Some(*radius),
                Some(PerAgent::Each(radii)) => radii.get(within).copied(),
                None => None,
            };
            let known = radius.or((range > 0.0 && range.is_finite()).then_some(range));
            // What sees without end is drawn a few bodies long.
            Some([angle, known.unwrap_or(10.0 * world.agents.radius[agent])])
        })
        .collect()
}

/// Draws the fields of view: in the plane faint sectors, in space the outlines of cones.
pub(in crate::render) fn draw<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    for (agent, field) in scene.fields.iter().enumerate() {
        let Some([angle, radius]) = *field else {
            continue;
        };
        let heading = state.heading(scene, agent);
        if heading.norm_squared() == 0.0 {
            continue;
        }
        let (at, color) = (state.positions[agent], state.colors[agent]);
        match D {
            2 => {
                let points = sector(&at, &heading, angle, radius);
                let seen: Option<Vec<_>> = points
                    .iter()
                    .map(|point| Some(canvas.view.see(point)?.at))
                    .collect();
                let color = color.opacity(0.07);
                canvas.mark_at(&at, 0.0, |_| Some(filled(Path::polygon(seen?), color)));
            }
            _ => {
                let lines = cone(&at, &heading, angle, radius);
                canvas.lines(&lines, &Stroke::new(color.opacity(0.25), 0.8));
            }
        }
    }
}

/// The corners of a sector of the plane.
fn sector<const D: usize>(
    at: &Vector<D>,
    heading: &Vector<D>,
    angle: f64,
    radius: f64,
) -> Vec<Vector<D>> {
    let ahead = heading[1].atan2(heading[0]);
    let steps = (angle / 0.1).ceil().max(2.0) as i32;
    let rim = (-steps..=steps).map(|k| {
        let (sin, cos) = (ahead + angle * f64::from(k) / f64::from(steps)).sin_cos();
        let way = [radius * cos, radius * sin];
        at + Vector::from_fn(|k, _| way.get(k).copied().unwrap_or(0.0))
    });
    std::iter::once(*at).chain(rim).collect()
}

/// The rim of a cone of space, and four lines to it.
fn cone<const D: usize>(
    at: &Vector<D>,
    heading: &Vector<D>,
    angle: f64,
    radius: f64,
) -> Vec<[Vector<D>; 2]> {
    let across = plane_across(heading).map(|way| direction(&way));
    let rim = |k: usize| {
        let (sin, cos) = (k as f64 / 24.0 * TAU).sin_cos();
        let way = (across[0] * cos + across[1] * sin) * angle.sin();
        at + (heading * angle.cos() + way) * radius
    };
    let circle = (0..24).map(|k| [rim(k), rim(k + 1)]);
    let sides = [0, 6, 12, 18].map(|k| [*at, rim(k)]);
    circle.chain(sides).collect()
}
