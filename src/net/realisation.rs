//! How far a net is from a realisation of its structural net (d_α, r).

use crate::math::{AlphaPair, Vector};
use crate::net::{Net, link_energy, potential_gradient, structural_potential};

/// The largest | |q_j − q_i| − d_α | over the edges; 0 without edges. The net is a
/// realisation (embedding) where it is zero: Olfati-Saber (2003), (20).
pub fn realisation_error<const D: usize>(positions: &[Vector<D>], net: &Net, spacing: f64) -> f64 {
    net.edges().iter().fold(0.0, |largest, &[i, j]| {
        f64::max(
            largest,
            ((positions[j] - positions[i]).norm() - spacing).abs(),
        )
    })
}

/// Whether every edge is `spacing` long, give or take `tolerance` (a length): (20). A net
/// without edges is a realisation.
pub fn is_realisation<const D: usize>(
    positions: &[Vector<D>],
    net: &Net,
    spacing: f64,
    tolerance: f64,
) -> bool {
    realisation_error(positions, net, spacing) <= tolerance
}

/// The defect factor μ = V(q) + w |∇V(q)|²: Olfati-Saber (2003), (46), with w above 0
/// (1 where the paper names none). Zero without edges.
pub fn defect<const D: usize>(
    positions: &[Vector<D>],
    net: &Net,
    pair: &AlphaPair,
    weight: f64,
) -> f64 {
    let slope: f64 = potential_gradient(positions, net, pair)
        .iter()
        .map(Vector::norm_squared)
        .sum();
    structural_potential(positions, net, pair) + weight * slope
}

/// The normalised defect factor μ_n = μ/(|E| h0), with |E| the number of undirected edges
/// and h0 the [`link_energy`]: Olfati-Saber (2003), (47). `None` without edges.
pub fn normalised_defect<const D: usize>(
    positions: &[Vector<D>],
    net: &Net,
    pair: &AlphaPair,
    weight: f64,
) -> Option<f64> {
    let scale = net.edges().len() as f64 * link_energy(pair);
    (scale > 0.0).then(|| defect(positions, net, pair, weight) / scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Action, Fade};

    #[test]
    fn a_pair_has_the_defect_of_its_formula() {
        let action = Action::new(1.0, 5.0);
        let pair = AlphaPair {
            action,
            spacing: 7.0,
            range: 8.4,
            fade: Fade::Sharp,
        };
        let at = |x: f64| [Vector::<2>::zeros(), Vector::<2>::new(x, 0.0)];
        let net = Net::from_edges(2, [[0, 1]]);
        let expected = action.potential(1.0) + 3.0 * 2.0 * action.force(1.0).powi(2);
        assert!((defect(&at(8.0), &net, &pair, 3.0) - expected).abs() < 1e-12);
        let normalised = expected / action.potential(8.4 - 7.0);
        let found = normalised_defect(&at(8.0), &net, &pair, 3.0).unwrap();
        assert!((found - normalised).abs() < 1e-12);
        assert_eq!(realisation_error(&at(8.0), &net, 7.0), 1.0);
        assert!(is_realisation(&at(7.0), &net, 7.0, 0.0));

        let apart = Net::from_edges(2, []);
        assert_eq!(defect(&at(8.0), &apart, &pair, 1.0), 0.0);
        assert_eq!(normalised_defect(&at(8.0), &apart, &pair, 1.0), None);
        assert!(is_realisation(&at(8.0), &apart, 7.0, 0.0));
    }
}
