//! Drag and thrust in a world file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ActsAs, Values};

/// Friction −c_i |v|^r v, or what makes up for it: Djokam & Rathinam, (2.8); Shi, Wang & Chu, (3)
/// and (4), with r = 0 and as a force.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Friction")]
pub struct FrictionSpec {
    /// Coefficient c_i (1/time over speed to the power of r; times mass where it is a force).
    pub coefficient: Values,
    /// Exponent r, or one for each agent: 0 is linear friction, 1 that of a wake.
    #[serde(default = "linear")]
    pub exponent: Values,
    /// Whether the friction is an acceleration, or is divided by the agent's mass.
    #[serde(default)]
    pub acts_as: ActsAs,
}

/// Self-propulsion αv − β|v|²v: D'Orsogna et al., as in Djokam & Rathinam, section 2.5. An agent
/// left alone comes to the speed √(α/β), unless it is at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SelfPropulsion")]
pub struct SelfPropulsionSpec {
    /// Propulsion α (1/time; times mass where it is a force).
    #[schemars(range(min = 0))]
    pub propulsion: f64,
    /// Drag β (time/length²; times mass where it is a force).
    #[schemars(range(min = 0))]
    pub drag: f64,
    /// Whether this is an acceleration, or is divided by the agent's mass.
    #[serde(default)]
    pub acts_as: ActsAs,
}

fn linear() -> Values {
    Values::All(0.0)
}
