//! Trajectories: places as functions of time, with velocity and acceleration.

mod ring;
mod spline;

use std::f64::consts::TAU;
use std::fmt;
use std::sync::Arc;

use crate::math::{Vector, sin_cos_of_turns};

pub use ring::plane_across;
pub use spline::Spline;

/// Place, velocity and acceleration at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment<const D: usize> {
    /// y.
    pub position: Vector<D>,
    /// ẏ.
    pub velocity: Vector<D>,
    /// ÿ.
    pub acceleration: Vector<D>,
}

/// A place that moves, y(t). Velocity and acceleration are its exact derivatives, and the
/// same on every platform but for those of a function of one's own.
#[derive(Clone)]
pub enum Trajectory<const D: usize> {
    /// start + velocity · t.
    Line {
        /// The place at time 0.
        start: Vector<D>,
        /// The velocity.
        velocity: Vector<D>,
    },
    /// center + a cos θ + b sin θ with θ = ωt + phase: an ellipse whose conjugate half axes
    /// are a and b, a circle where they are of one length and at right angles.
    Ellipse {
        /// The centre.
        center: Vector<D>,
        /// a and b.
        half_axes: [Vector<D>; 2],
        /// ω, in radians per time.
        angular_velocity: f64,
        /// Phase at time 0, in radians.
        phase: f64,
    },
    /// Along each axis an oscillation of its own: center + amplitude · sin(ωt + phase).
    Lissajous {
        /// The centre.
        center: Vector<D>,
        /// Amplitude along each axis.
        amplitudes: Vector<D>,
        /// ω of each axis, in radians per time.
        angular_velocities: Vector<D>,
        /// Phase of each axis at time 0, in radians.
        phases: Vector<D>,
    },
    /// From point to point along straight lines, at rest before the first time and after the
    /// last. At a point the velocity is that of the way ahead, and the acceleration is 0,
    /// though the velocity jumps there.
    Waypoints {
        /// The times, increasing; at least one.
        times: Vec<f64>,
        /// One point for each time.
        points: Vec<Vector<D>>,
    },
    /// From point to point along a cubic spline.
    Spline(Spline<D>),
    /// The sum of some trajectories, of their places as of their derivatives.
    Sum(Vec<Trajectory<D>>),
    /// A function of one's own, which must give the same for the same time, whatever was
    /// asked before, and the derivatives that belong to the place.
    Own(Arc<dyn Fn(f64) -> Moment<D> + Send + Sync>),
}

impl<const D: usize> Moment<D> {
    /// At rest.
    pub fn at_rest(position: Vector<D>) -> Self {
        Self {
            position,
            velocity: Vector::zeros(),
            acceleration: Vector::zeros(),
        }
    }
}

impl<const D: usize> Trajectory<D> {
    /// A place that does not move.
    pub fn rest(place: Vector<D>) -> Self {
        Self::Line {
            start: place,
            velocity: Vector::zeros(),
        }
    }

    /// A circle, run through counter-clockwise seen from the tip of `axis` where the angular
    /// velocity is positive; see [`plane_across`] for where its phase counts from. In the
    /// plane the axis is not used.
    pub fn circle(
        center: Vector<D>,
        radius: f64,
        axis: &Vector<D>,
        angular_velocity: f64,
        phase: f64,
    ) -> Self {
        Self::Ellipse {
            center,
            half_axes: plane_across(axis).map(|unit| unit * radius),
            angular_velocity,
            phase,
        }
    }

    /// A function of one's own.
    pub fn own(function: impl Fn(f64) -> Moment<D> + Send + Sync + 'static) -> Self {
        Self::Own(Arc::new(function))
    }

