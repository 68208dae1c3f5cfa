//! Sums over all pairs in a time that grows almost like the number of agents.
//!
//! # Method
//!
//! The agents are sorted into an adaptive tree of squares or cubes. What the agents of a cell
//! carry is handed to equally spaced nodes of that cell by the polynomials that interpolate
//! between them; cells that are far enough apart tell each other through their nodes, and nodes
//! hand on to agents by the same polynomials. Cells tell each other at the highest level at
//! which they are far enough apart; agents of cells that are nowhere far enough apart meet one by
//! one. This is the *black-box fast multipole method* of W. Fong and E. Darve, J. Comput. Phys.
//! 228, 2009, on equally spaced nodes, where sums between cells are convolutions that
//! Fourier's transform turns into products: P. Blanchard, O. Coulaud and E. Darve, "Fast
//! hierarchical algorithms for generating Gaussian random fields", Inria report 8811, 2015.
//!
//! Three things are our own.
//!
//! - How many nodes there are, and from which distance on they are used, is *measured* for the
//!   kernel at hand and cells of the size at hand. Cells that are small against the length of
//!   a smooth kernel need no distance at all: in a dense flock no two agents meet.
//! - All children of one cell tell all those of another at once, on the lattice that they have
//!   together; what children told that are too near is taken back. In space that is a third of
//!   the work of each child for itself.
//! - Nodes reach one spacing beyond their cell, which keeps high orders tame and costs less
//!   than it seems, as neighbours share those nodes.
//!
//! An attraction in proportion to the distance needs none of this: its sum is the number of
//! agents times the way to their mean.
//!
//! # Error
//!
//! The error of a sum Σ_j φ_ij c_j is its distance from the exact one over
//! Σ_j φ_ij |c_j| + φ(0) mean |c|: relative to what is summed, and where nobody is near, to what
//! a neighbour there would count for, shared out over all. What agents carry is taken
//! relative to its mean first, so differences of a flock that nearly agrees keep their digits.
//!
//! With the requested relative error ε, the root mean square of these errors over the agents of
//! a flock is at most ε. This is what sums are tested for, on even, dense and sparse flocks,
//! clusters, lines, strays, one agent apart and many at one place; it is no proof. An even
//! flock of 20,000 in space comes out fifty times as exact at 1e-6.
//!
//! What is held, measured at some places along each axis, is the error of each pair of agents,
//! wherever they lie in their cells: to ε in cells that tell themselves and their neighbours
//! through nodes, and to 100 ε in distant ones, or to 1 % where that is less and ε is not more.
//! So no single sum should be off by more than that, however the flock lies. It would take a
//! flock all of whose pairs lie in the worst places of the nearest of those cells: two clusters
//! alone, wherever they were put, came to less than ε. At the least ε, 1e-10, nodes are chosen
//! so that rounding stays below it too.
//!
//! # Bits
//!
//! They are the same on any number of threads: every number is summed by one thread in a fixed
//! order. They depend on the width of the processor's registers.
//!
//! # What else there is
//!
//! - *Fourier's transform of one grid* over all agents is as fast for dense flocks in a box,
//!   but a flock of N agents a length of the kernel apart, or one that has lost an agent, needs
//!   more grid than memory.
//! - *Treecodes* (Barnes and Hut; L. Wang, R. Krasny and S. Tlupova, Commun. Comput. Phys. 28,
//!   2020) sum each agent over clusters: simple, but each agent pays for each level of the
//!   tree.

mod agents;
mod convolution;
mod fold;
mod gemm;
mod grade;
mod grid;
mod kernel;
mod lattice;
mod level;
mod lists;
mod nearby;
mod passes;
mod products;
mod signs;
mod transform;
mod tree;

#[cfg(test)]
mod tests;

use pulp::Arch;

use crate::math::{Vector, mean};
use crate::sum::Sums;

use convolution::Channels;
use grade::{Grade, Profile};
use level::Level;
use lists::near;
use passes::{Nodes, Passes};
use tree::Tree;

pub use kernel::Kernel;

/// Most levels of a tree: what a number can tell apart.
const DEEPEST: usize = 60;

/// Steps to each doubling of a flock's extent.
const STEPS: f64 = 16.0;

