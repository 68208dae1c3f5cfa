//! Trajectories in a world file.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Values;
use crate::math::{Spline, Trajectory, Vector};
use crate::world::{vector, vector_or_zero};

/// A place as a function of time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Trajectory")]
pub enum TrajectorySpec {
    /// start + velocity · t.
    Line {
        /// The place at time 0.
        start: Vec<f64>,
        /// The velocity; absent means rest.
        #[serde(default)]
        velocity: Option<Vec<f64>>,
    },
    /// center + radius · (u cos θ + w sin θ) with θ = ωt + phase; in 2-D u and w are the
    /// axes of the world.
    Circle {
        /// The centre.
        center: Vec<f64>,
        /// The radius.
        #[schemars(range(min = 0))]
        radius: f64,
        /// ω (radians per time): counter-clockwise where positive, in 3-D seen from the tip
        /// of the axis.
        angular_velocity: f64,
        /// Phase at time 0, in radians.
        #[serde(default)]
        phase: f64,
        /// 3-D: the axis, of any length above 0; absent means e₃. Then u and w are e₁ and
        /// e₂, otherwise these, turned by the smallest rotation that takes e₃ to the axis.
        #[serde(default)]
        axis: Option<Vec<f64>>,
    },
    /// center + first · cos θ + second · sin θ with θ = ωt + phase.
    Ellipse {
        /// The centre.
        center: Vec<f64>,
        /// Where θ = 0 is, from the centre.
        first: Vec<f64>,
        /// Where θ is a quarter turn, from the centre.
        second: Vec<f64>,
        /// ω (radians per time).
        angular_velocity: f64,
        /// Phase at time 0, in radians.
        #[serde(default)]
        phase: f64,
    },
    /// Along each axis an oscillation of its own: center + amplitude · sin(ωt + phase).
    Lissajous {
        /// The centre.
        center: Vec<f64>,
        /// Amplitude along each axis.
        amplitudes: Vec<f64>,
        /// ω of each axis (radians per time).
        angular_velocities: Vec<f64>,
        /// Phase of each axis at time 0, in radians; absent means 0.
        #[serde(default)]
        phases: Option<Vec<f64>>,
    },
    /// From point to point along straight lines, at rest before the first time and after the
    /// last. The velocity jumps at the points.
    Waypoints {
        /// The times, each later than the one before it.
        #[schemars(length(min = 1))]
        times: Vec<f64>,
        /// One point for each time.
        points: Vec<Vec<f64>>,
    },
    /// From point to point along a cubic spline, whose acceleration is continuous. It goes on
    /// straight ahead before the first time and after the last, or is run through again and
    /// again.
    Spline {
        /// The times, each later than the one before it.
        #[schemars(length(min = 1))]
        times: Vec<f64>,
        /// One point for each time.
        points: Vec<Vec<f64>>,
        /// Whether it is closed; then the last of at least four points is the first again.
        #[serde(default)]
        periodic: bool,
    },
    /// The sum of some trajectories, none of them a sum.
    Sum(#[schemars(length(min = 1))] Vec<TrajectorySpec>),
}

/// A trajectory for each agent that a law acts on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "Trajectories")]
pub enum TrajectoriesSpec {
    /// One for each agent, in the order of the world.
    Each(Vec<TrajectorySpec>),
    /// All of them at once.
    Formation(FormationSpec),
}

/// Trajectories of many agents that belong together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Formation")]
pub enum FormationSpec {
    /// All turn about one axis: Djokam & Rathinam, (2.10).
    MillRing(MillRingSpec),
}

/// A mill ring, x_i = R_i (u cos(ω_i t + θ_i) + w sin(ω_i t + θ_i)) + k_i e about a centre, with
/// u, w and the axis e a right-handed frame: Djokam & Rathinam, (2.10).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MillRing")]
pub struct MillRingSpec {
    /// The centre.
    pub center: Vec<f64>,
    /// R_i: one radius for all, or a list with one for each agent.
    pub radius: Values,
    /// ω_i (radians per time): one angular velocity for all, or a list with one for each
    /// agent; counter-clockwise where positive, in 3-D seen from the tip of the axis.
    pub angular_velocity: NumbersSpec,
    /// θ_i, in radians: one for each agent; absent means evenly spread over a turn, in the
    /// order of the world.
    #[serde(default)]
    pub phases: Option<Vec<f64>>,
    /// 3-D: k_i, the height along the axis, one for all or a list with one for each agent;
    /// absent means 0.
    #[serde(default)]
    pub heights: Option<NumbersSpec>,
    /// 3-D: the axis e, of any length above 0; absent means e₃. Then u and w are e₁ and e₂,
    /// otherwise these, turned by the smallest rotation that takes e₃ to the axis.
    #[serde(default)]
    pub axis: Option<Vec<f64>>,
}

/// One number for all agents that a law acts on, or a list with one for each of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "Numbers")]
pub enum NumbersSpec {
    /// The same for all.
    All(f64),
    /// One for each agent, in order.
    Each(Vec<f64>),
}

impl NumbersSpec {
    /// The number of the agent in this place; 0 behind the end of a list.
    fn of(&self, place: usize) -> f64 {
        match self {
            Self::All(number) => *number,
            Self::Each(numbers) => numbers.get(place).copied().unwrap_or(0.0),
        }
    }
}

impl TrajectorySpec {
    /// The trajectory that it says in `D` dimensions.
    pub fn trajectory<const D: usize>(&self) -> Trajectory<D> {
        let all = |points: &[Vec<f64>]| points.iter().map(|point| vector(point)).collect();
        match self {
            Self::Line { start, velocity } => Trajectory::Line {
                start: vector(start),
                velocity: vector_or_zero(velocity),
            },
            Self::Circle {
                center,
                radius,
                angular_velocity,
                phase,
                axis,
            } => {
                let (center, axis) = (vector(center), vector_or_zero(axis));
                Trajectory::circle(center, *radius, &axis, *angular_velocity, *phase)
            }
            Self::Ellipse {
                center,
                first,
                second,
                angular_velocity,
                phase,
            } => Trajectory::Ellipse {
                center: vector(center),
                half_axes: [vector(first), vector(second)],
                angular_velocity: *angular_velocity,
                phase: *phase,
            },
            Self::Lissajous {
                center,
                amplitudes,
                angular_velocities,
                phases,
            } => Trajectory::Lissajous {
                center: vector(center),
                amplitudes: vector(amplitudes),
                angular_velocities: vector(angular_velocities),
                phases: vector_or_zero(phases),
            },
            Self::Waypoints { times, points } => Trajectory::Waypoints {
                times: times.clone(),
                points: all(points),
            },
            Self::Spline {
                times,
                points,
                periodic,
            } => Trajectory::Spline(match periodic {
                true => Spline::periodic(times.clone(), all(points)),
                false => Spline::natural(times.clone(), all(points)),
            }),
            Self::Sum(terms) => Trajectory::Sum(terms.iter().map(Self::trajectory).collect()),
        }
    }

