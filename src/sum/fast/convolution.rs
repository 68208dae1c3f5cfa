//! Sums between the nodes of cells, by Fourier's transform.
//!
//! Between two cells that are some whole number of sides apart, what the nodes of one are told by
//! those of the other is a convolution, since nodes form one lattice. With room for one turn
//! around it is a product of spectra, one for each frequency. Spectra are made one slab at a
//! time, a slab being all frequencies that have one frequency along the first axis: memory
//! stays small, and only half of them are needed, for the numbers are real.
//!
//! The transforms have a few dozen points, half of them zero, so they are taken as products of
//! matrices.

use pulp::{Arch, Simd, WithSimd};

use super::gemm::{LANES, multiply, padded};
use crate::math::sin_cos_of_turns;

/// Real parts and imaginary parts of this many frequencies lie side by side.
const PAIR: usize = 2 * LANES;

/// How many channels go in and come out, and how a kernel leads from one to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Channels {
    /// Numbers for each agent that are summed.
    pub given: usize,
    /// Sums for each agent.
    pub wanted: usize,
    /// One kernel for all channels, or one for each that is wanted of the one that is given.
    pub kernels: usize,
}

/// Sums between cells of one size.
#[derive(Debug, Clone)]
pub(super) struct Convolution<const D: usize> {
    arch: Arch,
    channels: Channels,
    /// Nodes of a cell along each axis.
    nodes: usize,
    /// Frequencies along each axis: twice the nodes, less one.
    turn: usize,
    /// Cosines and sines of 2π k j / turn: frequency k, node j.
    cosines: Vec<f64>,
    sines: Vec<f64>,
    /// By node along the last axis: [cos | −sin] and [sin | cos] of all frequencies.
    forth: [Vec<f64>; 2],
    /// By frequency along the last axis: cosines, sines and −sines of all nodes.
    back: [Vec<f64>; 3],
    /// How many sides apart cells may be along an axis.
    reach: usize,
    /// The kernels' spectra, by slab, then by frequencies, then by how cells lie.
    symbols: Vec<f64>,
}

/// What spectra are made in.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    first: Vec<f64>,
    second: Vec<f64>,
    third: Vec<f64>,
    sums: Vec<f64>,
}

impl<const D: usize> Convolution<D> {
    /// Cells with so many nodes along each axis, sides of `pitch` nodes, and up to `reach` sides
    /// apart. `kernel` gives the kernels' values by the way from source to target in spacings
    /// of the lattice.
    pub fn new(
        nodes: usize,
        pitch: usize,
        reach: usize,
        channels: Channels,
        kernel: impl Fn([i64; D], &mut [f64]),
    ) -> Self {
        let turn = 2 * nodes - 1;
        let angle = |k: usize, j: usize| sin_cos_of_turns((k * j % turn) as f64 / turn as f64);
        let table = |rows: usize, columns: usize, value: &dyn Fn(usize, usize) -> f64| {
            let stride = padded(columns);
            let mut table = vec![0.0; rows * stride];
            for row in 0..rows {
                for column in 0..columns {
                    table[row * stride + column] = value(row, column);
                }
            }
            table
        };
        let cos = |k: usize, j: usize| angle(k, j).1;
        let sin = |k: usize, j: usize| angle(k, j).0;
        let minus = |k: usize, j: usize| -angle(k, j).0;
        let square = |value: &dyn Fn(usize, usize) -> f64| {
            let pairs = (0..nodes).flat_map(|k| (0..nodes).map(move |j| (k, j)));
            pairs.map(|(k, j)| value(k, j)).collect()
        };
        let mut convolution = Self {
            arch: Arch::new(),
            channels,
            nodes,
            turn,
            cosines: square(&cos),
            sines: square(&sin),
            forth: [
                beside(&table(nodes, turn, &cos), &table(nodes, turn, &minus), turn),
                beside(&table(nodes, turn, &sin), &table(nodes, turn, &cos), turn),
            ],
            back: [
                table(turn, nodes, &cos),
                table(turn, nodes, &sin),
                table(turn, nodes, &minus),
            ],
            reach,
            symbols: Vec::new(),
        };
        convolution.symbols = convolution.transformed(pitch, kernel);
        convolution
    }

    /// How many ways there are for two cells to lie.
    fn ways(&self) -> usize {
        (2 * self.reach + 1).pow(D as u32)
    }

