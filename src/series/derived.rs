//! Quantities that follow from a frame, whatever of it was recorded.

use std::cell::OnceCell;

use super::targets::{Goals, world_of};
use crate::dynamics::Snapshot;
use crate::math::Vector;
use crate::metric::{agent_gap, diameter};
use crate::trace::record::{Frame, Header};
use crate::world::{AnyWorld, World, vector};

/// The names of the quantities, with the short ones of the papers.
pub(super) const NAMES: [&str; 7] = [
    "position_diameter",
    "velocity_diameter",
    "agent_gap",
    "mean_speed",
    "target_error",
    "d_X",
    "d_V",
];

/// What is known of a run, to derive quantities from its frames.
pub(super) struct Derived<'a> {
    header: &'a Header,
    /// Resolved when it is asked for; nothing where this program has no such world.
    world: OnceCell<Option<AnyWorld>>,
    goals: OnceCell<Goals>,
}

impl<'a> Derived<'a> {
    pub(super) fn of(header: &'a Header) -> Self {
        Self {
            header,
            world: OnceCell::new(),
            goals: OnceCell::new(),
        }
    }

    /// A quantity by one of its [`NAMES`]; nothing where the state does not define it.
    pub(super) fn value(&self, name: &str, frame: &Frame) -> Option<f64> {
        let states = || frame.positions.iter().zip(&frame.velocities);
        match name {
            "position_diameter" | "d_X" => Some(self.diameter(&frame.positions)),
            "velocity_diameter" | "d_V" => Some(self.diameter(&frame.velocities)),
            "agent_gap" => match self.world()? {
                AnyWorld::Plane(world) => gap(world, frame),
                AnyWorld::Space(world) => gap(world, frame),
            },
            "mean_speed" => {
                let speeds = frame.velocities.iter().map(|it| length(it));
                let count = frame.velocities.len();
                (count > 0).then(|| speeds.sum::<f64>() / count as f64)
            }
            "target_error" => recorded_error(frame).or_else(|| {
                let goals = self.goals.get_or_init(|| Goals::of(self.world()));
                let errors = states().enumerate().flat_map(|(agent, (position, _))| {
                    let aims = goals.of_agent(agent, frame.time).into_iter();
                    aims.map(|aim| {
                        let off = position.iter().zip(&aim.position);
                        length(&off.map(|(a, b)| a - b).collect::<Vec<_>>())
                    })
                });
                errors.reduce(f64::max)
            }),
            _ => None,
        }
    }

    fn world(&self) -> Option<&AnyWorld> {
        let world = self.world.get_or_init(|| world_of(self.header));
        world.as_ref()
    }

    fn diameter(&self, states: &[Vec<f64>]) -> f64 {
        match self.header.world.dimension {
            2 => diameter(&vectors::<2>(states)),
            _ => diameter(&vectors::<3>(states)),
        }
    }
}

/// The largest error of all laws that record one.
fn recorded_error(frame: &Frame) -> Option<f64> {
    let laws = frame.laws.iter().flat_map(|laws| &laws.laws);
    laws.filter_map(|law| law.position_error).reduce(f64::max)
}

/// The smallest gap in a world of balls alone; others tell it by their recorded metrics.
fn gap<const D: usize>(world: &World<D>, frame: &Frame) -> Option<f64> {
    let sound = frame.rotations.is_none() && frame.positions.len() == world.agents.radius.len();
    let positions = vectors(&frame.positions);
    let state = Snapshot {
        step: frame.step,
        time: frame.time,
        positions: &positions,
        velocities: &[],
        headings: &[],
        rotations: None,
        spins: None,
        obstacles: &[],
    };
    sound.then(|| agent_gap(world, &state)).flatten()
}

fn vectors<const D: usize>(states: &[Vec<f64>]) -> Vec<Vector<D>> {
    let sound = states.iter().filter(|it| it.len() == D);
    sound.map(|it| vector(it)).collect()
}

fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|it| it * it).sum::<f64>().sqrt()
}
