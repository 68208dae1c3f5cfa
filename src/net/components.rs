//! Weakly connected components and density.

/// The weakly connected components of a net: the largest sets of agents that are joined
/// by edges, whatever the edges' directions. Each is a flock by Olfati-Saber (2003),
/// Definition 1. Components are numbered in the order of their lowest agents.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Components {
    of: Vec<usize>,
    sizes: Vec<usize>,
}

impl Components {
    /// The components of `agents` agents joined by these edges.
    pub(super) fn new(agents: usize, edges: impl IntoIterator<Item = [usize; 2]>) -> Self {
        let mut parent: Vec<usize> = (0..agents).collect();
        for [i, j] in edges {
            let (a, b) = (root(&mut parent, i), root(&mut parent, j));
            // The lower index is the root, which makes the order that of lowest agents.
            parent[a.max(b)] = a.min(b);
        }
        let (mut of, mut sizes) = (vec![0; agents], Vec::new());
        for i in 0..agents {
            let root = root(&mut parent, i);
            if root == i {
                of[i] = sizes.len();
                sizes.push(0);
            }
            of[i] = of[root];
            sizes[of[i]] += 1;
        }
        Self { of, sizes }
    }

    /// The component of each agent.
    pub fn of(&self) -> &[usize] {
        &self.of
    }

    /// The number of agents in each component.
    pub fn sizes(&self) -> &[usize] {
        &self.sizes
    }

    /// The number of components.
    pub fn count(&self) -> usize {
        self.sizes.len()
    }

    /// The number of agents in the largest component; 0 without agents.
    pub fn largest(&self) -> usize {
        self.sizes.iter().copied().max().unwrap_or(0)
    }

    /// The number of agents in the smallest component; 0 without agents.
    pub fn smallest(&self) -> usize {
        self.sizes.iter().copied().min().unwrap_or(0)
    }

    /// Density δ0, the share of agents in the largest component, above 0 and up to 1:
    /// Olfati-Saber (2003), (7). No agents at all count as one flock.
    pub fn density(&self) -> f64 {
        if self.of.is_empty() {
            return 1.0;
        }
        self.largest() as f64 / self.of.len() as f64
    }

    /// Whether the net is a flock: weakly connected, of density 1.
    pub fn is_flock(&self) -> bool {
        self.count() <= 1
    }

    /// Whether the net is a quasi-flock: a density of at least 1 − `tolerance`. The paper
    /// asks for 0 < 1 − δ0 ≪ 1 below (7) and gives ≪ no number; a flock counts as well here.
    pub fn is_quasi_flock(&self, tolerance: f64) -> bool {
        1.0 - self.density() <= tolerance
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

    #[test]
    fn components_are_numbered_by_their_lowest_agents() {
        let parts = Components::new(7, [[5, 1], [0, 6], [2, 5], [4, 0]]);
        assert_eq!(parts.of(), [0, 1, 1, 2, 0, 1, 0]);
        assert_eq!(parts.sizes(), [3, 3, 1]);
        assert_eq!((parts.largest(), parts.smallest()), (3, 1));
        assert_eq!(parts.density(), 3.0 / 7.0);
        assert!(parts.is_quasi_flock(4.0 / 7.0) && !parts.is_quasi_flock(0.5));
        assert!(!parts.is_flock());
    }

    #[test]
    fn one_agent_is_a_flock_and_so_are_none() {
        for agents in [0, 1] {
            let parts = Components::new(agents, []);
            assert!(parts.is_flock() && parts.is_quasi_flock(0.0));
            assert_eq!(parts.density(), 1.0);
        }
    }
}
