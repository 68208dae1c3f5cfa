//! The report of a validation: what `volary validate --report` writes as JSON, and what all
//! other forms of it are made from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::claim::{Finding, Reading, Verdict};
use crate::world::spec::DynamicsName;

/// Name of the format, in every report.
pub const FORMAT: &str = "volary-validation";

/// Version of the format; it changes when a reader of the old one would misread the new.
pub const VERSION: u32 = 1;

/// What became of the papers' claims in some worlds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "Volary validation report")]
pub struct Report {
    /// Always "volary-validation".
    pub format: String,
    /// Version of the format.
    pub version: u32,
    /// The program that wrote it, with its version.
    pub program: String,
    /// Whether every finding is as expected.
    pub as_expected: bool,
    /// The worlds, in the order in which they were asked for.
    pub worlds: Vec<WorldReport>,
}

/// What became of the claims in one world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WorldReport {
    /// Name of the world.
    pub world: String,
    /// What it shows, by its own words.
    pub description: String,
    /// Number of agents.
    pub agents: usize,
    /// Number of space dimensions.
    pub dimension: usize,
    /// End of the runs.
    pub end: f64,
    /// The runs: as points, as bodies, or both.
    pub runs: Vec<RunReport>,
    /// The claims that have something to say of this world.
    pub claims: Vec<ClaimReport>,
    /// What bodies change; absent where bodies were not run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactReport>,
}

/// One run of a world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunReport {
    /// What moved the agents.
    pub dynamics: DynamicsName,
    /// How: the solver and its accuracy, or the step.
    pub method: String,
    /// Number of states that the claims were judged by.
    pub observations: usize,
    /// Time of the first contact; null without one.
    pub first_contact: Option<f64>,
    /// Contact episodes between agents.
    pub agent_contacts: usize,
    /// Contact episodes between agents and obstacles.
    pub obstacle_contacts: usize,
    /// The two agents that came closest; null for one agent.
    pub closest: Option<ClosestReport>,
}

/// Two agents when they came closest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ClosestReport {
    /// The agents.
    pub agents: [usize; 2],
    /// Distance between their positions, at any time up to the first contact.
    pub distance: f64,
    /// The time.
    pub time: f64,
}

/// What a claim came to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ClaimReport {
    /// Name, `paper/claim`.
    pub claim: String,
    /// Paper and number.
    pub source: String,
    /// Whose statement it is.
    pub reading: Reading,
    /// The statement.
    pub statement: String,
    /// What it came to on each run.
    pub findings: Vec<JudgedRun>,
}

/// What a claim came to on one run, and whether the world expects it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JudgedRun {
    /// What moved the agents.
    pub dynamics: DynamicsName,
    /// The verdict that the world expects; null where it says nothing: then the claim must not
    /// be violated, unless it is misprinted.
    pub expected: Option<Verdict>,
    /// Whether the finding is as expected.
    pub as_expected: bool,
    /// The finding.
    pub finding: Finding,
}

/// Bodies against points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ContactReport {
    /// Half of the largest sum of the radii of two agents: the radius, where all are alike.
    pub radius: f64,
    /// What theory says of the distance between agents, claim by claim.
    pub exclusions: Vec<ExclusionReport>,
    /// The largest radius at which the points, had they been bodies, would not have touched:
    /// half of their least distance at any time. Null without a run as points, or for one agent.
    pub points_radius: Option<f64>,
    /// The same of the bodies' centres; null where bodies touched, and so were kept apart by
    /// their size.
    pub bodies_radius: Option<f64>,
    /// The first contact; null without one.
    pub first: Option<FirstContact>,
    /// How far the bodies depart from the points; null without a run as points.
    pub departure: Option<Departure>,
}

/// What theory says of contacts, and what was seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ExclusionReport {
    /// The claim.
    pub claim: String,
    /// Its distance, as a formula.
    pub formula: String,
    /// No two points ever come closer than this.
    pub distance: f64,
    /// Half of it: the radius of bodies that theory keeps from touching.
    pub radius: f64,
    /// What theory and run come to together.
    pub outcome: ContactOutcome,
}

/// What theory says of contacts between agents, and what was seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactOutcome {
    /// Theory excludes contacts, and none is seen.
    ExcludedAndNoneSeen,
    /// Theory excludes contacts, and some are seen: a defect of the program or of the theorem.
    ExcludedYetSeen,
    /// Theory allows contacts, and some are seen.
    AllowedAndSeen,
    /// Theory allows contacts, and none is seen.
    AllowedAndNoneSeen,
    /// An agent met an obstacle first, of which theory does not speak.
    ObstacleMetFirst,
}

/// The first contact of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FirstContact {
    /// The time.
    pub time: f64,
    /// The agent.
    pub agent: usize,
    /// The other agent; null where it is an obstacle.
    pub other_agent: Option<usize>,
    /// The obstacle; null where it is an agent.
    pub obstacle: Option<usize>,
    /// Speed of approach along the normal.
    pub approach_speed: f64,
    /// Largest blow of the episode (mass × velocity); 0 where there was none.
    #[serde(default)]
    pub blow: f64,
    /// Least distance of the same two agents as points within a step of then; null for obstacles
    /// and without a run as points.
    pub points_apart: Option<f64>,
    /// Why it came about, in a sentence.
    pub cause: String,
}

/// How far bodies depart from points, as the largest of all agents.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Departure {
    /// Largest distance between an agent as body and as point before the first contact, over
    /// the whole run where there is none.
    pub before_contact: f64,
    /// The same of velocities.
    pub velocities_before_contact: f64,
    /// The distance at the end.
    pub at_end: f64,
    /// The times looked at.
    pub times: Vec<f64>,
    /// The distance at these.
    pub distances: Vec<f64>,
}
