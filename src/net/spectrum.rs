//! Algebraic connectivity.

use crate::net::Adjacency;

/// The algebraic connectivity λ2, the second smallest eigenvalue of the Laplacian: above 0
/// exactly where the net is connected. `None` for fewer than two agents.
///
/// Of a directed net it is that of its [mirror](Adjacency::mirror). For a balanced net
/// this is the λ2 of the symmetric part of L, which bounds how fast agreement is reached
/// (Olfati-Saber & Murray 2004); for others the symmetric part is no
/// Laplacian and may have negative eigenvalues, the mirror still has none. A net that is
/// not weakly connected has 0, without rounding.
///
/// Dense, cubic in the number of agents.
pub fn algebraic_connectivity(net: &Adjacency) -> Option<f64> {
    if net.agents() < 2 {
        return None;
    }
    if net.partition().count() > 1 {
        return Some(0.0);
    }
    let laplacian = net.mirror().laplacian();
    let mut values = laplacian.symmetric_eigenvalues();
    if values.iter().any(|value| value.is_nan()) {
        // The iteration fails on a matrix in a million; the eigenvalues of a Laplacian, which
        // are not negative, are its singular values as well.
        values = laplacian.singular_values();
    }
    let mut values: Vec<f64> = values.iter().copied().collect();
    values.sort_by(f64::total_cmp);
    Some(values[1].max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::net::Net;

    #[test]
    fn a_pair_has_two_and_its_weight_counts() {
        let pair = Adjacency::from(&Net::from_edges(2, [[0, 1]]));
        assert!((algebraic_connectivity(&pair).unwrap() - 2.0).abs() < 1e-14);
        // Seen one way with weight 1: the mirror has weight one half.
        let one_way = Adjacency::new(vec![vec![(1, 1.0)], vec![]]);
        assert!((algebraic_connectivity(&one_way).unwrap() - 1.0).abs() < 1e-14);
        assert_eq!(algebraic_connectivity(&Adjacency::new(vec![vec![]])), None);
    }
}
