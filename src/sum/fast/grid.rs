//! Numbers at the nodes of a cell: rows along the last axis, each padded.

use std::ops::Range;

use pulp::Arch;

use super::gemm::{multiply, padded};
use super::lattice::Lattice;

/// Numbers of one channel, with so many nodes along each axis.
pub(super) fn size<const D: usize>(nodes: usize) -> usize {
    nodes.pow(D as u32 - 1) * padded(nodes)
}

/// Calls `visit`, for each row of a child's nodes, with where it lies among the child's and
/// where among those of all siblings. `at` is the child's place in the grid of its level.
pub(super) fn overlay<const D: usize>(
    lattice: &Lattice,
    at: &[i64; D],
    mut visit: impl FnMut(Range<usize>, Range<usize>),
) {
    let nodes = lattice.nodes;
    let all = lattice.of_siblings();
    let corner = at.map(|at| (at & 1) as usize * lattice.pitch());
    for row in 0..nodes.pow(D as u32 - 1) {
        let among = (0..D - 1).fold(0, |among, axis| {
            let place = row / nodes.pow((D - 2 - axis) as u32) % nodes;
            among * all + place + corner[axis]
        });
        let small = row * padded(nodes);
        let large = among * padded(all) + corner[D - 1];
        visit(small..small + nodes, large..large + nodes);
    }
}

/// A change of the nodes along every axis.
#[derive(Debug, Clone)]
pub(super) struct Change {
    to: usize,
    from: usize,
    /// One row for each new node.
    matrix: Vec<f64>,
    /// One row for each old node, padded.
    turned: Vec<f64>,
}

impl Change {
    /// From the nodes of all children of a cell to the cell's own, which then do for them as
    /// sources.
    pub fn up(children: &Lattice, lattice: &Lattice) -> Self {
        Self::new(lattice.nodes, children.of_siblings(), |to, from| {
            lattice.weight(to, children.sibling(from))
        })
    }

    /// From a cell's nodes to those of all its children.
    pub fn down(lattice: &Lattice, children: &Lattice) -> Self {
        Self::new(children.of_siblings(), lattice.nodes, |to, from| {
            lattice.weight(from, children.sibling(to))
        })
    }

    fn new(to: usize, from: usize, weight: impl Fn(usize, usize) -> f64) -> Self {
        let narrow = padded(to);
        let mut change = Self {
            to,
            from,
            matrix: vec![0.0; to * from],
            turned: vec![0.0; from * narrow],
        };
        for new in 0..to {
            for old in 0..from {
                change.matrix[new * from + old] = weight(new, old);
                change.turned[old * narrow + new] = weight(new, old);
            }
        }
        change
    }

    /// Adds what the numbers of one channel become; `scratch` is worked in.
    pub fn add<const D: usize>(
        &self,
        arch: Arch,
        values: &[f64],
        out: &mut [f64],
        scratch: &mut [Vec<f64>; 2],
    ) {
        let Self { to, from, .. } = *self;
        let narrow = padded(to);
        let rows = from.pow(D as u32 - 1);
        let [first, second] = scratch;
        first.resize(rows * narrow, 0.0);
        let turned = (&self.turned[..], narrow);
        multiply(
            arch,
            [rows, from, narrow],
            (values, padded(from)),
            turned,
            first,
            false,
        );
        let matrix = (&self.matrix[..], from);
        let last = if D == 2 {
            first
        } else {
            second.resize(from * to * narrow, 0.0);
            let planes = first.chunks_exact(from * narrow);
            for (plane, out) in planes.zip(second.chunks_exact_mut(to * narrow)) {
                multiply(
                    arch,
                    [to, from, narrow],
                    matrix,
                    (plane, narrow),
                    out,
                    false,
                );
            }
            second
        };
        let rest = last.len() / from;
        multiply(arch, [to, from, rest], matrix, (last, rest), out, true);
    }
}
