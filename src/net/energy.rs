//! The structural potential of a net, its gradient, and the structural energy.

use crate::math::{AlphaPair, Fade, Vector, mean};
use crate::net::Net;

/// The structural potential V(q) = Σ_{i<j} a_ij ψ_α(|q_j − q_i| − d_α) over the edges of
/// `net`: Olfati-Saber (2003), (28), (30). Nonsmooth where the pair's fade is sharp,
/// smooth otherwise. Zero without edges.
pub fn structural_potential<const D: usize>(
    positions: &[Vector<D>],
    net: &Net,
    pair: &AlphaPair,
) -> f64 {
    let distance = |&[i, j]: &[usize; 2]| (positions[j] - positions[i]).norm();
    net.edges()
        .iter()
        .map(|edge| pair.potential(distance(edge)))
        .fold(0.0, |sum, energy| sum + energy)
}

/// The gradient of [`structural_potential`] with respect to each position, the net held
/// fixed (V jumps where a link of a nonsmooth net comes or goes). Two agents at the same
/// point have no direction between them and add nothing.
pub fn potential_gradient<const D: usize>(
    positions: &[Vector<D>],
    net: &Net,
    pair: &AlphaPair,
) -> Vec<Vector<D>> {
    let pair = with_gradient(pair);
    let mut gradient = vec![Vector::zeros(); positions.len()];
    for &[i, j] in net.edges() {
        let offset = positions[j] - positions[i];
        let distance = offset.norm();
        if distance > 0.0 {
            let slope = offset * (pair.force(distance) / distance);
            gradient[i] -= slope;
            gradient[j] += slope;
        }
    }
    gradient
}

/// The structural energy H_s = V(q) + ½ Σ |p_i − p̄|²: Olfati-Saber (2003), (27), (30), with
/// the potential and the weights of `pair`, over the edges of `net`.
pub fn structural_energy<const D: usize>(
    positions: &[Vector<D>],
    velocities: &[Vector<D>],
    net: &Net,
    pair: &AlphaPair,
) -> f64 {
    let center = mean(velocities);
    let kinetic: f64 = velocities.iter().map(|v| (v - center).norm_squared()).sum();
    structural_potential(positions, net, pair) + 0.5 * kinetic
}

/// The link energy h0 = ψ_α(r − d_α), by which V jumps where a link comes or goes:
/// Olfati-Saber (2003), (31).
pub fn link_energy(pair: &AlphaPair) -> f64 {
    pair.action.potential(pair.range - pair.spacing)
}

/// The same interaction with a force that is its potential's derivative: the approximate
/// protocol leaves out a part of it.
fn with_gradient(pair: &AlphaPair) -> AlphaPair {
    AlphaPair {
        fade: match pair.fade {
            Fade::Approximate(bump) => Fade::Smooth(bump),
            fade => fade,
        },
        ..*pair
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Action, Bump};

    #[test]
    fn a_pair_s_energy_is_its_potential_and_its_relative_motion() {
        let pair = AlphaPair {
            action: Action::new(1.0, 5.0),
            spacing: 7.0,
            range: 8.4,
            fade: Fade::Smooth(Bump::new(5.0 / 6.0)),
        };
        let positions = [Vector::<2>::zeros(), Vector::<2>::new(5.0, 0.0)];
        let velocities = [Vector::<2>::new(3.0, 1.0), Vector::<2>::new(1.0, 1.0)];
        let energy = structural_energy(&positions, &velocities, &Net::new(&positions, 8.4), &pair);
        assert!((energy - (pair.action.potential(-2.0) + 1.0)).abs() < 1e-12);
        assert_eq!(link_energy(&pair), pair.action.potential(8.4 - 7.0));
    }
}
