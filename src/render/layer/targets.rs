//! What agents are to follow or to come to: targets and destinations.

use crate::law::Targets;
use crate::math::Vector;
use crate::picture::{Color, Mark, Path, Stroke};
use crate::render::Scene;
use crate::render::frame::State;
use crate::render::view::{Canvas, stroked};
use crate::world::spec::{LawSpec, ScopeSpec};
use crate::world::{World, vector};

/// Points of the way of a target that are joined by lines.
const POINTS: usize = 240;

/// What the laws of a world lead to.
#[derive(Debug)]
pub(in crate::render) struct Aims<const D: usize> {
    /// Of each law: the targets, and which agents follow them; of shared ones the first.
    laws: Vec<(Targets<D>, Vec<usize>)>,
    /// Points to come to rest at.
    pub(in crate::render) destinations: Vec<Vector<D>>,
    /// The ways of the targets over the run.
    pub(in crate::render) ways: Vec<Vec<Vector<D>>>,
}

impl<const D: usize> Aims<D> {
    /// Those of a world, between two times.
    pub(in crate::render) fn new(world: &World<D>, [first, last]: [f64; 2]) -> Self {
        let mut laws = Vec::new();
        let mut destinations = Vec::new();
        for (scope, law) in world.laws() {
            match law {
                LawSpec::Tracking(spec) => {
                    let targets = Targets::of_tracking(spec, scope, world);
                    let agents = followers(&targets, scope, world);
                    laws.push((targets, agents));
                }
                LawSpec::Flatness(spec) => {
                    let targets = Targets::of_agents(&spec.trajectories, scope, world);
                    let agents = followers(&targets, scope, world);
                    laws.push((targets, agents));
                }
                LawSpec::Navigation(spec) => {
                    destinations.extend(spec.destination.iter().map(|it| vector(it)));
                }
                _ => {}
            }
        }
        let mut aims = Self {
            laws,
            destinations,
            ways: Vec::new(),
        };
        let time = |k: usize| first + (last - first) * k as f64 / POINTS as f64;
        let moments: Vec<_> = (0..=POINTS).map(|k| aims.now(time(k))).collect();
        let count = moments[0].len();
        aims.ways = (0..count)
            .map(|target| moments.iter().map(|places| places[target]).collect())
            .collect();
        aims
    }

    /// Where the targets are at a time.
    pub(in crate::render) fn now(&self, time: f64) -> Vec<Vector<D>> {
        let of_law = |(targets, agents): &(Targets<D>, Vec<usize>)| {
            let moments = targets.at(time);
            let places = agents.iter().filter_map(|&agent| moments.get(agent));
            places.map(|moment| moment.position).collect::<Vec<_>>()
        };
        self.laws.iter().flat_map(of_law).collect()
    }

    /// Whether there is nothing to come to.
    pub(in crate::render) fn is_empty(&self) -> bool {
        self.laws.is_empty() && self.destinations.is_empty()
    }
}

/// The entries of some targets that agents follow.
fn followers<const D: usize>(
    targets: &Targets<D>,
    scope: Option<&ScopeSpec>,
    world: &World<D>,
) -> Vec<usize> {
    match targets {
        Targets::Shared(_) => vec![0],
        Targets::Each(_) => {
            let acted_on = world.acted_on(scope).into_iter().enumerate();
            acted_on
                .filter(|(_, acts)| *acts)
                .map(|(agent, _)| agent)
                .collect()
        }
    }
}

/// Draws the ways of targets over the run.
pub(in crate::render) fn ways<const D: usize>(scene: &Scene<'_, D>, canvas: &mut Canvas<'_, D>) {
    // Pale, and not transparent: ways that lie over each other are no darker.
    let theme = &scene.look.theme;
    let stroke = Stroke::new(theme.page.mix(theme.faint, 0.5), 1.0);
    for way in &scene.aims.ways {
        let lines: Vec<_> = way.windows(2).map(|ends| [ends[0], ends[1]]).collect();
        canvas.lines(&lines, &stroke);
    }
}

/// Draws where targets are now, and the destinations.
pub(in crate::render) fn now<const D: usize>(
    scene: &Scene<'_, D>,
    state: &State<'_, D>,
    canvas: &mut Canvas<'_, D>,
) {
    let color = state.tint.unwrap_or(scene.look.theme.ink);
    let targets = scene.aims.now(state.frame.time);
    let size = match targets.len() > 1 {
        true => 3.0,
        false => 6.0,
    };
    for target in &targets {
        // Bodies that are on their targets must not hide them.
        canvas.mark_at(target, f64::INFINITY, |sight| {
            Some(star(sight.at, size, color))
        });
    }
    for destination in &scene.aims.destinations {
        canvas.mark_at(destination, f64::INFINITY, |sight| {
            Some(star(sight.at, 6.0, color))
        });
    }
}

/// A target: a plus in a diamond.
pub(in crate::render) fn star([x, y]: [f64; 2], size: f64, color: Color) -> Mark {
    let mut path = Path::polygon([[x - size, y], [x, y - size], [x + size, y], [x, y + size]]);
    let arm = 0.5 * size;
    for way in [[arm, 0.0], [0.0, arm]] {
        path.begin([x - way[0], y - way[1]]);
        path.line([x + way[0], y + way[1]]);
    }
    stroked(path, Stroke::new(color, 1.3))
}
