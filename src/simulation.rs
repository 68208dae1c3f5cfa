//! The loop: laws, bodies, contacts, frames.

use std::ops::ControlFlow;

use crate::dynamics::{Bodies, Engine, Failure, Snapshot};
use crate::law::{Flock, Law, build};
use crate::math::Vector;
use crate::metric::{Ledger, Net, measure};
use crate::sense::active_obstacles;
use crate::shape::In;
use crate::trace::record::{
    BetaAgent, Bodies as BodyProperties, Contact, FORMAT, Frame, Header, LawAccelerations, Metrics,
    Outcome, Record, Summary, VERSION,
};
use crate::world::World;
use crate::world::spec::Rotation;

/// A world in motion.
pub struct Simulation<const D: usize> {
    world: World<D>,
    flock: Flock<D>,
    bodies: Bodies<D>,
    ledger: Ledger,
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
        let mut laws = build(&world);
        laws.extend(more);
        let mut flock = Flock::new(laws);
        let bodies = Bodies::new(&world, &mut flock)?;
        Ok(Self {
            world,
            flock,
            bodies,
            ledger: Ledger::default(),
            smallest_agent_gap: None,
            smallest_obstacle_gap: None,
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
        record(Record::Header(Box::new(self.header())))?;
        let (steps, frame_steps) = (self.world.steps(), self.world.frame_steps());
        let mut end = Ok(Outcome::Completed);
        while self.snapshot().step < steps {
            if self.snapshot().step.is_multiple_of(frame_steps) {
                record(Record::Frame(self.frame()))?;
            }
            match self.step() {
                Ok(over) => over
                    .into_iter()
                    .try_for_each(|c| record(Record::Contact(c)))?,
                Err(failure) => {
                    end = Err(failure);
                    break;
                }
            }
            if watch(&self.snapshot()).is_break() && self.snapshot().step < steps {
                end = Ok(Outcome::Interrupted);
                break;
            }
        }
        // A step that failed left the state before it, but not the engine's.
        let recorded = end.is_err() && self.snapshot().step.is_multiple_of(frame_steps);
        if !recorded {
            record(Record::Frame(self.frame()))?;
        }
        let overlaps = match &end {
            Ok(_) => self.bodies.touches_now(),
            Err(_) => Vec::new(),
        };
        let rest = self.ledger.close(self.snapshot().time, &overlaps);
        rest.into_iter()
            .try_for_each(|c| record(Record::Contact(c)))?;
        let summary = self.summary(end);
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
        }
    }

    fn summary(&mut self, end: Result<Outcome, Failure>) -> Summary {
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
            outcome: *end.as_ref().unwrap_or(&Outcome::Failed),
            error: end.err().map(|failure| failure.to_string()),
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
                position: list(&active.projection.point),
                velocity: list(&active.projection.velocity(&state.velocities[agent])),
                distance: active.projection.distance,
            }
        })
    };
    (0..state.positions.len()).flat_map(of_agent).collect()
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
