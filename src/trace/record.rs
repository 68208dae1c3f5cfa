//! The trace format: what each line of a trace holds.
//!
//! A trace is a sequence of [`Record`]s: one header, then frames and contacts as
//! they happen, and a summary last. Every line names its kind in `record`.
//! Vectors are arrays of D numbers; agents and obstacles are named by their index
//! in the header. Numbers read back bit for bit.

mod contact;
mod laws;
mod net;

pub use contact::{Approach, Contact, ContactCount, Partner, StrainRecord};
pub use laws::{InfluenceRecord, LawRecord, LawsRecord};
pub use net::NetRecord;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::world::spec::{Rotation, WorldSpec};

/// Name of the format, in every header.
pub const FORMAT: &str = "volary-trace";

/// Version of the format; it changes when a reader of the old one would misread
/// the new.
pub const VERSION: u32 = 1;

/// One line of a trace.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "record", rename_all = "snake_case")]
#[schemars(title = "Volary trace record")]
#[allow(
    clippy::large_enum_variant,
    reason = "most records are frames, which gain nothing from a box"
)]
pub enum Record {
    /// The first line: what ran.
    Header(Box<Header>),
    /// The state at a sampled time.
    Frame(Frame),
    /// A contact episode, written when it ends.
    Contact(Contact),
    /// The last line: how the run ended.
    Summary(Box<Summary>),
}

/// What ran.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Header {
    /// Always "volary-trace".
    pub format: String,
    /// Version of the format.
    pub version: u32,
    /// The program that wrote it, with its version.
    pub program: String,
    /// What moved the agents: "bodies" is the rigid-body engine, "points" are point masses
    /// that nothing touches, integrated to an accuracy.
    pub dynamics: String,
    /// What solved the equations of motion; of points only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solver: Option<SolverRecord>,
    /// Name of the world: the shipped name, or the file's.
    pub name: String,
    /// The world with every default filled in, and the seed that was used.
    pub world: WorldSpec,
    /// The bodies, one entry for each agent.
    pub bodies: Bodies,
}

/// What solved the equations of motion of points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "Solver")]
pub struct SolverRecord {
    /// Name of the method.
    pub method: String,
    /// Its order.
    pub order: usize,
    /// The largest error that one of its steps may make in a position or velocity, as a share
    /// of the largest position and velocity so far.
    pub relative: f64,
}

/// Properties of the bodies; each list has one entry for each agent.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Bodies {
    /// Index of the agent's group in the world's `agents`.
    pub group: Vec<usize>,
    /// Radius of the smallest ball about the position that holds the body.
    pub radius: Vec<f64>,
    /// Mass.
    pub mass: Vec<f64>,
    /// Actuator limit (force); null means none. What else there is to know of a body (shape,
    /// further limits) stands in its group of the world.
    pub force_limit: Vec<Option<f64>>,
}

/// The state at a sampled time.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Frame {
    /// Steps taken so far.
    pub step: u64,
    /// Time, step × size of the step.
    pub time: f64,
    /// Position of each agent.
    pub positions: Vec<Vec<f64>>,
    /// Velocity of each agent.
    pub velocities: Vec<Vec<f64>>,
    /// Rotation of each body from its own frame, whose first axis is its heading: in 2-D an
    /// angle in radians, in 3-D a rotation vector. Absent in worlds of balls alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotations: Option<Vec<Rotation>>,
    /// The metrics of this state.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub metrics: Option<Metrics>,
    /// The acceleration that each law asks for, before the actuator limit; of laws that relax
    /// the one at this moment, which may last for less than a step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accelerations: Option<Vec<LawAccelerations>>,
    /// The β-agents of the obstacle laws.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beta_agents: Option<Vec<BetaAgent>>,
    /// The edges of the proximity net, as pairs of agents, first below second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edges: Option<Vec<[usize; 2]>>,
    /// The analysis of the proximity net.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub net: Option<Box<NetRecord>>,
    /// Who perceives whom within the largest range of the laws, as pairs of agents, the one
    /// that perceives first; sorted. Scopes are not regarded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub links: Option<Vec<[usize; 2]>>,
    /// What the laws' own quantities are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub laws: Option<Box<LawsRecord>>,
    /// The lines of sight along which at least one body or obstacle weakens or blocks the
    /// influence, for some alignment law with `line_of_sight`: pairs of agents, the one that
    /// looks first; sorted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub blocked: Option<Vec<[usize; 2]>>,
    /// Where the moving obstacles are; absent where none moves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub obstacles: Option<Vec<ObstaclePose>>,
}

/// Where a moving obstacle is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ObstaclePose {
    /// The obstacle.
    pub obstacle: usize,
    /// Position of its frame's origin.
    pub position: Vec<f64>,
    /// Rotation of its frame: an angle in 2-D, a rotation vector in 3-D, in radians.
    pub rotation: Rotation,
}

/// The acceleration that one law asks of each agent.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LawAccelerations {
    /// Name of the law.
    pub law: String,
    /// Acceleration of each agent.
    pub values: Vec<Vec<f64>>,
}

/// A β-agent: the projection of an agent on an active obstacle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BetaAgent {
    /// The agent.
    pub agent: usize,
    /// The obstacle.
    pub obstacle: usize,
    /// The part of the obstacle, counted from 0; absent where it has only one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<usize>,
    /// Position on the obstacle's surface, q̂.
    pub position: Vec<f64>,
    /// Velocity p̂: along the surface, and with it where the obstacle moves.
    pub velocity: Vec<f64>,
    /// Distance from the agent's centre to the surface; negative inside.
    pub distance: f64,
}

