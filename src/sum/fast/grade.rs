//! How finely a kernel is to be interpolated between cells of a size.
//!
//! Nothing is assumed of kernels: how well so many nodes do is measured, on pairs of lines
//! through cells as near to each other as interpolation may be used for, with nodes on both.
//! Cells that are small against the length of a smooth kernel then need no distance at all.

use super::gemm::LANES;
use super::lattice::Lattice;

/// Most nodes along an axis.
const MOST: usize = 20;

/// Most sides that cells may have to be apart.
const FARTHEST: usize = 3;

/// How many nodes more than between distant cells are worth it to have no near cells at all.
const EXTRA: usize = 3;

/// How far a pair of agents in distant cells may be off, over what sums may be: places where
/// interpolation is at its worst are few, its errors elsewhere are less and of either sign, and
/// agents nearby, that count for more, have none.
const PAIR: f64 = 100.0;

/// The most that such a pair may be off by, but where more is asked for of sums: there are
/// flocks of a few points.
const COARSEST: f64 = 0.01;

/// How far such a pair may be off, by what sums may be.
pub(super) fn of_pair(error: f64) -> f64 {
    (PAIR * error).min(COARSEST).max(error)
}

/// The share of the error that one axis may have: those of several add up, though they are
/// hardly ever at their largest together.
const SHARE: f64 = 0.7;

/// Places of agents along a line. Those between the ends are never nodes, for one less is a
/// prime number larger than any pitch.
const PLACES: usize = 3 * LANES;

/// A kernel, as far as interpolating it goes.
pub(super) struct Profile<'a> {
    /// The kernel by the square of the distance.
    pub kernel: &'a dyn Fn(f64) -> f64,
    /// Whether it is multiplied by the way from source to target.
    pub along: bool,
    /// The distance at which it counts for most.
    pub strongest: f64,
    /// What the error of a sum should be at most, as a share of the kernel's.
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

/// Two parallel lines through cells, along an axis: how far the middles of the cells are apart
/// along it, and the lines across it, in half sides.
type Lines = [f64; 2];

