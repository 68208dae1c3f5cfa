//! Vectors and the scalar functions that the laws are made of.

mod action;
mod alpha_pair;
mod angle;
mod bump;
mod digits;
mod gain;
mod influence;
mod normal;
mod ode;
mod potential;
mod radial;
mod time_function;
mod trajectory;
mod turn;
mod way;

pub use action::Action;
pub use alpha_pair::{AlphaPair, Fade};
pub use angle::{angle_between, turn_between};
pub use bump::Bump;
pub(crate) use digits::digits;
pub use gain::{Gain, shortened};
pub use influence::Influence;
pub use normal::normal_quantile;
pub use ode::{DormandPrince, Method, Radau, Solution, Stand, Stuck, Stumble, System};
pub use potential::Potential;
pub use radial::{LARGEST_SQUARE, Radial, Repulsion, WithRadial, vectorized};
pub(crate) use radial::{exp, inverse_square_root};
pub use time_function::{Interpolation, TimeFunction};
pub use trajectory::{Moment, Spline, Trajectory, plane_across};
pub use turn::{sin_cos, sin_cos_of_turns};
pub use way::{Way, turn as turning_place};

/// A vector of the `D`-dimensional world.
pub type Vector<const D: usize> = nalgebra::SVector<f64, D>;

/// A linear map of the `D`-dimensional world.
pub type Matrix<const D: usize> = nalgebra::SMatrix<f64, D, D>;

/// The bounded feedback φ(z) = z/√(1+|z|²): Olfati-Saber (2003), below (64). Its
/// length stays below 1.
pub fn saturate<const D: usize>(z: &Vector<D>) -> Vector<D> {
    z / (1.0 + z.norm_squared()).sqrt()
}

/// The unit vector along `z`, or zero where `z` is zero.
pub fn direction<const D: usize>(z: &Vector<D>) -> Vector<D> {
    let squared = z.norm_squared();
    if squared.is_normal() {
        return z / squared.sqrt();
    }
    // Very long or very short: its square cannot be told from infinity or zero.
    let largest = z.amax();
    if largest > 0.0 {
        (z / largest).normalize()
    } else {
        Vector::zeros()
    }
}

/// The unit vector along the coordinate axis number `k`.
pub fn axis<const D: usize>(k: usize) -> Vector<D> {
    Vector::from_fn(|row, _| if row == k { 1.0 } else { 0.0 })
}

/// The cross product with a vector, ω × x, as a matrix: the velocity that a rotation
/// at the rate ω gives a point at x from the axis. In the plane ω is along e₃.
pub fn cross<const D: usize>(omega: [f64; 3]) -> Matrix<D> {
    let [x, y, z] = omega;
    let full = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    Matrix::from_fn(|i, j| full[i][j])
}

/// The mean of some vectors, summed in their order; zero where there are none.
pub fn mean<const D: usize>(vectors: &[Vector<D>]) -> Vector<D> {
    if vectors.is_empty() {
        return Vector::zeros();
    }
    vectors.iter().sum::<Vector<D>>() / vectors.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_have_length_one_however_long_the_vector() {
        for length in [1e-310, 1e-200, 1.0, 1e200, 1e300] {
            let along = direction(&(Vector::<2>::new(3.0, 4.0) * length));
            assert!(
                (along - Vector::<2>::new(0.6, 0.8)).norm() < 1e-9,
                "{length}"
            );
        }
        assert_eq!(direction(&Vector::<2>::zeros()), Vector::<2>::zeros());
    }
}
