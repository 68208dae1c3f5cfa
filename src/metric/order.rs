//! How well the agents move together, and the energy of their net.

use crate::math::{AlphaPair, Vector, direction, mean};
use crate::metric::Net;

/// Polarization |Σ v_i/|v_i||/N, from 0 to 1; an agent at rest counts as zero.
pub fn polarization<const D: usize>(velocities: &[Vector<D>]) -> f64 {
    let headings: Vec<_> = velocities.iter().map(direction).collect();
    mean(&headings).norm()
}

/// Root mean square of |v_i − target|.
pub fn velocity_mismatch<const D: usize>(velocities: &[Vector<D>], target: &Vector<D>) -> f64 {
    let squares: f64 = velocities.iter().map(|v| (v - target).norm_squared()).sum();
    (squares / velocities.len().max(1) as f64).sqrt()
}

/// Structural energy H_s = V(q) + ½ Σ |p_i − p̄|²: Olfati-Saber (2003), (27), (30), with
/// the potential and the weights of `pair`, over the edges of `net`.
pub fn structural_energy<const D: usize>(
    positions: &[Vector<D>],
    velocities: &[Vector<D>],
    net: &Net,
    pair: &AlphaPair,
) -> f64 {
    let distance = |&[i, j]: &[usize; 2]| (positions[j] - positions[i]).norm();
    let potential: f64 = net
        .edges()
        .iter()
        .map(|edge| pair.potential(distance(edge)))
        .sum();
    let center = mean(velocities);
    let kinetic: f64 = velocities.iter().map(|v| (v - center).norm_squared()).sum();
    potential + 0.5 * kinetic
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Action, Bump, Fade};

    #[test]
    fn polarization_counts_headings_not_speeds() {
        let v = |x: f64, y: f64| Vector::<2>::new(x, y);
        assert_eq!(polarization(&[v(1.0, 0.0), v(9.0, 0.0)]), 1.0);
        assert_eq!(polarization(&[v(1.0, 0.0), v(-5.0, 0.0)]), 0.0);
        assert_eq!(polarization(&[v(1.0, 0.0), v(0.0, 0.0)]), 0.5);
    }

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
    }
}
