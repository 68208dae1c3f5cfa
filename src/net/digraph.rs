//! What only directed nets have: strong connectivity. Weight balance and weak connectivity
//! are in [`Adjacency`].

use crate::net::Adjacency;

/// Whether every agent reaches every other along arcs; so do none and one. A balanced net
/// that is weakly connected is strongly connected too: Shi, Wang & Chu, Proposition 1.
pub fn is_strongly_connected(net: &Adjacency) -> bool {
    let mut back = vec![Vec::new(); net.agents()];
    for i in 0..net.agents() {
        for &(j, _) in net.row(i) {
            back[j].push(i);
        }
    }
    let onward = |i: usize| net.row(i).iter().map(|&(j, _)| j).collect();
    all_reached(net.agents(), onward) && all_reached(net.agents(), |i| back[i].clone())
}

/// Whether all agents are reached from the first one.
fn all_reached(agents: usize, next: impl Fn(usize) -> Vec<usize>) -> bool {
    let mut reached = vec![false; agents];
    let mut open = Vec::from_iter((agents > 0).then_some(0));
    let mut count = 0;
    while let Some(i) = open.pop() {
        if !std::mem::replace(&mut reached[i], true) {
            count += 1;
            open.extend(next(i));
        }
    }
    count == agents
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::net::symmetric_connectivity;

    fn ring(agents: usize) -> Adjacency {
        Adjacency::new((0..agents).map(|i| vec![((i + 1) % agents, 0.5)]).collect())
    }

    #[test]
    fn a_ring_is_strongly_connected_and_a_chain_is_not() {
        assert!(is_strongly_connected(&ring(5)));
        let chain = Adjacency::new(vec![vec![(1, 1.0)], vec![(2, 1.0)], vec![]]);
        assert!(!is_strongly_connected(&chain) && chain.partition().is_flock());
        // From the first agent all are reached, but none comes back; and the other way round.
        let star = Adjacency::new(vec![vec![(1, 1.0), (2, 1.0)], vec![], vec![]]);
        assert!(!is_strongly_connected(&star));
        let sink = Adjacency::new(vec![vec![], vec![(0, 1.0)], vec![(0, 1.0)]]);
        assert!(!is_strongly_connected(&sink));
        for agents in [0, 1] {
            assert!(is_strongly_connected(&Adjacency::new(vec![
                Vec::new();
                agents
            ])));
        }
    }

    #[test]
    fn the_ring_has_the_eigenvalues_of_its_closed_form() {
        // L + Lᵀ of a ring of weight w is w times the Laplacian of the undirected ring.
        for agents in [3, 4, 9] {
            let angle = std::f64::consts::TAU / agents as f64;
            let expected = 0.5 * (2.0 - 2.0 * angle.cos());
            let found = symmetric_connectivity(&ring(agents)).unwrap();
            assert!(
                (found - expected).abs() < 1e-12,
                "{agents}: {found} {expected}"
            );
        }
        assert_eq!(symmetric_connectivity(&ring(1)), None);
        let apart = Adjacency::new(vec![Vec::new(); 3]);
        assert_eq!(symmetric_connectivity(&apart), Some(0.0));
    }
}
