//! How agents start, in a world file: where, and how fast.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::obstacle::Rotation;

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
    /// The points of a rectangular grid.
    Grid(GridSpec),
    /// The points of a hexagonal lattice (in 3-D, of balls packed most densely) that are
    /// nearest to a centre and clear of obstacles and of agents placed before.
    Hexagonal(HexagonalSpec),
    /// Evenly along a segment, both ends included; a single agent starts in the middle.
    Line(LineSpec),
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

/// Placement on a rectangular grid, along the first axis first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PositionsOnGrid")]
pub struct GridSpec {
    /// The grid's point with the lowest coordinates.
    pub corner: Vec<f64>,
    /// Distance between neighbours along each axis.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub spacing: f64,
    /// Number of points along each axis; their product is the number of agents.
    #[schemars(extend("items" = {"type": "integer", "minimum": 1, "maximum": 10_000_000}))]
    pub points: Vec<usize>,
}

/// Placement on a hexagonal lattice about a centre, which is a point of the lattice.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PositionsOnHexagonalLattice")]
pub struct HexagonalSpec {
    /// Centre of the patch.
    pub center: Vec<f64>,
    /// Distance between neighbours.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub spacing: f64,
}

/// Placement along a segment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PositionsOnLine")]
pub struct LineSpec {
    /// Position of the first agent.
    pub from: Vec<f64>,
    /// Position of the last agent.
    pub to: Vec<f64>,
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
    /// Uniform in a ball of velocities.
    Ball(VelocityBallSpec),
    /// Away from a centre, all at the same speed.
    Outward(OutwardSpec),
    /// As a rigid body turns about a centre.
    Rotating(RotatingSpec),
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

/// Velocities uniform in a ball.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "VelocitiesInBall")]
pub struct VelocityBallSpec {
    /// Centre, the mean velocity; absent means rest.
    #[serde(default)]
    pub center: Option<Vec<f64>>,
    /// Radius: the largest difference from the centre.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
}

/// Velocities away from a centre.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "VelocitiesOutward")]
pub struct OutwardSpec {
    /// Speed of every agent but one at the centre itself, which rests; below zero is inward.
    pub speed: f64,
    /// The centre; absent means the mean of the group's positions.
    #[serde(default)]
    pub center: Option<Vec<f64>>,
}

/// Velocities of a rigid rotation, rate × (position − centre).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "VelocitiesRotating")]
pub struct RotatingSpec {
    /// Rate of rotation: in 2-D in radians per unit of time, counter-clockwise; in 3-D the axis
    /// times the rate.
    pub rate: Rotation,
    /// The centre; absent means the mean of the group's positions.
    #[serde(default)]
    pub center: Option<Vec<f64>>,
}