    /// Place, velocity and acceleration at a time.
    pub fn at(&self, time: f64) -> Moment<D> {
        match self {
            Self::Line { start, velocity } => Moment {
                velocity: *velocity,
                ..Moment::at_rest(start + velocity * time)
            },
            Self::Ellipse {
                center,
                half_axes: [a, b],
                angular_velocity,
                phase,
            } => {
                let (sin, cos) = sin_cos_of_turns((angular_velocity * time + phase) / TAU);
                let from_center = a * cos + b * sin;
                Moment {
                    position: center + from_center,
                    velocity: (b * cos - a * sin) * *angular_velocity,
                    acceleration: -from_center * (angular_velocity * angular_velocity),
                }
            }
            Self::Lissajous {
                center,
                amplitudes,
                angular_velocities,
                phases,
            } => {
                let mut moment = Moment::at_rest(*center);
                for k in 0..D {
                    let (amplitude, rate) = (amplitudes[k], angular_velocities[k]);
                    let (sin, cos) = sin_cos_of_turns((rate * time + phases[k]) / TAU);
                    moment.position[k] += amplitude * sin;
                    moment.velocity[k] = amplitude * rate * cos;
                    moment.acceleration[k] = -amplitude * rate * rate * sin;
                }
                moment
            }
            Self::Waypoints { times, points } => leg(times, points, time),
            Self::Spline(spline) => spline.at(time),
            Self::Sum(terms) => {
                let mut sum = Moment::at_rest(Vector::zeros());
                for term in terms {
                    let moment = term.at(time);
                    sum.position += moment.position;
                    sum.velocity += moment.velocity;
                    sum.acceleration += moment.acceleration;
                }
                sum
            }
            Self::Own(function) => function(time),
        }
    }
}

/// On the straight way between two points; at rest at the origin where there are none.
fn leg<const D: usize>(times: &[f64], points: &[Vector<D>], time: f64) -> Moment<D> {
    let after = times.partition_point(|known| *known <= time);
    let (Some(last), Some(next)) = (after.checked_sub(1), points.get(after)) else {
        // Before the first time or after the last.
        let end = after.min(points.len().saturating_sub(1));
        return Moment::at_rest(points.get(end).copied().unwrap_or_else(Vector::zeros));
    };
    let velocity = (next - points[last]) / (times[after] - times[last]);
    Moment {
        velocity,
        ..Moment::at_rest(points[last] + velocity * (time - times[last]))
    }
}

