//! Sums over all pairs in a time that grows almost like the number of agents.

mod agents;
mod convolution;
mod gemm;
mod grade;
mod lattice;
mod level;
mod lists;
mod tree;

use pulp::Arch;
use rayon::prelude::*;

use crate::math::Vector;

use agents::Exchange;
use convolution::Channels;
use gemm::{multiply, padded};
use grade::{Grade, Profile};
use level::{Level, tell};
use lists::{Lists, near};
use tree::Tree;

/// Agents that a leaf should hold, in the plane and in space.
fn crowd<const D: usize>() -> f64 {
    let read = |name: &str, default| {
        std::env::var(name)
            .ok()
            .and_then(|it| it.parse().ok())
            .unwrap_or(default)
    };
    if D == 2 {
        read("CROWD", 40.0)
    } else {
        read("CROWD", 150.0)
    }
}

/// Fast sums.
pub struct FastSums<const D: usize> {
    kernel: Box<dyn Fn(f64) -> f64 + Send + Sync>,
    along: bool,
    peak: f64,
    error: f64,
    arch: Arch,
    tree: Tree<D>,
    levels: Vec<Level<D>>,
}

impl<const D: usize> FastSums<D> {
    /// Sums of a kernel.
    pub fn new(
        kernel: impl Fn(f64) -> f64 + Send + Sync + 'static,
        along: bool,
        error: f64,
    ) -> Self {
        let peak = if along {
            (-400..400)
                .map(|k| {
                    let r = 2f64.powf(f64::from(k) / 4.0);
                    (kernel(r * r) * r).abs()
                })
                .fold(0.0, f64::max)
        } else {
            kernel(0.0)
        };
        Self {
            kernel: Box::new(kernel),
            along,
            peak,
            error,
            arch: Arch::new(),
            tree: Tree::default(),
            levels: Vec::new(),
        }
    }

