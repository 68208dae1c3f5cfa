//! What is done between the cells of one size.

use rayon::prelude::*;

use super::convolution::{Channels, Convolution};
use super::fold::{fold, unfold};
use super::grade::{Grade, Profile};
use super::grid::Change;
use super::lattice::Lattice;
use super::lists::Lists;
use super::transform::Scratch;

/// Targets that are worked on at once: near each other, they share their sources.
const GROUP: usize = 8;

/// The nodes of cells of one side, and what they tell each other.
#[derive(Debug, Clone)]
pub(super) struct Level<const D: usize> {
    pub side: f64,
    pub grade: Grade,
    pub lattice: Lattice,
    /// From all children of one cell to all those of another.
    pub siblings: Convolution<D>,
    /// The same between two children that are too near for that, with the other sign; absent
    /// where none are.
    pub near: Option<Convolution<D>>,
    /// From all children of one cell to its own nodes and back; absent below the root, which
    /// has none.
    pub changes: Option<[Change; 2]>,
}

impl<const D: usize> Level<D> {
    /// The level below `above`, or the first.
    pub fn new(
        profile: &Profile<'_>,
        channels: Channels,
        side: f64,
        grade: Grade,
        above: Option<&Self>,
    ) -> Self {
        // Without a level above there is the root alone.
        let reach_above = above.and_then(|above| above.grade.reach).unwrap_or(0);
        let lattice = Lattice::new(grade.nodes, side);
        let (pitch, siblings) = (lattice.pitch(), lattice.of_siblings());
        let reach = grade.reach.unwrap_or(0);
        // As far as any two nodes lie apart, in spacings.
        let far = (siblings + 2 * pitch * reach_above).max(grade.nodes + pitch * reach);
        let square = lattice.spacing * lattice.spacing;
        let table: Vec<f64> = (0..=D * far * far)
            .map(|squared| match (profile.kernel)(squared as f64 * square) {
                value if value.is_finite() => value,
                // Between near nodes only, whose sums are taken back.
                _ => 0.0,
            })
            .collect();
        let kernel = |sign: f64| {
            let (table, spacing) = (&table, lattice.spacing);
            move |way: [i64; D], values: &mut [f64]| {
                let squared: i64 = way.iter().map(|part| part * part).sum();
                let value = sign * table[squared as usize];
                match profile.along {
                    true => (values.iter_mut().zip(way))
                        .for_each(|(it, part)| *it = value * part as f64 * spacing),
                    false => values[0] = value,
                }
            }
        };
        Self {
            side,
            grade,
            siblings: Convolution::new(siblings, 2 * pitch, reach_above, channels, kernel(1.0)),
            near: grade
                .reach
                .map(|reach| Convolution::new(grade.nodes, pitch, reach, channels, kernel(-1.0))),
            changes: above.map(|above| {
                [
                    Change::up(&lattice, &above.lattice),
                    Change::down(&above.lattice, &lattice),
                ]
            }),
            lattice,
        }
    }
}

/// Writes to the nodes of some cells what others tell them: `sources` has a list for each cell
/// of those it hears and the ways in which they lie. What is given is folded on the way, and
/// comes back but for rounding.
pub(super) fn tell<const D: usize>(
    convolution: &Convolution<D>,
    given: &mut [f64],
    sources: &Lists<(u32, u32)>,
    spectra: &mut Vec<f64>,
    wanted: &mut [f64],
) {
    let cells = sources.len();
    let nodes = convolution.nodes;
    let (given_of_one, wanted_of_one) = (given.len() / cells, wanted.len() / cells);
    let size = convolution.slab_given();
    // Not cleared: every number is written before it is read.
    spectra.resize(cells * size, 0.0);
    given
        .par_chunks_exact_mut(given_of_one)
        .for_each(|given| fold::<D>(nodes, given));
    for slab in 0..convolution.slabs() {
        (spectra
            .par_chunks_exact_mut(size)
            .zip(given.par_chunks_exact(given_of_one)))
        .for_each_init(Scratch::default, |scratch, (spectrum, given)| {
            convolution.forward(slab, given, spectrum, scratch)
        });
        let groups = wanted.par_chunks_mut(GROUP * wanted_of_one);
        groups.enumerate().for_each_init(
            <(Vec<f64>, Scratch)>::default,
            |(sums, scratch), (group, wanted)| {
                let first = group * GROUP;
                let last = cells.min(first + GROUP);
                let lists: Vec<_> = (first..last).map(|cell| sources.of(cell)).collect();
                convolution.back(slab, &lists, spectra, wanted, (sums, scratch));
            },
        );
    }
    given
        .par_chunks_exact_mut(given_of_one)
        .for_each(|given| unfold::<D>(nodes, given, 0.5));
    wanted
        .par_chunks_exact_mut(wanted_of_one)
        .for_each(|wanted| unfold::<D>(nodes, wanted, 1.0));
}