    /// The number of a way for two cells to lie, by how many sides the target is beyond the
    /// source.
    pub fn way(&self, sides: [i64; D]) -> u32 {
        let across = 2 * self.reach as i64 + 1;
        let way = |way, side| way * across + side + self.reach as i64;
        sides.into_iter().fold(0, way) as u32
    }

    /// Number of slabs.
    pub fn slabs(&self) -> usize {
        self.nodes
    }

    /// Lines of frequencies of a slab.
    fn lines(&self) -> usize {
        self.turn.pow(D as u32 - 2)
    }

    /// Registers' worths of frequencies of a slab.
    fn parts(&self) -> usize {
        self.lines() * padded(self.turn) / LANES
    }

    /// Numbers of a slab of the spectrum of a source.
    pub fn slab_given(&self) -> usize {
        self.parts() * self.channels.given * PAIR
    }

    /// Numbers of a slab of the spectrum of a target.
    fn slab_wanted(&self) -> usize {
        self.parts() * self.channels.wanted * PAIR
    }

    /// Numbers of one channel of a cell: the last axis is padded.
    fn grid(&self) -> usize {
        self.nodes.pow(D as u32 - 1) * padded(self.nodes)
    }

    /// Writes a slab of a source's spectrum.
    pub fn forward(
        &self,
        slab: usize,
        values: &[f64],
        spectrum: &mut [f64],
        scratch: &mut Scratch,
    ) {
        let Self { nodes, turn, .. } = *self;
        let (short, long) = (padded(nodes), padded(turn));
        let grid = self.grid();
        // Nodes of all axes but the first, and but the first and the last.
        let rest = grid / nodes;
        let rows = rest / short;
        let Scratch {
            first,
            second,
            third,
            ..
        } = scratch;
        first.resize(2 * rest, 0.0);
        second.resize(rows * 2 * long, 0.0);
        let waves: Vec<f64> = self.wave(slab, 1.0);
        for (channel, values) in values.chunks_exact(grid).enumerate() {
            multiply(
                self.arch,
                [2, nodes, rest],
                (&waves, nodes),
                (values, rest),
                first,
                false,
            );
            for (part, table) in self.forth.iter().enumerate() {
                multiply(
                    self.arch,
                    [rows, nodes, 2 * long],
                    (&first[part * rest..], short),
                    (table, 2 * long),
                    second,
                    part == 1,
                );
            }
            let mut write = |line: usize, re: &[f64], im: &[f64]| {
                let first = line * long / LANES;
                let parts = re.chunks_exact(LANES).zip(im.chunks_exact(LANES));
                for (part, (re, im)) in (first..).zip(parts) {
                    let at = (part * self.channels.given + channel) * PAIR;
                    spectrum[at..at + LANES].copy_from_slice(re);
                    spectrum[at + LANES..at + PAIR].copy_from_slice(im);
                }
            };
            if D == 2 {
                let (re, im) = second.split_at(long);
                write(0, re, im);
                continue;
            }
            // Both signs of a frequency have the same cosines and opposite sines.
            third.resize(nodes * 4 * long, 0.0);
            let (even, odd) = third.split_at_mut(nodes * 2 * long);
            for (table, out) in [(&self.cosines, &mut *even), (&self.sines, &mut *odd)] {
                self.square(table, second, out, false);
            }
            let [mut re, mut im] = [vec![0.0; long], vec![0.0; long]];
            for (k, (even, odd)) in even
                .chunks_exact(2 * long)
                .zip(odd.chunks_exact(2 * long))
                .enumerate()
            {
                let ((even_re, even_im), (odd_re, odd_im)) =
                    (even.split_at(long), odd.split_at(long));
                for j in 0..long {
                    re[j] = even_re[j] + odd_im[j];
                    im[j] = even_im[j] - odd_re[j];
                }
                write(k, &re, &im);
                if k > 0 {
                    for j in 0..long {
                        re[j] = even_re[j] - odd_im[j];
                        im[j] = even_im[j] + odd_re[j];
                    }
                    write(nodes - 1 + k, &re, &im);
                }
            }
        }
    }

    /// Cosines and −sines of a frequency along the first axis, times a factor: two rows.
    fn wave(&self, slab: usize, factor: f64) -> Vec<f64> {
        let row = slab * self.nodes..(slab + 1) * self.nodes;
        let cosines = self.cosines[row.clone()].iter().map(|cos| cos * factor);
        let sines = self.sines[row].iter().map(|sin| -sin * factor);
        cosines.chain(sines).collect()
    }

