//! Milling: turning about the common centre.

use crate::math::{Vector, direction, mean};

/// Normalised angular momentum M = |Σ r_i × v_i| / Σ |r_i||v_i| about the mean position,
/// with r_i the position relative to it: Y.-L. Chuang et al., "State transitions and the
/// continuum limit for a 2D interacting, self-propelled particle system" (2007). From 0 to
/// 1, and 1 where all turn one way on circles about the centre (in space, about one axis
/// through it, in its plane).
///
/// `None` where nobody moves away from the centre: for one agent, or for agents at rest.
pub fn milling<const D: usize>(positions: &[Vector<D>], velocities: &[Vector<D>]) -> Option<f64> {
    let center = mean(positions);
    let arms: Vec<_> = positions.iter().map(|q| q - center).collect();
    let scale: f64 = arms
        .iter()
        .zip(velocities)
        .map(|(r, v)| r.norm() * v.norm())
        .sum();
    (scale > 0.0).then(|| (turning(&arms, velocities) / scale).min(1.0))
}

/// Group rotation m = |Σ r̂_i × v̂_i| / N about the mean position, with r̂_i and v̂_i the
/// directions of relative position and velocity: I. D. Couzin et al., "Collective memory
/// and spatial sorting in animal groups" (2002). As [`milling`], but every agent counts
/// alike, however far out and fast; one at rest or at the centre counts as zero, so that
/// one agent gives 0, and no agents 0.
pub fn rotation<const D: usize>(positions: &[Vector<D>], velocities: &[Vector<D>]) -> f64 {
    let center = mean(positions);
    let arms: Vec<_> = positions.iter().map(|q| direction(&(q - center))).collect();
    let headings: Vec<_> = velocities.iter().map(direction).collect();
    (turning(&arms, &headings) / positions.len().max(1) as f64).min(1.0)
}

/// |Σ r × v|. In place of the cross product stands the bivector r_a v_b − r_b v_a, which
/// exists in every dimension and has the same length.
fn turning<const D: usize>(arms: &[Vector<D>], velocities: &[Vector<D>]) -> f64 {
    let mut squares = 0.0;
    for a in 0..D {
        for b in a + 1..D {
            let part: f64 = arms
                .iter()
                .zip(velocities)
                .map(|(r, v)| r[a] * v[b] - r[b] * v[a])
                .sum();
            squares += part * part;
        }
    }
    squares.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_mills_and_a_marching_column_does_not() {
        let turn = |k: u32| f64::from(k) * std::f64::consts::TAU / 8.0;
        let ring: Vec<_> = (0..8)
            .map(|k| Vector::<2>::new(turn(k).cos(), turn(k).sin()) * 3.0)
            .collect();
        let around: Vec<_> = ring
            .iter()
            .map(|q| Vector::<2>::new(-q.y, q.x) * 0.2)
            .collect();
        let out: Vec<_> = ring.iter().map(|q| q * 0.2).collect();
        let along = vec![Vector::<2>::new(1.0, 0.0); 8];
        assert!((milling(&ring, &around).unwrap() - 1.0).abs() < 1e-14);
        assert!((rotation(&ring, &around) - 1.0).abs() < 1e-14);
        for velocities in [&out, &along] {
            assert!(milling(&ring, velocities).unwrap() < 1e-14);
            assert!(rotation(&ring, velocities) < 1e-14);
        }
        // One who turns the other way takes a quarter: 7 − 1 of 8.
        let mut mixed = around.clone();
        mixed[3] *= -1.0;
        assert!((rotation(&ring, &mixed) - 0.75).abs() < 1e-14);
    }

    #[test]
    fn in_space_the_axis_may_point_anywhere() {
        let axis = Vector::<3>::new(1.0, -2.0, 0.5);
        let positions: Vec<_> = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]
            .map(|(a, b)| {
                let one = axis.cross(&Vector::<3>::x()).normalize();
                one * a + axis.normalize().cross(&one) * b
            })
            .to_vec();
        let velocities: Vec<_> = positions.iter().map(|q| axis.cross(q)).collect();
        assert!((milling(&positions, &velocities).unwrap() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn nobody_moving_is_no_mill() {
        let (at, rest) = (
            [Vector::<2>::zeros(), Vector::<2>::x()],
            [Vector::<2>::zeros(); 2],
        );
        assert_eq!(milling(&at, &rest), None);
        assert_eq!(rotation(&at, &rest), 0.0);
        assert_eq!(milling(&at[..1], &[Vector::<2>::x()]), None);
    }
}
