//! Agents in a world file: groups, where they start and how fast.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SensingSpec;

/// A group of agents: balls that share how they are placed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Group")]
pub struct GroupSpec {
    /// Name of the group, for reports and scopes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Number of agents; may be left out where positions are listed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 10_000_000))]
    pub count: Option<usize>,
    /// Radius of each body.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
    /// Mass of each body: one number for all, or a list with one for each.
    #[serde(default = "unit_mass")]
    pub mass: PerAgent,
    /// Actuator limit: the largest force that the laws can exert on one body;
    /// absent means no limit. Gravity and contacts are not limited.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub force_limit: Option<f64>,
    /// Where the agents start.
    pub positions: PlacementSpec,
    /// How fast the agents start; at rest when absent.
    #[serde(default)]
    pub velocities: VelocitySpec,
    /// How the agents perceive others; absent means without limits or errors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sensing: Option<SensingSpec>,
}

/// One positive number for all agents of a group, or a list with one for each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum PerAgent {
    /// The same for all.
    All(#[schemars(extend("exclusiveMinimum" = 0))] f64),
    /// One for each agent, in order.
    Each(#[schemars(extend("items" = {"type": "number", "exclusiveMinimum": 0}))] Vec<f64>),
}

/// Where the agents of a group start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Positions")]
pub enum PlacementSpec {
    /// One position for each agent.
    Explicit(Vec<Vec<f64>>),
    /// Uniform in an axis-aligned box.
    Box(BoxSpec),
    /// Uniform in a ball.
    Ball(BallSpec),
}

/// Uniform placement in an axis-aligned box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PositionsInBox")]
pub struct BoxSpec {
    /// Lowest corner.
    pub min: Vec<f64>,
    /// Highest corner, above the lowest in every coordinate.
    pub max: Vec<f64>,
    /// Smallest distance between the centres of any two agents; absent means
    /// that bodies just do not overlap.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub separation: Option<f64>,
}

/// Uniform placement in a ball.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PositionsInBall")]
pub struct BallSpec {
    /// Centre.
    pub center: Vec<f64>,
    /// Radius.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
    /// Smallest distance between the centres of any two agents; absent means
    /// that bodies just do not overlap.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub separation: Option<f64>,
}

/// How fast the agents of a group start.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Velocities")]
pub enum VelocitySpec {
    /// All at rest.
    #[default]
    Rest,
    /// One velocity for each agent.
    Explicit(Vec<Vec<f64>>),
    /// The same velocity for all.
    Common(Vec<f64>),
    /// Uniform in an axis-aligned box of velocities.
    Uniform(VelocityBoxSpec),
}

/// Velocities uniform in an axis-aligned box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "VelocitiesInBox")]
pub struct VelocityBoxSpec {
    /// Lowest corner.
    pub min: Vec<f64>,
    /// Highest corner, not below the lowest in any coordinate.
    pub max: Vec<f64>,
}

fn unit_mass() -> PerAgent {
    PerAgent::All(1.0)
}
