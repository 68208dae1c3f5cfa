//! Fourier's transform of the numbers at the nodes of a cell.
//!
//! A slab, which is all frequencies that have one frequency along the first axis, is worked
//! out at a time: memory stays small, and only half of them are needed, for the numbers are
//! real. The transforms have a few dozen points along an axis, half of them zero, so they are
//! products of small matrices: on [folded](super::fold) numbers those take no more operations
//! than fast transforms would, and fill vector registers.

use pulp::Arch;

use super::fold::sums_of;
use super::gemm::{multiply, padded};
use super::signs::{Join, Split};
use crate::math::sin_cos_of_turns;

/// Tables of a transform: of nodes whose middle is at 0.
#[derive(Debug, Clone)]
pub(super) struct Transform<const D: usize> {
    arch: Arch,
    /// Nodes along each axis.
    nodes: usize,
    /// Frequencies 0, 1, … along each axis; along all but the first, the negative ones as well.
    kept: usize,
    /// By frequency, the cosines at the nodes that hold sums, and the sines at those that hold
    /// differences.
    rows: [Vec<f64>; 2],
    /// The same by node.
    columns: [Vec<f64>; 2],
    /// By node: cosines of all frequencies, and beside them the sines, both padded.
    forth: Vec<f64>,
    /// By frequency: the cosines at their nodes, and the sines at theirs, with zeros elsewhere.
    back: [Vec<f64>; 2],
    /// 1 for the frequencies of a padded row that have another sign.
    signed: Vec<f64>,
}

/// What transforms are worked out in.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    first: Vec<f64>,
    second: Vec<f64>,
    third: Vec<f64>,
    wave: Vec<f64>,
    /// Real and imaginary parts of a slab, line by line.
    pub slab: [Vec<f64>; 2],
}

/// Makes room; what is there is written before it is read.
fn room(values: &mut Vec<f64>, count: usize) -> &mut [f64] {
    values.resize(count.max(values.len()), 0.0);
    &mut values[..count]
}

impl<const D: usize> Transform<D> {
    /// Of so many nodes along each axis, on a turn of so many, to frequencies below `kept`.
    pub fn new(nodes: usize, turn: usize, kept: usize) -> Self {
        let wave = |k: usize, node: usize| {
            let halves = k as i64 * (2 * node as i64 - (nodes as i64 - 1));
            let turn = 2 * turn as i64;
            sin_cos_of_turns(halves.rem_euclid(turn) as f64 / turn as f64)
        };
        let sums = sums_of(nodes);
        let value = |kind: usize, k: usize, node: usize| match kind {
            0 => wave(k, node).1,
            _ => wave(k, node).0,
        };
        let (short, long) = (padded(nodes), padded(kept));
        let mut forth = vec![0.0; sums * 2 * long];
        let mut back = [vec![0.0; kept * short], vec![0.0; kept * short]];
        for k in 0..kept {
            for node in 0..nodes {
                let kind = usize::from(node >= sums);
                let value = value(kind, k, node);
                forth[(node - kind * sums) * 2 * long + kind * long + k] = value;
                back[kind][k * short + node] = value;
            }
        }
        let places = [0..sums, sums..nodes];
        let table = |kind: usize, by_node: bool| -> Vec<f64> {
            let nodes = places[kind].clone();
            match by_node {
                false => (0..kept)
                    .flat_map(|k| nodes.clone().map(move |node| value(kind, k, node)))
                    .collect(),
                true => nodes
                    .flat_map(|node| (0..kept).map(move |k| value(kind, k, node)))
                    .collect(),
            }
        };
        Self {
            arch: Arch::new(),
            nodes,
            kept,
            rows: [table(0, false), table(1, false)],
            columns: [table(0, true), table(1, true)],
            forth,
            back,
            signed: (0..long)
                .map(|k| f64::from(u8::from((1..kept).contains(&k))))
                .collect(),
        }
    }

    /// Number of slabs.
    pub fn slabs(&self) -> usize {
        self.kept
    }

    /// Frequencies of a slab.
    pub fn slab(&self) -> usize {
        (2 * self.kept - 1).pow(D as u32 - 1)
    }

    /// First place and number of the sums, or of the differences, along an axis.
    fn places(&self, kind: usize) -> (usize, usize) {
        let sums = sums_of(self.nodes);
        [(0, sums), (sums, self.nodes - sums)][kind]
    }

