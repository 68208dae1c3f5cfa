//! How well the net is connected, and how even its lattice is.

use crate::math::Vector;
use crate::net::{Components, Net};

/// Normalised deviation energy Ẽ = Σ_i Σ_{j∈N_i} (|q_j − q_i| − d)² / ((|E| + 1) d²), with
/// d the spacing: R. Olfati-Saber, "Flocking for multi-agent dynamic systems" (2006), (7).
/// Edges are directed there: both the sum and |E| count each edge of
/// `net` twice. Zero without edges, and on a perfect lattice.
pub fn deviation_energy<const D: usize>(positions: &[Vector<D>], net: &Net, spacing: f64) -> f64 {
    let square = |&[i, j]: &[usize; 2]| {
        let off = ((positions[j] - positions[i]).norm() - spacing) / spacing;
        off * off
    };
    let sum: f64 = net.edges().iter().map(square).sum();
    2.0 * sum / (2 * net.edges().len() + 1) as f64
}

/// Union Φ_union = 1 − (n_c − 1)/(N − 1) with n_c components: 1 for a flock, 0 where all
/// agents are alone. E. Soria, F. Schiano & D. Floreano, "SwarmLab: a Matlab drone swarm
/// simulator" (2020); it equals the relative connectivity rank(L)/(N − 1) of Olfati-Saber
/// (2006). `None` for fewer than two agents.
pub fn union(clusters: &Components) -> Option<f64> {
    let agents = clusters.of().len();
    (agents > 1).then(|| (agents - clusters.count()) as f64 / (agents - 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stretched_edge_has_its_square() {
        let at = [Vector::<2>::zeros(), Vector::<2>::new(3.0, 0.0)];
        let net = Net::from_edges(2, [[0, 1]]);
        assert_eq!(deviation_energy(&at, &net, 2.0), 2.0 * 0.25 / 3.0);
        assert_eq!(deviation_energy(&at, &net, 3.0), 0.0);
        assert_eq!(deviation_energy(&at, &Net::from_edges(2, []), 2.0), 0.0);
    }

    #[test]
    fn union_falls_from_one_to_zero() {
        let union =
            |edges: &[[usize; 2]]| union(&Net::from_edges(4, edges.iter().copied()).partition());
        assert_eq!(union(&[[0, 1], [1, 2], [2, 3]]), Some(1.0));
        assert_eq!(union(&[[0, 1], [2, 3]]), Some(2.0 / 3.0));
        assert_eq!(union(&[]), Some(0.0));
        assert_eq!(super::union(&Net::from_edges(1, []).partition()), None);
    }
}
