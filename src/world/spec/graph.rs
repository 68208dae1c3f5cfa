//! Graphs of influence in a world file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::TimeFunctionSpec;

/// A weighted directed graph over all agents of the world, in their order: w_ij ≥ 0 is the
/// weight with which j influences i, and w_ii = 0. Shi, Wang & Chu, below (6).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Graph")]
pub enum GraphSpec {
    /// The weights: one row for each agent i, with an entry for each agent j.
    Matrix(
        #[schemars(extend("items" = {
            "type": "array", "items": {"type": "number", "minimum": 0}
        }))]
        Vec<Vec<f64>>,
    ),
    /// A ring: each agent is influenced by the next one, the last by the first.
    Ring {
        /// The weight.
        #[serde(default = "one")]
        #[schemars(range(min = 0))]
        weight: f64,
        /// Whether it is influenced by the one before it as well.
        #[serde(default)]
        both_ways: bool,
    },
    /// Each agent is influenced by all others.
    Complete {
        /// The weight.
        #[serde(default = "one")]
        #[schemars(range(min = 0))]
        weight: f64,
    },
    /// Drawn from the world's seed: a sum of directed cycles with random weights, the first
    /// through all agents in random order. So it is strongly connected, and balanced: the
    /// weights of each row add up to what those of its column do. Its weights lie between 0
    /// and 1.
    Random {
        /// Number of arcs, the nonzero weights: from N to N(N − 1).
        #[schemars(range(min = 2))]
        arcs: usize,
        /// Which of the seed's graphs: laws with the same number and arcs share one.
        #[serde(default)]
        #[schemars(range(max = u32::MAX))]
        number: u32,
    },
    /// Functions of time a_ij(t) ≥ 0, in rows: Djokam & Rathinam, (2.6). The diagonal a_ii
    /// counts for the sum of Motsch and Tadmor only.
    OpenLoop(Vec<Vec<TimeFunctionSpec>>),
}

fn one() -> f64 {
    1.0
}
