//! Kinetic energies, as the papers use them.

use crate::math::{Vector, mean};

/// ½ Σ |v̂_i|² with v̂_i = v_i − v_c relative to the mean velocity: what the energies W of
/// Song et al. (2013), (12) and (19), have beside their potentials. Masses count as 1.
pub fn relative_kinetic_energy<const D: usize>(velocities: &[Vector<D>]) -> f64 {
    let center = mean(velocities);
    let squares = velocities.iter().map(|v| (v - center).norm_squared());
    0.5 * squares.sum::<f64>()
}

/// ½ Σ m_i |v_i|²: what the energy J of Shi, Wang & Chu has beside its potentials.
pub fn kinetic_energy<const D: usize>(masses: &[f64], velocities: &[Vector<D>]) -> f64 {
    let energies = masses.iter().zip(velocities);
    0.5 * energies
        .map(|(mass, v)| mass * v.norm_squared())
        .sum::<f64>()
}

/// E = max_i ½ |v_i|²: Djokam & Rathinam, Lemma 1; 0 without agents.
pub fn largest_kinetic_energy<const D: usize>(velocities: &[Vector<D>]) -> f64 {
    let squares = velocities.iter().map(Vector::norm_squared);
    0.5 * squares.fold(0.0, f64::max)
}

/// The mean of some vectors, weighted by masses: the centre of mass x* of positions, and
/// its velocity v* of velocities, in Shi, Wang & Chu. Zero without agents.
pub fn center_of_mass<const D: usize>(masses: &[f64], vectors: &[Vector<D>]) -> Vector<D> {
    let total: f64 = masses.iter().sum();
    if total <= 0.0 {
        return Vector::zeros();
    }
    let weighted = masses.iter().zip(vectors).map(|(mass, x)| x * *mass);
    weighted.sum::<Vector<D>>() / total
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energies_of_two_agents_by_hand() {
        let velocities = [Vector::<2>::new(3.0, 0.0), Vector::<2>::new(0.0, 1.0)];
        let masses = [2.0, 4.0];
        assert_eq!(kinetic_energy(&masses, &velocities), 9.0 + 2.0);
        assert_eq!(largest_kinetic_energy(&velocities), 4.5);
        // Each is half their difference, of length √10, away from the mean.
        assert!((relative_kinetic_energy(&velocities) - 2.5).abs() < 1e-15);
        assert_eq!(
            center_of_mass(&masses, &velocities),
            Vector::<2>::new(1.0, 2.0 / 3.0)
        );
        assert_eq!(center_of_mass::<2>(&[], &[]), Vector::<2>::zeros());
    }
}
