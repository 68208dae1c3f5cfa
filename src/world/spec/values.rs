//! What several laws of a world file share: values for each agent, and what a law acts as.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One number ≥ 0 for all agents that a law acts on, or a list with one for each of them, in
/// the order of the world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Values {
    /// The same for all.
    All(#[schemars(range(min = 0))] f64),
    /// One for each agent, in order.
    Each(#[schemars(extend("items" = {"type": "number", "minimum": 0}))] Vec<f64>),
}

impl Values {
    /// The value of every agent of the world, 0 for those that the law does not act on.
    /// A list of another length than theirs, which no checked world has, ends in zeros.
    pub fn spread(&self, acted_on: &[bool]) -> Vec<f64> {
        match self {
            Self::All(value) => {
                let value = |&acts| if acts { *value } else { 0.0 };
                acted_on.iter().map(value).collect()
            }
            Self::Each(values) => spread(values.iter().copied(), 0.0, acted_on),
        }
    }

    /// The value of the agent in this place among those that the law acts on; 0 behind the end
    /// of a list.
    pub fn of(&self, place: usize) -> f64 {
        match self {
            Self::All(value) => *value,
            Self::Each(values) => values.get(place).copied().unwrap_or(0.0),
        }
    }

    /// The largest value, 0 where there are none.
    pub fn largest(&self) -> f64 {
        match self {
            Self::All(value) => *value,
            Self::Each(values) => values.iter().copied().fold(0.0, f64::max),
        }
    }
}

/// One value for each agent that a law acts on, dealt out over all agents of the world; the
/// others get `rest`.
pub fn spread<T: Clone>(values: impl IntoIterator<Item = T>, rest: T, acted_on: &[bool]) -> Vec<T> {
    let mut values = values.into_iter();
    acted_on
        .iter()
        .map(|&acts| acts.then(|| values.next()).flatten())
        .map(|value| value.unwrap_or_else(|| rest.clone()))
        .collect()
}

/// What a law's formula gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ActsAs {
    /// An acceleration, the same for light and heavy agents: a force times the mass.
    #[default]
    Acceleration,
    /// A force: an acceleration divided by the agent's mass.
    Force,
}

impl ActsAs {
    /// What turns the formula's value into an acceleration of an agent of this mass.
    pub fn factor(self, mass: f64) -> f64 {
        match self {
            Self::Acceleration => 1.0,
            Self::Force => 1.0 / mass,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_go_to_the_agents_that_the_law_acts_on() {
        let acted_on = [true, false, true];
        assert_eq!(Values::All(2.0).spread(&acted_on), [2.0, 0.0, 2.0]);
        let each = Values::Each(vec![1.0, 3.0]);
        assert_eq!(each.spread(&acted_on), [1.0, 0.0, 3.0]);
        assert_eq!(each.largest(), 3.0);
        assert_eq!(ActsAs::Force.factor(4.0), 0.25);
    }
}
