//! How sums over all pairs are taken, in a world file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a law sums over all pairs of agents.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Summation")]
pub enum SummationSpec {
    /// Fast, to a relative error of 1e-6, from as many agents on as make it the faster way:
    /// 10,000 in the plane, 30,000 in space. Directly below that, and wherever `fast` would be
    /// refused.
    #[default]
    Auto,
    /// Pair by pair, to rounding.
    Direct,
    /// Over a tree, in a time that grows almost like the number of agents. Only where a smooth
    /// kernel of all pairs is summed and nothing else: no range, no scope, no senses, no factors
    /// by graph, orientation, masking or line of sight. Kernels: all influences but the bump and
    /// those of Cucker and Smale with an exponent above 4; of the potentials, the Gaussian one,
    /// the attraction, and that of Gazi and Passino. Directly all the same where nodes do not
    /// reach the error, and for fewer than 64 agents. The last digits depend on the processor.
    Fast(FastSpec),
}

impl SummationSpec {
    /// Whether the choice is left open.
    pub(super) fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

/// How exact fast sums are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Fast")]
pub struct FastSpec {
    /// Error of a sum Σ_j φ_ij c_j over Σ_j φ_ij |c_j|, where c_j is what agent j carries
    /// relative to the mean, and where nobody is near, over φ(0) and the mean |c_j| as well; in
    /// root mean square over all agents. No single sum is off by more than 100 times as much.
    #[schemars(range(min = 1e-10, max = 0.1))]
    pub relative_error: f64,
}

impl Default for FastSpec {
    fn default() -> Self {
        Self {
            relative_error: 1e-6,
        }
    }
}
