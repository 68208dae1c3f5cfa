//! The weights of a graph of influences.

use std::fmt;
use std::sync::Arc;

use crate::math::TimeFunction;
use crate::net::Adjacency;
use crate::world::spec::{GraphSpec, TimeFunctionSpec};

/// Weights by which influences are multiplied, by the agents' indices in the world.
#[derive(Clone)]
pub(super) enum Weights {
    /// W of Shi, Wang & Chu, (6).
    Fixed(Adjacency),
    /// Djokam & Rathinam, (2.6): the functions, row by row.
    OpenLoop(Vec<Vec<TimeFunction>>),
    Own(Arc<dyn Fn(usize, usize, f64) -> f64 + Send + Sync>),
}

impl Weights {
    /// The weights of a checked graph over so many agents.
    pub(super) fn new(spec: &GraphSpec, agents: usize, seed: u64) -> Self {
        if let GraphSpec::OpenLoop(rows) = spec {
            let row =
                |row: &Vec<TimeFunctionSpec>| row.iter().map(TimeFunctionSpec::function).collect();
            return Self::OpenLoop(rows.iter().map(row).collect());
        }
        Self::Fixed(Adjacency::new(spec.rows(agents, seed).unwrap_or_default()))
    }

    /// A function of one's own of i, j and time.
    pub(super) fn own(weights: impl Fn(usize, usize, f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::Own(Arc::new(weights))
    }

    /// The weight of `j` for `i`.
    pub(super) fn between(&self, i: usize, j: usize, time: f64) -> f64 {
        match self {
            Self::Fixed(weights) => weights.weight(i, j),
            Self::OpenLoop(weights) => weights[i][j].value(time),
            Self::Own(weight) => weight(i, j, time),
        }
    }

    /// The weight of an agent for itself; a fixed graph says nothing of that.
    pub(super) fn of_itself(&self, i: usize, time: f64) -> f64 {
        match self {
            Self::Fixed(_) => 1.0,
            Self::OpenLoop(_) | Self::Own(_) => self.between(i, i, time),
        }
    }

    /// The largest sum of the others' weights for an agent; infinite where nothing is known.
    pub(super) fn largest_row(&self) -> f64 {
        match self {
            Self::Fixed(weights) => weights.out_degrees().into_iter().fold(0.0, f64::max),
            Self::OpenLoop(weights) => {
                let sum = |(i, row): (usize, &Vec<TimeFunction>)| -> f64 {
                    let others = row.iter().enumerate().filter(|&(j, _)| j != i);
                    others.map(|(_, weight)| weight.bounds()[1]).sum()
                };
                weights.iter().enumerate().map(sum).fold(0.0, f64::max)
            }
            Self::Own(_) => f64::INFINITY,
        }
    }
}

impl fmt::Debug for Weights {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(weights) => f.debug_tuple("Fixed").field(weights).finish(),
            Self::OpenLoop(weights) => f.debug_tuple("OpenLoop").field(weights).finish(),
            Self::Own(_) => f.write_str("Own(…)"),
        }
    }
}
