//! A flock: the sum of its laws.

use std::borrow::Borrow;

use rayon::prelude::*;

use crate::law::{Law, Pulls, build};
use crate::math::{Matrix, Vector, mean};
use crate::sense::{CHUNK, Cells, History, PARALLEL_FROM, Perception, Scene, Senses};
use crate::shape::Obstacle;
use crate::world::World;

/// The sum of some laws, and what the agents perceive for them.
pub struct Flock<const D: usize> {
    laws: Vec<Box<dyn Law<D>>>,
    /// Absent where all agents perceive without limits or errors.
    senses: Option<Senses<D>>,
    history: History<D>,
    stage: Stage<D>,
    /// Scratch: accelerations in the order of the cells.
    accelerations: Vec<Vector<D>>,
}

/// The state in the order of the cells, kept from step to step to save allocations.
#[derive(Default)]
struct Stage<const D: usize> {
    cells: Cells<D>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    groups: Vec<u32>,
    perception: Perception<D>,
}

/// A state of the agents and what stands around them: the input of a flock.
#[derive(Debug, Clone, Copy)]
pub struct State<'a, const D: usize> {
    /// Time since the start.
    pub time: f64,
    /// Position of each agent, finite.
    pub positions: &'a [Vector<D>],
    /// Velocity of each agent, finite.
    pub velocities: &'a [Vector<D>],
    /// Heading of each agent, a unit vector.
    pub headings: &'a [Vector<D>],
    /// Group of each agent.
    pub groups: &'a [usize],
    /// Mass of each agent.
    pub masses: &'a [f64],
    /// Rotation of each body; none where all are balls.
    pub rotations: &'a [Matrix<D>],
    /// The obstacles.
    pub obstacles: &'a [Obstacle<D>],
}

impl<const D: usize> Flock<D> {
    /// A flock that obeys some laws, whose agents perceive without limits or errors.
    pub fn new(laws: Vec<Box<dyn Law<D>>>) -> Self {
        Self {
            laws,
            senses: None,
            history: History::default(),
            stage: Stage::default(),
            accelerations: Vec::new(),
        }
    }

    /// The flock of a world: its laws, some more besides, and the senses of its agents.
    pub fn of_world(world: &World<D>, more: Vec<Box<dyn Law<D>>>) -> Self {
        let mut laws = build(world);
        laws.extend(more);
        Self::with_senses(world, laws)
    }

    /// A flock that obeys some laws, whose agents perceive as those of a world do.
    pub fn with_senses(world: &World<D>, laws: Vec<Box<dyn Law<D>>>) -> Self {
        let senses = Senses::new(world);
        let longest = senses.iter().flat_map(Senses::delays).max();
        Self {
            senses,
            history: History::new(longest.unwrap_or(0)),
            ..Self::new(laws)
        }
    }

    /// The laws, in their order.
    pub fn laws(&self) -> &[Box<dyn Law<D>>] {
        &self.laws
    }

    /// The distances at which some law jumps, increasing: see [`Law::jump`]. Radii of what agents
    /// see are among them, for laws that look for neighbours end there at once.
    pub fn jumps(&self) -> Vec<f64> {
        let looks = self.laws.iter().any(|law| law.range() > 0.0);
        let reaches = self
            .senses
            .iter()
            .filter(|_| looks)
            .flat_map(Senses::reaches);
        let reaches = reaches.copied().filter(|reach| reach.is_finite());
        let laws = self.laws.iter().filter_map(|law| law.jump());
        let mut jumps: Vec<f64> = laws.chain(reaches).filter(|jump| *jump > 0.0).collect();
        jumps.sort_unstable_by(f64::total_cmp);
        jumps.dedup();
        jumps
    }

    /// The past that agents with a delay see: what, besides the state, decides how the
    /// flock goes on.
    pub fn history(&self) -> &History<D> {
        &self.history
    }

    /// The same, to be restored.
    pub fn history_mut(&mut self) -> &mut History<D> {
        &mut self.history
    }

    /// Writes the acceleration of each agent into `out`, and the state into the history.
    ///
    /// Each agent's sum is taken in a fixed order, so the result does not depend on
    /// the number of threads.
    pub fn accelerations(&mut self, state: &State<'_, D>, out: &mut [Vector<D>]) {
        self.remember(state);
        self.add_up(|_, _| true, state, out);
    }

