//! A flock: the sum of its laws.

use rayon::prelude::*;

use crate::law::stage::{Stage, ranges};
use crate::law::watches::Watches;
use crate::law::{Law, Pulls, build};
use crate::math::{Matrix, Vector};
use crate::parallel::{CHUNK, for_each, gather};
use crate::sense::{History, Hold, Senses};
use crate::shape::Obstacle;
use crate::world::World;

/// The sum of some laws, and what the agents perceive for them.
pub struct Flock<const D: usize> {
    laws: Vec<Box<dyn Law<D>>>,
    /// Absent where all agents perceive without limits or errors.
    senses: Option<Senses<D>>,
    history: History<D>,
    stage: Stage<D>,
    /// Scratch: accelerations in the order of the scene.
    accelerations: Vec<Vector<D>>,
    watches: Watches,
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
            watches: Watches::new(laws.len()),
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

    /// Measures from now on where the time goes, or does so no longer.
    pub fn measure(&mut self, on: bool) {
        self.watches.run(on);
    }

    /// The seconds that went, while they were measured, to finding out who perceives whom, and to
    /// each law, by name.
    pub fn profile(&self) -> Vec<(String, f64)> {
        let names = self.laws.iter().map(|law| format!("law {}", law.name()));
        let laws = names.zip(self.watches.of_laws());
        let senses = ("senses".to_owned(), self.watches.senses.seconds());
        [senses].into_iter().chain(laws).collect()
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
        self.accelerations_held(state, &[], out);
    }

    /// As [`Flock::accelerations`], with some pairs held as near or far, whatever their
    /// distances are.
    pub fn accelerations_held(
        &mut self,
        state: &State<'_, D>,
        holds: &[Hold],
        out: &mut [Vector<D>],
    ) {
        self.remember(state);
        self.add_up_held(|_, _| true, state, holds, out);
    }

    /// As [`Flock::accelerations`], without the laws that relax: their pulls are
    /// integrated apart, see [`Flock::pulls`]. Where laws pull softly, the others go by the
    /// velocities `before`, if there are any.
    pub fn forces(
        &mut self,
        state: &State<'_, D>,
        before: Option<&[Vector<D>]>,
        out: &mut [Vector<D>],
    ) {
        self.remember(state);
        let stiff = self.is_stiff();
        let soft = |law: &dyn Law<D>| law.stiffness() > 0.0;
        match before.filter(|_| self.pulls_softly()) {
            Some(before) if !self.laws.iter().all(|law| soft(&**law)) => {
                let other = State {
                    velocities: before,
                    ..*state
                };
                self.add_up(|_, law| !soft(law) && !relaxes(law, stiff), &other, out);
                let mut pulled = vec![Vector::zeros(); out.len()];
                self.add_up(|_, law| soft(law), state, &mut pulled);
                out.iter_mut().zip(pulled).for_each(|(out, it)| *out += it);
            }
            _ => self.add_up(|_, law| !relaxes(law, stiff), state, out),
        }
    }

