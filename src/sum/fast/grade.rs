//! How finely a kernel is to be interpolated between cells of a size.
//!
//! Nothing is assumed of kernels: how well so many nodes do is measured, on lines through pairs
//! of cells as near to each other as interpolation may be used for. Cells that are small against
//! the length of a smooth kernel then need no distance at all.

use super::gemm::LANES;
use super::lattice::Lattice;

/// Most nodes along an axis: with more, equally spaced ones lose to rounding what they gain.
const MOST: usize = 20;

/// How many nodes more than between distant cells are worth it to have no near cells at all.
const EXTRA: usize = 3;

/// A kernel, as far as interpolating it goes.
pub(super) struct Profile<'a> {
    /// The kernel by the square of the distance.
    pub kernel: &'a dyn Fn(f64) -> f64,
    /// Whether it is multiplied by the way from source to target.
    pub along: bool,
    /// What a pair's error may be at most, as a share of the kernel at its distance.
    pub error: f64,
    /// The least value that errors are measured by.
    pub floor: f64,
}

/// How sums between cells of one size are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Grade {
    /// Nodes along each axis.
    pub nodes: usize,
    /// Cells at most so many sides apart along each axis are too near for the nodes; nothing
    /// where no cells are.
    pub reach: Option<usize>,
}

impl Profile<'_> {
    /// The grade of cells of a side; nothing where interpolation does not do.
    pub fn grade(&self, side: f64) -> Option<Grade> {
        let apart = (1..3).find_map(|reach| {
            let nodes = self.nodes(side, &apart(reach))?;
            Some(Grade {
                nodes,
                reach: Some(reach),
            })
        })?;
        let anywhere = self.nodes(side, &anywhere());
        let anywhere = anywhere.filter(|nodes| *nodes <= apart.nodes + EXTRA);
        Some(anywhere.map_or(apart, |nodes| Grade { nodes, reach: None }))
    }

    /// The least number of nodes that do for all of some lines, if any does.
    fn nodes(&self, side: f64, lines: &[[f64; 2]]) -> Option<usize> {
        (Lattice::LEAST..=MOST).find(|&nodes| {
            let lattice = Lattice::new(nodes, side);
            let error = |line: &[f64; 2]| self.worst(&lattice, side / 2.0, line);
            lines.iter().all(|line| error(line) <= self.error)
        })
    }

    /// The largest error on a line through a cell, of half a side `half`, that passes a point in
    /// another at a distance; along the line that point lies `line[0]` half sides from the
    /// cell's middle, and `line[1]` off it.
    fn worst(&self, lattice: &Lattice, half: f64, line: &[f64; 2]) -> f64 {
        let nodes = lattice.nodes;
        let [along, off] = line.map(|length| length * half);
        // The kernel, and its greatest share in what is asked of it.
        let value = |x: f64| {
            let squared = (along - x) * (along - x) + off * off;
            let kernel = (self.kernel)(squared);
            match self.along {
                true => (
                    [kernel * (along - x), kernel * off],
                    kernel * squared.sqrt(),
                ),
                false => ([kernel, 0.0], kernel),
            }
        };
        let middle = (nodes - 1) as f64 / 2.0;
        let at_nodes: Vec<_> = (0..nodes)
            .map(|k| value((k as f64 - middle) * lattice.spacing).0)
            .collect();
        let mut weights = vec![[0.0; LANES]; nodes];
        let mut worst = 0.0f64;
        let steps = 4 * LANES;
        for step in (0..=steps).step_by(LANES) {
            let places: [f64; LANES] = std::array::from_fn(|lane| {
                half * (2.0 * ((step + lane).min(steps)) as f64 / steps as f64 - 1.0)
            });
            lattice.weights(&places, &mut weights);
            for (lane, &place) in places.iter().enumerate() {
                let (exact, scale) = value(place);
                for part in 0..2 {
                    let sum: f64 = (weights.iter().zip(&at_nodes))
                        .map(|(weights, value)| weights[lane] * value[part])
                        .sum();
                    let error = (sum - exact[part]).abs() / scale.abs().max(self.floor);
                    // What is no number is no good.
                    worst = if error > worst || error.is_nan() {
                        error
                    } else {
                        worst
                    };
                    if error.is_nan() {
                        return f64::INFINITY;
                    }
                }
            }
        }
        worst
    }
}

/// Lines to points in cells more than `reach` sides apart: beyond the cell's end, and past
/// it.
fn apart(reach: usize) -> Vec<[f64; 2]> {
    let gap = 2.0 * reach as f64;
    let beyond = [1.0, 2.0, 3.0, 5.0].map(|along| gap + along);
    let beyond = beyond
        .into_iter()
        .flat_map(|along| [0.0, 1.0, 2.0, 4.0].map(|off| [along, off]));
    let past = [0.0, 1.0, 2.0, 3.0]
        .into_iter()
        .flat_map(|along| [0.0, 1.0, 2.0].map(|off| [along, gap + off]));
    beyond.chain(past).collect()
}

/// Lines to points in any cells, the cell itself among them.
fn anywhere() -> Vec<[f64; 2]> {
    let alongs = [0.0, 0.3, 0.6, 1.0, 1.5, 2.0, 3.0, 5.0, 7.0];
    let offs = [0.0, 0.3, 0.6, 1.0, 2.0, 4.0, 6.0];
    let pairs = alongs
        .into_iter()
        .flat_map(|along| offs.map(|off| [along, off]));
    pairs.collect()
}
