//! A run, as claims see it.

use std::collections::BTreeMap;
use std::fmt;

use crate::law::Field;
use crate::math::Vector;
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
    /// The two agents that came closest of all, over all steps up to the first contact. Nothing
    /// where there is one agent.
    pub closest: Option<Closest>,
    /// The same over the steps after the first contact.
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
