//! How a body moves through a step: a parabola, or a straight line, turning at a constant rate.

use crate::math::{Matrix, Vector, sin_cos};
use crate::shape::Pose;

/// The way of a body from some time of the step on; times count from the step's start.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Way<const D: usize> {
    /// Since when it goes this way.
    pub(super) since: f64,
    /// Position, velocity and rotation then.
    pub(super) position: Vector<D>,
    pub(super) velocity: Vector<D>,
    pub(super) rotation: Matrix<D>,
    /// Acceleration all along.
    pub(super) acceleration: Vector<D>,
    /// Angular velocity; in the plane the last component.
    pub(super) spin: Vector<3>,
    /// The rate at which it is turned all along: the mean of its angular velocity, which torques
    /// change.
    pub(super) turning: Vector<3>,
}

impl<const D: usize> Way<D> {
    /// Where it is at a time.
    pub(super) fn position_at(&self, time: f64) -> Vector<D> {
        let t = time - self.since;
        self.position + (self.velocity + self.acceleration * (0.5 * t)) * t
    }

    /// How fast it is at a time.
    pub(super) fn velocity_at(&self, time: f64) -> Vector<D> {
        self.velocity + self.acceleration * (time - self.since)
    }

    /// How it is turned at a time.
    pub(super) fn rotation_at(&self, time: f64) -> Matrix<D> {
        turned(&self.rotation, &self.turning, time - self.since)
    }

    /// Where it stands at a time.
    pub(super) fn pose_at(&self, time: f64) -> Pose<D> {
        Pose::from_matrix(self.position_at(time), self.rotation_at(time))
    }

    /// How fast its point at `place` moves at a time.
    pub(super) fn velocity_of(&self, place: &Vector<D>, time: f64) -> Vector<D> {
        let arm = embed(&(place - self.position_at(time)));
        self.velocity_at(time) + project(&self.spin.cross(&arm))
    }

    /// The same way, told from a later time on.
    pub(super) fn from(&self, time: f64) -> Self {
        Self {
            since: time,
            position: self.position_at(time),
            velocity: self.velocity_at(time),
            rotation: self.rotation_at(time),
            ..*self
        }
    }

    /// Whether it turns on the way.
    pub(super) fn turns(&self) -> bool {
        self.turning.amax() > 0.0 || self.spin.amax() > 0.0
    }
}

/// A rotation after some time of turning at a rate.
fn turned<const D: usize>(rotation: &Matrix<D>, spin: &Vector<3>, time: f64) -> Matrix<D> {
    let rate = spin.norm();
    if rate * time == 0.0 {
        return *rotation;
    }
    let axis: [f64; 3] = (spin / rate).into();
    let here = Pose::from_matrix(Vector::zeros(), *rotation);
    let there = here.turned(&Vector::zeros(), axis, sin_cos(rate * time));
    *there.rotation()
}

/// The angular velocity that takes a rotation to another in some time, the short way.
pub(super) fn rate_between<const D: usize>(
    from: &Matrix<D>,
    to: &Matrix<D>,
    time: f64,
) -> Vector<3> {
    if from == to {
        return Vector::zeros();
    }
    let between = Pose::from_matrix(Vector::zeros(), to * from.transpose());
    Vector::<3>::from(between.turn()) / time
}

/// A vector in space.
pub(super) fn embed<const D: usize>(vector: &Vector<D>) -> Vector<3> {
    Vector::<3>::from_fn(|k, _| if k < D { vector[k] } else { 0.0 })
}

/// What of a vector in space lies in the world.
pub(super) fn project<const D: usize>(vector: &Vector<3>) -> Vector<D> {
    Vector::from_fn(|k, _| vector[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn way() -> Way<3> {
        Way {
            since: 0.25,
            position: Vector::<3>::new(1.0, -2.0, 0.5),
            velocity: Vector::<3>::new(3.0, 0.0, -1.0),
            rotation: Matrix::identity(),
            acceleration: Vector::<3>::new(0.0, -9.81, 2.0),
            spin: Vector::<3>::new(0.4, -2.0, 1.1),
            turning: Vector::<3>::new(0.4, -2.0, 1.1),
        }
    }

    #[test]
    fn a_way_told_from_later_on_is_the_same() {
        let (way, later) = (way(), way().from(0.5));
        assert!((way.position_at(0.8) - later.position_at(0.8)).norm() < 1e-15);
        assert!((way.velocity_at(0.8) - later.velocity_at(0.8)).norm() < 1e-15);
        assert!((way.rotation_at(0.8) - later.rotation_at(0.8)).norm() < 1e-15);
    }

    #[test]
    fn a_rate_leads_from_one_rotation_to_the_other() {
        let way = way();
        let (from, to) = (way.rotation_at(0.3), way.rotation_at(0.4));
        let rate = rate_between(&from, &to, 0.1);
        assert!((rate - way.spin).norm() < 1e-12);
        assert_eq!(rate_between(&from, &from, 0.1), Vector::<3>::zeros());
    }

    #[test]
    fn points_of_a_body_move_as_differences_tell() {
        let way = way();
        let place = Vector::<3>::new(1.5, -2.5, 0.1);
        let inner = way.pose_at(0.4).point_to_local(&place);
        let at = |time: f64| way.pose_at(time).point_to_world(&inner);
        let difference = (at(0.4 + 1e-6) - at(0.4 - 1e-6)) / 2e-6;
        assert!((difference - way.velocity_of(&place, 0.4)).norm() < 1e-8);
    }
}
