//! The world file: every field that a `worlds/**/*.json` file may hold, with
//! its default, unit and range.
//!
//! These types are the only description of the format. The JSON Schema that
//! `volary schema world` prints is derived from them, and the reader checks
//! files against that schema, so a range written here is documented, checked
//! and reported in one stroke. Units are those of the world: lengths, times and
//! masses are whatever the laws' parameters are measured in.

mod agents;
mod alignment;
mod claim;
mod drag;
mod graph;
mod law;
mod motion;
mod obstacle;
mod pair_force;
mod pattern;
mod scope;
mod sensing;
mod start;
mod steering;
mod summation;
mod time_function;
mod trajectory;
mod values;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use agents::{BodyShapeSpec, GroupSpec, HeadingSpec, PerAgent, TorqueSpec, TurnSpec};
pub use alignment::{
    AlignmentSpec, GainSpec, KernelSpec, LineOfSightSpec, MaskingSpec, NormalisationSpec,
    OpenLoopSpec, OrientationSpec, RelaxationSpec, VaryingGainSpec,
};
pub use claim::{ClaimSpec, DynamicsName, VerdictSpec};
pub use drag::{FrictionSpec, SelfPropulsionSpec};
pub use graph::GraphSpec;
pub use law::{
    ActionSpec, AlphaInteractionSpec, AlphaProtocol, Feedback, GammaSpec, HeadingConsensusSpec,
    LawSpec, NavigationSpec, ObstacleAvoidanceSpec, Steered,
};
pub use motion::{EasingSpec, MotionSpec};
pub use obstacle::{BetaAgents, CompoundPart, Heights, ObstacleSpec, Rotation, ShapeSpec};
pub use pair_force::{
    CuckerDongSpec, FirstOrderFlowSpec, PairPotentialSpec, ParkBondingSpec, Share,
};
pub use pattern::{BallPatternSpec, LinePatternSpec};
pub use scope::{ScopeSpec, acting_on, acts_on, each_law, seen_by};
pub(in crate::world) use scope::{each_law_mut, each_path};
pub use sensing::{BlockedBySpec, ConeSpec, FieldOfViewSpec, NoiseSpec, SensingSpec};
pub use start::{
    BallSpec, BoxSpec, GridSpec, HexagonalSpec, LineSpec, OutwardSpec, PlacementSpec, RotatingSpec,
    VelocityBallSpec, VelocityBoxSpec, VelocitySpec,
};
pub use steering::{FlatnessSpec, SteeringSpec, TrackingSpec};
pub use summation::{FastSpec, SummationSpec};
pub use time_function::{InterpolationSpec, TimeFunctionSpec, VaryingSpec};
pub use trajectory::{FormationSpec, MillRingSpec, NumbersSpec, TrajectoriesSpec, TrajectorySpec};
pub use values::{ActsAs, Values, spread};

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
    /// The agents, in groups; ten million agents at most.
    #[schemars(length(min = 1, max = 1_000_000))]
    pub agents: Vec<GroupSpec>,
    /// The obstacles, fixed or moving; of all convex parts together two million at most, of those
    /// without bounds (half-spaces, walls of rooms) a thousand.
    #[serde(default)]
    #[schemars(length(max = 1_000_000))]
    pub obstacles: Vec<ObstacleSpec>,
    /// The laws whose sum accelerates the agents; a thousand at most, those inside scopes counted.
    #[serde(default)]
    pub laws: Vec<LawSpec>,
    /// What the trace records, and how often.
    #[serde(default)]
    pub record: RecordSpec,
    /// What `volary validate` is to find here; of claims that are not listed only that none is
    /// violated, but for those that are misprinted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 1_000))]
    pub claims: Vec<ClaimSpec>,
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
    /// Solver substeps in each step, 1 to 64; twice as many in worlds where some body is not
    /// round. One is enough but for dense piles.
    #[schemars(range(min = 1, max = 64))]
    pub solver_iterations: usize,
    /// Restitution of every surface: 0 keeps no normal speed, 1 keeps all of it, but for bounces
    /// shorter than a step. A contact's is the mean of its two surfaces'; groups and obstacles may
    /// have their own.
    #[schemars(range(min = 0, max = 1))]
    pub restitution: f64,
    /// Coulomb friction coefficient of every surface. A contact's is the mean of its two
    /// surfaces'; groups may have their own.
    #[schemars(range(min = 0))]
    pub friction: f64,
    /// Acceleration of gravity, one number per dimension; absent means none.
    pub gravity: Option<Vec<f64>>,
    /// Size of a typical body; the tolerances of lasting contact scale with it (bodies are held
    /// from 0.02 of it on). Absent means the diameter of the smallest body.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length_unit: Option<f64>,
}

impl Default for PhysicsSpec {
    fn default() -> Self {
        Self {
            solver_iterations: 1,
            restitution: 0.0,
            friction: 0.0,
            gravity: None,
            length_unit: None,
        }
    }
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
    /// Record the analysis of the proximity net: connectivity, energy, defect, rigidity,
    /// planarity, votes. Its cost grows with the cube of the number of agents, which may be a
    /// thousand at most.
    pub net: bool,
    /// Record the links: who perceives whom within the largest range of the laws.
    pub links: bool,
    /// Record what the laws are about: energies, centres, distances from patterns and
    /// targets, influences. Its cost grows with the square of the number of agents, that of
    /// alignment laws with its cube. Ten thousand agents at most.
    pub laws: bool,
    /// A threshold θ of influence: with `laws`, count the agents of the global active set,
    /// those whose influence on everyone is at least θ; Djokam & Rathinam, (3.5).
    #[schemars(range(min = 0))]
    pub active_at: Option<f64>,
    /// Record the blocked lines of sight of alignment laws that regard them.
    pub blocked: bool,
}

impl Default for RecordSpec {
    fn default() -> Self {
        Self {
            every: 0.1,
            metrics: true,
            accelerations: false,
            beta_agents: false,
            edges: false,
            net: false,
            links: false,
            laws: false,
            active_at: None,
            blocked: false,
        }
    }
}

fn one_u64() -> u64 {
    1
}

fn default_step() -> f64 {
    0.01
}