    /// Works out a slab of folded numbers.
    pub fn forward(&self, slab: usize, values: &[f64], scratch: &mut Scratch) {
        let Self {
            arch, nodes, kept, ..
        } = *self;
        let (short, long) = (padded(nodes), padded(kept));
        let planes = nodes.pow(D as u32 - 2);
        let rest = planes * short;
        let first = room(&mut scratch.first, 2 * rest);
        for (kind, first) in first.chunks_exact_mut(rest).enumerate() {
            let (from, count) = self.places(kind);
            let wave = (&self.rows[kind][slab * count..], count);
            let values = (&values[from * rest..], rest);
            multiply(arch, [1, count, rest], wave, values, first, false);
        }
        let second = room(&mut scratch.second, 2 * planes * 2 * long);
        for kind in 0..2 {
            let (from, count) = self.places(kind);
            multiply(
                arch,
                [2 * planes, count, long],
                (&first[from..], short),
                (&self.forth[kind * long..], 2 * long),
                &mut second[kind * long..],
                false,
            );
        }
        let square = kept.pow(D as u32 - 2) * 2 * long;
        let products = if D == 2 {
            second
        } else {
            let third = room(&mut scratch.third, 4 * square);
            for (index, third) in third.chunks_exact_mut(square).enumerate() {
                let (from, count) = self.places(index % 2);
                let from = (index / 2 * nodes + from) * 2 * long;
                multiply(
                    arch,
                    [kept, count, 2 * long],
                    (&self.rows[index % 2], count),
                    (&second[from..], 2 * long),
                    third,
                    false,
                );
            }
            third
        };
        let count = self.slab();
        for parts in &mut scratch.slab {
            parts.resize(padded(count + long), 0.0);
        }
        let [re, im] = &mut scratch.slab;
        arch.dispatch(Join::<D> {
            kept,
            products,
            slab: [&mut *re, &mut *im],
        });
        for parts in &mut scratch.slab {
            parts[count..].fill(0.0);
        }
    }

    /// Adds to half the sums and differences of a grid what a slab comes to there, and the
    /// slab of opposite frequencies.
    pub fn inverse(&self, slab: usize, values: &mut [f64], scratch: &mut Scratch) {
        let Self {
            arch, nodes, kept, ..
        } = *self;
        let (short, long) = (padded(nodes), padded(kept));
        let planes = nodes.pow(D as u32 - 2);
        let rest = planes * short;
        let square = kept.pow(D as u32 - 2) * 2 * long;
        for parts in &mut scratch.slab {
            // What is beyond is read with the last, and given no weight.
            parts.resize(padded(self.slab() + long), 0.0);
        }
        let split = Split::<D> {
            kept,
            slab: scratch.slab.each_ref().map(|part| &part[..]),
            signed: &self.signed,
            products: room(&mut scratch.third, 4 * square),
        };
        arch.dispatch(split);
        let third = &scratch.third[..4 * square];
        let second = if D == 2 {
            third
        } else {
            let second = room(&mut scratch.second, 2 * planes * 2 * long);
            for (index, third) in third.chunks_exact(square).enumerate() {
                let (to, count) = self.places(index % 2);
                let to = (index / 2 * nodes + to) * 2 * long;
                multiply(
                    arch,
                    [count, kept, 2 * long],
                    (&self.columns[index % 2], kept),
                    (third, 2 * long),
                    &mut second[to..],
                    false,
                );
            }
            second
        };
        let first = room(&mut scratch.first, 2 * rest);
        for (kind, table) in self.back.iter().enumerate() {
            // Whole registers before the first that holds a difference are left out.
            let from = self.places(kind).0 / padded(1) * padded(1);
            multiply(
                arch,
                [2 * planes, kept, short - from],
                (&second[kind * long..], 2 * long),
                (&table[from..], short),
                &mut first[from..],
                kind == 1,
            );
        }
        // The opposite frequencies add the same once more.
        let factor = if slab == 0 { 1.0 } else { 2.0 };
        for (kind, first) in first.chunks_exact(rest).enumerate() {
            let (to, count) = self.places(kind);
            scratch.wave.clear();
            let wave = &self.rows[kind][slab * count..][..count];
            scratch.wave.extend(wave.iter().map(|value| factor * value));
            multiply(
                arch,
                [count, 1, rest],
                (&scratch.wave, 1),
                (first, rest),
                &mut values[to * rest..][..count * rest],
                true,
            );
        }
    }
}
