//! From a state to the scene that laws see.

use crate::law::{Law, State};
use crate::math::{Vector, mean};
use crate::parallel::gather;
use crate::sense::{
    Cells, History, Hold, Perception, Scene, Search, Senses, Surroundings, Vicinity,
};

/// The state in the order of the scene, kept from step to step to save allocations.
#[derive(Default)]
pub(super) struct Stage<const D: usize> {
    cells: Cells<D>,
    places: Vec<u32>,
    positions: Vec<Vector<D>>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    groups: Vec<u32>,
    perception: Perception<D>,
    vicinity: Vicinity<D>,
    surroundings: Surroundings<D>,
}

/// The largest distance at which some laws look for neighbours, and the largest that is
/// finite, 0 where there is none.
pub(super) fn ranges<'a, const D: usize>(
    laws: impl Iterator<Item = (usize, &'a dyn Law<D>)> + Clone,
) -> [f64; 2] {
    let ranges = laws.map(|(_, law)| law.range());
    let finite = ranges.clone().filter(|range| range.is_finite());
    [ranges.fold(0.0, f64::max), finite.fold(0.0, f64::max)]
}

impl<const D: usize> Stage<D> {
    /// The scene that laws see who look so far; see [`ranges`].
    pub(super) fn scene<'a>(
        &'a mut self,
        state: &State<'a, D>,
        [range, finite]: [f64; 2],
        senses: Option<&Senses<D>>,
        history: &History<D>,
        holds: &'a [Hold],
    ) -> Scene<'a, D> {
        self.surroundings.follow(state.obstacles);
        let mean_position = mean(state.positions);
        let senses = senses.filter(|_| range > 0.0);
        // Without neighbours to look for, one cell will do, in which agents keep their order.
        let side = if finite > 0.0 { finite } else { f64::MAX };
        let (cells, places, search) = if senses.is_none() && finite > 0.0 {
            let listed = self.vicinity.follow(state.positions, mean_position, finite);
            let vicinity = &self.vicinity;
            let search = match listed {
                true => Search::Lists(vicinity),
                // All are near all.
                false if vicinity.cells().is_one() => Search::All,
                false => Search::Cells(vicinity.cells()),
            };
            (vicinity.cells(), vicinity.places(), search)
        } else {
            self.cells.rebuild(state.positions, side);
            self.cells.places(&mut self.places);
            (&self.cells, &self.places[..], Search::All)
        };
        let agents = cells.order();
        self.groups.clear();
        let groups = agents.iter().map(|&agent| state.groups[agent as usize]);
        self.groups.extend(groups.map(|group| group as u32));
        let mut scene = Scene {
            time: state.time,
            agents,
            places,
            positions: gathered(agents, state.positions, &mut self.positions),
            velocities: gathered(agents, state.velocities, &mut self.velocities),
            headings: gathered(agents, state.headings, &mut self.headings),
            groups: &self.groups,
            masses: state.masses,
            rotations: state.rotations,
            search,
            obstacles: state.obstacles,
            surroundings: &self.surroundings,
            mean_position,
            mean_velocity: mean(state.velocities),
            perception: None,
            visible: None,
            holds,
        };
        if let Some(senses) = senses {
            self.perception
                .rebuild(senses, history, &scene, cells, [range, side]);
            scene.perception = Some(&self.perception);
        }
        scene
    }
}

/// The vectors of some agents, in this order of them.
fn gathered<'a, const D: usize>(
    agents: &[u32],
    vectors: &[Vector<D>],
    out: &'a mut Vec<Vector<D>>,
) -> &'a [Vector<D>] {
    out.resize(agents.len(), Vector::zeros());
    gather(agents, vectors, out);
    out
}