    /// The sums.
    pub fn sums(
        &mut self,
        positions: &[Vector<D>],
        given: &[Vec<f64>],
        wanted: &mut [Vec<f64>],
    ) -> bool {
        let channels = Channels {
            given: given.len(),
            wanted: wanted.len(),
            kernels: if self.along { D } else { 1 },
        };
        let clock = std::time::Instant::now();
        let trace = std::env::var("TRACE").is_ok();
        let tick = |name: &str| {
            if trace {
                eprintln!("{name}: {:.1} ms", clock.elapsed().as_secs_f64() * 1e3);
            }
        };
        if !self.grow(positions, channels) {
            return false;
        }
        tick("tree+levels");
        let Self {
            tree, levels, arch, ..
        } = self;
        let near = near(tree, |level| levels[level - 1].grade.reach);
        let order = &tree.order;
        let places: [Vec<f64>; D] = std::array::from_fn(|axis| {
            order.iter().map(|&i| positions[i as usize][axis]).collect()
        });
        let sorted: Vec<Vec<f64>> = given
            .iter()
            .map(|given| order.iter().map(|&i| given[i as usize]).collect())
            .collect();
        tick("lists");
        // Upwards.
        let mut from_below: Vec<f64> = Vec::new();
        let mut local: Vec<[Vec<f64>; 2]> = Vec::new();
        let mut spectra = Vec::new();
        for index in (1..tree.levels.len()).rev() {
            let level = &levels[index - 1];
            let cells = &tree.levels[index];
            let lattice = &level.lattice;
            let size = grid::<D>(lattice.nodes);
            let below = levels.get(index).filter(|_| index + 1 < tree.levels.len());
            let up = below.map(|below| {
                let matrix = lattice.to_children(&below.lattice);
                (
                    transposed(&matrix, below.lattice.of_siblings(), lattice.nodes),
                    below,
                )
            });
            let mut values = vec![0.0; cells.len() * channels.given * size];
            values
                .par_chunks_exact_mut(channels.given * size)
                .zip(cells)
                .for_each_init(Exchange::default, |exchange, (values, cell)| {
                    if cell.is_leaf() {
                        let range = cell.agents.clone();
                        let centre = tree.centre(index, cell);
                        let here: [&[f64]; D] =
                            std::array::from_fn(|axis| &places[axis][range.clone()]);
                        let given: Vec<&[f64]> =
                            sorted.iter().map(|given| &given[range.clone()]).collect();
                        exchange.gather(*arch, lattice, &centre, here, &given, values);
                    } else if let Some((matrix, below)) = &up {
                        let fine = below.lattice.of_siblings();
                        let fine_size = grid::<D>(fine);
                        let from = &from_below[cell.branch * channels.given * fine_size..];
                        for c in 0..channels.given {
                            change::<D>(
                                *arch,
                                matrix,
                                [lattice.nodes, fine],
                                &from[c * fine_size..][..fine_size],
                                &mut values[c * size..][..size],
                            );
                        }
                    }
                });
            // Siblings together.
            let parents = &tree.levels[index - 1];
            let branches: Vec<_> = parents
                .iter()
                .enumerate()
                .filter(|(_, cell)| !cell.is_leaf())
                .collect();
            let fine = lattice.of_siblings();
            let fine_size = grid::<D>(fine);
            let mut together = vec![0.0; branches.len() * channels.given * fine_size];
            together
                .par_chunks_exact_mut(channels.given * fine_size)
                .zip(&branches)
                .for_each(|(together, (_, parent))| {
                    for child in parent.children.clone() {
                        for c in 0..channels.given {
                            let from = &values[(child * channels.given + c) * size..][..size];
                            let to = &mut together[c * fine_size..][..fine_size];
                            overlay::<D>(
                                lattice.nodes,
                                fine,
                                corner(&cells[child].at, lattice.pitch()),
                                |small, large| {
                                    to[large.clone()]
                                        .iter_mut()
                                        .zip(&from[small])
                                        .for_each(|(to, from)| *to += from);
                                },
                            );
                        }
                    }
                });
            // What they tell each other.
            let reach = level.grade.reach;
            let all_near = |sides: &[i64; D]| {
                let far = sides
                    .iter()
                    .map(|side| side.unsigned_abs() as usize)
                    .max()
                    .unwrap_or(0);
                reach.is_some_and(|reach| 2 * far + 1 <= reach)
            };
            let mut lists = Lists::default();
            for (place, _) in &branches {
                for near in near[index - 1].of(*place) {
                    let other = &parents[near.cell as usize];
                    if !other.is_leaf() && !all_near(&near.sides) {
                        lists.push((other.branch as u32, level.siblings.way(near.sides)));
                    }
                }
                lists.end();
            }
            let mut fine_local = vec![0.0; branches.len() * channels.wanted * fine_size];
            tick(&format!(
                "level {index} up, cells {} nodes {:?}",
                cells.len(),
                level.grade
            ));
            tell(
                &level.siblings,
                &together,
                &lists,
                &mut spectra,
                &mut fine_local,
            );
            tick("  siblings");
            let mut coarse_local = vec![0.0; cells.len() * channels.wanted * size];
            if let Some(convolution) = &level.near {
                let mut lists = Lists::default();
                for (place, cell) in cells.iter().enumerate() {
                    for near in near[index].of(place) {
                        let other = &cells[near.cell as usize];
                        let sides = std::array::from_fn(|axis| {
                            parents[cell.parent].at[axis] - parents[other.parent].at[axis]
                        });
                        if !all_near(&sides) {
                            lists.push((near.cell, convolution.way(near.sides)));
                        }
                    }
                    lists.end();
                }
                tell(
                    convolution,
                    &values,
                    &lists,
                    &mut spectra,
                    &mut coarse_local,
                );
            }
            tick("  near");
            local.push([fine_local, coarse_local]);
            from_below = together;
        }
        local.reverse();
        tick("up");
        // Downwards.
        for index in 1..tree.levels.len() {
            let level = &levels[index - 1];
            let (cells, parents) = (&tree.levels[index], &tree.levels[index - 1]);
            let lattice = &level.lattice;
            let size = grid::<D>(lattice.nodes);
            let fine = lattice.of_siblings();
            let fine_size = grid::<D>(fine);
            let (above, here) = local.split_at_mut(index - 1);
            let [fine_local, coarse_local] = &mut here[0];
            if let Some([_, above]) = above.last() {
                let coarse = &levels[index - 2].lattice;
                let nodes = coarse.nodes;
                let matrix = coarse.to_children(lattice);
                let matrix = packed(&matrix, fine, nodes);
                let branches: Vec<_> = (parents.iter().enumerate())
                    .filter(|(_, cell)| !cell.is_leaf())
                    .collect();
                fine_local
                    .par_chunks_exact_mut(channels.wanted * fine_size)
                    .zip(branches)
                    .for_each(|(local, (place, _))| {
                        let from_size = grid::<D>(nodes);
                        for c in 0..channels.wanted {
                            let from =
                                &above[(place * channels.wanted + c) * from_size..][..from_size];
                            change::<D>(
                                *arch,
                                &matrix,
                                [fine, nodes],
                                from,
                                &mut local[c * fine_size..][..fine_size],
                            );
                        }
                    });
            }
            coarse_local
                .par_chunks_exact_mut(channels.wanted * size)
                .zip(cells)
                .for_each(|(local, cell)| {
                    let branch = parents[cell.parent].branch;
                    for c in 0..channels.wanted {
                        let from =
                            &fine_local[(branch * channels.wanted + c) * fine_size..][..fine_size];
                        let to = &mut local[c * size..][..size];
                        overlay::<D>(
                            lattice.nodes,
                            fine,
                            corner(&cell.at, lattice.pitch()),
                            |small, large| {
                                to[small]
                                    .iter_mut()
                                    .zip(&from[large])
                                    .for_each(|(to, from)| *to += from);
                            },
                        );
                    }
                });
        }
        tick("down");
        // Leaves.
        let mut leaves: Vec<(usize, usize)> = Vec::new();
        for (index, cells) in tree.levels.iter().enumerate() {
            for (place, cell) in cells.iter().enumerate() {
                if cell.is_leaf() {
                    leaves.push((index, place));
                }
            }
        }
        leaves.sort_by_key(|&(index, place)| tree.levels[index][place].agents.start);
        let kernel = &self.kernel;
        let along = self.along;
        let results: Vec<Vec<Vec<f64>>> = leaves
            .par_iter()
            .map_init(Exchange::default, |exchange, &(index, place)| {
                let cell = &tree.levels[index][place];
                let range = cell.agents.clone();
                let mut sums = vec![vec![0.0; range.len()]; channels.wanted];
                let level = &levels[index - 1];
                let size = grid::<D>(level.lattice.nodes) * channels.wanted;
                let here: [&[f64]; D] = std::array::from_fn(|axis| &places[axis][range.clone()]);
                {
                    let mut sums: Vec<&mut [f64]> = sums.iter_mut().map(|it| &mut it[..]).collect();
                    exchange.spread(
                        *arch,
                        &level.lattice,
                        &tree.centre(index, cell),
                        here,
                        &local[index - 1][1][place * size..][..size],
                        &mut sums,
                    );
                }
                let (mut up, mut at) = (index, place);
                loop {
                    let target = &tree.levels[up][at];
                    for near in near[up].of(at) {
                        let source = &tree.levels[up][near.cell as usize];
                        if target.is_leaf() || source.is_leaf() {
                            for (k, i) in range.clone().enumerate() {
                                for j in source.agents.clone() {
                                    let way: [f64; D] = std::array::from_fn(|axis| {
                                        places[axis][i] - places[axis][j]
                                    });
                                    let squared: f64 = way.iter().map(|it| it * it).sum();
                                    let value = (kernel)(squared);
                                    for c in 0..channels.wanted {
                                        sums[c][k] += match along {
                                            true => value * way[c] * sorted[0][j],
                                            false => value * sorted[c][j],
                                        };
                                    }
                                }
                            }
                        }
                    }
                    if up == 0 {
                        break;
                    }
                    at = target.parent;
                    up -= 1;
                }
                sums
            })
            .collect();
        for (&(index, place), sums) in leaves.iter().zip(&results) {
            for (k, i) in tree.levels[index][place].agents.clone().enumerate() {
                for c in 0..channels.wanted {
                    wanted[c][order[i] as usize] = sums[c][k];
                }
            }
        }
        tick("leaves");
        true
    }

