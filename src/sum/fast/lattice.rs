//! Nodes between which a kernel is interpolated.

use super::gemm::LANES;

/// The equally spaced nodes of the cells of a level. Their lattice goes on from cell to cell,
/// so what a kernel does between nodes of two cells depends on differences of places alone; and
/// each cell has one node beyond either side, which keeps interpolation tame up to its
/// edges.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Lattice {
    /// Nodes of a cell along each axis.
    pub nodes: usize,
    /// Distance between nodes.
    pub spacing: f64,
    /// 1/Π_{j≠k} (k − j) for each node k.
    scales: Vec<f64>,
}

impl Lattice {
    /// The least number of nodes along an axis.
    pub const LEAST: usize = 4;

    /// The lattice of cells of some side, with at least [`Lattice::LEAST`] nodes.
    pub fn new(nodes: usize, side: f64) -> Self {
        let spacing = side / Self::pitch_of(nodes) as f64;
        let factorial = |n: usize| (1..=n).fold(1.0, |product, j| product * j as f64);
        let scale = |k: usize| {
            let above = nodes - 1 - k;
            let sign = if above.is_multiple_of(2) { 1.0 } else { -1.0 };
            sign / (factorial(k) * factorial(above))
        };
        Self {
            nodes,
            spacing,
            scales: (0..nodes).map(scale).collect(),
        }
    }

    const fn pitch_of(nodes: usize) -> usize {
        nodes - 3
    }

    /// How many spacings a cell is wide.
    pub fn pitch(&self) -> usize {
        Self::pitch_of(self.nodes)
    }

    /// Nodes along each axis that the children of one cell have together, if this is theirs.
    pub fn of_siblings(&self) -> usize {
        self.nodes + self.pitch()
    }

    /// For up to [`LANES`] places along an axis, relative to the cell's centre, the weights by
    /// which the value of a function there follows from its values at the nodes, one row for
    /// each node: Lagrange's polynomials.
    pub fn weights(&self, places: &[f64; LANES], weights: &mut [[f64; LANES]]) {
        let count = self.nodes;
        let middle = (count - 1) as f64 / 2.0;
        let per_spacing = self.spacing.recip();
        let place = places.map(|x| x * per_spacing + middle);
        // Products of x − j over the nodes j below k, then times those above it.
        let mut product = [1.0; LANES];
        for (j, row) in weights[..count].iter_mut().enumerate() {
            *row = product;
            for lane in 0..LANES {
                product[lane] *= place[lane] - j as f64;
            }
        }
        product = [1.0; LANES];
        for (j, row) in weights[..count].iter_mut().enumerate().rev() {
            let scale = self.scales[j];
            for lane in 0..LANES {
                row[lane] *= product[lane] * scale;
                product[lane] *= place[lane] - j as f64;
            }
        }
    }

    /// The weight of one node at a place.
    pub fn weight(&self, node: usize, place: f64) -> f64 {
        let mut weights = vec![[0.0; LANES]; self.nodes];
        self.weights(&[place; LANES], &mut weights);
        weights[node][0]
    }

    /// Where a node of all children of one cell is, if these are theirs, relative to that
    /// cell's centre.
    pub fn sibling(&self, node: usize) -> f64 {
        (node as f64 - (self.of_siblings() - 1) as f64 / 2.0) * self.spacing
    }
}
