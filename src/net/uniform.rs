//! Undirected nets without weights: who is within range of whom.

use serde::{Deserialize, Serialize};

use crate::math::Vector;
use crate::net::{Adjacency, Components};
use crate::sense::Cells;

/// An undirected graph on the agents. [`Net::new`] is the uniform net of Olfati-Saber
/// (2003), (8): agents at most a range apart are joined.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Net {
    agents: usize,
    edges: Vec<[usize; 2]>,
}

impl Net {
    /// The net that these finite positions induce with this range, above 0.
    pub fn new<const D: usize>(positions: &[Vector<D>], range: f64) -> Self {
        let mut cells = Cells::default();
        cells.rebuild(positions, range);
        let mut edges = Vec::new();
        for (i, position) in positions.iter().enumerate() {
            let first = edges.len();
            cells.for_each_within(position, range, |place, _, _| {
                let j = cells.order()[place] as usize;
                if i < j {
                    edges.push([i, j]);
                }
            });
            edges[first..].sort_unstable();
        }
        Self {
            agents: positions.len(),
            edges,
        }
    }

    /// The graph of these edges. Directions and repetitions do not count; an edge from an
    /// agent to itself is left out.
    ///
    /// # Panics
    /// Where an edge names an agent that is not among the `agents`.
    pub fn from_edges(agents: usize, edges: impl IntoIterator<Item = [usize; 2]>) -> Self {
        let mut edges: Vec<[usize; 2]> = edges
            .into_iter()
            .filter(|[i, j]| i != j)
            .map(|[i, j]| [i.min(j), i.max(j)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        for [_, j] in &edges {
            assert!(*j < agents, "an edge names agent {j} of {agents}");
        }
        Self { agents, edges }
    }

    /// The underlying undirected graph of an adjacency: an edge where either sees the other.
    pub fn underlying(adjacency: &Adjacency) -> Self {
        let arcs = (0..adjacency.agents())
            .flat_map(|i| adjacency.row(i).iter().map(move |&(j, _)| [i, j]));
        Self::from_edges(adjacency.agents(), arcs)
    }

    /// The number of agents.
    pub fn agents(&self) -> usize {
        self.agents
    }

    /// The edges as pairs of agents, first below second, sorted.
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// The number of edges at each agent.
    pub fn degrees(&self) -> Vec<usize> {
        let mut degrees = vec![0; self.agents];
        for &[i, j] in &self.edges {
            degrees[i] += 1;
            degrees[j] += 1;
        }
        degrees
    }

    /// Which agents are connected with which.
    pub fn partition(&self) -> Components {
        Components::new(self.agents, self.edges.iter().copied())
    }

    /// The sizes of the connected components, in the order of their lowest agents.
    pub fn components(&self) -> Vec<usize> {
        self.partition().sizes().to_vec()
    }

    /// Density δ0, the share of agents in the largest component: Olfati-Saber (2003), (7).
    pub fn density(&self) -> f64 {
        self.partition().density()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(at: &[f64]) -> Vec<Vector<2>> {
        at.iter().map(|&x| Vector::<2>::new(x, 0.0)).collect()
    }

    #[test]
    fn finds_components_edges_and_density() {
        let net = Net::new(&line(&[0.0, 5.0, 1.0, 6.0, 2.0, 20.0]), 1.0);
        assert_eq!(net.edges(), [[0, 2], [1, 3], [2, 4]]);
        assert_eq!(net.components(), [3, 2, 1]);
        assert_eq!(net.density(), 0.5);
        assert_eq!(net.degrees(), [1, 1, 2, 1, 1, 0]);
    }

    #[test]
    fn the_range_itself_is_within_range() {
        assert_eq!(Net::new(&line(&[0.0, 2.0]), 2.0).edges().len(), 1);
        assert_eq!(Net::new(&line(&[0.0, 2.0]), 1.999).edges().len(), 0);
    }

    #[test]
    fn edges_are_put_in_order() {
        let net = Net::from_edges(4, [[3, 1], [0, 2], [1, 3], [2, 2], [2, 0]]);
        assert_eq!(net.edges(), [[0, 2], [1, 3]]);
    }
}
