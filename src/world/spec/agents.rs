//! Agents in a world file: groups of bodies.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SensingSpec;
use super::start::{PlacementSpec, VelocitySpec};

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

fn unit_mass() -> PerAgent {
    PerAgent::All(1.0)
}