    /// A square table times rows of complex numbers, as many as there are nodes.
    fn square(&self, table: &[f64], rows: &[f64], out: &mut [f64], add: bool) {
        let stride = 2 * padded(self.turn);
        multiply(
            self.arch,
            [self.nodes, self.nodes, stride],
            (table, self.nodes),
            (rows, stride),
            out,
            add,
        );
    }

    /// Adds to the values at the nodes of some targets what their sources tell them, one slab
    /// of it. `sources` are, for each target, those sources' places in `spectra` and the ways
    /// in which they lie; `values` are the targets', one after another.
    pub fn back(
        &self,
        slab: usize,
        sources: &[&[(u32, u32)]],
        spectra: &[f64],
        values: &mut [f64],
        scratch: &mut Scratch,
    ) {
        let mut sums = std::mem::take(&mut scratch.sums);
        sums.resize(sources.len() * self.slab_wanted(), 0.0);
        let symbols = self.symbols.len() / self.slabs();
        self.arch.dispatch(Gather {
            channels: self.channels,
            parts: self.parts(),
            ways: self.ways(),
            sources,
            spectra,
            symbols: &self.symbols[slab * symbols..][..symbols],
            sums: &mut sums,
        });
        let values = values.chunks_exact_mut(self.grid() * self.channels.wanted);
        for (sums, values) in sums.chunks_exact(self.slab_wanted()).zip(values) {
            self.inverse(slab, sums, values, scratch);
        }
        scratch.sums = sums;
    }

    /// Adds what one slab of a target's spectrum comes to at its nodes.
    fn inverse(&self, slab: usize, sums: &[f64], values: &mut [f64], scratch: &mut Scratch) {
        let Self { nodes, turn, .. } = *self;
        let (short, long) = (padded(nodes), padded(turn));
        let grid = self.grid();
        let rest = grid / nodes;
        let rows = rest / short;
        let Scratch {
            first,
            second,
            third,
            ..
        } = scratch;
        first.resize(2 * rest, 0.0);
        second.resize(rows * 2 * long, 0.0);
        // The other half of the frequencies adds the same once more.
        let waves = self.wave(slab, if slab == 0 { 1.0 } else { 2.0 });
        let mut turned = vec![0.0; 2 * nodes];
        for (k, wave) in waves.iter().enumerate() {
            turned[k % nodes * 2 + k / nodes] = *wave;
        }
        for (channel, values) in values.chunks_exact_mut(grid).enumerate() {
            let at = |part: usize| (part * self.channels.wanted + channel) * PAIR;
            if D == 2 {
                for part in 0..long / LANES {
                    let from = &sums[at(part)..][..PAIR];
                    second[part * LANES..][..LANES].copy_from_slice(&from[..LANES]);
                    second[long + part * LANES..][..LANES].copy_from_slice(&from[LANES..]);
                }
            } else {
                third.resize(nodes * 4 * long, 0.0);
                let (even, odd) = third.split_at_mut(nodes * 2 * long);
                let rows = even
                    .chunks_exact_mut(2 * long)
                    .zip(odd.chunks_exact_mut(2 * long));
                for (k, (even, odd)) in rows.enumerate() {
                    for part in 0..long / LANES {
                        let plus = &sums[at(k * long / LANES + part)..][..PAIR];
                        let (re, im) = (part * LANES, long + part * LANES);
                        if k == 0 {
                            even[re..re + LANES].copy_from_slice(&plus[..LANES]);
                            even[im..im + LANES].copy_from_slice(&plus[LANES..]);
                            odd[re..re + LANES].fill(0.0);
                            odd[im..im + LANES].fill(0.0);
                            continue;
                        }
                        let minus = (nodes - 1 + k) * long / LANES + part;
                        let minus = &sums[at(minus)..][..PAIR];
                        for lane in 0..LANES {
                            let (plus_im, minus_im) = (plus[LANES + lane], minus[LANES + lane]);
                            even[re + lane] = plus[lane] + minus[lane];
                            even[im + lane] = plus_im + minus_im;
                            // Times the imaginary unit.
                            odd[re + lane] = minus_im - plus_im;
                            odd[im + lane] = plus[lane] - minus[lane];
                        }
                    }
                }
                self.square(&self.cosines, even, second, false);
                self.square(&self.sines, odd, second, true);
            }
            let [cosines, sines, minus] = &self.back;
            for (part, tables) in [[cosines, minus], [sines, cosines]].iter().enumerate() {
                for (from, table) in tables.iter().enumerate() {
                    multiply(
                        self.arch,
                        [rows, turn, short],
                        (&second[from * long..], 2 * long),
                        (table, short),
                        &mut first[part * rest..][..rest],
                        from == 1,
                    );
                }
            }
            multiply(
                self.arch,
                [nodes, 2, rest],
                (&turned, 2),
                (first, rest),
                values,
                true,
            );
        }
    }

