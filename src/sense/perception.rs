//! What every agent perceives of the others at one moment.

use rayon::prelude::*;

use crate::math::{Matrix, Vector, direction};
use crate::parallel::{CHUNK, for_each};
use crate::sense::noise::LinkDraws;
use crate::sense::senses::{Sense, Senses};
use crate::sense::sight::{Sight, body_blocks};
use crate::sense::{Cells, History, Moment, Neighbour, Scene, in_view};

/// The neighbours that each agent of a scene perceives.
///
/// Who is perceived follows from the true geometry, with the others where they were
/// `delay` ago: distance, field of view, cone and line of sight. Then links drop out, and
/// noise corrupts what the rest tell. In an order that depends on no thread.
#[derive(Debug, Default)]
pub struct Perception<const D: usize> {
    lists: Vec<List<D>>,
    pasts: Vec<Past<D>>,
}

/// What the agents of one chunk perceive.
#[derive(Debug, Default)]
struct List<const D: usize> {
    /// Where each agent's neighbours end.
    ends: Vec<usize>,
    seen: Vec<Seen<D>>,
    sight: Sight<D>,
}

/// A neighbour as it is perceived, and where it is within range.
#[derive(Debug)]
struct Seen<const D: usize> {
    neighbour: Neighbour<D>,
    /// Square of the distance without noise.
    true_squared: f64,
}

/// The others as they were some steps ago, sorted by the cells of that moment.
#[derive(Debug, Default)]
struct Past<const D: usize> {
    delay: u64,
    cells: Cells<D>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    /// Place in the scene of each agent.
    places: Vec<u32>,
    /// In the order of the world.
    rotations: Vec<Matrix<D>>,
}

/// The others as an agent sees them, sorted by cells.
struct View<'a, const D: usize> {
    cells: &'a Cells<D>,
    velocities: &'a [Vector<D>],
    headings: &'a [Vector<D>],
    /// Place in the scene of each agent; the same place where absent.
    places: Option<&'a [u32]>,
    /// In the order of the world; none where all bodies are balls.
    rotations: &'a [Matrix<D>],
}

impl<const D: usize> Perception<D> {
    /// Perceives a scene anew, up to `range` > 0, with the past in cells of this side.
    pub fn rebuild(
        &mut self,
        senses: &Senses<D>,
        history: &History<D>,
        scene: &Scene<'_, D>,
        cells: &Cells<D>,
        [range, side]: [f64; 2],
    ) {
        let step = senses.step_at(scene.time);
        let mut delays: Vec<u64> = senses.delays().filter(|&delay| delay > 0).collect();
        delays.sort_unstable();
        delays.dedup();
        let moment = |delay: u64| history.at(step.saturating_sub(delay));
        // Nothing is written down before the start, where the past is the present.
        delays.retain(|&delay| moment(delay).is_some());
        self.pasts.resize_with(delays.len(), Past::default);
        for (past, delay) in self.pasts.iter_mut().zip(delays) {
            if let Some(moment) = moment(delay) {
                past.rebuild(delay, moment, scene.places, side);
            }
        }
        let pasts = &self.pasts;
        let perceive = |(chunk, list): (usize, &mut List<D>)| {
            list.ends.clear();
            list.seen.clear();
            let first = chunk * CHUNK;
            for i in first..scene.agents.len().min(first + CHUNK) {
                let sense = senses.of_group(scene.groups[i]);
                let view = match pasts.iter().find(|past| past.delay == sense.delay) {
                    Some(past) => past.view(),
                    None => View::present(scene, cells),
                };
                list.perceive(i, step, sense, senses, &view, scene, range);
                list.ends.push(list.seen.len());
            }
        };
        let chunks = scene.agents.len().div_ceil(CHUNK);
        self.lists.resize_with(chunks, List::default);
        let lists = self.lists.par_iter_mut().enumerate();
        for_each(scene.agents.len(), lists, perceive);
    }

    /// The neighbours that agent `i` of the scene perceives at most `range` away, or to the
    /// degree that is `held` of them there.
    pub(super) fn of(
        &self,
        i: usize,
        range: f64,
        held: impl Fn(usize) -> Option<f64>,
    ) -> impl Iterator<Item = Neighbour<D>> {
        let (list, at) = (&self.lists[i / CHUNK], i % CHUNK);
        let begin = if at == 0 { 0 } else { list.ends[at - 1] };
        list.seen[begin..list.ends[at]]
            .iter()
            .filter_map(move |seen| {
                let near = f64::from(u8::from(seen.true_squared <= range * range));
                let share = held(seen.neighbour.index).unwrap_or(near);
                let mut neighbour = seen.neighbour;
                neighbour.weight *= share;
                (share > 0.0).then_some(neighbour)
            })
    }
}

