//! The world file: every field that a `worlds/**/*.json` file may hold, with
//! its default, unit and range.
//!
//! These types are the only description of the format. The JSON Schema that
//! `volary schema world` prints is derived from them, and the reader checks
//! files against that schema, so a range written here is documented, checked
//! and reported in one stroke. Units are those of the world: lengths, times and
//! masses are whatever the laws' parameters are measured in.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::{Action, AlphaPair, Bump, Fade};

/// A world: agents, obstacles, laws and time, as read from one JSON file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "World", title = "Volary world")]
pub struct WorldSpec {
    /// The JSON Schema this file follows; for editors, ignored by the program.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// What the world shows, in a sentence or two.
    #[serde(default)]
    pub description: String,
    /// Anything a reader should know: sources, choices made, results.
    #[serde(default)]
    pub notes: Vec<String>,
    /// Number of space dimensions, 2 or 3. Every vector of the file has this length.
    #[schemars(range(min = 2, max = 3))]
    pub dimension: usize,
    /// Step and end of the run.
    pub time: TimeSpec,
    /// Seed of every random draw of the world.
    #[serde(default = "one_u64")]
    #[schemars(range(max = u64::MAX))]
    pub seed: u64,
    /// Settings of the physics engine.
    #[serde(default)]
    pub physics: PhysicsSpec,
    /// The agents, in groups.
    #[schemars(length(min = 1))]
    pub agents: Vec<GroupSpec>,
    /// The obstacles: fixed convex bodies.
    #[serde(default)]
    pub obstacles: Vec<ObstacleSpec>,
    /// The laws whose sum accelerates the agents.
    #[serde(default)]
    pub laws: Vec<LawSpec>,
    /// What the trace records, and how often.
    #[serde(default)]
    pub record: RecordSpec,
}

/// Step and end of the run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Time")]
pub struct TimeSpec {
    /// Step of the physics engine.
    #[serde(default = "default_step")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub step: f64,
    /// End of the run; a whole number of steps.
    #[schemars(range(min = 0))]
    pub end: f64,
}

/// Settings of the physics engine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Physics")]
pub struct PhysicsSpec {
    /// Solver substeps in each step, 1 to 64. One is enough but for dense piles.
    #[schemars(range(min = 1, max = 64))]
    pub solver_iterations: usize,
    /// Restitution of every contact: 0 keeps no normal speed, 1 keeps all of it.
    #[schemars(range(min = 0, max = 1))]
    pub restitution: f64,
    /// Coulomb friction coefficient of every contact.
    #[schemars(range(min = 0))]
    pub friction: f64,
    /// Acceleration of gravity, one number per dimension; absent means none.
    pub gravity: Option<Vec<f64>>,
    /// How many length units make up a typical body's size; scales the engine's
    /// contact tolerances (prediction distance 0.02 and slop 0.005 of it).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length_unit: f64,
}

impl Default for PhysicsSpec {
    fn default() -> Self {
        Self {
            solver_iterations: 1,
            restitution: 0.0,
            friction: 0.0,
            gravity: None,
            length_unit: 1.0,
        }
    }
}

/// A group of agents: balls that share how they are placed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Group")]
pub struct GroupSpec {
    /// Name of the group, for reports.
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

/// An obstacle: a fixed convex body, posed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Obstacle")]
pub struct ObstacleSpec {
    /// Name of the obstacle, for reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its shape, in its own frame.
    pub shape: ShapeSpec,
    /// Position of its frame's origin; absent means the world's origin.
    #[serde(default)]
    pub position: Option<Vec<f64>>,
    /// Rotation of its frame: in 2-D an angle in radians, counter-clockwise; in
    /// 3-D a rotation vector, axis times angle in radians.
    #[serde(default)]
    pub rotation: Option<Rotation>,
}

/// A rotation: an angle in 2-D, a rotation vector in 3-D (radians).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Rotation {
    /// 2-D: the angle.
    Angle(f64),
    /// 3-D: axis times angle.
    Vector(Vec<f64>),
}

