//! Patterns that a flock is driven into, in a world file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::law::one;

/// Driving to a line through the mean position: Li, Liu & Wu, (4), (14).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "LinePattern")]
pub struct LinePatternSpec {
    /// Direction l of the line; any length above 0.
    pub direction: Vec<f64>,
    /// Strength γ (1/time²; where normalised, an acceleration).
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub strength: f64,
    /// Whether the force is divided by 1 + Σ|w_j|, (14), rather than in proportion to the
    /// distance from the line, (4).
    #[serde(default)]
    pub normalised: bool,
}

/// Driving to a circle or sphere about the mean position: Li, Liu & Wu, (6), (15).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "BallPattern")]
pub struct BallPatternSpec {
    /// Radius R of the circle or sphere.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
    /// Strength γ (1/time²; where normalised, an acceleration); 1 in the paper.
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub strength: f64,
    /// Whether the force is divided by 1 + Σ|w_j|, as in the paper, rather than in proportion
    /// to the distance from the circle or sphere.
    #[serde(default = "yes")]
    pub normalised: bool,
}

fn yes() -> bool {
    true
}
