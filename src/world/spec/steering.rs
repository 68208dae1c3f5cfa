//! Laws in a world file that steer along given courses.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{TimeFunctionSpec, TrajectoriesSpec, TrajectorySpec};

/// Following a target that moves: a_i = γ1 (ẏ − v_i) + γ2 (y − x_i). Djokam & Rathinam,
/// section 5.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Tracking")]
pub struct TrackingSpec {
    /// One target y(t) for all agents; a law has either this or `targets`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<TrajectorySpec>,
    /// A target y_i(t) for each agent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub targets: Option<TrajectoriesSpec>,
    /// Gain γ1 of the velocity error (1/time).
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub velocity_gain: f64,
    /// Gain γ2 of the position error (1/time²).
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub position_gain: f64,
    /// Whether the target's own acceleration ÿ is added, with which errors die out however
    /// the target moves.
    #[serde(default)]
    pub feedforward: bool,
}

/// Steering given in advance, an acceleration β_i(t): Djokam & Rathinam, (2.14).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Steering")]
pub struct SteeringSpec {
    /// β(t) for all agents, a function of time along each axis; a law has either this or
    /// `accelerations`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<Vec<TimeFunctionSpec>>,
    /// β_i(t) for each agent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accelerations: Option<Vec<Vec<TimeFunctionSpec>>>,
}

/// Steering by differential flatness: the acceleration β_i with which agents that start on
/// given trajectories stay on them, whatever the world's other laws and gravity are. Djokam &
/// Rathinam, section 2.6.
///
/// β_i = ÿ_i − (what all other laws and gravity give agent i where all agents that this law
/// acts on are on their trajectories, and all others where they are).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Flatness")]
pub struct FlatnessSpec {
    /// The trajectory y_i(t) of each agent; none whose velocity jumps.
    pub trajectories: TrajectoriesSpec,
    /// Gain of the velocity error ẏ_i − v_i (1/time), added to β_i.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub velocity_gain: f64,
    /// Gain of the position error y_i − x_i (1/time²), added to β_i.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub position_gain: f64,
}

fn one() -> f64 {
    1.0
}