/// The agents that a leaf should hold: as many as cost about as much to meet one by one as the
/// nodes cost that are saved.
const fn crowd<const D: usize>() -> f64 {
    if D == 2 { 80.0 } else { 180.0 }
}

/// Fast sums over all pairs, to a relative error; see the module. What it makes for one flock it
/// keeps for the next that is about as large.
#[derive(Debug, Clone)]
pub struct FastSums<const D: usize> {
    /// What is bounded of the kernel, and the factor of the way that comes on top.
    kernel: Option<Kernel>,
    factor: f64,
    error: f64,
    peak: f64,
    tree: Tree<D>,
    levels: Vec<Level<D>>,
    /// Grades of sides, for so many agents.
    grades: Vec<(f64, Option<Grade>)>,
    count: usize,
    nodes: Nodes,
    rows: Vec<Vec<f64>>,
    sorted: Vec<f64>,
}

impl<const D: usize> FastSums<D> {
    /// From so many agents on these sums are clearly faster than direct ones at a relative error
    /// of 1e-6, of a kernel that is quick to sum directly: about three times in the plane, and
    /// two and a half times in space.
    pub const CROSSOVER: usize = if D == 2 { 10_000 } else { 30_000 };

    /// Sums of a kernel to a relative error from 1e-10, where rounding shows, to 0.1; nothing
    /// where the kernel is not [smooth](Kernel::is_smooth).
    pub fn new(kernel: Kernel, relative_error: f64) -> Option<Self> {
        let (kernel, factor) = kernel.parts()?;
        Some(Self {
            peak: kernel.as_ref().map_or(0.0, Kernel::peak),
            kernel,
            factor,
            error: relative_error,
            tree: Tree::default(),
            levels: Vec::new(),
            grades: Vec::new(),
            count: 0,
            nodes: Nodes::default(),
            rows: Vec::new(),
            sorted: Vec::new(),
        })
    }

    /// Writes the sums at all points, over all others, by where they are and what they carry: for
    /// an influence both sums, for a force that over the positions, whatever is carried, and no
    /// weight. Returns whether it could: not where nodes do for no distance, or where
    /// there are no two places.
    pub fn run(
        &mut self,
        positions: &[Vector<D>],
        carried: &[Vector<D>],
        sums: &mut Vec<Sums<D>>,
    ) -> bool {
        let Some(kernel) = self.kernel.clone() else {
            sums.clear();
            sums.resize(positions.len(), nothing());
            add_linear(self.factor, positions, sums);
            return true;
        };
        let along = kernel.along();
        let channels = Channels {
            given: if along { 1 } else { D + 1 },
            wanted: if along { D } else { D + 1 },
            kernels: if along { D } else { 1 },
        };
        if !self.plan(&kernel, positions, channels) {
            return false;
        }
        let Self {
            tree, levels, rows, ..
        } = self;
        let middle = mean(carried);
        let order = || tree.order.iter().map(|&agent| agent as usize);
        rows.resize_with(D + channels.given, Vec::new);
        for (index, row) in rows.iter_mut().enumerate() {
            row.clear();
            match index {
                axis if axis < D => row.extend(order().map(|agent| positions[agent][axis])),
                ones if ones == D => row.resize(positions.len(), 1.0),
                _ => {
                    let axis = index - D - 1;
                    row.extend(order().map(|agent| carried[agent][axis] - middle[axis]));
                }
            }
        }
        self.sorted.clear();
        self.sorted.resize(positions.len() * channels.wanted, 0.0);
        let near = near(tree, |level| levels[level - 1].grade.reach);
        let passes = Passes {
            arch: Arch::new(),
            kernel: &kernel,
            channels,
            tree,
            levels: &levels[..tree.levels.len() - 1],
            near: &near,
            rows,
        };
        passes.run(&mut self.nodes, &mut self.sorted);
        sums.clear();
        sums.resize(positions.len(), nothing());
        let found = self.sorted.chunks_exact(channels.wanted);
        for (&agent, found) in tree.order.iter().zip(found) {
            let agent = agent as usize;
            sums[agent] = if along {
                Sums {
                    weight: 0.0,
                    drive: Vector::from_fn(|axis, _| -found[axis]),
                }
            } else {
                // The agent itself is in the sums: it tells itself nothing.
                let own = carried[agent] - middle;
                Sums {
                    weight: found[0] - self.peak,
                    drive: Vector::from_fn(|axis, _| found[axis + 1] - own[axis] * found[0]),
                }
            };
        }
        if self.factor != 0.0 {
            add_linear(self.factor, positions, sums);
        }
        true
    }

