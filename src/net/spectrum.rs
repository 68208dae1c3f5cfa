//! Algebraic connectivity.

use nalgebra::DMatrix;

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
    // A Laplacian's eigenvalues, which are not negative, are its singular values as well.
    let values = eigenvalues(&laplacian, || laplacian.singular_values());
    Some(values[1].max(0.0))
}

/// The second smallest eigenvalue of L + Lᵀ, with L the Laplacian: how fast velocities that
/// such influences pull agree at least. Shi, Wang & Chu, (18). `None` for fewer than two
/// agents.
///
/// For a balanced net, whose smallest one is 0, it is twice the [`algebraic_connectivity`]; otherwise L + Lᵀ is no
/// Laplacian, and may have negative eigenvalues.
///
/// Dense, cubic in the number of agents.
pub fn symmetric_connectivity(net: &Adjacency) -> Option<f64> {
    if net.agents() < 2 {
        return None;
    }
    let laplacian = net.laplacian();
    let symmetric = &laplacian + laplacian.transpose();
    // Shifted until none is negative, the eigenvalues are the singular values.
    let shift = symmetric.norm();
    let shifted = || {
        let unit = DMatrix::identity(net.agents(), net.agents());
        (&symmetric + unit * shift)
            .singular_values()
            .add_scalar(-shift)
    };
    Some(eigenvalues(&symmetric, shifted)[1])
}

/// The eigenvalues of a symmetric matrix, sorted; `otherwise` where the iteration fails, as it
/// does on a matrix in a million.
fn eigenvalues(
    matrix: &DMatrix<f64>,
    otherwise: impl FnOnce() -> nalgebra::DVector<f64>,
) -> Vec<f64> {
    let mut values = matrix.symmetric_eigenvalues();
    if values.iter().any(|value| value.is_nan()) {
        values = otherwise();
    }
    let mut values: Vec<f64> = values.iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::net::Net;

    #[test]
    fn of_a_balanced_net_the_symmetric_connectivity_is_twice_that_of_its_mirror() {
        let ring = Adjacency::new((0..5).map(|i| vec![((i + 1) % 5, 0.3)]).collect());
        let twice = 2.0 * algebraic_connectivity(&ring).unwrap();
        assert!((symmetric_connectivity(&ring).unwrap() - twice).abs() < 1e-14);
        // One that all others see, and that sees nobody: [[0, −1], [−1, 2]] for two.
        let star = Adjacency::new(vec![vec![], vec![(0, 1.0)]]);
        let wanted = 1.0 + 2f64.sqrt();
        assert!((symmetric_connectivity(&star).unwrap() - wanted).abs() < 1e-14);
        assert_eq!(symmetric_connectivity(&Adjacency::new(vec![vec![]])), None);
    }

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