    /// The kernels' spectra for all ways in which cells may lie.
    fn transformed(&self, pitch: usize, kernel: impl Fn([i64; D], &mut [f64])) -> Vec<f64> {
        let Self { nodes, turn, .. } = *self;
        let kernels = self.channels.kernels;
        let long = padded(turn);
        let last = nodes as i64 - 1;
        // Frequencies in the order of lines, and places from the last before to the last
        // beyond.
        let frequency = |line: usize| match line {
            line if line < nodes => line as i64,
            line => nodes as i64 - 1 - line as i64,
        };
        let angle = |k: i64, place: usize| {
            let turns = k * (place as i64 - last);
            sin_cos_of_turns(turns.rem_euclid(turn as i64) as f64 / turn as f64)
        };
        let full = |value: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
            let pairs = (0..turn).flat_map(|k| (0..turn).map(move |j| (k, j)));
            pairs.map(|(k, j)| value(k, j)).collect()
        };
        let cosines = full(&|line, place| angle(frequency(line), place).1);
        let sines = full(&|line, place| angle(frequency(line), place).0);
        // By place along the last axis, the frequencies in their own order.
        let along = |value: &dyn Fn((f64, f64)) -> f64| {
            let mut table = vec![0.0; turn * long];
            for place in 0..turn {
                for k in 0..turn {
                    table[place * long + k] = value(angle(k as i64, place));
                }
            }
            table
        };
        let [cos, sin, minus] = [
            along(&|(_, cos)| cos),
            along(&|(sin, _)| sin),
            along(&|(sin, _)| -sin),
        ];
        let forth = [beside(&cos, &minus, turn), beside(&sin, &cos, turn)];
        let scale = (turn as f64).powi(-(D as i32));
        let rows = self.lines();
        let rest = rows * long;
        let mut symbols = vec![0.0; self.slabs() * self.parts() * self.ways() * kernels * PAIR];
        let mut grids = vec![0.0; kernels * turn * rest];
        let mut values = vec![0.0; kernels];
        let (mut first, mut second) = (vec![0.0; 2 * rest], vec![0.0; rows * 2 * long]);
        let (mut turned, mut third) = (second.clone(), second.clone());
        for way in 0..self.ways() {
            let across = 2 * self.reach + 1;
            let sides: [i64; D] = std::array::from_fn(|axis| {
                let digit = way / across.pow((D - 1 - axis) as u32) % across;
                digit as i64 - self.reach as i64
            });
            for place in 0..turn.pow(D as u32) {
                let digits: [usize; D] =
                    std::array::from_fn(|axis| place / turn.pow((D - 1 - axis) as u32) % turn);
                let from: [i64; D] = std::array::from_fn(|axis| {
                    digits[axis] as i64 - last + sides[axis] * pitch as i64
                });
                kernel(from, &mut values);
                for (index, value) in values.iter().enumerate() {
                    let line = place / turn;
                    grids[index * turn * rest + line * long + digits[D - 1]] = value * scale;
                }
            }
            for slab in 0..self.slabs() {
                for (index, grid) in grids.chunks_exact(turn * rest).enumerate() {
                    let row = slab * turn..(slab + 1) * turn;
                    let wave = cosines[row.clone()].iter().copied();
                    let wave: Vec<f64> = wave.chain(sines[row].iter().map(|sin| -sin)).collect();
                    multiply(
                        self.arch,
                        [2, turn, rest],
                        (&wave, turn),
                        (grid, rest),
                        &mut first,
                        false,
                    );
                    for (part, table) in forth.iter().enumerate() {
                        let left = (&first[part * rest..], long);
                        multiply(
                            self.arch,
                            [rows, turn, 2 * long],
                            left,
                            (table, 2 * long),
                            &mut second,
                            part == 1,
                        );
                    }
                    if D == 3 {
                        let pairs = second.chunks_exact(2 * long);
                        for (row, turned) in pairs.zip(turned.chunks_exact_mut(2 * long)) {
                            turned[..long].copy_from_slice(&row[long..]);
                            turned[long..]
                                .iter_mut()
                                .zip(row)
                                .for_each(|(it, re)| *it = -re);
                        }
                        let shape = [rows, turn, 2 * long];
                        for (table, rows, add) in
                            [(&cosines, &second, false), (&sines, &turned, true)]
                        {
                            multiply(
                                self.arch,
                                shape,
                                (table, turn),
                                (rows, 2 * long),
                                &mut third,
                                add,
                            );
                        }
                        std::mem::swap(&mut second, &mut third);
                    }
                    for (line, row) in second.chunks_exact(2 * long).enumerate() {
                        for part in 0..long / LANES {
                            let at = (slab * self.parts() + line * long / LANES + part)
                                * self.ways()
                                + way;
                            let at = (at * kernels + index) * PAIR;
                            symbols[at..at + LANES].copy_from_slice(&row[part * LANES..][..LANES]);
                            symbols[at + LANES..at + PAIR]
                                .copy_from_slice(&row[long + part * LANES..][..LANES]);
                        }
                    }
                }
            }
        }
        symbols
    }
}