impl<const D: usize> fmt::Debug for Trajectory<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line { start, velocity } => {
                write!(f, "{:?} + {:?}·t", start.as_slice(), velocity.as_slice())
            }
            Self::Ellipse {
                center,
                half_axes: [a, b],
                angular_velocity,
                phase,
            } => write!(
                f,
                "{:?} + {:?}·cos θ + {:?}·sin θ, θ = {angular_velocity}·t + {phase}",
                center.as_slice(),
                a.as_slice(),
                b.as_slice()
            ),
            Self::Lissajous {
                center,
                amplitudes,
                angular_velocities,
                phases,
            } => write!(
                f,
                "{:?} + {:?}·sin({:?}·t + {:?})",
                center.as_slice(),
                amplitudes.as_slice(),
                angular_velocities.as_slice(),
                phases.as_slice()
            ),
            Self::Waypoints { times, points } => (f.debug_struct("Waypoints"))
                .field("times", times)
                .field("points", points)
                .finish(),
            Self::Spline(spline) => spline.fmt(f),
            Self::Sum(terms) => f.debug_tuple("Sum").field(terms).finish(),
            Self::Own(_) => f.write_str("Own(…)"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points() -> Vec<Vector<3>> {
        [
            [0.0, 0.0, 0.0],
            [1.0, -0.5, 0.3],
            [0.5, 2.0, 1.0],
            [3.0, 0.0, -1.0],
            [0.0, 0.0, 0.0],
        ]
        .map(Vector::<3>::from)
        .to_vec()
    }

    /// One of each smooth kind.
    fn smooth() -> Vec<Trajectory<3>> {
        let times = vec![0.0, 0.7, 1.1, 2.4, 3.0];
        let center = Vector::<3>::new(1.0, 2.0, 3.0);
        let line = Trajectory::Line {
            start: center,
            velocity: Vector::<3>::new(0.3, -2.0, 1.0),
        };
        let circle = Trajectory::circle(center, 2.0, &Vector::<3>::new(1.0, 1.0, -1.0), -1.3, 0.4);
        let own = |t: f64| Moment {
            position: Vector::<3>::repeat(t * t * t),
            velocity: Vector::<3>::repeat(3.0 * t * t),
            acceleration: Vector::<3>::repeat(6.0 * t),
        };
        vec![
            Trajectory::rest(center),
            line.clone(),
            circle.clone(),
            Trajectory::Ellipse {
                center,
                half_axes: [
                    Vector::<3>::new(3.0, 0.0, 1.0),
                    Vector::<3>::new(0.5, 1.0, 0.0),
                ],
                angular_velocity: 0.8,
                phase: -0.7,
            },
            Trajectory::Lissajous {
                center,
                amplitudes: Vector::<3>::new(1.0, 2.0, 0.5),
                angular_velocities: Vector::<3>::new(1.0, -2.0, 3.1),
                phases: Vector::<3>::new(0.0, 0.5, 1.0),
            },
            Trajectory::Spline(Spline::natural(times.clone(), points())),
            Trajectory::Spline(Spline::periodic(times, points())),
            Trajectory::Sum(vec![line, circle]),
            Trajectory::own(own),
        ]
    }

    #[test]
    fn derivatives_are_those_of_the_place() {
        let h = 1e-4;
        for trajectory in smooth() {
            for k in 0..400 {
                // Never at a point of the splines, where the third derivative jumps.
                let time = -1.0 + 0.01537 * f64::from(k);
                let [before, now, after] = [time - h, time, time + h].map(|t| trajectory.at(t));
                let velocity = (after.position - before.position) / (2.0 * h);
                let acceleration = (after.velocity - before.velocity) / (2.0 * h);
                let error = (velocity - now.velocity).norm();
                assert!(error < 1e-4, "{trajectory:?} at {time}: {error}");
                let error = (acceleration - now.acceleration).norm();
                assert!(error < 1e-2, "{trajectory:?} at {time}: {error}");
            }
        }
    }

    #[test]
    fn the_circle_of_the_paper_is_the_one_printed() {
        // Djokam & Rathinam, section 5: y(t) = (100 + 10 sin 0.1t, 10 + 10 cos 0.1t).
        let quarter = std::f64::consts::FRAC_PI_2;
        let center = Vector::<2>::new(100.0, 10.0);
        let circle = Trajectory::circle(center, 10.0, &Vector::<2>::zeros(), -0.1, quarter);
        for k in 0..100 {
            let time = f64::from(k);
            let (sin, cos) = (0.1 * time).sin_cos();
            let expected = Vector::<2>::new(100.0 + 10.0 * sin, 10.0 + 10.0 * cos);
            let moment = circle.at(time);
            assert!((moment.position - expected).norm() < 1e-12, "{time}");
            assert!((moment.velocity - Vector::<2>::new(cos, -sin)).norm() < 1e-13);
        }
    }

    #[test]
    fn waypoints_are_met_at_their_times_and_kept_outside() {
        let points = points();
        let times = vec![0.0, 0.7, 1.1, 2.4, 3.0];
        let way = Trajectory::Waypoints {
            times: times.clone(),
            points: points.clone(),
        };
        for (time, point) in times.iter().zip(&points) {
            assert_eq!(way.at(*time).position, *point);
        }
        assert_eq!(way.at(-1.0), Moment::at_rest(points[0]));
        assert_eq!(way.at(99.0), Moment::at_rest(points[4]));
        let middle = way.at(0.35);
        assert!((middle.position - points[1] / 2.0).norm() < 1e-15);
        assert!((middle.velocity - points[1] / 0.7).norm() < 1e-15);
    }
}