impl<const D: usize> List<D> {
    /// Adds what agent `i` perceives.
    #[allow(clippy::too_many_arguments, reason = "one call, split for length")]
    fn perceive(
        &mut self,
        i: usize,
        step: u64,
        sense: &Sense,
        senses: &Senses<D>,
        view: &View<'_, D>,
        scene: &Scene<'_, D>,
        range: f64,
    ) {
        let Self { seen, sight, .. } = self;
        let agent = |place: usize| scene.agents[place] as usize;
        let (from, heading) = (&scene.positions[i], &scene.headings[i]);
        let reach = range.min(senses.reaches[agent(i)]);
        sight.clear();
        if sense.blocked_by.obstacles {
            sight.note_obstacles(scene.surroundings, from, reach);
        }
        if sense.blocked_by.bodies {
            sight.note_bodies(view.cells, from, reach + senses.largest_body, |place| {
                let place = view.place(place);
                (place != i).then(|| senses.bodies[agent(place)])
            });
        }
        // What is held at the range itself is left to those who ask.
        let own = reach < range;
        let mut perceive = |place: usize, offset: Vector<D>, squared: f64, share: f64| {
            let index = view.place(place);
            if index == i {
                return;
            }
            let seen_at = |angle| in_view(heading, &offset, angle);
            if !sense.field_of_view.is_none_or(seen_at) {
                return;
            }
            let weight = match &sense.cone {
                None => Some(1.0),
                Some(cone) => cone.weight(heading, &view.headings[place]),
            };
            let Some(weight) = weight else {
                return;
            };
            let draws = LinkDraws::new(senses.seed, step, agent(i), agent(index));
            if sense.dropout > 0.0 && draws.is_lost(sense.dropout) {
                return;
            }
            let meets = |other: usize, at: &Vector<D>, radius: f64| {
                let body = view.place(other);
                let solid = &senses.solids[scene.groups[body] as usize];
                let rotation = || view.rotations[agent(body)];
                body_blocks(solid, radius, rotation, from, at, &offset)
            };
            if sight.is_blocked(scene.obstacles, from, place, &offset, meets) {
                return;
            }
            let mut neighbour = Neighbour {
                index,
                offset,
                squared,
                velocity: view.velocities[place],
                heading: view.headings[place],
                weight: if own { weight * share } else { weight },
            };
            neighbour.corrupt(sense, draws);
            seen.push(Seen {
                neighbour,
                true_squared: squared,
            });
        };
        view.cells
            .for_each_within(from, reach, |place, offset, squared| {
                if scene.held(i, view.place(place), reach).is_none() {
                    perceive(place, offset, squared, 1.0);
                }
            });
        // Where agents are held nobody sees late: places are those of the scene.
        for (place, share) in scene.held_near(i, reach) {
            let offset = scene.positions[place] - from;
            perceive(place, offset, offset.norm_squared(), share);
        }
    }
}

impl<const D: usize> Neighbour<D> {
    /// Adds the errors of perception.
    fn corrupt(&mut self, sense: &Sense, draws: LinkDraws) {
        if sense.noise.position > 0.0 {
            self.offset += draws.offset_error::<D>(sense.noise.position);
            self.squared = self.offset.norm_squared();
        }
        if sense.noise.velocity > 0.0 {
            self.velocity += draws.velocity_error::<D>(sense.noise.velocity);
            let along = direction(&self.velocity);
            if along.norm_squared() > 0.0 {
                self.heading = along;
            }
        }
    }
}

impl<const D: usize> Past<D> {
    fn rebuild(&mut self, delay: u64, moment: &Moment<D>, places: &[u32], side: f64) {
        self.delay = delay;
        self.cells.rebuild(&moment.positions, side);
        let order = || self.cells.order().iter().map(|&agent| agent as usize);
        self.places.clear();
        self.places.extend(order().map(|agent| places[agent]));
        self.velocities.clear();
        self.velocities
            .extend(order().map(|agent| moment.velocities[agent]));
        self.headings.clear();
        self.headings
            .extend(order().map(|agent| moment.headings[agent]));
        self.rotations.clone_from(&moment.rotations);
    }

    fn view(&self) -> View<'_, D> {
        View {
            cells: &self.cells,
            velocities: &self.velocities,
            headings: &self.headings,
            places: Some(&self.places),
            rotations: &self.rotations,
        }
    }
}

impl<'a, const D: usize> View<'a, D> {
    /// The others as they are now.
    fn present(scene: &Scene<'a, D>, cells: &'a Cells<D>) -> Self {
        Self {
            cells,
            velocities: scene.velocities,
            headings: scene.headings,
            places: None,
            rotations: scene.rotations,
        }
    }

    /// The place in the scene of an agent of the view.
    fn place(&self, place: usize) -> usize {
        self.places.map_or(place, |places| places[place] as usize)
    }
}
