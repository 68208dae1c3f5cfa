//! Where a shape stands.

use crate::math::{Matrix, Vector, cross, sin_cos};

/// A rotation followed by a translation.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose<const D: usize> {
    /// Where the frame's origin is.
    pub translation: Vector<D>,
    rotation: Matrix<D>,
}

impl<const D: usize> Pose<D> {
    /// From the origin's place and a rotation vector, of which the plane takes only the
    /// last component.
    pub fn new(translation: Vector<D>, turn: [f64; 3]) -> Self {
        let turn = if D == 2 { [0.0, 0.0, turn[2]] } else { turn };
        let angle = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
        let rotation = match angle > 0.0 {
            true => rotation(turn.map(|x| x / angle), sin_cos(angle)),
            false => Matrix::identity(),
        };
        Self {
            translation,
            rotation,
        }
    }

    /// From the origin's place and a rotation matrix.
    pub fn from_matrix(translation: Vector<D>, rotation: Matrix<D>) -> Self {
        Self {
            translation,
            rotation,
        }
    }

    /// The same frame with its origin elsewhere.
    pub fn at(&self, translation: Vector<D>) -> Self {
        Self {
            translation,
            ..self.clone()
        }
    }

    /// The same frame turned about a point: around a unit axis (in the plane ±e₃), by an
    /// angle of which sine and cosine are given.
    pub fn turned(&self, about: &Vector<D>, axis: [f64; 3], sin_cos: (f64, f64)) -> Self {
        let by = rotation(axis, sin_cos);
        let turned = by * self.rotation;
        Self {
            translation: about + by * (self.translation - about),
            rotation: turned,
        }
    }

    /// The pose in the world of a frame that has the pose `inner` in this one.
    pub fn then(&self, inner: &Self) -> Self {
        let turned = self.rotation * inner.rotation;
        Self {
            translation: self.point_to_world(&inner.translation),
            rotation: turned,
        }
    }

    /// The rotation as axis times angle in radians, the angle at most half a turn; in the plane
    /// along the third axis.
    pub fn turn(&self) -> [f64; 3] {
        rotation_vector(&self.rotation)
    }

    /// The rotation as a matrix.
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

/// Rodrigues' formula, I + sin θ K + (1 − cos θ) K² with K = axis ×.
fn rotation<const D: usize>(axis: [f64; 3], (sin, cos): (f64, f64)) -> Matrix<D> {
    let k = cross::<D>(axis);
    Matrix::identity() + k * sin + k * k * (1.0 - cos)
}

/// The rotation vector of a rotation, its angle from −π to π (0 to π in space).
fn rotation_vector<const D: usize>(rotation: &Matrix<D>) -> [f64; 3] {
    if D == 2 {
        return [0.0, 0.0, rotation[(1, 0)].atan2(rotation[(0, 0)])];
    }
    let full = nalgebra::Matrix3::from_fn(|i, j| rotation[(i, j)]);
    let full = nalgebra::Rotation3::from_matrix_unchecked(full);
    nalgebra::UnitQuaternion::from_rotation_matrix(&full)
        .scaled_axis()
        .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_vectors_come_back() {
        for turn in [
            [0.0; 3],
            [0.3, -0.2, 0.9],
            [0.0, 3.1, 0.0],
            [1e-9, 0.0, 0.0],
        ] {
            let pose = Pose::<3>::new(Vector::<3>::zeros(), turn);
            let back = rotation_vector(pose.rotation());
            for k in 0..3 {
                assert!((back[k] - turn[k]).abs() < 1e-12, "{turn:?} {back:?}");
            }
        }
    }

    #[test]
    fn frames_in_frames_compose() {
        let outer = Pose::<3>::new(Vector::<3>::new(1.0, 2.0, 3.0), [0.4, -1.0, 0.2]);
        let inner = Pose::<3>::new(Vector::<3>::new(-0.5, 0.1, 0.0), [2.0, 0.3, -0.7]);
        let point = Vector::<3>::new(0.3, 0.4, -5.0);
        let both = outer.then(&inner).point_to_world(&point);
        let each = outer.point_to_world(&inner.point_to_world(&point));
        assert!((both - each).norm() < 1e-14);
        let again = Pose::new(outer.then(&inner).translation, outer.then(&inner).turn());
        assert!((again.point_to_world(&point) - each).norm() < 1e-13);
    }
}
