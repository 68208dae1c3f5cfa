//! How far a flock is from a pattern about its mean position.

use crate::math::{Vector, direction, mean};

/// Largest distance of a position from the line through their mean along `along`, of any
/// length: max_i |⟨x_i − x̄, l⟩l − (x_i − x̄)|, Li, Liu & Wu, (4). 0 without positions.
pub fn line_residual<const D: usize>(positions: &[Vector<D>], along: &Vector<D>) -> f64 {
    let along = direction(along);
    farthest(positions, |arm| (along * arm.dot(&along) - arm).norm())
}

/// Largest distance of a position from the circle, in space the sphere, of this radius
/// about their mean: max_i | |x_i − x̄| − R |, Li, Liu & Wu, (6). 0 without positions.
pub fn ball_residual<const D: usize>(positions: &[Vector<D>], radius: f64) -> f64 {
    farthest(positions, |arm| (arm.norm() - radius).abs())
}

fn farthest<const D: usize>(positions: &[Vector<D>], away: impl Fn(Vector<D>) -> f64) -> f64 {
    let center = mean(positions);
    let far = positions.iter().map(|position| away(position - center));
    far.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residuals_of_a_square() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let square = square.map(|(x, y)| Vector::<2>::new(x, y));
        let diagonal = Vector::<2>::new(3.0, 3.0);
        assert!((line_residual(&square, &diagonal) - 2f64.sqrt()).abs() < 1e-12);
        assert!(line_residual(&square[1..2], &diagonal) < 1e-12);
        assert!((ball_residual(&square, 1.0) - (2f64.sqrt() - 1.0)).abs() < 1e-12);
        assert!(ball_residual(&square, 2f64.sqrt()) < 1e-12);
    }
}
