//! Where a shape stands.

use crate::math::{Matrix, Vector};

/// A rotation followed by a translation.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose<const D: usize> {
    /// Where the frame's origin is.
    pub translation: Vector<D>,
    /// Axis times angle in radians; in the plane only the last component counts.
    pub turn: [f64; 3],
    rotation: Matrix<D>,
}

impl<const D: usize> Pose<D> {
    /// From the origin's place and a rotation vector, of which the plane takes only the
    /// last component.
    pub fn new(translation: Vector<D>, turn: [f64; 3]) -> Self {
        let turn = if D == 2 { [0.0, 0.0, turn[2]] } else { turn };
        let full = nalgebra::Rotation3::from_scaled_axis(nalgebra::Vector3::from(turn));
        let rotation = Matrix::from_fn(|i, j| full[(i, j)]);
        Self {
            translation,
            turn,
            rotation,
        }
    }

    /// From the origin's place and a rotation matrix.
    pub fn from_matrix(translation: Vector<D>, rotation: Matrix<D>) -> Self {
        Self {
            translation,
            turn: turn(&rotation),
            rotation,
        }
    }

    /// The rotation, from the frame to the world.
    pub fn rotation(&self) -> &Matrix<D> {
        &self.rotation
    }

    /// A point of the frame, in the world.
    pub fn point_to_world(&self, point: &Vector<D>) -> Vector<D> {
        self.rotation * point + self.translation
    }

    /// A point of the world, in the frame.
    pub fn point_to_local(&self, point: &Vector<D>) -> Vector<D> {
        self.rotation.tr_mul(&(point - self.translation))
    }

    /// A direction of the frame, in the world.
    pub fn vector_to_world(&self, vector: &Vector<D>) -> Vector<D> {
        self.rotation * vector
    }

    /// A direction of the world, in the frame.
    pub fn vector_to_local(&self, vector: &Vector<D>) -> Vector<D> {
        self.rotation.tr_mul(vector)
    }

    /// A linear map of the frame, in the world.
    pub fn map_to_world(&self, map: &Matrix<D>) -> Matrix<D> {
        self.rotation * map * self.rotation.transpose()
    }
}

/// The rotation vector of a rotation matrix, its angle at most half a turn.
fn turn<const D: usize>(rotation: &Matrix<D>) -> [f64; 3] {
    if D == 2 {
        return [0.0, 0.0, rotation[(1, 0)].atan2(rotation[(0, 0)])];
    }
    let full = nalgebra::Rotation3::from_matrix_unchecked(nalgebra::Matrix3::from_fn(|i, j| {
        rotation[(i, j)]
    }));
    // By the quaternion, for the trace tells small angles only to half the digits.
    nalgebra::UnitQuaternion::from_rotation_matrix(&full)
        .scaled_axis()
        .into()
}
