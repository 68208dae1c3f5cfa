//! A step as the engine took it: the ways of all bodies and obstacles, before bounces.

use super::way::{Way, rate_between};
use crate::math::{Matrix, Vector};
use crate::shape::{Obstacle, Pose};

/// The step that the engine has just taken, in which it let bounce nothing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flight<'a, const D: usize> {
    /// Time at its start, and its length.
    pub(crate) begin: f64,
    pub(crate) step: f64,
    /// Positions at its start and end.
    pub(crate) from: &'a [Vector<D>],
    pub(crate) to: &'a [Vector<D>],
    /// The engine's velocities at its end, and how long ago they were those of the bodies.
    pub(crate) velocities: &'a [Vector<D>],
    pub(crate) lag: f64,
    /// The accelerations of the step; nothing where velocities do not change evenly.
    pub(crate) accelerations: Option<&'a [Vector<D>]>,
    /// Whether each body was pressed against something by the engine.
    pub(crate) pressed: &'a [bool],
    /// Rotations at its start and end, and angular velocities at its end; nothing where nothing
    /// turns.
    pub(crate) turns: Option<(&'a [Matrix<D>], &'a [Matrix<D>], &'a [Vector<3>])>,
    /// The obstacles where they are at its end, and where they stood at its start.
    pub(crate) obstacles: &'a [Obstacle<D>],
    pub(crate) stood: &'a [Pose<D>],
}

impl<const D: usize> Flight<'_, D> {
    /// The way of an agent that bounces off nothing. A ball looks the same however it is turned,
    /// so it is followed in its angular velocity alone.
    pub(super) fn way(&self, agent: usize, ball: bool) -> Way<D> {
        let (position, velocity) = (self.from[agent], self.velocities[agent]);
        let (acceleration, velocity) = match self.accelerations {
            Some(accelerations) if !self.pressed[agent] => {
                let acceleration = accelerations[agent];
                (
                    acceleration,
                    velocity - acceleration * (self.step - self.lag),
                )
            }
            _ => (Vector::zeros(), (self.to[agent] - position) / self.step),
        };
        let (rotation, spin, turning) = match self.turns {
            None => (Matrix::identity(), Vector::zeros(), Vector::zeros()),
            Some((before, _, spins)) if ball => (before[agent], spins[agent], spins[agent]),
            Some((before, after, spins)) => {
                let short = rate_between(&before[agent], &after[agent], self.step);
                let turning = whole_turns(short, &spins[agent], self.step);
                (before[agent], spins[agent], turning)
            }
        };
        Way {
            since: 0.0,
            position,
            velocity,
            rotation,
            acceleration,
            spin,
            turning,
        }
    }

    /// The way of an obstacle.
    pub(super) fn wall(&self, obstacle: usize) -> Way<D> {
        let (from, to) = (&self.stood[obstacle], &self.obstacles[obstacle].pose);
        let turning = rate_between(from.rotation(), to.rotation(), self.step);
        Way {
            since: 0.0,
            position: from.translation,
            velocity: (to.translation - from.translation) / self.step,
            rotation: *from.rotation(),
            acceleration: Vector::zeros(),
            spin: turning,
            turning,
        }
    }

    /// How fast the surface of an obstacle moves at a point and a time of the step, by its motion
    /// itself.
    pub(super) fn surface(&self, obstacle: usize, point: &Vector<D>, time: f64) -> Vector<D> {
        let obstacle = &self.obstacles[obstacle];
        if obstacle.motion().is_none() {
            return Vector::zeros();
        }
        let mut then = obstacle.clone();
        then.move_to(self.begin + time);
        then.twist()
            .map_or(Vector::zeros(), |twist| twist.at(point))
    }

    /// How far the surface of an obstacle moved at most.
    pub(super) fn moved(&self, obstacle: usize) -> f64 {
        let it = &self.obstacles[obstacle];
        let Some(twist) = it.twist() else {
            return 0.0;
        };
        let way = self.wall(obstacle);
        let swing = way.turning.norm() * self.step;
        let reach = match swing > 0.0 {
            true => it.reach(),
            false => 0.0,
        };
        // Motions that swing to and fro may bend in the step as well.
        let straight = way
            .velocity
            .norm()
            .max(twist.at(&it.pose.translation).norm());
        2.0 * straight * self.step + swing * reach
    }
}

/// A rate of turning that leads the short way, or one that takes as many whole turns more as an
/// angular velocity tells.
fn whole_turns(short: Vector<3>, spin: &Vector<3>, step: f64) -> Vector<3> {
    let rate = spin.norm();
    // Most bodies turn far less.
    if rate * step < 2.0 {
        return short;
    }
    let axis = spin / rate;
    let turn = std::f64::consts::TAU / step;
    short + axis * (((spin - short).dot(&axis) / turn).round() * turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fast_spins_take_whole_turns() {
        let spin = Vector::<3>::new(0.0, 0.0, -1000.0);
        // Ten radians back are 2.57 on, the short way.
        let short = Vector::<3>::new(0.0, 0.0, (2.0 * std::f64::consts::TAU - 10.0) / 0.01);
        assert!((whole_turns(short, &spin, 0.01) - spin).norm() < 1e-9);
        let slow = Vector::<3>::new(0.0, 3.0, 0.0);
        assert_eq!(whole_turns(slow, &slow, 0.01), slow);
    }
}
