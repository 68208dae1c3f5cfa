//! Motions of obstacles: pose and velocity as closed functions of time.

use std::f64::consts::TAU;

use crate::math::{Matrix, Vector, cross, sin_cos, sin_cos_of_turns};
use crate::shape::Pose;

/// How an obstacle moves.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion<const D: usize> {
    /// To and fro: position + amplitude · sin(2πt/period + phase).
    Oscillation {
        /// Farthest displacement.
        amplitude: Vector<D>,
        /// Time of one oscillation, above 0.
        period: f64,
        /// Phase at time 0, in radians.
        phase: f64,
    },
    /// Turning at a constant rate.
    Rotation {
        /// The point that stays; the obstacle's own position where absent.
        about: Option<Vector<D>>,
        /// Angular velocity, axis times radians per time; along e₃ in the plane.
        rate: [f64; 3],
    },
    /// Round trips over points.
    Waypoints {
        /// The points, at least two, not all the same.
        points: Vec<Vector<D>>,
        /// Time spent at each point.
        dwell: f64,
        /// Time of a round trip, above the sum of the times spent at points.
        period: f64,
        /// How each leg is travelled.
        easing: Easing,
    },
    /// Motion at a constant velocity.
    Drift {
        /// The velocity.
        velocity: Vector<D>,
    },
}

/// How a leg between two waypoints is travelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Easing {
    /// At constant speed.
    Linear,
    /// From rest to rest, by the share 3u² − 2u³ of the way at the share u of the time.
    Smooth,
}

/// Velocity of a rigid body: of each of its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Twist<const D: usize> {
    /// Angular velocity, axis times radians per time; along e₃ in the plane.
    pub rate: [f64; 3],
    spin: Matrix<D>,
    origin: Vector<D>,
    velocity: Vector<D>,
}

impl<const D: usize> Twist<D> {
    /// Of a body that turns at `rate` while its point `origin` moves at `velocity`.
    fn new(origin: Vector<D>, velocity: Vector<D>, rate: [f64; 3]) -> Self {
        Self {
            rate,
            spin: cross(rate),
            origin,
            velocity,
        }
    }

    /// Velocity of the body's point that is at `point` now.
    pub fn at(&self, point: &Vector<D>) -> Vector<D> {
        self.velocity + self.spin * (point - self.origin)
    }
}

impl<const D: usize> Motion<D> {
    /// Pose and velocity at a time, of what stands at `rest` before any motion.
    pub fn at(&self, rest: &Pose<D>, time: f64) -> (Pose<D>, Twist<D>) {
        let moved = |translation: Vector<D>, velocity: Vector<D>| {
            let twist = Twist::new(translation, velocity, [0.0; 3]);
            (rest.at(translation), twist)
        };
        match self {
            Self::Oscillation {
                amplitude,
                period,
                phase,
            } => {
                // The remainder is exact, however long the time.
                let turns = (time % period) / period;
                let (sin, cos) = sum(sin_cos_of_turns(turns), sin_cos(*phase));
                moved(
                    rest.translation + amplitude * sin,
                    amplitude * (cos * TAU / period),
                )
            }
            Self::Rotation { about, rate } => {
                let about = about.unwrap_or(rest.translation);
                let speed = rate.iter().map(|x| x * x).sum::<f64>().sqrt();
                let pose = match speed > 0.0 {
                    true => {
                        let turned = sin_cos_of_turns(time * speed / TAU);
                        rest.turned(&about, rate.map(|x| x / speed), turned)
                    }
                    false => rest.clone(),
                };
                (pose, Twist::new(about, Vector::zeros(), *rate))
            }
            Self::Waypoints {
                points,
                dwell,
                period,
                easing,
            } => {
                let (place, velocity) = round_trip(points, *dwell, *period, *easing, time % period);
                moved(place, velocity)
            }
            Self::Drift { velocity } => moved(rest.translation + velocity * time, *velocity),
        }
    }

    /// Whether the motion turns the body.
    pub fn turns(&self) -> bool {
        matches!(self, Self::Rotation { rate, .. } if rate.iter().any(|&x| x != 0.0))
    }
}

