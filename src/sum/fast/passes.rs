//! Up the tree and down again.

use pulp::Arch;
use rayon::prelude::*;

use super::agents::Exchange;
use super::convolution::Channels;
use super::grid::{overlay, size};
use super::kernel::Kernel;
use super::level::{Level, tell};
use super::lists::{Lists, Near};
use super::nearby::{Crowd, Nearby};
use super::tree::Tree;

/// What all passes look at.
pub(super) struct Passes<'a, const D: usize> {
    pub arch: Arch,
    pub kernel: &'a Kernel,
    pub channels: Channels,
    pub tree: &'a Tree<D>,
    /// Those of the tree, without the root's.
    pub levels: &'a [Level<D>],
    /// For each level of the tree, who is too near for whom.
    pub near: &'a [Lists<Near<D>>],
    /// Coordinates of the agents in the order of the tree, then their numbers: one row each.
    pub rows: &'a [Vec<f64>],
}

/// Numbers at nodes, kept from one time to the next.
#[derive(Debug, Clone, Default)]
pub(super) struct Nodes {
    /// Sources: of the cells of the level at hand, of all children of a cell together, and the
    /// latter of the level below.
    own: Vec<f64>,
    together: Vec<f64>,
    below: Vec<f64>,
    /// Targets, by level: all children of a cell together, and cells.
    told: Vec<[Vec<f64>; 2]>,
    spectra: Vec<f64>,
}

/// Empties a list and fills it with zeros.
fn zeros(values: &mut Vec<f64>, count: usize) -> &mut [f64] {
    values.clear();
    values.resize(count, 0.0);
    values
}