impl Profile<'_> {
    /// The grade of cells of a side, of so many axes; nothing where interpolation does not do.
    pub fn grade(&self, side: f64, axes: i32) -> Option<Grade> {
        let pair = of_pair(self.error);
        let apart = (1..=FARTHEST).find_map(|reach| {
            let nodes = self.nodes(side, axes, &apart(reach), pair)?;
            Some(Grade {
                nodes,
                reach: Some(reach),
            })
        })?;
        // Lines that lie by the cell's size would miss a kernel that is far narrower.
        let mut lines = anywhere();
        lines.push([0.0, self.strongest / (side / 2.0)]);
        // A tight flock is one cell's alone: all of its pairs may lie in the worst places.
        let anywhere = self.nodes(side, axes, &lines, self.error);
        let anywhere = anywhere.filter(|nodes| *nodes <= apart.nodes + EXTRA);
        Some(anywhere.map_or(apart, |nodes| Grade { nodes, reach: None }))
    }

    /// The least number of nodes that interpolate along all of some lines to an error, if any
    /// does.
    fn nodes(&self, side: f64, axes: i32, lines: &[Lines], error: f64) -> Option<usize> {
        (Lattice::LEAST..=MOST).find(|&nodes| {
            let lattice = Lattice::new(nodes, side);
            let weights = Weights::new(&lattice, side / 2.0);
            // What rounding comes to when it is as large as it can be along one line, and has
            // no common sign along others.
            let rounding = f64::EPSILON * weights.sum().powi(2 * axes - 1);
            let most = SHARE * error - rounding;
            let worst = |lines: &Lines| self.worst(&weights, lattice.spacing, side / 2.0, lines);
            rounding < SHARE * self.error && lines.iter().all(|lines| worst(lines) <= most)
        })
    }

    /// The largest error of pairs of agents on two lines, in cells of half a side `half`.
    fn worst(&self, weights: &Weights, spacing: f64, half: f64, lines: &Lines) -> f64 {
        let [along, off] = lines.map(|length| length * half);
        let Weights { nodes, rows } = weights;
        // The parts of the kernel, and the greatest share in what is asked of it.
        let value = |way: f64| {
            let way = along + way;
            let squared = way * way + off * off;
            let kernel = (self.kernel)(squared);
            match self.along {
                true => ([kernel * way, kernel * off], kernel * squared.sqrt()),
                false => ([kernel, 0.0], kernel),
            }
        };
        let between = |count: usize, spacing: f64| -> Vec<_> {
            let last = count as f64 - 1.0;
            (0..2 * count - 1)
                .map(|k| value((k as f64 - last) * spacing))
                .collect()
        };
        let at_nodes = between(*nodes, spacing);
        let exact = between(PLACES, 2.0 * half / (PLACES - 1) as f64);
        let mut worst = 0.0f64;
        for part in 0..if self.along { 2 } else { 1 } {
            // From all places to each node, then to all places.
            let told: Vec<[f64; PLACES]> = (0..*nodes)
                .map(|node| {
                    let mut told = [0.0; PLACES];
                    for (other, row) in rows.iter().enumerate() {
                        let value = at_nodes[node + nodes - 1 - other].0[part];
                        for (told, weight) in told.iter_mut().zip(row) {
                            *told += value * weight;
                        }
                    }
                    told
                })
                .collect();
            for place in 0..PLACES {
                let mut sums = [0.0; PLACES];
                for (row, told) in rows.iter().zip(&told) {
                    for (sum, told) in sums.iter_mut().zip(told) {
                        *sum += row[place] * told;
                    }
                }
                for (other, sum) in sums.iter().enumerate() {
                    let (exact, scale) = exact[place + PLACES - 1 - other];
                    let error = (sum - exact[part]).abs() / scale.abs().max(self.floor);
                    // What is no number is no good.
                    if error.is_nan() {
                        return f64::INFINITY;
                    }
                    worst = worst.max(error);
                }
            }
        }
        worst
    }
}

/// Interpolation weights of places from one end of a line through a cell to the other.
struct Weights {
    nodes: usize,
    /// By node, then by place.
    rows: Vec<[f64; PLACES]>,
}

impl Weights {
    fn new(lattice: &Lattice, half: f64) -> Self {
        let mut rows = vec![[0.0; PLACES]; lattice.nodes];
        let mut some = vec![[0.0; LANES]; lattice.nodes];
        for first in (0..PLACES).step_by(LANES) {
            let places = std::array::from_fn(|lane| {
                half * (2.0 * (first + lane) as f64 / (PLACES - 1) as f64 - 1.0)
            });
            lattice.weights(&places, &mut some);
            for (row, some) in rows.iter_mut().zip(&some) {
                row[first..first + LANES].copy_from_slice(some);
            }
        }
        Self {
            nodes: lattice.nodes,
            rows,
        }
    }

    /// The largest sum of weights without their signs.
    fn sum(&self) -> f64 {
        let of = |place: usize| self.rows.iter().map(|row| row[place].abs()).sum();
        (0..PLACES).map(of).fold(0.0, f64::max)
    }
}

/// Lines through cells more than `reach` sides apart: along the axis in which they are, and
/// across it.
fn apart(reach: usize) -> Vec<Lines> {
    let gap = 2.0 * reach as f64;
    let along = [2.0, 4.0]
        .into_iter()
        .flat_map(|more| [0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0].map(|off| [gap + more, off]));
    let across = (0..=reach)
        .flat_map(|sides| [0.0, 0.3, 1.0, 2.0].map(|off| [2.0 * sides as f64, gap + off]));
    along.chain(across).collect()
}

/// Lines through any cells.
fn anywhere() -> Vec<Lines> {
    let alongs = [0.0, 2.0, 4.0, 6.0];
    let offs = [0.0, 0.3, 0.6, 1.0, 1.5, 2.0, 3.0, 5.0];
    let lines = alongs
        .into_iter()
        .flat_map(|along| offs.map(|off| [along, off]));
    lines.collect()
}
