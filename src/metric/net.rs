//! The proximity net: who is within range of whom.

use crate::math::Vector;
use crate::sense::Cells;

/// The undirected net of agents at most a range apart: Olfati-Saber (2003), (8).
#[derive(Debug, Clone, PartialEq)]
pub struct Net {
    agents: usize,
    edges: Vec<[usize; 2]>,
}

impl Net {
    /// The net that these finite positions induce with this range.
    pub fn new<const D: usize>(positions: &[Vector<D>], range: f64) -> Self {
        let mut cells = Cells::default();
        cells.rebuild(positions, range);
        let mut edges = Vec::new();
        for (i, position) in positions.iter().enumerate() {
            let first = edges.len();
            cells.for_each_within(position, range, |j, _, _| {
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

    /// The edges as pairs of agents, first below second, sorted.
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// The sizes of the connected components, in the order of their lowest agents.
    pub fn components(&self) -> Vec<usize> {
        let mut parent: Vec<usize> = (0..self.agents).collect();
        for &[i, j] in &self.edges {
            let (a, b) = (root(&mut parent, i), root(&mut parent, j));
            // The lower index is the root, which makes the order that of lowest agents.
            parent[a.max(b)] = a.min(b);
        }
        let mut size = vec![0; self.agents];
        for i in 0..self.agents {
            size[root(&mut parent, i)] += 1;
        }
        size.retain(|&size| size > 0);
        size
    }

    /// Density δ0, the share of agents in the largest component: Olfati-Saber (2003), (7).
    pub fn density(&self) -> f64 {
        let largest = self.components().into_iter().max().unwrap_or(0);
        largest as f64 / self.agents as f64
    }
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
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
    }

    #[test]
    fn the_range_itself_is_within_range() {
        assert_eq!(Net::new(&line(&[0.0, 2.0]), 2.0).edges().len(), 1);
        assert_eq!(Net::new(&line(&[0.0, 2.0]), 1.999).edges().len(), 0);
    }
}
