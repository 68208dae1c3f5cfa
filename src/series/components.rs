//! The components of agents' states over time.

use super::targets::{Aim, Goals, world_of};
use super::{Course, Motion, Probe, Run, apart};
use crate::picture::Theme;
use crate::plot::{Axis, Item, Plot};

/// How many agents are told apart by name: as many as there are colours.
const NAMED: usize = 7;

/// A line in the colour of a place, told apart from those of the same colour by its dashes: solid
/// at the first seven places, dashed at the next, dotted at those after.
pub(super) fn at_place(line: Item, place: usize, theme: &Theme) -> Item {
    let line = Item {
        color: theme.of(place),
        ..line
    };
    match place / NAMED % 3 {
        0 => line,
        1 => line.dashed(),
        _ => line.dotted(),
    }
}

/// How many points a target's course is drawn by, at least and at most; in between one for each
/// frame.
const SAMPLES: [usize; 2] = [2000, 20_000];

/// What to probe for [`components`] of these agents.
pub fn component_probes(dimension: usize, motion: Motion, agents: &[usize]) -> Vec<Probe> {
    let axes = 0..dimension;
    let of_axis = |axis| {
        let agents = agents.iter();
        agents.map(move |&agent| Probe::Component {
            agent,
            motion,
            axis,
        })
    };
    axes.flat_map(of_axis).collect()
}

/// A plot of each component over time, as Djokam & Rathinam's Figures 4 to 6, targets in dashes.
/// Each run has courses of the probes of [`component_probes`] for its own `agents`; all have the
/// same dimension.
pub fn components(runs: &[Run], motion: Motion, agents: &[Vec<usize>], theme: &Theme) -> Vec<Plot> {
    let dimension = runs.first().map_or(0, |run| run.header.world.dimension);
    let ends = runs.iter().map(|run| run.times);
    let range = ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    let paint = Paint::of(runs, agents, theme);
    let panel = |axis: usize| {
        let mut items: Vec<Item> = Vec::new();
        for (n, (run, agents)) in runs.iter().zip(agents).enumerate() {
            let own = &run.courses[axis * agents.len()..][..agents.len()];
            let lines = agents.iter().zip(own);
            items.extend(lines.map(|(&agent, course)| paint.line(n, agent, course)));
        }
        for (run, agents) in runs.iter().zip(agents) {
            for course in targets(run, agents, |time, aim| [time, aim.of(motion)[axis]]) {
                let target = target(course, theme);
                // Runs of one world have the same.
                if !items.contains(&target) {
                    items.push(target);
                }
            }
        }
        Plot {
            x: Axis {
                range,
                ..Axis::new("time").linear()
            },
            y: Axis::new(motion.name(axis)).linear(),
            items,
            ..Plot::default()
        }
    };
    (0..dimension).map(panel).collect()
}

/// The courses of the targets that a run's laws give these agents, as points of time and target.
pub(super) fn targets(
    run: &Run,
    agents: &[usize],
    point: impl Fn(f64, &Aim) -> [f64; 2],
) -> Vec<Vec<[f64; 2]>> {
    let world = world_of(&run.header);
    let goals = Goals::of(world.as_ref());
    let [first, last] = run.times;
    let samples = ((last - first) / run.header.world.record.every) as usize;
    let samples = samples.clamp(SAMPLES[0], SAMPLES[1]);
    let courses = goals.courses(agents).into_iter();
    let points = courses.map(|target| {
        let times = (0..=samples).map(|k| first + (last - first) * k as f64 / samples as f64);
        let points = times.filter_map(|time| Some(point(time, &target(time)?)));
        points.collect()
    });
    points.collect()
}

/// The line of a target.
pub(super) fn target(course: Vec<[f64; 2]>, theme: &Theme) -> Item {
    let line = Item::line(course, theme.ink).dashed();
    line.sized(1.2).named("target")
}

/// How the lines of agents are painted.
pub(super) struct Paint<'a> {
    runs: &'a [Run],
    names: Vec<Option<String>>,
    agents: &'a [Vec<usize>],
    theme: &'a Theme,
}

impl<'a> Paint<'a> {
    pub(super) fn of(runs: &'a [Run], agents: &'a [Vec<usize>], theme: &'a Theme) -> Self {
        Self {
            runs,
            names: apart(runs),
            agents,
            theme,
        }
    }

    /// The line of an agent of a run. Several runs have a colour each; in a single one few agents
    /// have one each, and a name, many the colour of their group, or in turn where there is one
    /// group.
    pub(super) fn line(&self, run: usize, agent: usize, course: &Course) -> Item {
        let agents = &self.agents[run];
        let groups = &self.runs[run].header.bodies.group;
        let few = agents.len() <= NAMED;
        let several = self.runs.len() > 1;
        let color = match groups.get(agent) {
            _ if several => run,
            _ if few => agents.iter().position(|it| *it == agent).unwrap_or(0),
            Some(&group) if groups.last() > Some(&0) => group,
            _ => agent,
        };
        let line = Item::parted(course.points().iter().copied(), self.theme.of(color));
        let line = line.sized(if few { 1.5 } else { 1.0 });
        let line = match several {
            true => at_place(line, run, self.theme),
            false => line,
        };
        match &self.names[run] {
            Some(name) => line.named(name),
            None if few && agents.len() > 1 => line.named(format!("agent {agent}")),
            None => line,
        }
    }
}