    /// Sorts the agents into a tree, and makes its levels ready.
    fn plan(&mut self, kernel: &Kernel, positions: &[Vector<D>], channels: Channels) -> bool {
        let Some(first) = positions.first() else {
            return false;
        };
        let [low, high] = positions
            .iter()
            .fold([*first; 2], |[low, high], x| [low.inf(x), high.sup(x)]);
        let longest = (high - low).amax();
        if !(longest.is_normal() && longest < 1e150) {
            return false;
        }
        let count = positions.len();
        if count != self.count {
            // What counts as nothing depends on it.
            self.count = count;
            self.grades.clear();
            self.levels.clear();
        }
        let root = root_side((high - low).map(|side| side / longest), longest, count);
        let Self {
            grades,
            levels,
            tree,
            ..
        } = self;
        let profile = Profile {
            kernel: &|squared| kernel.value(squared),
            along: kernel.along(),
            strongest: kernel.largest()[0],
            error: self.error,
            floor: 0.1 * self.peak / count as f64,
        };
        let mut last = 0;
        let mut wanted = Vec::new();
        while last < DEEPEST {
            last += 1;
            let side = root * 0.5f64.powi(last as i32);
            let grade = match grades.iter().find(|(known, _)| *known == side) {
                Some((_, grade)) => *grade,
                None => {
                    let grade = profile.grade(side, D as i32);
                    grades.push((side, grade));
                    grade
                }
            };
            let Some(grade) = grade else {
                return false;
            };
            wanted.push((side, grade));
            if grade.reach.is_none() {
                break;
            }
        }
        let corner = (low + high) / 2.0 - Vector::repeat(root / 2.0);
        let most = (2.0 * crowd::<D>()) as usize;
        tree.rebuild(positions, corner.into(), root, most, last);
        wanted.truncate(tree.levels.len() - 1);
        let known = wanted.iter().zip(levels.iter());
        let kept = known
            .take_while(|((side, _), level)| *side == level.side)
            .count();
        levels.truncate(if kept == wanted.len() {
            levels.len()
        } else {
            kept
        });
        for &(side, grade) in &wanted[levels.len().min(wanted.len())..] {
            levels.push(Level::new(&profile, channels, side, grade, levels.last()));
        }
        true
    }
}

fn nothing<const D: usize>() -> Sums<D> {
    Sums {
        weight: 0.0,
        drive: Vector::zeros(),
    }
}

/// Adds Σ_j (x_j − x_i) times a factor: the number of agents times the way to their mean.
fn add_linear<const D: usize>(factor: f64, positions: &[Vector<D>], sums: &mut [Sums<D>]) {
    let middle = mean(positions);
    let factor = factor * positions.len() as f64;
    for (sums, position) in sums.iter_mut().zip(positions) {
        sums.drive += (middle - position) * factor;
    }
}

/// The side of a root whose leaves would hold as many agents as they should, if the agents
/// filled the box that they lie in evenly. Leaves fit that box, an even number of them along its
/// longest side, for cells meet in its middle; but that side counts in steps, so that a flock
/// that swells does not ask for new levels each time. `shape` is the box over its longest side.
fn root_side<const D: usize>(shape: Vector<D>, longest: f64, count: usize) -> f64 {
    // Rounding must not leave anyone outside.
    let longest = libm::exp2((STEPS * libm::log2(longest * (1.0 + 1e-9))).ceil() / STEPS);
    let filled: f64 = shape.iter().map(|side| side.max(1e-3)).product();
    let share = libm::pow(crowd::<D>() * filled / count as f64, 1.0 / D as f64).min(1.0);
    let leaves = 2.0 * (0.5 / share).round().max(1.0);
    longest / leaves * libm::exp2(libm::log2(leaves).ceil())
}
