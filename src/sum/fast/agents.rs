//! From agents to the nodes of their cell, and back.

use pulp::Arch;

use super::gemm::{LANES, multiply, padded};
use super::lattice::Lattice;

/// Agents that are worked on at once.
const BATCH: usize = 4 * LANES;

/// Agents of a cell, one slice of coordinates for each axis.
pub(super) type Places<'a, const D: usize> = [&'a [f64]; D];

/// What agents and nodes are exchanged in.
#[derive(Debug, Default)]
pub(super) struct Exchange {
    /// Interpolation weights by axis, node and agent of a batch.
    weights: Vec<[f64; BATCH]>,
    /// The weights along the last axis, by agent and node.
    turned: Vec<f64>,
    /// One row for each channel and node of the other axes, by agent.
    rows: Vec<[f64; BATCH]>,
}

impl Exchange {
    /// Interpolation weights of a batch of agents, with zeros where the batch has none.
    fn weigh<const D: usize>(
        &mut self,
        lattice: &Lattice,
        centre: &[f64; D],
        places: &Places<'_, D>,
    ) {
        let nodes = lattice.nodes;
        let count = places[0].len();
        self.weights.resize(D * nodes, [0.0; BATCH]);
        let mut part = [[0.0; LANES]; 32];
        let of_axes = self.weights.chunks_exact_mut(nodes);
        for ((weights, places), centre) in of_axes.zip(places).zip(centre) {
            for first in (0..count).step_by(LANES) {
                let relative = std::array::from_fn(|lane| {
                    let place = places.get(first + lane);
                    place.map_or(0.0, |place| place - centre)
                });
                lattice.weights(&relative, &mut part);
                for (weights, part) in weights.iter_mut().zip(&part) {
                    weights[first..first + LANES].copy_from_slice(part);
                }
            }
        }
    }

    /// Adds the agents' numbers, one slice for each channel, to the nodes.
    pub fn gather<const D: usize>(
        &mut self,
        arch: Arch,
        lattice: &Lattice,
        centre: &[f64; D],
        places: Places<'_, D>,
        given: &[&[f64]],
        values: &mut [f64],
    ) {
        let nodes = lattice.nodes;
        let short = padded(nodes);
        let lines = nodes.pow(D as u32 - 1);
        for first in (0..places[0].len()).step_by(BATCH) {
            let last = places[0].len().min(first + BATCH);
            self.weigh(lattice, centre, &places.map(|axis| &axis[first..last]));
            let Self {
                weights,
                turned,
                rows,
            } = self;
            turned.resize(BATCH * short, 0.0);
            for (node, weights) in weights[(D - 1) * nodes..].iter().take(nodes).enumerate() {
                for (agent, weight) in weights.iter().enumerate() {
                    turned[agent * short + node] = *weight;
                }
            }
            rows.resize(given.len() * lines, [0.0; BATCH]);
            arch.dispatch(|| {
                for (rows, given) in rows.chunks_exact_mut(lines).zip(given) {
                    let mut number = [0.0; BATCH];
                    number[..last - first].copy_from_slice(&given[first..last]);
                    outer::<D>(weights, nodes, &number, rows);
                }
            });
            multiply(
                arch,
                [given.len() * lines, last - first, short],
                (rows.as_flattened(), BATCH),
                (turned, short),
                values,
                true,
            );
        }
    }

    /// Adds what the nodes' values are at the agents to their sums, one slice for each
    /// channel.
    pub fn spread<const D: usize>(
        &mut self,
        arch: Arch,
        lattice: &Lattice,
        centre: &[f64; D],
        places: Places<'_, D>,
        values: &[f64],
        wanted: &mut [&mut [f64]],
    ) {
        let nodes = lattice.nodes;
        let short = padded(nodes);
        let lines = nodes.pow(D as u32 - 1);
        for first in (0..places[0].len()).step_by(BATCH) {
            let last = places[0].len().min(first + BATCH);
            self.weigh(lattice, centre, &places.map(|axis| &axis[first..last]));
            let Self { weights, rows, .. } = self;
            rows.resize(wanted.len() * lines, [0.0; BATCH]);
            multiply(
                arch,
                [wanted.len() * lines, nodes, padded(last - first)],
                (values, short),
                (weights[(D - 1) * nodes..].as_flattened(), BATCH),
                rows.as_flattened_mut(),
                false,
            );
            arch.dispatch(|| {
                for (rows, wanted) in rows.chunks_exact(lines).zip(wanted.iter_mut()) {
                    let sums = inner::<D>(weights, nodes, rows);
                    let wanted = wanted[first..last].iter_mut();
                    wanted.zip(sums).for_each(|(wanted, sum)| *wanted += sum);
                }
            });
        }
    }
}

/// For each node of all axes but the last, the agents' numbers times their weights.
#[inline(always)]
fn outer<const D: usize>(
    weights: &[[f64; BATCH]],
    nodes: usize,
    number: &[f64; BATCH],
    rows: &mut [[f64; BATCH]],
) {
    let (across, along) = weights.split_at(nodes);
    for (x, across) in across.iter().enumerate() {
        let first = std::array::from_fn(|agent| number[agent] * across[agent]);
        if D == 2 {
            rows[x] = first;
            continue;
        }
        for (row, along) in rows[x * nodes..][..nodes].iter_mut().zip(along) {
            *row = std::array::from_fn(|agent| first[agent] * along[agent]);
        }
    }
}

/// The sum over all nodes of all axes but the last, weighted for each agent.
#[inline(always)]
fn inner<const D: usize>(
    weights: &[[f64; BATCH]],
    nodes: usize,
    rows: &[[f64; BATCH]],
) -> [f64; BATCH] {
    let (across, along) = weights.split_at(nodes);
    let mut sums = [0.0; BATCH];
    for (x, across) in across.iter().enumerate() {
        let mut line = [0.0; BATCH];
        if D == 2 {
            line = rows[x];
        } else {
            for (row, along) in rows[x * nodes..][..nodes].iter().zip(along) {
                add_products(&mut line, row, along);
            }
        }
        add_products(&mut sums, &line, across);
    }
    sums
}

#[inline(always)]
fn add_products(sums: &mut [f64; BATCH], left: &[f64; BATCH], right: &[f64; BATCH]) {
    for (sum, (left, right)) in sums.iter_mut().zip(left.iter().zip(right)) {
        *sum += left * right;
    }
}