    /// As [`Flock::accelerations`], without the laws that relax: their pulls are
    /// integrated apart, see [`Flock::pulls`].
    pub fn forces(&mut self, state: &State<'_, D>, out: &mut [Vector<D>]) {
        self.remember(state);
        let stiff = self.is_stiff();
        self.add_up(|_, law| !relaxes(law, stiff), state, out);
    }

    /// Whether some law relaxes.
    pub fn relaxes(&self) -> bool {
        let stiff = self.is_stiff();
        self.laws.iter().any(|law| relaxes(&**law, stiff))
    }

    /// Writes the pulls of the laws that relax into `pulls`. Nothing is written into the
    /// history.
    pub fn pulls(&mut self, state: &State<'_, D>, pulls: &mut Pulls<D>) {
        let stiff = self.is_stiff();
        self.pulls_of(|_, law| relaxes(law, stiff), state, pulls);
    }

    /// Whether the laws together are too stiff to be held over a step.
    fn is_stiff(&self) -> bool {
        self.laws.iter().map(|law| law.stiffness()).sum::<f64>() >= STIFF
    }

    /// The pulls of law number `law`; nothing where it has none. Nothing is written into
    /// the history.
    pub fn pulls_of_law(&mut self, law: usize, state: &State<'_, D>) -> Pulls<D> {
        let mut pulls = Pulls::default();
        self.pulls_of(|index, _| index == law, state, &mut pulls);
        pulls
    }

    /// Writes the state into the history, for agents that see late.
    fn remember(&mut self, state: &State<'_, D>) {
        if let Some(senses) = &self.senses {
            self.history.record(
                senses.step_at(state.time),
                state.positions,
                state.velocities,
                state.headings,
                state.rotations,
            );
        }
    }

    /// The acceleration that each law alone gives each agent, by name of the law. Nothing
    /// is written into the history.
    pub fn by_law(&mut self, state: &State<'_, D>) -> Vec<(String, Vec<Vector<D>>)> {
        let mut by_law = Vec::new();
        for law in 0..self.laws.len() {
            let mut out = vec![Vector::zeros(); state.positions.len()];
            self.add_up(|index, _| index == law, state, &mut out);
            by_law.push((self.laws[law].name().to_owned(), out));
        }
        by_law
    }

    /// The links: who perceives whom within the largest range of the laws, as pairs of
    /// agents, the one that perceives first; sorted.
    pub fn links(&mut self, state: &State<'_, D>) -> Vec<[usize; 2]> {
        let [range, _] = range_and_side(&self.laws);
        let senses = self.senses.as_ref();
        let scene = self.stage.scene(state, &self.laws, senses, &self.history);
        let mut links = Vec::new();
        if range > 0.0 {
            for (i, &agent) in scene.agents.iter().enumerate() {
                scene.neighbours(i, range, |neighbour| {
                    links.push([agent as usize, scene.agents[neighbour.index] as usize]);
                });
            }
        }
        links.sort_unstable();
        links
    }

    /// The lines of sight in which something weakens or blocks an influence, for some law, as
    /// pairs of agents, the one that looks first; sorted.
    pub fn blocked(&mut self, state: &State<'_, D>) -> Vec<[usize; 2]> {
        let senses = self.senses.as_ref();
        let scene = self.stage.scene(state, &self.laws, senses, &self.history);
        let mut blocked = Vec::new();
        for law in &mut self.laws {
            law.prepare(&scene);
            for (i, &agent) in scene.agents.iter().enumerate() {
                law.blocked(&scene, i, &mut |other| {
                    blocked.push([agent as usize, scene.agents[other] as usize]);
                });
            }
        }
        blocked.sort_unstable();
        blocked.dedup();
        blocked
    }

    /// The pulls of some of the laws, agent by agent in the order of the cells.
    fn pulls_of(
        &mut self,
        chosen: impl Fn(usize, &dyn Law<D>) -> bool,
        state: &State<'_, D>,
        pulls: &mut Pulls<D>,
    ) {
        let mut laws = choose(&mut self.laws, chosen);
        let senses = self.senses.as_ref();
        let scene = self.stage.scene(state, &laws, senses, &self.history);
        pulls.clear();
        for law in &mut laws {
            law.prepare(&scene);
            pulls.add(&***law, &scene);
        }
    }