    /// Whether its velocity jumps, so that no finite acceleration takes a body along it.
    pub fn jumps(&self) -> bool {
        match self {
            Self::Waypoints { points, .. } => points.iter().any(|point| *point != points[0]),
            Self::Sum(terms) => terms.iter().any(Self::jumps),
            _ => false,
        }
    }
}

impl TrajectoriesSpec {
    /// The trajectories of `count` agents.
    pub fn trajectories<const D: usize>(&self, count: usize) -> Vec<Trajectory<D>> {
        match self {
            Self::Each(trajectories) => trajectories
                .iter()
                .map(TrajectorySpec::trajectory)
                .collect(),
            Self::Formation(FormationSpec::MillRing(ring)) => ring.trajectories(count),
        }
    }
}

impl MillRingSpec {
    fn trajectories<const D: usize>(&self, count: usize) -> Vec<Trajectory<D>> {
        let radii = self.radius.spread(&vec![true; count]);
        let axis: Vector<D> = match &self.axis {
            Some(axis) => crate::math::direction(&vector(axis)),
            // In the plane there is none, and all heights are 0.
            None => crate::math::axis(2),
        };
        (0..count)
            .map(|i| {
                let height = self.heights.as_ref().map_or(0.0, |heights| heights.of(i));
                let phase = match &self.phases {
                    Some(phases) => phases.get(i).copied().unwrap_or(0.0),
                    None => TAU * i as f64 / count as f64,
                };
                let center = vector(&self.center) + axis * height;
                let angular_velocity = self.angular_velocity.of(i);
                Trajectory::circle(center, radii[i], &axis, angular_velocity, phase)
            })
            .collect()
    }
}