/// The shape of an obstacle, in its own frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Shape")]
pub enum ShapeSpec {
    /// A disk or sphere about the origin.
    Ball {
        /// Radius.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius: f64,
    },
    /// A rectangle or box about the origin, its sides along the axes.
    Cuboid {
        /// Half the side along each axis, all above 0.
        #[schemars(extend("items" = {"type": "number", "exclusiveMinimum": 0}))]
        half_extents: Vec<f64>,
    },
    /// All points within a radius of a segment.
    Capsule {
        /// One end of the segment.
        from: Vec<f64>,
        /// The other end, different from the first.
        to: Vec<f64>,
        /// Radius about the segment.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius: f64,
    },
    /// Everything behind a flat face through the origin.
    HalfSpace {
        /// Normal of the face, pointing out of the obstacle; any length above 0.
        normal: Vec<f64>,
    },
    /// The convex hull of some points: a polygon in 2-D, a polyhedron in 3-D.
    Convex {
        /// The points; more than the dimension, and not all in one plane (line).
        points: Vec<Vec<f64>>,
    },
}

/// One law: a term of the sum that accelerates the agents.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Law")]
pub enum LawSpec {
    /// Spacing and velocity damping between neighbours: the (α, α) protocols.
    AlphaInteraction(AlphaInteractionSpec),
    /// Repulsion from obstacles by β-agents, guidance around them by γ-agents.
    ObstacleAvoidance(ObstacleAvoidanceSpec),
    /// Steering to a common velocity or to a destination.
    Navigation(NavigationSpec),
}

/// The (α, α) protocols of Olfati-Saber (2003), equations (34) to (36).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "AlphaInteraction")]
pub struct AlphaInteractionSpec {
    /// Which protocol.
    #[serde(default)]
    pub protocol: AlphaProtocol,
    /// Desired distance between neighbours, d_α; below the range.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub spacing: f64,
    /// Interaction range r: agents at most this far apart are neighbours.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: f64,
    /// Velocity damping between neighbours, c1 (1/time).
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub damping: f64,
    /// The action function φ_α.
    #[serde(default)]
    pub action: ActionSpec,
    /// Where the bump function ρ(z) leaves 1, as a share k0 of the range; used by
    /// the smooth protocols.
    #[serde(default = "default_bump_start")]
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub bump_start: f64,
}

/// The (α, α) protocols of Olfati-Saber (2003).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AlphaProtocol {
    /// (34): full force up to the range, none beyond.
    Nonsmooth,
    /// (35) as printed: force fades out smoothly, damping does not.
    Smooth,
    /// (35) with the damping weighted by a_ij(q), so that it fades out as well.
    #[default]
    SmoothWeightedDamping,
    /// (36): (35) without the gradient of the weight.
    Approximate,
}

/// The uneven sigmoidal action function φ_α and its potential ψ_α, Olfati-Saber
/// (2003), equation (29): attraction tends to a, repulsion to b.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Action")]
pub struct ActionSpec {
    /// Limit of the attraction between far neighbours, a (acceleration).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub attraction: f64,
    /// Limit of the repulsion between near neighbours, b (acceleration); not
    /// below the attraction.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub repulsion: f64,
}

impl Default for ActionSpec {
    fn default() -> Self {
        Self {
            attraction: 1.0,
            repulsion: 5.0,
        }
    }
}

/// The (α, β) and (α, γ) interactions of Olfati-Saber (2003), equations (53) to (57).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ObstacleAvoidance")]
pub struct ObstacleAvoidanceSpec {
    /// Activation range r0: an obstacle acts on agents whose centre is at most
    /// this far from its surface.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: f64,
    /// Distance d_β from the surface below which the β-agent repels.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub standoff: f64,
    /// Gain c3 of the whole interaction.
    #[schemars(range(min = 0))]
    pub gain: f64,
    /// Damping c4 relative to the β-agent's velocity (1/time, times the gain).
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub damping: f64,
    /// The action function behind φ_β = min(φ_α, 0) and φ_γ = φ_α.
    #[serde(default)]
    pub action: ActionSpec,
    /// Where the bump function ρ(z) leaves 1, as a share k0 of the range.
    #[serde(default = "default_bump_start")]
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub bump_start: f64,
    /// The γ-agents; absent means none.
    #[serde(default)]
    pub gamma: Option<GammaSpec>,
}