    /// Builds tree and levels.
    fn grow(&mut self, positions: &[Vector<D>], channels: Channels) -> bool {
        let count = positions.len().max(1) as f64;
        let mut low = [f64::INFINITY; D];
        let mut high = [f64::NEG_INFINITY; D];
        for x in positions {
            for axis in 0..D {
                low[axis] = low[axis].min(x[axis]);
                high[axis] = high[axis].max(x[axis]);
            }
        }
        let extent: [f64; D] = std::array::from_fn(|axis| high[axis] - low[axis]);
        let longest = extent.into_iter().fold(f64::MIN_POSITIVE, f64::max) * (1.0 + 1e-9);
        // A side that would hold as many as a leaf should, if agents were spread evenly; in
        // steps, so that a flock that swells does not ask for new tables each time.
        let volume: f64 = extent
            .iter()
            .map(|side| (side / longest).max(1e-3))
            .product();
        let share = (crowd::<D>() * volume / count)
            .powf(1.0 / D as f64)
            .min(1.0);
        let side = (4.0 * (longest * share).log2()).round() / 4.0;
        let side = 2f64.powf(side);
        let root = side * 2f64.powi((longest / side).log2().ceil().max(0.0) as i32);
        let middle: [f64; D] = std::array::from_fn(|axis| low[axis] + 0.5 * extent[axis]);
        let corner = middle.map(|middle| middle - 0.5 * root);
        let profile = Profile {
            kernel: &self.kernel,
            along: self.along,
            error: self.error / 3.0,
            floor: self.peak / count,
        };
        // Grades.
        let mut grades: Vec<Grade> = Vec::new();
        loop {
            let Some(grade) = profile.grade(root * 0.5f64.powi(grades.len() as i32 + 1)) else {
                return false;
            };
            grades.push(grade);
            if grade.reach.is_none() || grades.len() >= 40 {
                break;
            }
        }
        let most = (2.0 * crowd::<D>()) as usize;
        self.tree
            .rebuild(positions, corner, root, most, grades.len());
        self.levels.clear();
        let mut reach = 0;
        for (index, grade) in grades.iter().enumerate().take(self.tree.levels.len() - 1) {
            let side = self.tree.side(index + 1);
            self.levels
                .push(Level::new(&profile, channels, side, *grade, reach));
            reach = grade.reach.unwrap_or(0);
        }
        true
    }
}

