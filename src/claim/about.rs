//! What a claim says.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a claim says, where it stands, and how it is judged. Texts are sentences or formulas
/// in plain Unicode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct About {
    /// Name, `paper/claim`.
    pub name: &'static str,
    /// Paper and number of the statement.
    pub source: &'static str,
    /// Whether it is the paper's statement or ours.
    pub reading: Reading,
    /// The statement, in one or two sentences.
    pub statement: &'static str,
    /// The hypotheses.
    pub hypotheses: &'static str,
    /// What is measured on a run.
    pub measured: &'static str,
    /// What is allowed for rounding, integration and steps, and why.
    pub tolerance: &'static str,
}

/// Whose statement a claim is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Reading {
    /// The paper's, word for word.
    Printed,
    /// The paper's, word for word, where it is known to be wrong: another one corrects it. That
    /// a run violates it is no surprise.
    Misprinted,
    /// Ours, in place of a printed one that is wrong or incomplete.
    Corrected,
    /// Ours, stronger than a printed one that holds.
    Sharpened,
}
