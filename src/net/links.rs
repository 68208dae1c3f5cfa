//! Links that came and went between two states.

use crate::net::Net;

/// The edges in which a later net differs from an earlier one of the same agents.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LinkChanges {
    /// Edges of the later net that the earlier lacks, sorted.
    pub created: Vec<[usize; 2]>,
    /// Edges of the earlier net that the later lacks, sorted.
    pub lost: Vec<[usize; 2]>,
}

impl LinkChanges {
    /// What changed from `before` to `after`. A link that came and went in between is not
    /// seen.
    pub fn between(before: &Net, after: &Net) -> Self {
        let missing = |from: &Net, among: &Net| {
            let absent = |edge: &&[usize; 2]| among.edges().binary_search(*edge).is_err();
            from.edges().iter().filter(absent).copied().collect()
        };
        Self {
            created: missing(after, before),
            lost: missing(before, after),
        }
    }

    /// What the changes add to the nonsmooth energy, h0 (created − lost), with h0 of
    /// [`link_energy`](crate::net::link_energy): Olfati-Saber (2003), (31). True of links
    /// at the moment when they come and go, at a distance of just the range.
    pub fn energy_jump(&self, link_energy: f64) -> f64 {
        link_energy * (self.created.len() as f64 - self.lost.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tells_new_links_from_lost_ones() {
        let before = Net::from_edges(5, [[0, 1], [1, 2], [3, 4]]);
        let after = Net::from_edges(5, [[0, 1], [0, 2], [2, 3], [3, 4]]);
        let changes = LinkChanges::between(&before, &after);
        assert_eq!(changes.created, [[0, 2], [2, 3]]);
        assert_eq!(changes.lost, [[1, 2]]);
        assert_eq!(changes.energy_jump(0.5), 0.5);
    }
}