    /// Whether some law that might relax does not: at a small part of its rate per step it is held
    /// over the step, and needs velocities of third order to be no less exact than if it did.
    pub fn pulls_softly(&self) -> bool {
        !self.is_stiff() && self.laws.iter().any(|law| law.stiffness() > 0.0)
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
        let ranges @ [range, _] = ranges(choose(&self.laws, &|_, _| true));
        let senses = self.senses.as_ref();
        let scene = self.stage.scene(state, ranges, senses, &self.history, &[]);
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
        let ranges = ranges(choose(&self.laws, &|_, _| true));
        let senses = self.senses.as_ref();
        let scene = self.stage.scene(state, ranges, senses, &self.history, &[]);
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

    /// The pulls of some of the laws.
    fn pulls_of(
        &mut self,
        chosen: impl Fn(usize, &dyn Law<D>) -> bool,
        state: &State<'_, D>,
        pulls: &mut Pulls<D>,
    ) {
        let ranges = ranges(choose(&self.laws, &chosen));
        let senses = self.senses.as_ref();
        let watches = &self.watches;
        let begin = watches.senses.begin();
        let scene = self.stage.scene(state, ranges, senses, &self.history, &[]);
        watches.senses.end(begin);
        pulls.clear();
        for (index, law) in self.laws.iter_mut().enumerate() {
            if chosen(index, &**law) {
                watches.laws[index][0].time(|| {
                    law.prepare(&scene);
                    pulls.add(&**law, &scene);
                });
            }
        }
    }

    /// Sums some of the laws over all agents.
    fn add_up(
        &mut self,
        chosen: impl Fn(usize, &dyn Law<D>) -> bool + Sync,
        state: &State<'_, D>,
        out: &mut [Vector<D>],
    ) {
        self.add_up_held(chosen, state, &[], out);
    }

    fn add_up_held(
        &mut self,
        chosen: impl Fn(usize, &dyn Law<D>) -> bool + Sync,
        state: &State<'_, D>,
        holds: &[Hold],
        out: &mut [Vector<D>],
    ) {
        let ranges = ranges(choose(&self.laws, &chosen));
        let senses = self.senses.as_ref();
        let watches = &self.watches;
        let begin = watches.senses.begin();
        let scene = self
            .stage
            .scene(state, ranges, senses, &self.history, holds);
        watches.senses.end(begin);
        for (index, law) in self.laws.iter_mut().enumerate() {
            if chosen(index, &**law) {
                watches.laws[index][0].time(|| {
                    law.prepare(&scene);
                    law.gather(&scene);
                });
            }
        }
        let laws = &self.laws;
        self.accelerations.clear();
        self.accelerations.resize(out.len(), Vector::zeros());
        let add = |(chunk, out): (usize, &mut [Vector<D>])| {
            for (index, law) in choose(laws, &chosen) {
                let accelerate = || law.accelerate(&scene, chunk * CHUNK, out);
                watches.laws[index][1].time(accelerate);
            }
        };
        let begin = watches.passes.begin();
        let chunks = self.accelerations.par_chunks_mut(CHUNK).enumerate();
        for_each(out.len(), chunks, add);
        watches.passes.end(begin);
        gather(scene.places, &self.accelerations, out);
    }
}

/// Rate × step from which on pulls are integrated apart.
const STIFF: f64 = 0.25;

/// Whether a law relaxes, among laws that are stiff together or are not.
fn relaxes<const D: usize>(law: &dyn Law<D>, stiff: bool) -> bool {
    law.relaxes() || (stiff && law.stiffness() > 0.0)
}

/// Some of the laws, with their numbers.
fn choose<'a, const D: usize>(
    laws: &'a [Box<dyn Law<D>>],
    chosen: &'a impl Fn(usize, &dyn Law<D>) -> bool,
) -> impl Iterator<Item = (usize, &'a dyn Law<D>)> + Clone {
    let laws = laws.iter().map(|law| &**law).enumerate();
    laws.filter(|(index, law)| chosen(*index, *law))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::AlphaInteraction;
    use proptest::prelude::*;

    fn flock() -> Flock<2> {
        let spec = r#"{ "spacing": 2, "range": 2.5, "damping": 0.7 }"#;
        let spec = serde_json::from_str(spec).expect("the law is well formed");
        Flock::new(vec![Box::new(AlphaInteraction::new(&spec))])
    }

    fn accelerations(flock: &mut Flock<2>, x: &[Vector<2>], v: &[Vector<2>]) -> Vec<Vector<2>> {
        let mut out = vec![Vector::zeros(); x.len()];
        let state = State {
            time: 0.0,
            positions: x,
            velocities: v,
            headings: v,
            groups: &vec![0; x.len()],
            masses: &vec![1.0; x.len()],
            rotations: &[],
            obstacles: &[],
        };
        flock.accelerations(&state, &mut out);
        out
    }

    proptest! {
        /// Or a run that is resumed would not go on as it would have.
        #[test]
        fn what_a_flock_does_depends_on_its_state_alone(
            start in prop::collection::vec(prop::array::uniform2(-6.0..6.0f64), 2..80),
            pushes in prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 1..9),
            speed in 0.0..0.2f64,
            // At the least all are so near each other that no lists are kept.
            size in 0.1..1.0f64,
        ) {
            let mut x: Vec<_> = start.into_iter().map(|x| Vector::<2>::from(x) * size).collect();
            let mut old = flock();
            for step in 0..20 {
                let push = |k: usize| Vector::from(pushes[(k + step) % pushes.len()]);
                let v: Vec<Vector<2>> = (0..x.len()).map(push).collect();
                let fresh = accelerations(&mut flock(), &x, &v);
                prop_assert_eq!(accelerations(&mut old, &x, &v), fresh);
                x.iter_mut().zip(&v).for_each(|(x, v)| *x += v * speed);
            }
        }
    }
}