/// Sine and cosine of the sum of two angles.
fn sum((sin_a, cos_a): (f64, f64), (sin_b, cos_b): (f64, f64)) -> (f64, f64) {
    (sin_a * cos_b + cos_a * sin_b, cos_a * cos_b - sin_a * sin_b)
}

/// Place and velocity at a time within one round trip. Each leg takes its share of the
/// travelling time by length.
fn round_trip<const D: usize>(
    points: &[Vector<D>],
    dwell: f64,
    period: f64,
    easing: Easing,
    time: f64,
) -> (Vector<D>, Vector<D>) {
    let legs = || points.iter().zip(points.iter().cycle().skip(1));
    let length: f64 = legs().map(|(from, to)| (to - from).norm()).sum();
    let travel = period - dwell * points.len() as f64;
    let mut left = time;
    for (from, to) in legs() {
        if left < dwell {
            return (*from, Vector::zeros());
        }
        left -= dwell;
        let leg = to - from;
        let takes = travel * leg.norm() / length;
        if left < takes {
            let u = left / takes;
            let (share, slope) = match easing {
                Easing::Linear => (u, 1.0),
                Easing::Smooth => (u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u)),
            };
            return (from + leg * share, leg * (slope / takes));
        }
        left -= takes;
    }
    // Rounding can leave a last instant over, at the end of the last leg.
    (points[0], Vector::zeros())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motions() -> Vec<Motion<3>> {
        vec![
            Motion::Oscillation {
                amplitude: Vector::<3>::new(1.0, -2.0, 0.5),
                period: 1.7,
                phase: 0.4,
            },
            Motion::Rotation {
                about: Some(Vector::<3>::new(3.0, 0.0, -1.0)),
                rate: [0.3, -0.8, 0.5],
            },
            Motion::Waypoints {
                points: vec![
                    Vector::<3>::new(0.0, 0.0, 0.0),
                    Vector::<3>::new(4.0, 0.0, 0.0),
                    Vector::<3>::new(4.0, 3.0, 1.0),
                ],
                dwell: 0.2,
                period: 5.0,
                easing: Easing::Smooth,
            },
            Motion::Drift {
                velocity: Vector::<3>::new(0.1, 0.2, 0.3),
            },
        ]
    }

    #[test]
    fn velocities_are_derivatives_of_poses() {
        let rest = Pose::<3>::new(Vector::<3>::new(0.5, 0.2, 0.1), [0.2, 0.1, -0.4]);
        let marked = Vector::<3>::new(0.7, -0.3, 1.1);
        for motion in motions() {
            for k in 0..200 {
                let (time, h) = (0.0531 * f64::from(k) + 0.01, 1e-5);
                let place = |time| motion.at(&rest, time).0.point_to_world(&marked);
                let numeric = (place(time + h) - place(time - h)) / (2.0 * h);
                let exact = motion.at(&rest, time).1.at(&place(time));
                let error = (numeric - exact).norm();
                assert!(error < 1e-4, "{motion:?} at {time}: {error}");
            }
        }
    }

    #[test]
    fn periods_hold_at_any_time() {
        let rest = Pose::<3>::new(Vector::<3>::zeros(), [0.0; 3]);
        // A period that binary fractions express, so that the sums are exact.
        let motion = Motion::Oscillation {
            amplitude: Vector::<3>::new(1.0, 0.0, 0.0),
            period: 0.75,
            phase: 0.3,
        };
        let early = motion.at(&rest, 0.25);
        assert_eq!(motion.at(&rest, 0.25 + 0.75 * 2f64.powi(40)), early);
    }

    #[test]
    fn waypoints_are_met_and_rested_at() {
        let Motion::Waypoints { points, .. } = &motions()[2] else {
            panic!("the list has changed");
        };
        let at = |time| round_trip(points, 0.2, 5.0, Easing::Linear, time);
        let length = 4.0 + 10f64.sqrt() + 26f64.sqrt();
        let first = 0.2 + 4.4 * 4.0 / length;
        assert_eq!(at(0.1), (points[0], Vector::<3>::zeros()));
        assert_eq!(at(first + 0.1), (points[1], Vector::<3>::zeros()));
        let (_, velocity) = at(0.5);
        assert!((velocity.norm() - length / 4.4).abs() < 1e-12, "one speed");
    }
}