/// γ-agents: points inside the obstacles that draw agents past them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Gamma")]
pub struct GammaSpec {
    /// Where the γ-agent sits on the way from the obstacle's centre to its surface
    /// along the direction, λ_d: 0 excluded, 1 on the surface.
    #[serde(default = "one")]
    #[schemars(range(max = 1), extend("exclusiveMinimum" = 0))]
    pub offset: f64,
    /// Desired distance to the γ-agent, d_γ.
    #[schemars(range(min = 0))]
    pub spacing: f64,
    /// The direction n_d; any length above 0. Absent means the direction of the
    /// first navigation law that steers to a velocity other than rest.
    #[serde(default)]
    pub direction: Option<Vec<f64>>,
}

/// Steering: Olfati-Saber (2003), equations (50), (64) and (66), and the forms
/// in between.
///
/// With (q, p) the agent's own position and velocity or the group's mean, and F
/// the identity or F(z) = z/√(1+|z|²), the acceleration of every agent is
/// −c_q F(q − q_d) − c_p F(p − p_d).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Navigation")]
pub struct NavigationSpec {
    /// Whose position and velocity are steered.
    #[serde(default)]
    pub steer: Steered,
    /// How the feedback grows with the error.
    #[serde(default)]
    pub feedback: Feedback,
    /// Destination q_d, a point to come to rest at; absent means none.
    #[serde(default)]
    pub destination: Option<Vec<f64>>,
    /// Velocity p_d; absent means rest. Needed where there is no destination.
    #[serde(default)]
    pub velocity: Option<Vec<f64>>,
    /// Gain c_q of the position error; has no effect without a destination.
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub position_gain: f64,
    /// Gain c_p (the papers' c2) of the velocity error.
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub velocity_gain: f64,
}

/// Whose position and velocity a navigation law steers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Steered {
    /// Each agent's own: needs no communication.
    #[default]
    Agent,
    /// The group's mean, with the same acceleration for all: (64), (66).
    Mean,
}

/// How a navigation law's feedback grows with the error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Feedback {
    /// F(z) = z/√(1+|z|²): never more than the gain.
    #[default]
    Bounded,
    /// F(z) = z.
    Linear,
}

/// What the trace records, and how often.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Record")]
pub struct RecordSpec {
    /// Time between frames; a whole number of steps. The first frame is the start,
    /// the last is the end.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub every: f64,
    /// Record the metrics of each frame.
    pub metrics: bool,
    /// Record the acceleration that each law gives each agent.
    pub accelerations: bool,
    /// Record the β-agents: projection and velocity for each agent and active obstacle.
    pub beta_agents: bool,
    /// Record the edges of the proximity net.
    pub edges: bool,
}

impl Default for RecordSpec {
    fn default() -> Self {
        Self {
            every: 0.1,
            metrics: true,
            accelerations: false,
            beta_agents: false,
            edges: false,
        }
    }
}

impl ActionSpec {
    /// The function that these limits make.
    pub fn action(&self) -> Action {
        Action::new(self.attraction, self.repulsion)
    }
}

impl AlphaInteractionSpec {
    /// The pair interaction that these parameters make.
    pub fn pair(&self) -> AlphaPair {
        let bump = Bump::new(self.bump_start);
        AlphaPair {
            action: self.action.action(),
            spacing: self.spacing,
            range: self.range,
            fade: match self.protocol {
                AlphaProtocol::Nonsmooth => Fade::Sharp,
                AlphaProtocol::Smooth | AlphaProtocol::SmoothWeightedDamping => Fade::Smooth(bump),
                AlphaProtocol::Approximate => Fade::Approximate(bump),
            },
        }
    }
}

fn one() -> f64 {
    1.0
}

fn one_u64() -> u64 {
    1
}

fn default_step() -> f64 {
    0.01
}

fn unit_mass() -> PerAgent {
    PerAgent::All(1.0)
}

fn default_bump_start() -> f64 {
    5.0 / 6.0
}