impl<const D: usize> Passes<'_, D> {
    /// The sums of all agents, row by row of channels, in the order of the tree.
    pub fn run(&self, nodes: &mut Nodes, sums: &mut [f64]) {
        nodes.told.resize_with(self.levels.len(), Default::default);
        for index in (1..=self.levels.len()).rev() {
            self.collect(index, nodes);
            self.between(index, nodes);
            std::mem::swap(&mut nodes.together, &mut nodes.below);
        }
        for index in 1..=self.levels.len() {
            self.hand_down(index, nodes);
        }
        self.finish(nodes, sums);
    }

    /// From agents, or from children, to the nodes of the cells of a level, and from there to
    /// those that they have together.
    fn collect(&self, index: usize, nodes: &mut Nodes) {
        let Self { arch, tree, .. } = *self;
        let (cells, parents) = (&tree.levels[index], &tree.levels[index - 1]);
        let given = self.channels.given;
        let lattice = &self.levels[index - 1].lattice;
        let one = size::<D>(lattice.nodes);
        let below = self.levels.get(index).map(|below| {
            let [up, _] = below.changes.as_ref().expect("it is not the first");
            (up, size::<D>(below.lattice.of_siblings()))
        });
        let from_below = &nodes.below;
        zeros(&mut nodes.own, cells.len() * given * one)
            .par_chunks_exact_mut(given * one)
            .zip(cells)
            .for_each_init(
                <(Exchange, [Vec<f64>; 2])>::default,
                |(exchange, scratch), (own, cell)| match &below {
                    Some((up, many)) if !cell.is_leaf() => {
                        let from = from_below[cell.branch * given * many..].chunks_exact(*many);
                        for (own, from) in own.chunks_exact_mut(one).zip(from) {
                            up.add::<D>(arch, from, own, scratch);
                        }
                    }
                    _ => {
                        let [places, numbers] = self.agents(cell.agents.clone());
                        let places = std::array::from_fn(|axis| places[axis]);
                        let centre = tree.centre(index, cell);
                        exchange.gather::<D>(arch, lattice, &centre, places, &numbers, own);
                    }
                },
            );
        let own = &nodes.own;
        let many = size::<D>(lattice.of_siblings());
        let branches: Vec<_> = parents.iter().filter(|cell| !cell.is_leaf()).collect();
        zeros(&mut nodes.together, branches.len() * given * many)
            .par_chunks_exact_mut(given * many)
            .zip(branches)
            .for_each(|(together, parent)| {
                for child in parent.children.clone() {
                    let own = own[child * given * one..].chunks_exact(one);
                    for (together, own) in together.chunks_exact_mut(many).zip(own) {
                        overlay(lattice, &cells[child].at, |small, large| {
                            add(&mut together[large], &own[small]);
                        });
                    }
                }
            });
    }

    /// The coordinates of some agents, and their numbers.
    fn agents(&self, agents: std::ops::Range<usize>) -> [Vec<&[f64]>; 2] {
        let (places, numbers) = self.rows.split_at(D);
        [places, numbers].map(|rows| rows.iter().map(|row| &row[agents.clone()]).collect())
    }

    /// What the children of near cells tell each other, but for those too near.
    fn between(&self, index: usize, nodes: &mut Nodes) {
        let Self { tree, near, .. } = *self;
        let (cells, parents) = (&tree.levels[index], &tree.levels[index - 1]);
        let level = &self.levels[index - 1];
        let wanted = self.channels.wanted;
        // Where all children are too near for all others, there is nothing to tell and nothing
        // to take back.
        let some_tell = |sides: &[i64; D]| {
            let far = sides
                .iter()
                .map(|side| side.unsigned_abs())
                .max()
                .unwrap_or(0) as usize;
            level.grade.reach.is_none_or(|reach| 2 * far + 1 > reach)
        };
        let mut sources = Lists::default();
        for (place, parent) in parents.iter().enumerate() {
            if parent.is_leaf() {
                continue;
            }
            for near in near[index - 1].of(place) {
                let other = &parents[near.cell as usize];
                if !other.is_leaf() && some_tell(&near.sides) {
                    sources.push((other.branch as u32, level.siblings.way(near.sides)));
                }
            }
            sources.end();
        }
        let [together, own] = &mut nodes.told[index - 1];
        let many = size::<D>(level.lattice.of_siblings());
        let together = zeros(together, sources.len() * wanted * many);
        let spectra = &mut nodes.spectra;
        tell(
            &level.siblings,
            &mut nodes.together,
            &sources,
            spectra,
            together,
        );
        let one = size::<D>(level.lattice.nodes);
        let own = zeros(own, cells.len() * wanted * one);
        if let Some(convolution) = &level.near {
            let mut sources = Lists::default();
            for (place, cell) in cells.iter().enumerate() {
                for near in near[index].of(place) {
                    let [mine, theirs] =
                        [cell, &cells[near.cell as usize]].map(|cell| &parents[cell.parent].at);
                    if some_tell(&std::array::from_fn(|axis| mine[axis] - theirs[axis])) {
                        sources.push((near.cell, convolution.way(near.sides)));
                    }
                }
                sources.end();
            }
            tell(convolution, &mut nodes.own, &sources, spectra, own);
        }
    }

    /// From the cells of the level above to the nodes that their children have together, and
    /// from those to each child.
    fn hand_down(&self, index: usize, nodes: &mut Nodes) {
        let (cells, parents) = (&self.tree.levels[index], &self.tree.levels[index - 1]);
        let level = &self.levels[index - 1];
        let wanted = self.channels.wanted;
        let many = size::<D>(level.lattice.of_siblings());
        let (above, here) = nodes.told.split_at_mut(index - 1);
        let [together, own] = &mut here[0];
        if let (Some([_, above]), Some([_, down])) = (above.last(), &level.changes) {
            let one = size::<D>(self.levels[index - 2].lattice.nodes);
            let branches = (0..parents.len()).filter(|&place| !parents[place].is_leaf());
            let branches: Vec<_> = branches.collect();
            together
                .par_chunks_exact_mut(wanted * many)
                .zip(branches)
                .for_each_init(Default::default, |scratch, (together, place)| {
                    let from = above[place * wanted * one..].chunks_exact(one);
                    for (together, from) in together.chunks_exact_mut(many).zip(from) {
                        down.add::<D>(self.arch, from, together, scratch);
                    }
                });
        }
        let one = size::<D>(level.lattice.nodes);
        own.par_chunks_exact_mut(wanted * one)
            .zip(cells)
            .for_each(|(own, cell)| {
                let branch = parents[cell.parent].branch;
                let from = together[branch * wanted * many..].chunks_exact(many);
                for (own, from) in own.chunks_exact_mut(one).zip(from) {
                    overlay(&level.lattice, &cell.at, |small, large| {
                        add(&mut own[small], &from[large]);
                    });
                }
            });
    }

    /// From the nodes of each leaf to its agents, and from the agents too near.
    fn finish(&self, nodes: &Nodes, sums: &mut [f64]) {
        let wanted = self.channels.wanted;
        let levels = self.tree.levels.iter().enumerate();
        let mut leaves: Vec<_> = levels
            .flat_map(|(index, cells)| (0..cells.len()).map(move |place| (index, place)))
            .filter(|&(index, place)| self.tree.levels[index][place].is_leaf())
            .collect();
        leaves.sort_unstable_by_key(|&(index, place)| self.tree.levels[index][place].agents.start);
        // Leaves share out the agents, so their sums follow one another.
        let mut rest = sums;
        let mut tasks = Vec::with_capacity(leaves.len());
        for (index, place) in leaves {
            let count = self.tree.levels[index][place].agents.len();
            let (mine, others) = std::mem::take(&mut rest).split_at_mut(count * wanted);
            tasks.push((index, place, mine));
            rest = others;
        }
        tasks.into_par_iter().for_each_init(
            <(Exchange, Crowd)>::default,
            |(exchange, crowd), (index, place, sums)| {
                let cell = &self.tree.levels[index][place];
                let [places, _] = self.agents(cell.agents.clone());
                let places: [&[f64]; D] = std::array::from_fn(|axis| places[axis]);
                let lattice = &self.levels[index - 1].lattice;
                let many = wanted * size::<D>(lattice.nodes);
                let values = &nodes.told[index - 1][1][place * many..][..many];
                let centre = self.tree.centre(index, cell);
                let count = cell.agents.len();
                let mut by_channel = vec![0.0; count * wanted];
                let mut channels: Vec<_> = by_channel.chunks_exact_mut(count).collect();
                exchange.spread::<D>(self.arch, lattice, &centre, places, values, &mut channels);
                self.meet(crowd, index, place);
                let nearby = Nearby::<D> {
                    crowd,
                    targets: places,
                    wanted: &mut channels,
                };
                nearby.run(self.kernel);
                for (agent, sums) in sums.chunks_exact_mut(wanted).enumerate() {
                    let channels = channels.iter();
                    sums.iter_mut()
                        .zip(channels)
                        .for_each(|(sum, channel)| *sum = channel[agent]);
                }
            },
        );
    }

    /// All agents that a leaf must look at one by one: those of near cells, where it or they
    /// are not split any more.
    fn meet(&self, crowd: &mut Crowd, mut index: usize, mut place: usize) {
        crowd.clear(self.rows.len());
        loop {
            let cells = &self.tree.levels[index];
            for near in self.near[index].of(place) {
                let other = &cells[near.cell as usize];
                if cells[place].is_leaf() || other.is_leaf() {
                    crowd.extend(self.rows.iter().map(|row| &row[other.agents.clone()]));
                }
            }
            if index == 0 {
                break;
            }
            (index, place) = (index - 1, cells[place].parent);
        }
        crowd.pad(D);
    }
}

fn add(to: &mut [f64], from: &[f64]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
}
