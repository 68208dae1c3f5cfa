//! Correlation of headings: among all agents, and within clusters.

use crate::math::{Vector, direction};
use crate::net::Components;

/// Order Φ_order: the mean of v_i·v_j/(|v_i||v_j|) over all pairs, from −1/(N − 1) to 1.
/// E. Soria, F. Schiano & D. Floreano, "SwarmLab: a Matlab drone swarm simulator" (2020);
/// φ_corr of G. Vásárhelyi et al., "Optimized flocking of autonomous drones in confined
/// environments" (2018) where all agents are one cluster. (SwarmLab's program takes the
/// pairs of neighbours alone.)
///
/// A pair with an agent at rest counts as zero; `None` for fewer than two agents.
pub fn order<const D: usize>(velocities: &[Vector<D>]) -> Option<f64> {
    let headings: Vec<_> = velocities.iter().map(direction).collect();
    let n = headings.len() as f64;
    (headings.len() > 1).then(|| ordered_pairs(headings.iter()) / (n * (n - 1.0)))
}

/// Correlation within clusters Φ_corr: the mean over agents of their mean correlation of
/// headings with the others in their cluster, Vásárhelyi et al. (2018). Clusters are the
/// components of the net.
///
/// Agents alone in their cluster correlate with nobody and are left out of the mean;
/// `None` where all are alone. A pair with an agent at rest counts as zero.
pub fn cluster_correlation<const D: usize>(
    velocities: &[Vector<D>],
    clusters: &Components,
) -> Option<f64> {
    let mut headings = vec![Vec::new(); clusters.count()];
    for (velocity, &cluster) in velocities.iter().zip(clusters.of()) {
        headings[cluster].push(direction(velocity));
    }
    let (mut sum, mut agents) = (0.0, 0);
    for cluster in headings.iter().filter(|cluster| cluster.len() > 1) {
        sum += ordered_pairs(cluster.iter()) / (cluster.len() - 1) as f64;
        agents += cluster.len();
    }
    (agents > 0).then(|| sum / agents as f64)
}

/// Σ_i Σ_{j≠i} h_i·h_j, as |Σ h|² − Σ |h|².
fn ordered_pairs<'a, const D: usize>(headings: impl Iterator<Item = &'a Vector<D>> + Clone) -> f64 {
    let squares: f64 = headings.clone().map(Vector::norm_squared).sum();
    headings.sum::<Vector<D>>().norm_squared() - squares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::net::Net;

    fn v(x: f64, y: f64) -> Vector<2> {
        Vector::<2>::new(x, y)
    }

    #[test]
    fn order_is_the_mean_over_pairs() {
        assert_eq!(order(&[v(2.0, 0.0), v(5.0, 0.0)]), Some(1.0));
        assert_eq!(order(&[v(2.0, 0.0), v(-5.0, 0.0)]), Some(-1.0));
        assert_eq!(order(&[v(2.0, 0.0), v(0.0, 0.0)]), Some(0.0));
        assert_eq!(
            order(&[v(1.0, 0.0), v(1.0, 0.0), v(0.0, 1.0)]),
            Some(1.0 / 3.0)
        );
        assert_eq!(order(&[v(1.0, 0.0)]), None);
    }

    #[test]
    fn clusters_that_part_are_ordered_within() {
        let velocities = [
            v(1.0, 0.0),
            v(-2.0, 0.0),
            v(3.0, 0.0),
            v(-4.0, 0.0),
            v(1.0, 1.0),
        ];
        let clusters = Net::from_edges(5, [[0, 2], [1, 3]]).partition();
        assert_eq!(cluster_correlation(&velocities, &clusters), Some(1.0));
        assert!(order(&velocities[..4]).unwrap() < 0.0);
        let alone = Net::from_edges(5, []).partition();
        assert_eq!(cluster_correlation(&velocities, &alone), None);
    }
}
