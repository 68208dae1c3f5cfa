//! Infinitesimal rigidity by the rank of the rigidity matrix.

use nalgebra::DMatrix;

use crate::math::{Vector, direction};
use crate::net::Net;

/// Singular values of the rigidity matrix up to this share of the largest count as zero.
/// Its rows are scaled to unit directions first, which changes no rank and makes the
/// share independent of lengths.
pub const RANK_TOLERANCE: f64 = 1e-9;

/// Whether the bars of a framework, the edges of a net at their present places, leave it
/// any motion but that of a rigid body, to first order.
///
/// The rigidity matrix has a row for each edge ij, with q_i − q_j at i and q_j − q_i at j;
/// its kernel holds the velocities that keep all lengths. See L. Asimow & B. Roth, "The
/// rigidity of graphs" (1978), and reference \[14\] of Olfati-Saber (2003).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rigidity {
    /// The rank of the rigidity matrix: edges that are not redundant.
    pub rank: usize,
    /// The rank that a rigid framework of as many agents has.
    pub full: usize,
}

impl Rigidity {
    /// Of the net at these positions. Edges of length zero constrain nothing.
    ///
    /// Rank by singular values above [`RANK_TOLERANCE`] of the largest, for each component
    /// of the net by itself: dense, cubic in the size of the components.
    pub fn new<const D: usize>(positions: &[Vector<D>], net: &Net) -> Self {
        let parts = net.partition();
        let mut edges = vec![Vec::new(); parts.count()];
        for edge in net.edges() {
            edges[parts.of()[edge[0]]].push(*edge);
        }
        // The place of each agent in its own component.
        let mut next = vec![0; parts.count()];
        let place: Vec<usize> = parts
            .of()
            .iter()
            .map(|&part| {
                next[part] += 1;
                next[part] - 1
            })
            .collect();
        let rank_of = |(edges, &size): (&Vec<[usize; 2]>, &usize)| {
            rank(directions(positions, edges, &place, size))
        };
        Self {
            rank: edges.iter().zip(parts.sizes()).map(rank_of).sum(),
            full: full_rank(positions.len(), D),
        }
    }

    /// Whether the framework is infinitesimally rigid. Collinear agents in the plane and
    /// coplanar ones in space are not, from D + 1 agents on, however many edges they have.
    pub fn is_rigid(&self) -> bool {
        self.rank == self.full
    }

    /// The degrees of freedom left besides those of a rigid body.
    pub fn freedoms(&self) -> usize {
        self.full - self.rank
    }
}

/// The rank of a rigid framework of n agents in general position: d n − d(d+1)/2, and for
/// fewer agents than dimensions the number of pairs.
fn full_rank(agents: usize, dimension: usize) -> usize {
    if agents < dimension {
        agents * agents.saturating_sub(1) / 2
    } else {
        dimension * agents - dimension * (dimension + 1) / 2
    }
}

/// The rigidity matrix of one component with its rows scaled to unit directions.
fn directions<const D: usize>(
    positions: &[Vector<D>],
    edges: &[[usize; 2]],
    place: &[usize],
    size: usize,
) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(edges.len(), D * size);
    for (row, &[i, j]) in edges.iter().enumerate() {
        let along = direction(&(positions[j] - positions[i]));
        for axis in 0..D {
            matrix[(row, D * place[i] + axis)] = -along[axis];
            matrix[(row, D * place[j] + axis)] = along[axis];
        }
    }
    matrix
}

fn rank(matrix: DMatrix<f64>) -> usize {
    if matrix.is_empty() {
        return 0;
    }
    let values = matrix.singular_values();
    let least = RANK_TOLERANCE * values.max();
    values.iter().filter(|&&value| value > least).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complete<const D: usize>(positions: &[Vector<D>]) -> Rigidity {
        Rigidity::new(positions, &Net::new(positions, 1e9))
    }

    #[test]
    fn flat_and_straight_frameworks_are_not_rigid() {
        let line: Vec<_> = (0..4)
            .map(|k| Vector::<2>::new(f64::from(k), 2.0))
            .collect();
        assert_eq!(complete(&line).freedoms(), 2);
        let flat: Vec<_> = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)]
            .map(|(x, y)| Vector::<3>::new(x, y, 0.0))
            .to_vec();
        assert_eq!(complete(&flat).freedoms(), 1);
        assert!(complete(&flat[..3]).is_rigid());
        assert!(complete(&flat[..2]).is_rigid());
        assert!(complete(&flat[..1]).is_rigid());
        assert!(complete::<3>(&[]).is_rigid());
    }

    #[test]
    fn agents_at_one_point_are_held_by_nothing() {
        let twins = [Vector::<2>::zeros(); 2];
        assert_eq!(complete(&twins).freedoms(), 1);
    }

    #[test]
    fn scale_does_not_matter() {
        for scale in [1e-6, 1.0, 1e6] {
            let triangle =
                [(0.0, 0.0), (1.0, 0.0), (0.3, 0.01)].map(|(x, y)| Vector::<2>::new(x, y) * scale);
            assert!(complete(&triangle).is_rigid());
        }
    }
}
