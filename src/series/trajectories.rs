//! Where agents go, and how they move, from above.

use super::components::{Paint, target, targets};
use super::laps::{along, once};
use super::{Motion, Probe, Run};
use crate::picture::Theme;
use crate::plot::{Axis, Item, Marker, Plot};

/// The pairs of components that show a space of so many dimensions.
fn views(dimension: usize) -> &'static [[usize; 2]] {
    match dimension {
        2 => &[[0, 1]],
        _ => &[[0, 1], [0, 2], [1, 2]],
    }
}

/// What to probe for [`trajectories`] of these agents.
pub fn trajectory_probes(dimension: usize, agents: &[usize]) -> Vec<Probe> {
    let mut probes = Vec::new();
    for motion in [Motion::Positions, Motion::Velocities] {
        for &axes in views(dimension) {
            probes.extend(agents.iter().map(|&agent| Probe::Place {
                agent,
                motion,
                axes,
            }));
        }
    }
    probes
}

/// Plots of position space and velocity space, as Djokam & Rathinam's Figure 3: agents' courses
/// from circles to stars, targets in dashes. In space there are three views of each, xy, xz and
/// yz. Each run has courses of the probes of [`trajectory_probes`] for its own `agents`; all have
/// the same dimension.
pub fn trajectories(runs: &[Run], agents: &[Vec<usize>], theme: &Theme) -> Vec<Plot> {
    let Some(dimension) = runs.first().map(|run| run.header.world.dimension) else {
        return Vec::new();
    };
    let views = views(dimension);
    let motions = [Motion::Positions, Motion::Velocities];
    let panels = motions
        .iter()
        .flat_map(|motion| views.iter().map(move |it| (*motion, *it)));
    let panel = |(place, (motion, axes)): (usize, (Motion, [usize; 2]))| {
        let mut plot = Plot {
            title: motion.plural().to_owned(),
            x: Axis::new(motion.name(axes[0])),
            y: Axis::new(motion.name(axes[1])),
            equal: true,
            ..Plot::default()
        };
        let mut ends = Vec::new();
        let mut starts = Vec::new();
        let paint = Paint::of(runs, agents, theme);
        for (n, (run, agents)) in runs.iter().zip(agents).enumerate() {
            let own = &run.courses[place * agents.len()..][..agents.len()];
            for (&agent, course) in agents.iter().zip(own) {
                plot.items.push(paint.line(n, agent, course));
                starts.extend(course.known().next());
                ends.extend(course.known().next_back());
            }
        }
        let mut courses: Vec<Vec<[f64; 2]>> = Vec::new();
        for (run, agents) in runs.iter().zip(agents) {
            for course in targets(run, agents, |_, aim| axes.map(|axis| aim.of(motion)[axis])) {
                let course = once(course);
                if !courses.iter().any(|other| along(&course, other)) {
                    courses.push(course);
                }
            }
        }
        plot.items
            .extend(courses.into_iter().map(|it| target(it, theme)));
        let small = starts.len() > 30;
        let start = Item::markers(starts, Marker::Ring, theme.of(3)).named("start");
        let end = Item::markers(ends, Marker::Star, theme.ink).named("end");
        let size = if small { 3.0 } else { 5.0 };
        plot.items.extend([start.sized(size), end.sized(size)]);
        plot
    };
    panels.enumerate().map(panel).collect()
}
