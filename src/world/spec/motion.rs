//! Motions of obstacles in a world file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::obstacle::Rotation;

/// How an obstacle moves. Its pose is a function of time alone: nothing pushes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Motion")]
pub enum MotionSpec {
    /// To and fro along a line: position + amplitude · sin(2πt/period + phase).
    Oscillation {
        /// The farthest displacement.
        amplitude: Vec<f64>,
        /// Time of one oscillation.
        #[schemars(extend("exclusiveMinimum" = 0))]
        period: f64,
        /// Phase at time 0, in radians.
        #[serde(default)]
        phase: f64,
    },
    /// Turning at a constant rate. What has no bounds, such as a half-space or a room,
    /// cannot turn.
    Rotation {
        /// The point that stays; absent means the obstacle's position.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        about: Option<Vec<f64>>,
        /// Angular velocity: in 2-D radians per time, counter-clockwise; in 3-D the axis
        /// times that.
        rate: Rotation,
    },
    /// Round trips over points, which take the place of the obstacle's position.
    Waypoints {
        /// The points, at least two and not all the same; the last leg leads back to the
        /// first, where the obstacle is at time 0.
        points: Vec<Vec<f64>>,
        /// Time spent at each point.
        #[serde(default)]
        #[schemars(range(min = 0))]
        dwell: f64,
        /// Time of a whole round trip. What the stays leave of it is shared out over the
        /// legs by their length.
        #[schemars(extend("exclusiveMinimum" = 0))]
        period: f64,
        /// How each leg is travelled.
        #[serde(default)]
        easing: EasingSpec,
    },
    /// Motion at a constant velocity.
    Drift {
        /// The velocity.
        velocity: Vec<f64>,
    },
}

/// How a leg between two waypoints is travelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Easing")]
pub enum EasingSpec {
    /// At constant speed.
    #[default]
    Linear,
    /// From rest to rest: 3u² − 2u³ of the way at the share u of the time.
    Smooth,
}
