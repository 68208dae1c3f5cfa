//! How well the agents move together.

use crate::math::{Vector, direction, mean};

/// Polarization |Σ v_i/|v_i||/N, from 0 to 1; an agent at rest counts as zero.
pub fn polarization<const D: usize>(velocities: &[Vector<D>]) -> f64 {
    let headings: Vec<_> = velocities.iter().map(direction).collect();
    mean(&headings).norm()
}

/// Root mean square of |v_i − target_i|; 0 without agents.
pub fn velocity_mismatch<const D: usize>(
    velocities: &[Vector<D>],
    targets: impl Iterator<Item = Vector<D>>,
) -> f64 {
    let errors = velocities.iter().zip(targets);
    let squares: f64 = errors.map(|(v, target)| (v - target).norm_squared()).sum();
    (squares / velocities.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polarization_counts_headings_not_speeds() {
        let v = |x: f64, y: f64| Vector::<2>::new(x, y);
        assert_eq!(polarization(&[v(1.0, 0.0), v(9.0, 0.0)]), 1.0);
        assert_eq!(polarization(&[v(1.0, 0.0), v(-5.0, 0.0)]), 0.0);
        assert_eq!(polarization(&[v(1.0, 0.0), v(0.0, 0.0)]), 0.5);
    }
}
