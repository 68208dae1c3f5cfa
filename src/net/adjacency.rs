//! Weighted adjacency, directed or not, with degrees and the Laplacian.

use nalgebra::DMatrix;

use crate::net::{Components, Net};

/// The adjacency matrix (a_ij) of a net in sparse rows: whom each agent sees, and how
/// strongly. Entries are above 0; a_ii is 0. [`neighborhood`](crate::net::neighborhood)
/// makes it from positions.
#[derive(Debug, Clone, PartialEq)]
pub struct Adjacency {
    rows: Vec<Vec<(usize, f64)>>,
}

impl Adjacency {
    /// From rows of (j, a_ij), in any order, each j at most once in a row. Entries that are
    /// not above 0 are left out, as are those of an agent with itself.
    ///
    /// # Panics
    /// Where an entry names an agent that has no row.
    pub fn new(mut rows: Vec<Vec<(usize, f64)>>) -> Self {
        let agents = rows.len();
        for (i, row) in rows.iter_mut().enumerate() {
            row.retain(|&(j, weight)| j != i && weight > 0.0);
            row.sort_unstable_by_key(|&(j, _)| j);
            if let Some((j, _)) = row.last() {
                assert!(*j < agents, "an entry names agent {j} of {agents}");
            }
        }
        Self { rows }
    }

    /// The number of agents.
    pub fn agents(&self) -> usize {
        self.rows.len()
    }

    /// The neighbours N_i of agent `i` with their weights a_ij, by rising index:
    /// Olfati-Saber (2003), (3).
    pub fn row(&self, i: usize) -> &[(usize, f64)] {
        &self.rows[i]
    }

    /// The weight a_ij, 0 where `i` does not see `j`.
    pub fn weight(&self, i: usize, j: usize) -> f64 {
        let row = &self.rows[i];
        row.binary_search_by_key(&j, |&(j, _)| j)
            .map_or(0.0, |place| row[place].1)
    }

    /// The number of directed edges: an undirected edge counts twice.
    pub fn arcs(&self) -> usize {
        self.rows.iter().map(Vec::len).sum()
    }

    /// Whether a_ij = a_ji for all pairs, bit for bit.
    pub fn is_undirected(&self) -> bool {
        self.entries().all(|(i, j, a)| self.weight(j, i) == a)
    }

    /// The out-degree Σ_j a_ij of each agent: Olfati-Saber (2003), (9).
    pub fn out_degrees(&self) -> Vec<f64> {
        let degree = |row: &Vec<(usize, f64)>| row.iter().map(|(_, a)| a).sum();
        self.rows.iter().map(degree).collect()
    }

    /// The in-degree Σ_j a_ji of each agent: Olfati-Saber (2003), (9).
    pub fn in_degrees(&self) -> Vec<f64> {
        let mut degrees = vec![0.0; self.agents()];
        for (_, j, a) in self.entries() {
            degrees[j] += a;
        }
        degrees
    }

    /// The largest |deg_in − deg_out| of an agent: the largest entry of |1ᵀL|,
    /// Olfati-Saber (2003), Proposition 1.
    pub fn imbalance(&self) -> f64 {
        self.in_degrees()
            .iter()
            .zip(self.out_degrees())
            .fold(0.0, |largest, (a, b)| f64::max(largest, (a - b).abs()))
    }

    /// Whether in-degrees equal out-degrees, to 1e-12 of the largest degree: the net is
    /// balanced. Undirected nets are.
    pub fn is_balanced(&self) -> bool {
        let largest = self.out_degrees().into_iter().fold(0.0, f64::max);
        self.imbalance() <= 1e-12 * largest
    }

    /// The weakly connected components.
    pub fn partition(&self) -> Components {
        Components::new(self.agents(), self.entries().map(|(i, j, _)| [i, j]))
    }

    /// The mirror of the net, with weights (a_ij + a_ji)/2: the undirected net that
    /// Olfati-Saber & Murray, "Consensus problems in networks of agents with switching
    /// topology and time-delays" (2004), give a digraph.
    pub fn mirror(&self) -> Self {
        let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.agents()];
        for (i, j, a) in self.entries() {
            let back = self.weight(j, i);
            // Of a pair that is seen both ways, the lower agent writes both entries.
            if back == 0.0 || i < j {
                let weight = 0.5 * (a + back);
                rows[i].push((j, weight));
                rows[j].push((i, weight));
            }
        }
        Self::new(rows)
    }

    /// The adjacency matrix as a dense one.
    pub fn dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.agents(), self.agents());
        for (i, j, a) in self.entries() {
            dense[(i, j)] = a;
        }
        dense
    }

    /// The Laplacian L = Δ − A with the out-degrees on the diagonal of Δ, dense:
    /// Olfati-Saber (2003), (10), (11). Its rows sum to zero.
    pub fn laplacian(&self) -> DMatrix<f64> {
        let mut laplacian = -self.dense();
        for (i, degree) in self.out_degrees().into_iter().enumerate() {
            laplacian[(i, i)] = degree;
        }
        laplacian
    }

    /// The entries (i, j, a_ij), row by row.
    fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        (0..self.agents()).flat_map(|i| self.rows[i].iter().map(move |&(j, a)| (i, j, a)))
    }
}

impl From<&Net> for Adjacency {
    /// Weight 1 in both directions of every edge.
    fn from(net: &Net) -> Self {
        let mut rows = vec![Vec::new(); net.agents()];
        for &[i, j] in net.edges() {
            rows[i].push((j, 1.0));
            rows[j].push((i, 1.0));
        }
        Self::new(rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_road_is_balanced_though_directed_and_a_dead_end_is_not() {
        let ring = Adjacency::new((0..5).map(|i| vec![((i + 1) % 5, 0.3)]).collect());
        assert!(ring.is_balanced() && !ring.is_undirected());
        assert!(ring.mirror().is_undirected());
        assert_eq!(ring.mirror().weight(0, 4), 0.15);
        let dead_end = Adjacency::new(vec![vec![(1, 1.0)], vec![]]);
        assert_eq!(dead_end.imbalance(), 1.0);
        assert!(!dead_end.is_balanced());
        assert_eq!(dead_end.partition().count(), 1);
    }

    #[test]
    fn rows_are_put_in_order_and_cleaned() {
        let net = Adjacency::new(vec![vec![(2, 1.0), (0, 5.0), (1, 0.0)], vec![], vec![]]);
        assert_eq!(net.row(0), [(2, 1.0)]);
        assert_eq!((net.weight(0, 2), net.weight(2, 0)), (1.0, 0.0));
        assert_eq!(net.arcs(), 1);
    }
}
