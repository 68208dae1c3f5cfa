//! The loop: laws, bodies, contacts, frames.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::dynamics::{Bodies, BodiesState, Engine, Failure, Snapshot, Unusable};
use crate::law::{Flock, Law};
use crate::math::Vector;
use crate::metric::{Ledger, NetAnalysis, measure};
use crate::net::Net;
use crate::sense::{History, active_obstacles};
use crate::shape::{In, Obstacle};
use crate::trace::record::{
    BetaAgent, Bodies as BodyProperties, Contact, FORMAT, Frame, Header, LawAccelerations, Metrics,
    ObstaclePose, Outcome, Record, Summary, VERSION,
};
use crate::world::World;
use crate::world::spec::Rotation;

/// What a simulation must know between two steps, besides its world and laws, to go on
/// bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SimulationState<const D: usize> {
    bodies: BodiesState<D>,
    history: History<D>,
    ledger: Ledger,
    net_analysis: NetAnalysis,
    smallest_agent_gap: Option<f64>,
    smallest_obstacle_gap: Option<f64>,
}

/// Why [`Simulation::advance`] came back.
#[derive(Debug, Clone, PartialEq)]
pub enum Pause {
    /// The step that it was to go to is reached.
    Reached,
    /// Whoever watched wants to stop.
    Stopped,
    /// The state cannot go on; it is the one before the step that failed.
    Failed(Failure),
}

/// A world in motion.
pub struct Simulation<const D: usize> {
    world: World<D>,
    flock: Flock<D>,
    bodies: Bodies<D>,
    ledger: Ledger,
    net_analysis: NetAnalysis,
    smallest_agent_gap: Option<f64>,
    smallest_obstacle_gap: Option<f64>,
}

impl<const D: usize> Simulation<D>
where
    In<D>: Engine<D>,
{
    /// The world at its start, under the laws that its file names.
    ///
    /// # Errors
    /// Where the laws give no finite acceleration at the start.
    pub fn new(world: World<D>) -> Result<Self, Failure> {
        Self::with_laws(world, Vec::new())
    }

    /// As [`Simulation::new`], under some more laws besides.
    ///
    /// # Errors
    /// Where the laws give no finite acceleration at the start.
    pub fn with_laws(world: World<D>, more: Vec<Box<dyn Law<D>>>) -> Result<Self, Failure> {
        let mut flock = Flock::of_world(&world, more);
        let bodies = Bodies::new(&world, &mut flock)?;
        Ok(Self {
            world,
            flock,
            bodies,
            ledger: Ledger::default(),
            net_analysis: NetAnalysis::default(),
            smallest_agent_gap: None,
            smallest_obstacle_gap: None,
        })
    }

    /// A simulation of `world` that goes on from a state which [`Simulation::capture`] gave,
    /// under the world's laws and the same ones besides as then. A run that goes on here
    /// does the same, to the last bit, as the one that was captured.
    ///
    /// # Errors
    /// Where the state is not one of this world.
    pub fn restore(
        world: World<D>,
        more: Vec<Box<dyn Law<D>>>,
        state: SimulationState<D>,
    ) -> Result<Self, Unusable> {
        let bodies = Bodies::restore(&world, state.bodies)?;
        let mut flock = Flock::of_world(&world, more);
        *flock.history_mut() = state.history;
        Ok(Self {
            flock,
            bodies,
            ledger: state.ledger,
            net_analysis: state.net_analysis,
            smallest_agent_gap: state.smallest_agent_gap,
            smallest_obstacle_gap: state.smallest_obstacle_gap,
            world,
        })
    }
}

