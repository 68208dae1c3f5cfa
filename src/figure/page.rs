//! How figures are laid out, and what more than one of them draws.

use super::course::Of;
use crate::picture::{Color, Picture, Theme};
use crate::plot::{Axis, Item, Marker, Plot, Sheet};
use crate::trace::record::Frame;

/// Plots beside each other, in rows of so many, each of this width and height in pixels.
pub(super) fn page(plots: Vec<Plot>, columns: usize, size: [f64; 2], theme: &Theme) -> Picture {
    let rows = plots.len().div_ceil(columns);
    let size = [size[0] * columns as f64, size[1] * rows as f64];
    let sheet = Sheet {
        plots,
        columns,
        ..Sheet::default()
    };
    sheet.draw(size, theme)
}

/// A plot against time.
pub(super) fn against_time(title: &str, y: Axis, items: Vec<Item>) -> Plot {
    Plot {
        title: title.to_owned(),
        x: Axis::new("time t").linear(),
        y,
        items,
        ..Plot::default()
    }
}

/// A plot in the plane, a unit as long on both axes.
pub(super) fn plane(title: &str, names: [&str; 2], items: Vec<Item>) -> Plot {
    Plot {
        title: title.to_owned(),
        x: Axis::new(names[0]).linear(),
        y: Axis::new(names[1]).linear(),
        items,
        equal: true,
    }
}

/// The ways of all agents, each in its colour.
pub(super) fn tracks(frames: &[Frame], of: Of, theme: &Theme) -> Vec<Item> {
    let agents = 0..frames.first().map_or(0, |frame| frame.positions.len());
    let track = |i| Item::line(of.track(frames, i), theme.of(i)).sized(1.2);
    agents.map(track).collect()
}

/// A component of all agents against time, each in its colour.
pub(super) fn components(frames: &[Frame], of: Of, axis: usize, theme: &Theme) -> Vec<Item> {
    let agents = 0..frames.first().map_or(0, |frame| frame.positions.len());
    let line = |i| Item::line(of.component(frames, i, axis), theme.of(i)).sized(1.2);
    agents.map(line).collect()
}

/// A marker at each agent.
pub(super) fn at_agents(states: &[Vec<f64>], marker: Marker, color: Color) -> Item {
    let points = states.iter().filter_map(|it| it.as_slice().try_into().ok());
    Item::markers(points, marker, color)
}
