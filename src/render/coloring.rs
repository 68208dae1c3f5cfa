//! The colours of bodies.

use std::f64::consts::TAU;

use crate::net::Net;
use crate::picture::{Color, Ramp, Theme};
use crate::render::{Coloring, Scene};

use super::frame::State;

/// The colour of each agent, as the scene's look has it.
pub(super) fn colors<const D: usize>(scene: &Scene<'_, D>, state: &State<'_, D>) -> Vec<Color> {
    let theme = &scene.look.theme;
    match scene.look.coloring {
        Coloring::Group => {
            let groups = scene.world.agents.group.iter();
            groups.map(|&group| theme.of(group)).collect()
        }
        Coloring::Speed => {
            let share = |speed: f64| match scene.survey.speed > 0.0 {
                true => speed / scene.survey.speed,
                false => 0.0,
            };
            let speeds = state.velocities.iter().map(|velocity| velocity.norm());
            speeds.map(|speed| of_speed(theme, share(speed))).collect()
        }
        Coloring::Component => of_components(scene, state),
        Coloring::Heading => (0..state.positions.len())
            .map(|agent| state.heading(scene, agent))
            .map(|heading| match heading[0] == 0.0 && heading[1] == 0.0 {
                true => theme.faint,
                false => of_heading(heading[1].atan2(heading[0])),
            })
            .collect(),
    }
}

/// The colour of a speed, as a share of the largest: without the end of the ramp that is hard to
/// see on the page.
pub(super) fn of_speed(theme: &Theme, share: f64) -> Color {
    let [red, green, blue] = theme.page.rgb.map(u32::from);
    let is_light = red + green + blue > 3 * 128;
    Ramp::Viridis.at(match is_light {
        true => 0.92 * share,
        false => 0.18 + 0.82 * share,
    })
}

/// The colour of a heading, an angle in radians.
pub(super) fn of_heading(angle: f64) -> Color {
    Ramp::Cyclic.at((angle / TAU).rem_euclid(1.0))
}

/// Components of the net by their size, the largest first; of two alike that of the first agent.
fn of_components<const D: usize>(scene: &Scene<'_, D>, state: &State<'_, D>) -> Vec<Color> {
    let agents = state.positions.len();
    let net = Net::from_edges(agents, state.edges(scene));
    let parts = net.partition();
    let mut order: Vec<usize> = (0..parts.count()).collect();
    order.sort_by_key(|&part| std::cmp::Reverse(parts.sizes()[part]));
    let mut rank = vec![0; order.len()];
    for (place, &part) in order.iter().enumerate() {
        rank[part] = place;
    }
    parts
        .of()
        .iter()
        .map(|&part| scene.look.theme.of(rank[part]))
        .collect()
}
