//! Sums between the nodes of cells, by Fourier's transform.
//!
//! Between two cells that are some whole number of sides apart, what the nodes of one are told
//! by those of the other is a convolution, since nodes form one lattice. With room for one
//! turn around it is a product of spectra, one for each frequency.

use pulp::Arch;

use super::fold::fold;
use super::gemm::{LANES, padded};
use super::products::{Gather, PAIR};
use super::transform::{Scratch, Transform};

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
    pub nodes: usize,
    transform: Transform<D>,
    /// How many sides apart cells may be along an axis.
    reach: usize,
    /// The kernels' spectra, by slab, then by frequencies, then by how cells lie.
    symbols: Vec<f64>,
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
        // Nodes are up to so many places apart, either way.
        let turn = 2 * nodes - 1;
        let mut convolution = Self {
            arch: Arch::new(),
            channels,
            nodes,
            transform: Transform::new(nodes, turn, nodes),
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
        self.transform.slabs()
    }

    /// Registers' worths of frequencies of a slab.
    fn parts(&self) -> usize {
        padded(self.transform.slab()) / LANES
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

    /// Writes a slab of a source's spectrum, by its folded numbers.
    pub fn forward(
        &self,
        slab: usize,
        values: &[f64],
        spectrum: &mut [f64],
        scratch: &mut Scratch,
    ) {
        let given = self.channels.given;
        for (channel, values) in values.chunks_exact(self.grid()).enumerate() {
            self.transform.forward(slab, values, scratch);
            let blocks = (channel..).step_by(given).take(self.parts());
            let places = blocks.map(|block| block * PAIR);
            write(&scratch.slab, spectrum, places);
        }
    }

    /// Adds to the values at the nodes of some targets, halves of sums and differences, what
    /// their sources tell them, one slab of it. `sources` are, for each target, those sources'
    /// places in `spectra` and the ways in which they lie; `values` are the targets', one after
    /// another; `sums` is worked in.
    pub fn back(
        &self,
        slab: usize,
        sources: &[&[(u32, u32)]],
        spectra: &[f64],
        values: &mut [f64],
        (sums, scratch): (&mut Vec<f64>, &mut Scratch),
    ) {
        sums.resize(sources.len() * self.slab_wanted(), 0.0);
        let symbols = self.symbols.len() / self.slabs();
        self.arch.dispatch(Gather {
            channels: self.channels,
            parts: self.parts(),
            ways: self.ways(),
            sources,
            spectra,
            symbols: &self.symbols[slab * symbols..][..symbols],
            sums,
        });
        let wanted = self.channels.wanted;
        let of_cell = values.chunks_exact_mut(self.grid() * wanted);
        for (sums, values) in sums.chunks_exact(self.slab_wanted()).zip(of_cell) {
            for (channel, values) in values.chunks_exact_mut(self.grid()).enumerate() {
                let [re, im] = &mut scratch.slab;
                for parts in [&mut *re, &mut *im] {
                    parts.resize(parts.len().max(self.parts() * LANES), 0.0);
                }
                let blocks = sums.chunks_exact(PAIR).skip(channel).step_by(wanted);
                let parts = re.chunks_exact_mut(LANES).zip(im.chunks_exact_mut(LANES));
                for (block, (re, im)) in blocks.zip(parts) {
                    re.copy_from_slice(&block[..LANES]);
                    im.copy_from_slice(&block[LANES..]);
                }
                self.transform.inverse(slab, values, scratch);
            }
        }
    }

    /// The kernels' spectra for all ways in which cells may lie.
    fn transformed(&self, pitch: usize, kernel: impl Fn([i64; D], &mut [f64])) -> Vec<f64> {
        let kernels = self.channels.kernels;
        let turn = 2 * self.nodes - 1;
        let transform = Transform::<D>::new(turn, turn, self.nodes);
        let row = padded(turn);
        let scale = (turn as f64).powi(-(D as i32));
        let mut symbols = vec![0.0; self.slabs() * self.parts() * self.ways() * kernels * PAIR];
        let mut grids = vec![0.0; kernels * turn.pow(D as u32 - 1) * row];
        let size = grids.len() / kernels;
        let mut values = vec![0.0; kernels];
        let mut scratch = Scratch::default();
        for way in 0..self.ways() {
            let across = 2 * self.reach + 1;
            let sides: [i64; D] = std::array::from_fn(|axis| {
                let digit = way / across.pow((D - 1 - axis) as u32) % across;
                digit as i64 - self.reach as i64
            });
            for place in 0..turn.pow(D as u32) {
                let from: [i64; D] = std::array::from_fn(|axis| {
                    let digit = place / turn.pow((D - 1 - axis) as u32) % turn;
                    digit as i64 - (self.nodes as i64 - 1) + sides[axis] * pitch as i64
                });
                kernel(from, &mut values);
                for (grid, value) in grids.chunks_exact_mut(size).zip(&values) {
                    grid[place / turn * row + place % turn] = value * scale;
                }
            }
            for (index, grid) in grids.chunks_exact_mut(size).enumerate() {
                fold::<D>(turn, grid);
                for slab in 0..self.slabs() {
                    transform.forward(slab, grid, &mut scratch);
                    let first = slab * self.parts() * self.ways() + way;
                    let blocks = (first..).step_by(self.ways()).take(self.parts());
                    let places = blocks.map(|block| (block * kernels + index) * PAIR);
                    write(&scratch.slab, &mut symbols, places);
                }
            }
        }
        symbols
    }
}

/// Writes a slab, register by register, to some places.
fn write([re, im]: &[Vec<f64>; 2], out: &mut [f64], places: impl Iterator<Item = usize>) {
    let parts = re.chunks_exact(LANES).zip(im.chunks_exact(LANES));
    for ((re, im), at) in parts.zip(places) {
        out[at..at + LANES].copy_from_slice(re);
        out[at + LANES..at + PAIR].copy_from_slice(im);
    }
}