impl<const D: usize> Simulation<D> {
    /// Runs to the world's end. Everything that happens goes to `record`: the header, frames
    /// and contacts as they come, the summary last. After each step `watch` sees the state
    /// and may stop the run.
    ///
    /// A state that cannot go on ends the run with [`Outcome::Failed`].
    ///
    /// # Errors
    /// Those of `record`, which end the run at once.
    pub fn run<E>(
        &mut self,
        mut record: impl FnMut(Record) -> Result<(), E>,
        mut watch: impl FnMut(&Snapshot<'_, D>) -> ControlFlow<()>,
    ) -> Result<Summary, E> {
        self.begin(&mut record)?;
        let pause = self.advance(self.world.steps(), &mut record, &mut watch)?;
        self.finish(pause, &mut record)
    }

    /// The first part of [`Simulation::run`]: records the header.
    ///
    /// # Errors
    /// Those of `record`.
    pub fn begin<E>(&self, record: &mut impl FnMut(Record) -> Result<(), E>) -> Result<(), E> {
        record(Record::Header(Box::new(self.header())))
    }

    /// The middle part of [`Simulation::run`], in one go or in several: takes steps until
    /// `end` steps are taken in all. Parts record the same as the whole does, and between
    /// them the simulation can be captured.
    ///
    /// # Errors
    /// Those of `record`, which end the run at once.
    pub fn advance<E>(
        &mut self,
        end: u64,
        record: &mut impl FnMut(Record) -> Result<(), E>,
        watch: &mut impl FnMut(&Snapshot<'_, D>) -> ControlFlow<()>,
    ) -> Result<Pause, E> {
        let frame_steps = self.world.frame_steps();
        while self.snapshot().step < end {
            if self.snapshot().step.is_multiple_of(frame_steps) {
                record(Record::Frame(self.frame()))?;
            }
            match self.step() {
                Ok(over) => over
                    .into_iter()
                    .try_for_each(|c| record(Record::Contact(c)))?,
                Err(failure) => return Ok(Pause::Failed(failure)),
            }
            if watch(&self.snapshot()).is_break() && self.snapshot().step < self.world.steps() {
                return Ok(Pause::Stopped);
            }
        }
        Ok(Pause::Reached)
    }

    /// The last part of [`Simulation::run`]: records the last state, the contacts that are
    /// still open, and the summary.
    ///
    /// # Errors
    /// Those of `record`.
    pub fn finish<E>(
        &mut self,
        pause: Pause,
        record: &mut impl FnMut(Record) -> Result<(), E>,
    ) -> Result<Summary, E> {
        let failed = matches!(pause, Pause::Failed(_));
        // A step that failed left the state before it, but not the engine's.
        let recorded = failed
            && self
                .snapshot()
                .step
                .is_multiple_of(self.world.frame_steps());
        if !recorded {
            record(Record::Frame(self.frame()))?;
        }
        let overlaps = match failed {
            false => self.bodies.touches_now(),
            true => Vec::new(),
        };
        let rest = self.ledger.close(self.snapshot().time, &overlaps);
        rest.into_iter()
            .try_for_each(|c| record(Record::Contact(c)))?;
        let summary = self.summary(pause);
        record(Record::Summary(Box::new(summary.clone())))?;
        Ok(summary)
    }

    /// Takes one step; returns the contact episodes that ended before it.
    ///
    /// # Errors
    /// Where the state or the laws are no longer finite.
    pub fn step(&mut self) -> Result<Vec<Contact>, Failure> {
        let begin = self.snapshot().time;
        self.bodies.step(&mut self.flock)?;
        Ok(self
            .ledger
            .enter(begin, self.snapshot().time, self.bodies.touches()))
    }

    /// What [`Simulation::restore`] needs to go on from here.
    ///
    /// # Errors
    /// Where the engine cannot tell its state.
    pub fn capture(&self) -> Result<SimulationState<D>, Unusable> {
        // Every field is named, so that a new one cannot be forgotten here.
        let Self {
            // Given again when it is restored.
            world: _,
            flock,
            bodies,
            ledger,
            net_analysis,
            smallest_agent_gap,
            smallest_obstacle_gap,
        } = self;
        Ok(SimulationState {
            bodies: bodies.capture()?,
            // Laws have no memory.
            history: flock.history().clone(),
            ledger: ledger.clone(),
            net_analysis: net_analysis.clone(),
            smallest_agent_gap: *smallest_agent_gap,
            smallest_obstacle_gap: *smallest_obstacle_gap,
        })
    }

    /// The world that runs.
    pub fn world(&self) -> &World<D> {
        &self.world
    }

    /// The state now.
    pub fn snapshot(&self) -> Snapshot<'_, D> {
        self.bodies.snapshot()
    }

    /// The force that the laws exerted on each agent in the last step, after the actuators'
    /// cuts; at the start that of the step to come.
    pub fn pushes(&self) -> &[Vector<D>] {
        self.bodies.pushes()
    }

    /// The contacts so far.
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// The metrics of the state now.
    pub fn metrics(&self) -> Metrics {
        measure(&self.world, &self.snapshot())
    }

    fn header(&self) -> Header {
        let agents = &self.world.agents;
        Header {
            format: FORMAT.to_owned(),
            version: VERSION,
            program: format!("volary {}", env!("CARGO_PKG_VERSION")),
            dynamics: "bodies".to_owned(),
            name: self.world.name.clone(),
            world: self.world.spec.clone(),
            bodies: BodyProperties {
                group: agents.group.clone(),
                radius: agents.radius.clone(),
                mass: agents.mass.clone(),
                force_limit: agents
                    .force_limit
                    .iter()
                    .map(|limit| limit.is_finite().then_some(*limit))
                    .collect(),
            },
        }
    }

    fn frame(&mut self) -> Frame {
        // Measured whether recorded or not: the summary keeps the smallest gaps.
        let metrics = self.metrics();
        keep_least(&mut self.smallest_agent_gap, metrics.agent_gap);
        keep_least(&mut self.smallest_obstacle_gap, metrics.obstacle_gap);
        let state = self.bodies.snapshot();
        let world = &self.world;
        Frame {
            step: state.step,
            time: state.time,
            positions: lists(state.positions),
            velocities: lists(state.velocities),
            rotations: state
                .rotations
                .map(|rotations| rotations.iter().map(Rotation::of).collect()),
            metrics: world.spec.record.metrics.then_some(metrics),
            accelerations: world.spec.record.accelerations.then(|| {
                self.flock
                    .by_law(&self.bodies.state())
                    .into_iter()
                    .map(|(law, values)| LawAccelerations {
                        law,
                        values: lists(&values),
                    })
                    .collect()
            }),
            beta_agents: world
                .beta_range()
                .filter(|_| world.spec.record.beta_agents)
                .map(|range| beta_agents(&state, range)),
            edges: world
                .alpha_interaction()
                .filter(|_| world.spec.record.edges)
                .map(|alpha| Net::new(state.positions, alpha.range).edges().to_vec()),
            net: (world.spec.record.net)
                .then(|| self.net_analysis.record(world, &state))
                .flatten()
                .map(Box::new),
            links: (world.spec.record.links).then(|| self.flock.links(&self.bodies.state())),
            obstacles: obstacle_poses(state.obstacles),
        }
    }

    fn summary(&mut self, pause: Pause) -> Summary {
        let (outcome, error) = match pause {
            Pause::Failed(failure) => (Outcome::Failed, Some(failure.to_string())),
            _ if self.snapshot().step < self.world.steps() => (Outcome::Interrupted, None),
            _ => (Outcome::Completed, None),
        };
        let cuts = self.bodies.cuts();
        let state = self.bodies.snapshot();
        let last = measure(&self.world, &state);
        let (mut agent_gap, mut obstacle_gap) =
            (self.smallest_agent_gap, self.smallest_obstacle_gap);
        for gap in [last.agent_gap, self.ledger.smallest_agent_gap()] {
            keep_least(&mut agent_gap, gap);
        }
        for gap in [last.obstacle_gap, self.ledger.smallest_obstacle_gap()] {
            keep_least(&mut obstacle_gap, gap);
        }
        Summary {
            name: self.world.name.clone(),
            seed: self.world.spec.seed,
            outcome,
            error,
            agents: self.world.agents.len(),
            steps: state.step,
            time: state.time,
            agent_contacts: self.ledger.agent_contacts().clone(),
            obstacle_contacts: self.ledger.obstacle_contacts().clone(),
            force_cuts: cuts.force,
            rate_cuts: cuts.rate,
            speed_cuts: cuts.speed,
            smallest_agent_gap: agent_gap,
            smallest_obstacle_gap: obstacle_gap,
            last,
        }
    }
}

fn beta_agents<const D: usize>(state: &Snapshot<'_, D>, range: f64) -> Vec<BetaAgent> {
    let of_agent = |agent: usize| {
        active_obstacles(state.obstacles, &state.positions[agent], range).map(move |active| {
            BetaAgent {
                agent,
                obstacle: active.obstacle,
                part: (state.obstacles[active.obstacle].parts().len() > 1).then_some(active.part),
                position: list(&active.projection.point),
                velocity: list(&active.projection.velocity(&state.velocities[agent])),
                distance: active.projection.distance,
            }
        })
    };
    (0..state.positions.len()).flat_map(of_agent).collect()
}

/// Where the obstacles are that move; nothing where none does.
fn obstacle_poses<const D: usize>(obstacles: &[Obstacle<D>]) -> Option<Vec<ObstaclePose>> {
    let moving = obstacles.iter().enumerate();
    let moving = moving.filter(|(_, obstacle)| obstacle.motion().is_some());
    let poses: Vec<_> = moving
        .map(|(index, obstacle)| ObstaclePose {
            obstacle: index,
            position: list(&obstacle.pose.translation),
            rotation: match D {
                2 => Rotation::Angle(obstacle.pose.turn[2]),
                _ => Rotation::Vector(obstacle.pose.turn.to_vec()),
            },
        })
        .collect();
    (!poses.is_empty()).then_some(poses)
}

fn keep_least(least: &mut Option<f64>, value: Option<f64>) {
    *least = match (*least, value) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    };
}

fn list<const D: usize>(vector: &Vector<D>) -> Vec<f64> {
    vector.iter().copied().collect()
}

fn lists<const D: usize>(vectors: &[Vector<D>]) -> Vec<Vec<f64>> {
    vectors.iter().map(list).collect()
}
