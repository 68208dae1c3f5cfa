//! What a claim comes to.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use crate::world::spec::VerdictSpec as Verdict;

/// What a claim comes to on one run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Finding {
    /// The verdict.
    pub verdict: Verdict,
    /// How far the verdict is from another: of a bound the least distance from it as a share
    /// of the bound, negative where it is crossed; of a limit 1 less the share of its largest
    /// value that is left in the last half, or minus that share where it is refuted; of a
    /// hypothesis that is not met by how much it fails, negative. Null where there is nothing
    /// to measure.
    pub margin: Option<f64>,
    /// The time at which the run came closest to failing, or failed; null where that has no
    /// time.
    pub closest: Option<f64>,
    /// Why, in one sentence.
    pub reason: String,
    /// The hypotheses, and whether they are met.
    pub hypotheses: Vec<Hypothesis>,
    /// The numbers that decide.
    pub quantities: Vec<Quantity>,
    /// What was measured along the run, against its bounds.
    pub curves: Vec<Curve>,
}

/// A hypothesis of a claim on a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Hypothesis {
    /// What it asks for.
    pub statement: String,
    /// Whether it is met.
    pub met: bool,
    /// By how much, as a share; negative where it is not met. Null where it is yes or no.
    pub margin: Option<f64>,
}

/// A number by name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Quantity {
    /// What it is, as a formula.
    pub name: String,
    /// Its value; null where it is infinite.
    pub value: Option<f64>,
}

/// A quantity along a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Curve {
    /// What it is, as a formula.
    pub name: String,
    /// The times.
    pub times: Vec<f64>,
    /// Its values; null where they are infinite.
    pub values: Vec<Option<f64>>,
    /// The bound at each time, slack included; empty where it has none.
    pub bounds: Vec<Option<f64>>,
    /// On which side of the bound it must stay.
    pub side: Side,
}

/// A side of a bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// At most the bound.
    Below,
    /// At least the bound.
    Above,
}
