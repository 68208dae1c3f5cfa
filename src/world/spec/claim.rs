//! What a world expects of the papers' claims.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What `volary validate` is to find of one claim.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Claim")]
pub struct ClaimSpec {
    /// Name of the claim, as `volary claims` lists it: `paper/claim`.
    pub claim: String,
    /// The verdict that is expected; any other is a failure.
    pub expect: VerdictSpec,
    /// What moves the agents in the runs that this is about; absent means both.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dynamics: Option<DynamicsName>,
}

/// What a claim comes to on a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Verdict")]
pub enum VerdictSpec {
    /// Its hypotheses are met, and its conclusion is seen to hold.
    Holds,
    /// Its hypotheses are met, and its conclusion fails.
    Violated,
    /// It says nothing of this run. Never a pass.
    HypothesisNotMet,
    /// The run is too short to tell. Never a pass.
    Undecided,
}

/// What moves the agents.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Dynamics")]
pub enum DynamicsName {
    /// Rigid bodies.
    Bodies,
    /// Point masses.
    Points,
}
