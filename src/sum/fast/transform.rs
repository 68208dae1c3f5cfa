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
}

/// What transforms are worked out in.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    first: Vec<f64>,
    second: Vec<f64>,
    third: Vec<f64>,
    none: Vec<f64>,
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
        let line = 2 * kept - 1;
        let [re, im] = &mut scratch.slab;
        for parts in [&mut *re, &mut *im] {
            parts.resize(padded(self.slab()), 0.0);
            parts[self.slab()..].fill(0.0);
        }
        let count = self.slab();
        let (re, im) = (&mut re[..count], &mut im[..count]);
        let none = &*room(&mut scratch.none, 2 * long);
        if D == 2 {
            let (plain, turned) = second.split_at(2 * long);
            arch.dispatch(|| join(kept, [[plain, none], [turned, none]], 1.0, re, im));
            return;
        }
        let square = kept * 2 * long;
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
        arch.dispatch(|| {
            for k in 0..kept {
                let row = |index: usize| &third[index * square + k * 2 * long..][..2 * long];
                let rows = [[row(0), row(1)], [row(2), row(3)]];
                let mut write = |at: usize, sign: f64| {
                    let at = at * line..(at + 1) * line;
                    join(kept, rows, sign, &mut re[at.clone()], &mut im[at]);
                };
                write(k, 1.0);
                if k > 0 {
                    write(kept - 1 + k, -1.0);
                }
            }
        });
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
        let line = 2 * kept - 1;
        let none = &*room(&mut scratch.none, line);
        let [re, im] = &scratch.slab;
        let second = room(&mut scratch.second, 2 * planes * 2 * long);
        if D == 2 {
            let (plain, turned) = second.split_at_mut(2 * long);
            let mut others = [vec![0.0; 2 * long], vec![0.0; 2 * long]];
            let [with, without] = &mut others;
            let rows = [[plain, &mut with[..]], [turned, &mut without[..]]];
            arch.dispatch(|| part(kept, [[re, im], [none, none]], rows));
        } else {
            let square = kept * 2 * long;
            let third = room(&mut scratch.third, 4 * square);
            arch.dispatch(|| {
                let mut parts = third.chunks_exact_mut(square);
                let [a, b, c, d] = std::array::from_fn(|_| parts.next().expect("there are 4"));
                for k in 0..kept {
                    let at = |at: usize| [&re[at * line..][..line], &im[at * line..][..line]];
                    let opposite = match k {
                        0 => [none, none],
                        k => at(kept - 1 + k),
                    };
                    let row = k * 2 * long..(k + 1) * 2 * long;
                    let rows = [
                        [&mut a[row.clone()], &mut b[row.clone()]],
                        [&mut c[row.clone()], &mut d[row]],
                    ];
                    part(kept, [at(k), opposite], rows);
                }
            });
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
        }
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

/// A line of a slab of so many frequencies with both signs, from the products of cosines and
/// sines: `rows[a][b]` holds those with a sine along the first axis if a is 1, along the
/// second if b is, and of these with a cosine along the last, then with a sine. `sign` is that
/// of the frequency along the second axis.
#[inline(always)]
fn join(kept: usize, rows: [[&[f64]; 2]; 2], sign: f64, re: &mut [f64], im: &mut [f64]) {
    let long = padded(kept);
    let at = |a: usize, b: usize, c: usize| &rows[a][b][c * long..][..kept];
    let [even_re, odd_re] = [[at(0, 0, 0), at(1, 1, 0)], [at(1, 0, 1), at(0, 1, 1)]];
    let [even_im, odd_im] = [[at(1, 0, 0), at(0, 1, 0)], [at(0, 0, 1), at(1, 1, 1)]];
    // Each sine comes with −i.
    let parts = |j: usize| {
        [
            even_re[0][j] - sign * even_re[1][j],
            -(odd_re[0][j] + sign * odd_re[1][j]),
            -(even_im[0][j] + sign * even_im[1][j]),
            sign * odd_im[1][j] - odd_im[0][j],
        ]
    };
    let (re, negative_re) = re.split_at_mut(kept);
    let (im, negative_im) = im.split_at_mut(kept);
    for j in 0..kept {
        let [even_re, odd_re, even_im, odd_im] = parts(j);
        re[j] = even_re + odd_re;
        im[j] = even_im + odd_im;
    }
    for j in 1..kept {
        let [even_re, odd_re, even_im, odd_im] = parts(j);
        negative_re[j - 1] = even_re - odd_re;
        negative_im[j - 1] = even_im - odd_im;
    }
}

/// The other way: what cosines and sines are to be multiplied by, of two lines of opposite
/// frequencies along the second axis, each with its real and imaginary parts.
#[inline(always)]
fn part(kept: usize, lines: [[&[f64]; 2]; 2], rows: [[&mut [f64]; 2]; 2]) {
    let long = padded(kept);
    let [plain, turned] = rows;
    let [plain, turned] = [plain, turned].map(|[with, without]| {
        [with, without].map(|row| {
            let (cosines, sines) = row.split_at_mut(long);
            [&mut cosines[..kept], &mut sines[..kept]]
        })
    });
    let [[p00, p01], [p10, p11]] = plain;
    let [[t00, t01], [t10, t11]] = turned;
    let mut write = |j: usize, negative: [[f64; 2]; 2]| {
        // By line, then real and imaginary: sum and difference over signs of the last axis.
        let sums = |line: usize, part: usize| {
            let (plus, minus) = (lines[line][part][j], negative[line][part]);
            [plus + minus, plus - minus]
        };
        let [[re, im], [other_re, other_im]] =
            [[sums(0, 0), sums(0, 1)], [sums(1, 0), sums(1, 1)]];
        // Each sine comes with i.
        p00[j] = re[0] + other_re[0];
        t00[j] = -(im[0] + other_im[0]);
        p01[j] = -(im[1] + other_im[1]);
        t01[j] = -(re[1] + other_re[1]);
        p10[j] = other_im[0] - im[0];
        t10[j] = other_re[0] - re[0];
        p11[j] = other_re[1] - re[1];
        t11[j] = im[1] - other_im[1];
    };
    write(0, [[0.0; 2]; 2]);
    for j in 1..kept {
        write(j, lines.map(|line| line.map(|part| part[kept - 1 + j])));
    }
}
