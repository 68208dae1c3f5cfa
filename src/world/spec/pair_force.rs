//! Forces between pairs in a world file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::law::one;
use super::{ActsAs, SummationSpec};
use crate::math::Potential;

/// Forces of a potential between any two agents: Song et al. (2013), (8), (16), (17), and Shi,
/// Wang & Chu, (6).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PairPotential")]
pub struct PairPotentialSpec {
    /// The potential of a pair.
    pub potential: Potential,
    /// Whether the forces of the others are summed or averaged.
    #[serde(default)]
    pub share: Share,
    /// Whether the forces are accelerations, or are divided by the agent's mass.
    #[serde(default)]
    pub acts_as: ActsAs,
    /// Interaction range: agents farther apart exert no force on each other, and the potential
    /// has a step there. Absent means all pairs, as in the papers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: Option<f64>,
    /// How the forces are summed.
    #[serde(default, skip_serializing_if = "SummationSpec::is_auto")]
    pub summation: SummationSpec,
}

/// How the forces of the others on one agent add up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Share {
    /// Their sum.
    #[default]
    Sum,
    /// Their sum over N, the number of agents that the law sees, the agent itself included.
    Mean,
}

/// Repulsion in proportion to the disagreement of the velocities: Cucker & Dong, as in Song et
/// al. (2013), (3), with f(s) = strength/(s − d0)^exponent of the squared distance s.
///
/// The true motion of all pairs keeps every distance above √d0; worlds that start with a pair at
/// √d0 or nearer are refused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CuckerDong")]
pub struct CuckerDongSpec {
    /// Strength of the repulsion (1/time, times length to the power of 2 · exponent − 1).
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub strength: f64,
    /// Exponent; above 1, so that f is integrable far away and not at d0, as the paper demands.
    #[serde(default = "two")]
    #[schemars(extend("exclusiveMinimum" = 1))]
    pub exponent: f64,
    /// d0, the square of the distance to which no pair comes (length²).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub squared_distance: f64,
    /// Least s − d0 (length²) that f is taken at: nearer pairs, which a step too long or a push
    /// may bring there, repel each other as pairs there do.
    #[serde(default = "default_floor")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub floor: f64,
    /// Whether the repulsion is an acceleration, or is divided by the agent's mass.
    #[serde(default)]
    pub acts_as: ActsAs,
    /// Interaction range, of distances, not of their squares; absent means all pairs, as in the
    /// paper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: Option<f64>,
}

/// Bonding of Park et al., as in Song et al. (2013), (7): between any two agents a spring of
/// length 2R, and damping along it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ParkBonding")]
pub struct ParkBondingSpec {
    /// Strength σ of the whole bond.
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub strength: f64,
    /// Gain K1 of the damping along the bond (1/time).
    #[schemars(range(min = 0))]
    pub velocity_gain: f64,
    /// Gain K2 of the spring (1/time²).
    #[schemars(range(min = 0))]
    pub position_gain: f64,
    /// R: half the length at which a bond neither pulls nor pushes.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
    /// Whether the forces are accelerations, or are divided by the agent's mass.
    #[serde(default)]
    pub acts_as: ActsAs,
    /// Interaction range; absent means all pairs, as in the paper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: Option<f64>,
}

/// A swarm of first order, ẋ = −∇V, as a velocity that bodies are steered to: Gazi & Passino, as
/// in Song et al. (2013), (16), or any other potential.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FirstOrderFlow")]
pub struct FirstOrderFlowSpec {
    /// The potential of a pair; its force is a velocity here, so there is one 1/time less in the
    /// units of its numbers.
    pub potential: Potential,
    /// Whether the velocities that the others ask for are summed or averaged.
    #[serde(default)]
    pub share: Share,
    /// Rate at which velocities go to those of the flow (1/time); the larger, the nearer to a
    /// motion of first order.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rate: f64,
    /// Interaction range; absent means all pairs, as in the paper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: Option<f64>,
}

fn two() -> f64 {
    2.0
}

fn default_floor() -> f64 {
    1e-6
}