/// The metrics of one state; null where the world does not define them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Metrics {
    /// Connected components of the proximity net.
    pub components: Option<usize>,
    /// Density δ0: share of agents in the largest component; Olfati-Saber (2003), (7).
    pub density: Option<f64>,
    /// Edges of the proximity net.
    pub edges: Option<usize>,
    /// Structural energy H_s; Olfati-Saber (2003), (27), smooth or not as the protocol is.
    pub structural_energy: Option<f64>,
    /// Polarization: length of the mean of the unit velocities, 0 to 1; agents at
    /// rest count as zero.
    pub polarization: f64,
    /// Root mean square of |p_i − p_d|, the distance to the velocity of the navigation law
    /// that acts on the agent, or to the mean velocity where none does.
    pub velocity_mismatch: f64,
    /// Smallest gap between the surfaces of two agents; negative where they overlap.
    pub agent_gap: Option<f64>,
    /// Smallest gap between the surfaces of an agent and an obstacle.
    pub obstacle_gap: Option<f64>,
    /// Smallest gap between two agents so far: at any time until now, between frames and within
    /// steps too.
    #[serde(default)]
    pub smallest_agent_gap: Option<f64>,
    /// The same between an agent and an obstacle.
    #[serde(default)]
    pub smallest_obstacle_gap: Option<f64>,
    /// Position diameter d_X: largest distance between two agents.
    pub position_diameter: f64,
    /// Velocity diameter d_V: largest difference between two velocities.
    pub velocity_diameter: f64,
    /// Agents in the largest component of the proximity net.
    pub largest_component: Option<usize>,
    /// Agents in the smallest component of the proximity net.
    pub smallest_component: Option<usize>,
    /// Union: 1 for one component, 0 where all agents are alone; SwarmLab (Soria et al.
    /// 2020). Null for one agent.
    pub union: Option<f64>,
    /// Normalised deviation energy of the net's edges from their spacing; Olfati-Saber
    /// (2006), (7). 0 without edges.
    pub deviation_energy: Option<f64>,
    /// Order: mean over all pairs of the cosine between their velocities, a pair with an
    /// agent at rest counting as zero; SwarmLab (Soria et al. 2020). Null for one agent.
    pub order: Option<f64>,
    /// The same over pairs within a component of the proximity net, averaged over the
    /// agents that are not alone; Vásárhelyi et al. (2018). Null where all are alone.
    pub cluster_correlation: Option<f64>,
    /// Milling: angular momentum about the mean position, as a share of Σ |r_i||v_i|, 0 to
    /// 1; Chuang et al. (2007). Null where it is 0/0: one agent, or all at rest.
    pub milling: Option<f64>,
    /// Group rotation: the same of unit vectors, each agent counting alike, 0 to 1; Couzin
    /// et al. (2002). Agents at rest or at the mean position count as zero.
    pub rotation: Option<f64>,
    /// Collision ratio: share of pairs of agents whose bodies overlap as they stand;
    /// Vásárhelyi et al. (2018). Positions alone: contacts are recorded apart. Null for
    /// one agent.
    pub collision_ratio: Option<f64>,
    /// Safety: 1 − the collision ratio; SwarmLab (Soria et al. 2020).
    pub safety: Option<f64>,
    /// Safety from obstacles: 1 − the share of pairs of an agent and an obstacle that
    /// overlap. Null without obstacles.
    pub obstacle_safety: Option<f64>,
}

/// How the run ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "Volary summary")]
pub struct Summary {
    /// Name of the world.
    pub name: String,
    /// Seed that was used.
    pub seed: u64,
    /// How the run ended.
    pub outcome: Outcome,
    /// Why it failed, where it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Number of agents.
    pub agents: usize,
    /// Steps taken.
    pub steps: u64,
    /// Time reached.
    pub time: f64,
    /// Contacts between agents.
    pub agent_contacts: ContactCount,
    /// Contacts between agents and obstacles.
    pub obstacle_contacts: ContactCount,
    /// Agent-steps in which the actuator limit cut the force.
    pub force_cuts: u64,
    /// Agent-steps in which the limit of its rate cut the change of the force.
    #[serde(default)]
    pub rate_cuts: u64,
    /// Agent-steps in which the top speed cut the force.
    #[serde(default)]
    pub speed_cuts: u64,
    /// Smallest gap between two agents at any time, between frames and within steps too;
    /// negative where they overlapped.
    pub smallest_agent_gap: Option<f64>,
    /// Between whom that was, and when.
    #[serde(default)]
    pub closest_agents: Option<Approach>,
    /// Smallest gap between an agent and an obstacle at any time.
    pub smallest_obstacle_gap: Option<f64>,
    /// Between whom that was, and when.
    #[serde(default)]
    pub closest_obstacle: Option<Approach>,
    /// How near the run came to what contacts can do at its step.
    #[serde(default)]
    pub strain: StrainRecord,
    /// The metrics at the end.
    #[serde(rename = "final")]
    pub last: Metrics,
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// It reached its end.
    Completed,
    /// Someone stopped it.
    Interrupted,
    /// The state became non-finite, or something else made it impossible to go on.
    Failed,
}
