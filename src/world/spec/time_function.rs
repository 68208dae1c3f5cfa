//! Numbers that change with time, in a world file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::{Interpolation, TimeFunction};

/// A number, or one that changes with time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "TimeFunction")]
pub enum TimeFunctionSpec {
    /// The same at all times.
    Constant(f64),
    /// A function of time.
    Varying(VaryingSpec),
}

/// A function of time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Varying")]
pub enum VaryingSpec {
    /// Values at some times. Constant before the first time and after the last.
    Table {
        /// The times, each later than the one before it.
        #[schemars(length(min = 1))]
        times: Vec<f64>,
        /// One value for each time.
        values: Vec<f64>,
        /// What lies between them.
        #[serde(default)]
        interpolation: InterpolationSpec,
    },
    /// mean + amplitude · sin(2πt/period + phase).
    Sine {
        /// What it swings about.
        #[serde(default)]
        mean: f64,
        /// How far it swings.
        amplitude: f64,
        /// Time of one oscillation.
        #[schemars(extend("exclusiveMinimum" = 0))]
        period: f64,
        /// Phase at time 0, in radians.
        #[serde(default)]
        phase: f64,
    },
    /// High from time 0 on for a share of each period, low for the rest of it.
    Square {
        /// The value in the rest of each period.
        #[serde(default)]
        low: f64,
        /// The value in the first part of each period.
        high: f64,
        /// Time from one rise to the next.
        #[schemars(extend("exclusiveMinimum" = 0))]
        period: f64,
        /// Share of each period in which it is high.
        #[serde(default = "half")]
        #[schemars(range(min = 0, max = 1))]
        duty: f64,
    },
    /// end + (start − end) e^(−t/time): what decays, or settles.
    Exponential {
        /// The value at time 0.
        start: f64,
        /// The value that it tends to.
        #[serde(default)]
        end: f64,
        /// Time in which what is left to that falls to 1/e.
        #[schemars(extend("exclusiveMinimum" = 0))]
        time: f64,
    },
    /// The sum of some functions; these may be products, but go no deeper.
    Sum(#[schemars(length(min = 1))] Vec<TimeFunctionSpec>),
    /// The product of some functions; these may be sums, but go no deeper.
    Product(#[schemars(length(min = 1))] Vec<TimeFunctionSpec>),
}

/// What lies between the values of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Interpolation")]
pub enum InterpolationSpec {
    /// The straight line between the values on either side.
    #[default]
    Linear,
    /// The value of the last time so far.
    Step,
}

impl TimeFunctionSpec {
    /// The function.
    pub fn function(&self) -> TimeFunction {
        let all = |parts: &[Self]| parts.iter().map(Self::function).collect();
        match self {
            Self::Constant(value) => TimeFunction::Constant(*value),
            Self::Varying(varying) => match varying {
                VaryingSpec::Table {
                    times,
                    values,
                    interpolation,
                } => TimeFunction::Table {
                    times: times.clone(),
                    values: values.clone(),
                    interpolation: match interpolation {
                        InterpolationSpec::Linear => Interpolation::Linear,
                        InterpolationSpec::Step => Interpolation::Step,
                    },
                },
                &VaryingSpec::Sine {
                    mean,
                    amplitude,
                    period,
                    phase,
                } => TimeFunction::Sine {
                    mean,
                    amplitude,
                    period,
                    phase,
                },
                &VaryingSpec::Square {
                    low,
                    high,
                    period,
                    duty,
                } => TimeFunction::Square {
                    low,
                    high,
                    period,
                    duty,
                },
                &VaryingSpec::Exponential { start, end, time } => {
                    TimeFunction::Exponential { start, end, time }
                }
                VaryingSpec::Sum(terms) => TimeFunction::Sum(all(terms)),
                VaryingSpec::Product(factors) => TimeFunction::Product(all(factors)),
            },
        }
    }
}

fn half() -> f64 {
    0.5
}