/// Numbers of one channel at so many nodes along each axis.
fn grid<const D: usize>(nodes: usize) -> usize {
    nodes.pow(D as u32 - 1) * padded(nodes)
}

/// Where the nodes of a child begin among those of its siblings.
fn corner<const D: usize>(at: &[i64; D], pitch: usize) -> [usize; D] {
    at.map(|at| (at & 1) as usize * pitch)
}

/// Calls `visit` with the ranges of each line of nodes.
fn overlay<const D: usize>(
    nodes: usize,
    fine: usize,
    corner: [usize; D],
    mut visit: impl FnMut(std::ops::Range<usize>, std::ops::Range<usize>),
) {
    let (short, long) = (padded(nodes), padded(fine));
    for line in 0..nodes.pow(D as u32 - 1) {
        let mut place = 0;
        for axis in 0..D - 1 {
            let digit = line / nodes.pow((D - 2 - axis) as u32) % nodes;
            place = place * fine + digit + corner[axis];
        }
        let large = place * long + corner[D - 1];
        visit(line * short..line * short + nodes, large..large + nodes);
    }
}

/// rows × columns with padded columns → columns × rows, packed.
fn transposed(matrix: &[f64], rows: usize, columns: usize) -> Vec<f64> {
    let stride = padded(columns);
    (0..columns)
        .flat_map(|column| (0..rows).map(move |row| matrix[row * stride + column]))
        .collect()
}

fn packed(matrix: &[f64], rows: usize, columns: usize) -> Vec<f64> {
    let stride = padded(columns);
    (0..rows)
        .flat_map(|row| matrix[row * stride..][..columns].to_vec())
        .collect()
}

/// Applies matrix (to × from, packed) along every axis; adds.
fn change<const D: usize>(
    arch: Arch,
    matrix: &[f64],
    [to, from]: [usize; 2],
    values: &[f64],
    out: &mut [f64],
) {
    let (wide, narrow) = (padded(from), padded(to));
    // Along the last axis.
    let mut table = vec![0.0; from * narrow];
    for row in 0..to {
        for column in 0..from {
            table[column * narrow + row] = matrix[row * from + column];
        }
    }
    let lines = from.pow(D as u32 - 1);
    let mut first = vec![0.0; lines * narrow];
    multiply(
        arch,
        [lines, from, narrow],
        (values, wide),
        (&table, narrow),
        &mut first,
        false,
    );
    let mut second = first;
    if D == 3 {
        let mut third = vec![0.0; from * to * narrow];
        for x in 0..from {
            multiply(
                arch,
                [to, from, narrow],
                (matrix, from),
                (&second[x * from * narrow..], narrow),
                &mut third[x * to * narrow..][..to * narrow],
                false,
            );
        }
        second = third;
    }
    let rest = second.len() / from;
    multiply(
        arch,
        [to, from, rest],
        (matrix, from),
        (&second, rest),
        out,
        true,
    );
}
