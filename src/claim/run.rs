//! A run, as claims see it.

use std::collections::BTreeMap;
use std::fmt;

use crate::law::Field;
use crate::math::{Vector, Way};
use crate::metric::Observation;
use crate::trace::record::Contact;
use crate::world::World;
use crate::world::spec::DynamicsName;

/// A run: what it was of, and what was seen of it.
#[derive(Debug, Clone)]
pub struct Run<'w, const D: usize> {
    /// The world.
    pub world: &'w World<D>,
    /// What moved the agents.
    pub moved_by: MovedBy,
    /// The same in words: the solver and its accuracy, or the step.
    pub method: String,
    /// What was seen, from time 0 on: of bodies before the first contact, since after it no
    /// theorem on points speaks of them any more. Never empty.
    pub observations: Vec<Observation<D>>,
    /// What was seen from the first contact on.
    pub after_contact: Vec<Observation<D>>,
    /// The time of the first contact between bodies, with one another or with an obstacle.
    pub first_contact: Option<f64>,
    /// The contacts, in the order in which they began.
    pub contacts: Vec<Contact>,
    /// The two agents that came closest of all, at any time up to the step of the first contact,
    /// within steps too. Nothing where there is one agent.
    pub closest: Option<Closest>,
    /// The same at the steps after the first contact.
    pub closest_after_contact: Option<Closest>,
    /// Runs of variations of the world, by the name of the claim that asked for them.
    pub companions: BTreeMap<&'static str, Vec<(World<D>, Vec<Observation<D>>)>>,
}

/// What moved the agents, and how exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MovedBy {
    /// Points, with the error of a step below this share.
    Points {
        /// The relative accuracy.
        relative: f64,
    },
    /// Bodies, in steps of this size.
    Bodies {
        /// The step.
        step: f64,
    },
}

/// Two agents when they came closest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// The agents.
    pub pair: [usize; 2],
    /// The distance between their positions.
    pub distance: f64,
    /// The time.
    pub time: f64,
}

impl MovedBy {
    /// What moved the agents, without how exactly.
    pub fn name(self) -> DynamicsName {
        match self {
            Self::Points { .. } => DynamicsName::Points,
            Self::Bodies { .. } => DynamicsName::Bodies,
        }
    }
}

impl fmt::Display for MovedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Points { relative } => write!(f, "to {relative:e} in each step"),
            Self::Bodies { step } => write!(f, "in steps of {step}"),
        }
    }
}

impl<'w, const D: usize> Run<'w, D> {
    /// A run of which these states were seen: times, from 0 on and increasing, positions and
    /// velocities. Without contacts.
    pub fn of_states(
        world: &'w World<D>,
        moved_by: MovedBy,
        states: impl IntoIterator<Item = (f64, Vec<Vector<D>>, Vec<Vector<D>>)>,
    ) -> Self {
        let mut field = Field::of_world(world);
        let observe = |(time, x, v)| Observation::new(&mut field, time, x, v);
        let observations: Vec<_> = states.into_iter().map(observe).collect();
        let mut run = Self {
            world,
            moved_by,
            method: moved_by.to_string(),
            observations,
            after_contact: Vec::new(),
            first_contact: None,
            contacts: Vec::new(),
            closest: None,
            closest_after_contact: None,
            companions: BTreeMap::new(),
        };
        for seen in &run.observations {
            run.closest = closer(run.closest, seen.time, &seen.positions);
        }
        run
    }

    /// The times of the observations.
    pub fn times(&self) -> Vec<f64> {
        self.series(|seen| seen.time)
    }

    /// A number of each observation.
    pub fn series(&self, of: impl FnMut(&Observation<D>) -> f64) -> Vec<f64> {
        self.observations.iter().map(of).collect()
    }

    /// What was seen first.
    pub fn start(&self) -> &Observation<D> {
        &self.observations[0]
    }

    /// What was seen last, before any contact.
    pub fn last(&self) -> &Observation<D> {
        &self.observations[self.observations.len() - 1]
    }

    /// Runs of the variations that the claim of this name asked for.
    pub fn companions(&self, claim: &str) -> &[(World<D>, Vec<Observation<D>>)] {
        self.companions.get(claim).map_or(&[], Vec::as_slice)
    }
}

/// The closer of a pair and the closest pair of some positions.
pub fn closer<const D: usize>(
    known: Option<Closest>,
    time: f64,
    positions: &[Vector<D>],
) -> Option<Closest> {
    let mut best = known.map_or(f64::INFINITY, |it| it.distance * it.distance);
    let mut closest = known;
    for (i, x) in positions.iter().enumerate() {
        for (j, y) in positions.iter().enumerate().skip(i + 1) {
            let square = (x - y).norm_squared();
            if square < best {
                best = square;
                closest = Some(Closest {
                    pair: [i, j],
                    distance: square.sqrt(),
                    time,
                });
            }
        }
    }
    closest
}

/// The closer of a pair and the pair that comes closest in a step between two states, each of
/// positions and velocities: on the [`Way`] through them.
pub fn closer_between<const D: usize>(
    known: Option<Closest>,
    times: [f64; 2],
    positions: [&[Vector<D>]; 2],
    velocities: [&[Vector<D>]; 2],
) -> Option<Closest> {
    let duration = times[1] - times[0];
    let way = |i: usize| {
        let ends = positions.map(|it| it[i]);
        Way::new(ends, velocities.map(|it| it[i]), duration)
    };
    let ways: Vec<_> = (0..positions[0].len()).map(way).collect();
    let gone = |way: &Way<D>| {
        let [from, on_the_way @ ..] = way.points();
        let squares = on_the_way.map(|point| (point - from).norm_squared());
        squares.into_iter().fold(0.0, f64::max)
    };
    let reach = 2.0 * ways.iter().map(gone).fold(0.0, f64::max).sqrt();
    let mut closest = known;
    for (i, x) in positions[0].iter().enumerate() {
        for (j, y) in positions[0].iter().enumerate().skip(i + 1) {
            let best = closest.map_or(f64::INFINITY, |it| it.distance);
            let near = best + reach;
            if (x - y).norm_squared() >= near * near {
                continue;
            }
            let (distance, share) = ways[i].seen_from(&ways[j]).nearest();
            if distance < best {
                closest = Some(Closest {
                    pair: [i, j],
                    distance,
                    time: times[0] + share * duration,
                });
            }
        }
    }
    closest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_passes_between_two_states_is_seen() {
        let states = |x: f64| [Vector::<2>::new(x, 0.5), Vector::<2>::new(-x, 0.0)];
        let velocities = [Vector::<2>::new(20.0, 0.0), Vector::<2>::new(-20.0, 0.0)];
        let (before, after) = (states(-1.0), states(1.0));
        let far = closer(closer(None, 0.0, &before), 0.1, &after).expect("two");
        assert!(far.distance > 2.0);
        let seen = closer_between(
            Some(far),
            [0.0, 0.1],
            [&before, &after],
            [&velocities, &velocities],
        );
        let seen = seen.expect("two");
        assert!((seen.distance - 0.5).abs() < 1e-12, "{seen:?}");
        assert!((seen.time - 0.05).abs() < 1e-9, "{seen:?}");
        // What is known to be closer stays.
        let closer = Closest {
            distance: 0.4,
            ..far
        };
        let kept = closer_between(
            Some(closer),
            [0.0, 0.1],
            [&before, &after],
            [&velocities, &velocities],
        );
        assert_eq!(kept, Some(closer));
    }
}
