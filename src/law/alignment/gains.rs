//! The gains of the agents.

use std::fmt;
use std::sync::Arc;

use crate::math::{Gain, TimeFunction};
use crate::world::spec::{
    AlignmentSpec, GainSpec, OpenLoopSpec, TimeFunctionSpec, VaryingGainSpec, spread,
};

/// The gain of each agent of a world, in its order, over ε and the mass where it must be.
#[derive(Debug, Clone)]
pub(super) struct Gains {
    kind: Kind,
    /// What each agent's gain is divided by; 0 for those on which the law does not act.
    divisors: Vec<f64>,
}

#[derive(Clone)]
enum Kind {
    /// Functions of |u|, already divided.
    Feedback(Vec<Gain>),
    OpenLoop(Vec<TimeFunction>),
    Own(Arc<dyn Fn(usize, f64) -> f64 + Send + Sync>),
}

impl Gains {
    /// The gains of a checked law, for the agents on which it acts.
    pub(super) fn new(spec: &AlignmentSpec, acted_on: &[bool], masses: &[f64]) -> Self {
        let divisor = |(&acts, &mass): (&bool, &f64)| match acts {
            true => spec.epsilon / spec.acts_as.factor(mass),
            false => 0.0,
        };
        let divisors: Vec<f64> = acted_on.iter().zip(masses).map(divisor).collect();
        let kind = match &spec.gain {
            GainSpec::Constant(gains) => {
                let gains = gains.spread(acted_on).into_iter().zip(&divisors);
                let gain = |(gain, &by): (f64, &f64)| Gain::Constant(divided(gain, by));
                Kind::Feedback(gains.map(gain).collect())
            }
            GainSpec::Varying(VaryingGainSpec::Bounded { bound, scale }) => {
                let bounds = bound.spread(acted_on).into_iter().zip(&divisors);
                let scales = scale.spread(acted_on);
                let gain = |((bound, &by), scale): ((f64, &f64), f64)| match by > 0.0 {
                    true => Gain::Bounded {
                        bound: bound / by,
                        scale,
                    },
                    false => Gain::Constant(0.0),
                };
                Kind::Feedback(bounds.zip(scales).map(gain).collect())
            }
            GainSpec::Varying(VaryingGainSpec::OpenLoop(functions)) => {
                Kind::OpenLoop(match functions {
                    OpenLoopSpec::All(function) => vec![function.function(); acted_on.len()],
                    OpenLoopSpec::Each(functions) => {
                        let functions = functions.iter().map(TimeFunctionSpec::function);
                        spread(functions, TimeFunction::Constant(0.0), acted_on)
                    }
                })
            }
        };
        Self { kind, divisors }
    }

    /// The same with a function of agent and time in their place.
    pub(super) fn with(self, gain: impl Fn(usize, f64) -> f64 + Send + Sync + 'static) -> Self {
        Self {
            kind: Kind::Own(Arc::new(gain)),
            ..self
        }
    }

    /// The gain of an agent of the world at a time.
    pub(super) fn of(&self, agent: usize, time: f64) -> Gain {
        let over = |gain| Gain::Constant(divided(gain, self.divisors[agent]));
        match &self.kind {
            Kind::Feedback(gains) => gains[agent],
            Kind::OpenLoop(functions) => over(functions[agent].value(time)),
            Kind::Own(gain) => over(gain(agent, time)),
        }
    }

    /// The largest gain of any agent at any time; infinite where nothing is known.
    pub(super) fn largest(&self) -> f64 {
        match &self.kind {
            Kind::Feedback(gains) => gains.iter().map(|gain| gain.largest()).fold(0.0, f64::max),
            Kind::OpenLoop(functions) => functions
                .iter()
                .zip(&self.divisors)
                .map(|(function, &by)| divided(function.bounds()[1], by))
                .fold(0.0, f64::max),
            Kind::Own(_) => f64::INFINITY,
        }
    }
}

/// A gain over what divides it; 0 for agents on which the law does not act.
fn divided(gain: f64, by: f64) -> f64 {
    if by > 0.0 { gain / by } else { 0.0 }
}

impl fmt::Debug for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Feedback(gains) => f.debug_tuple("Feedback").field(gains).finish(),
            Self::OpenLoop(functions) => f.debug_tuple("OpenLoop").field(functions).finish(),
            Self::Own(_) => f.write_str("Own(…)"),
        }
    }
}