    /// Sums some of the laws over all agents.
    fn add_up(
        &mut self,
        chosen: impl Fn(usize, &dyn Law<D>) -> bool,
        state: &State<'_, D>,
        out: &mut [Vector<D>],
    ) {
        let mut laws = choose(&mut self.laws, chosen);
        let senses = self.senses.as_ref();
        let scene = self.stage.scene(state, &laws, senses, &self.history);
        for law in &mut laws {
            law.prepare(&scene);
            law.gather(&scene);
        }
        let laws = &laws;
        self.accelerations.clear();
        self.accelerations.resize(out.len(), Vector::zeros());
        let add = |(chunk, out): (usize, &mut [Vector<D>])| {
            for law in laws {
                law.accelerate(&scene, chunk * CHUNK, out);
            }
        };
        if out.len() < PARALLEL_FROM {
            let chunks = self.accelerations.chunks_mut(CHUNK);
            chunks.enumerate().for_each(add);
        } else {
            let chunks = self.accelerations.par_chunks_mut(CHUNK);
            chunks.enumerate().for_each(add);
        }
        for (&agent, acceleration) in scene.agents.iter().zip(&self.accelerations) {
            out[agent as usize] = *acceleration;
        }
    }
}

/// Rate × step from which on pulls are integrated apart.
const STIFF: f64 = 0.25;

/// Whether a law relaxes, among laws that are stiff together or are not.
fn relaxes<const D: usize>(law: &dyn Law<D>, stiff: bool) -> bool {
    law.relaxes() || (stiff && law.stiffness() > 0.0)
}

/// Some of the laws.
fn choose<const D: usize>(
    laws: &mut [Box<dyn Law<D>>],
    chosen: impl Fn(usize, &dyn Law<D>) -> bool,
) -> Vec<&mut Box<dyn Law<D>>> {
    let laws = laws.iter_mut().enumerate();
    laws.filter(|(index, law)| chosen(*index, &***law))
        .map(|(_, law)| law)
        .collect()
}

/// The largest distance at which some laws look for neighbours, and the side of cells that
/// suits them: their largest finite range, for a search of all pairs looks into every cell.
fn range_and_side<const D: usize>(laws: &[impl Borrow<Box<dyn Law<D>>>]) -> [f64; 2] {
    let ranges = || laws.iter().map(|law| law.borrow().range());
    let finite = ranges()
        .filter(|range| range.is_finite())
        .fold(0.0, f64::max);
    // Without neighbours to look for, one cell will do.
    let side = if finite > 0.0 { finite } else { f64::MAX };
    [ranges().fold(0.0, f64::max), side]
}

impl<const D: usize> Stage<D> {
    /// The scene that some laws see.
    fn scene<'a>(
        &'a mut self,
        state: &State<'a, D>,
        laws: &[impl Borrow<Box<dyn Law<D>>>],
        senses: Option<&Senses<D>>,
        history: &History<D>,
    ) -> Scene<'a, D> {
        let [range, side] = range_and_side(laws);
        let Self {
            cells,
            velocities,
            headings,
            groups,
            perception,
        } = self;
        cells.rebuild(state.positions, side);
        let order = || cells.order().iter().map(|&agent| agent as usize);
        velocities.clear();
        velocities.extend(order().map(|agent| state.velocities[agent]));
        headings.clear();
        headings.extend(order().map(|agent| state.headings[agent]));
        groups.clear();
        groups.extend(order().map(|agent| state.groups[agent] as u32));
        let mut scene = Scene {
            time: state.time,
            agents: cells.order(),
            positions: cells.sorted(),
            velocities,
            headings,
            groups,
            masses: state.masses,
            rotations: state.rotations,
            cells,
            obstacles: state.obstacles,
            mean_position: mean(state.positions),
            mean_velocity: mean(state.velocities),
            perception: None,
            visible: None,
        };
        if let Some(senses) = senses
            && range > 0.0
        {
            perception.rebuild(senses, history, &scene, [range, side]);
            scene.perception = Some(perception);
        }
        scene
    }
}