/// Two tables side by side, row by row; each has `columns` before its padding.
fn beside(left: &[f64], right: &[f64], columns: usize) -> Vec<f64> {
    let stride = padded(columns);
    let rows = left.chunks_exact(stride).zip(right.chunks_exact(stride));
    rows.flat_map(|(left, right)| left.iter().chain(right))
        .copied()
        .collect()
}

/// The products of spectra of some targets with those of their sources, summed.
struct Gather<'a> {
    channels: Channels,
    parts: usize,
    ways: usize,
    sources: &'a [&'a [(u32, u32)]],
    spectra: &'a [f64],
    symbols: &'a [f64],
    sums: &'a mut [f64],
}

impl WithSimd for Gather<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        // The numbers of channels are known to the compiler, so that sums stay in registers.
        match (self.channels.given, self.channels.wanted) {
            (1, 1) => self.run::<S, 1, 1>(simd),
            (1, 2) => self.run::<S, 1, 2>(simd),
            (1, 3) => self.run::<S, 1, 3>(simd),
            (3, 3) => self.run::<S, 3, 3>(simd),
            (4, 4) => self.run::<S, 4, 4>(simd),
            other => unreachable!("no law has channels {other:?}"),
        }
    }
}

impl Gather<'_> {
    /// G channels given, W wanted.
    #[inline(always)]
    fn run<S: Simd, const G: usize, const W: usize>(self, simd: S) {
        let lanes = S::F64_LANES;
        // Registers in half a pair.
        let half = LANES / lanes;
        let zero = simd.splat_f64s(0.0);
        let kernels = if G == W { 1 } else { W };
        let spectra = S::as_simd_f64s(self.spectra).0;
        let symbols = S::as_simd_f64s(self.symbols).0;
        let sums = S::as_mut_simd_f64s(self.sums).0;
        for part in 0..self.parts {
            for (target, sources) in self.sources.iter().enumerate() {
                for register in 0..half {
                    let mut re = [zero; W];
                    let mut im = [zero; W];
                    for &(source, way) in *sources {
                        let from = (source as usize * self.parts + part) * G * 2 * half + register;
                        let from = &spectra[from..][..(2 * G - 1) * half + 1];
                        let by = (part * self.ways + way as usize) * kernels * 2 * half + register;
                        let by = &symbols[by..][..(2 * kernels - 1) * half + 1];
                        for w in 0..W {
                            let (g, k) = if G == W { (w, 0) } else { (0, w) };
                            let (a, b) = (from[2 * g * half], from[(2 * g + 1) * half]);
                            let (c, d) = (by[2 * k * half], by[(2 * k + 1) * half]);
                            re[w] = simd.mul_add_e_f64s(a, c, re[w]);
                            im[w] = simd.mul_add_e_f64s(a, d, im[w]);
                            re[w] = simd.negate_mul_add_e_f64s(b, d, re[w]);
                            im[w] = simd.mul_add_e_f64s(b, c, im[w]);
                        }
                    }
                    let out = (target * self.parts + part) * W * 2 * half + register;
                    for w in 0..W {
                        sums[out + 2 * w * half] = re[w];
                        sums[out + (2 * w + 1) * half] = im[w];
                    }
                }
            }
        }
    }
}
