//! The loop: laws, what moves the agents, contacts, frames.

mod profiling;
mod recording;

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::dynamics::{
    Dynamics, Engine, Failure, Gaps, Mover, MoverState, Snapshot, Solver, Strain, Unusable,
};
use crate::law::{Flock, Law};
use crate::math::Vector;
use crate::metric::{Ledger, NetAnalysis, measure, share_apart};
use crate::sense::History;
use crate::shape::In;
use crate::stop::Stop;
use crate::trace::record::{Contact, Metrics, Record, Summary};
use crate::world::World;
use profiling::Watches;

/// What a simulation must know between two steps, besides its world and laws, to go on
/// bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SimulationState<const D: usize> {
    agents: MoverState<D>,
    history: History<D>,
    ledger: Ledger,
    net_analysis: NetAnalysis,
    smallest_agent_gap: Option<f64>,
    smallest_obstacle_gap: Option<f64>,
    #[serde(default)]
    framed: Option<u64>,
}

/// Why [`Simulation::advance`] came back.
#[derive(Debug, Clone, PartialEq)]
pub enum Pause {
    /// The step that it was to go to is reached.
    Reached,
    /// Whoever watched wants to stop, or somebody asked for it.
    Stopped,
    /// The state cannot go on; it is the one before the step that failed.
    Failed(Failure),
}

/// A world in motion.
pub struct Simulation<const D: usize> {
    world: World<D>,
    flock: Flock<D>,
    agents: Mover<D>,
    ledger: Ledger,
    net_analysis: NetAnalysis,
    smallest_agent_gap: Option<f64>,
    smallest_obstacle_gap: Option<f64>,
    /// The step of the last frame: one that was stopped within the step after it has it already.
    framed: Option<u64>,
    watches: Watches,
    stop: Stop,
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
        Self::with_dynamics(world, more, Dynamics::Bodies)
    }

    /// As [`Simulation::with_laws`], with the agents moved in a way of one's choice.
    ///
    /// # Errors
    /// Where the laws give no finite acceleration at the start, or the world cannot be moved
    /// in this way.
    pub fn with_dynamics(
        world: World<D>,
        more: Vec<Box<dyn Law<D>>>,
        dynamics: Dynamics,
    ) -> Result<Self, Failure> {
        let mut flock = Flock::of_world(&world, more);
        let agents = Mover::new(&world, &mut flock, dynamics)?;
        Ok(Self {
            world,
            flock,
            agents,
            ledger: Ledger::default(),
            net_analysis: NetAnalysis::default(),
            smallest_agent_gap: None,
            smallest_obstacle_gap: None,
            framed: None,
            watches: Watches::default(),
            stop: Stop::default(),
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
        let mut flock = Flock::of_world(&world, more);
        let agents = Mover::restore(&world, &flock, state.agents)?;
        *flock.history_mut() = state.history;
        Ok(Self {
            flock,
            agents,
            ledger: state.ledger,
            net_analysis: state.net_analysis,
            smallest_agent_gap: state.smallest_agent_gap,
            smallest_obstacle_gap: state.smallest_obstacle_gap,
            framed: state.framed,
            watches: Watches::default(),
            stop: Stop::default(),
            world,
        })
    }
}

impl<const D: usize> Simulation<D> {
    /// Stops from now on as soon as it can where somebody asks for it: between two steps, and
    /// within one where that may take long. [`Simulation::advance`] comes back with
    /// [`Pause::Stopped`], at the state before the step that was not ended.
    pub fn heed(&mut self, stop: Stop) {
        self.agents.heed(stop.clone());
        self.stop = stop;
    }

    /// Runs to the world's end. Everything that happens goes to `record`: the header, frames
    /// and contacts as they come, the summary last. After each step `watch` sees the state
    /// and may stop the run.
    ///
    /// A state that cannot go on ends the run with [`Outcome::Failed`](crate::trace::record::Outcome::Failed).
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
            if self.stop.asked() {
                return Ok(Pause::Stopped);
            }
            let step = self.snapshot().step;
            if step.is_multiple_of(frame_steps) && self.framed != Some(step) {
                self.framed = Some(step);
                let frame = Record::Frame(self.frame(false));
                self.watches.trace.time(|| record(frame))?;
            }
            match self.step() {
                Ok(over) => over
                    .into_iter()
                    .try_for_each(|c| self.watches.trace.time(|| record(Record::Contact(c))))?,
                Err(Failure::Stopped) => return Ok(Pause::Stopped),
                Err(failure) => return Ok(Pause::Failed(failure)),
            }
            if watch(&self.snapshot()).is_break() && self.snapshot().step < self.world.steps() {
                return Ok(Pause::Stopped);
            }
        }
        Ok(Pause::Reached)
    }

    /// The last part of [`Simulation::run`]: records the last state, the contacts that are
    /// still open, and the summary. Of a run that was asked to stop ([`Simulation::heed`]) the last
    /// frame has neither `net` nor `laws`.
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
        if self.framed != Some(self.snapshot().step) {
            // Who stops a run waits for no analysis that takes long.
            let frame = Record::Frame(self.frame(self.stop.asked()));
            self.watches.trace.time(|| record(frame))?;
        }
        let overlaps = match failed {
            false => self.agents.touches_now(),
            true => Vec::new(),
        };
        let rest = self.ledger.close(self.snapshot().time, &overlaps);
        rest.into_iter()
            .try_for_each(|c| record(Record::Contact(c)))?;
        let summary = self.summary(pause);
        record(Record::Summary(Box::new(summary.clone())))?;
        Ok(summary)
    }

    /// Takes one step; returns the contact episodes that ended in it.
    ///
    /// # Errors
    /// Where the state or the laws are no longer finite.
    pub fn step(&mut self) -> Result<Vec<Contact>, Failure> {
        let begin = self.snapshot().time;
        self.watches
            .step
            .time(|| self.agents.step(&mut self.flock))?;
        let end = self.snapshot().time;
        let touches = self.agents.touches();
        let apart = share_apart(&self.world, &self.agents.snapshot());
        let enter = || self.ledger.enter(begin, end, touches, apart);
        Ok(self.watches.ledger.time(enter))
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
            // The past alone.
            watches: _,
            // Given again when it goes on.
            stop: _,
            flock,
            agents,
            ledger,
            net_analysis,
            smallest_agent_gap,
            smallest_obstacle_gap,
            framed,
        } = self;
        Ok(SimulationState {
            agents: agents.capture()?,
            // Laws have no memory.
            history: flock.history().clone(),
            ledger: ledger.clone(),
            net_analysis: net_analysis.clone(),
            smallest_agent_gap: *smallest_agent_gap,
            smallest_obstacle_gap: *smallest_obstacle_gap,
            framed: *framed,
        })
    }

    /// The world that runs.
    pub fn world(&self) -> &World<D> {
        &self.world
    }

    /// The state now.
    pub fn snapshot(&self) -> Snapshot<'_, D> {
        self.agents.snapshot()
    }

    /// The force that the laws exerted on each body in the last step, after the actuators'
    /// cuts; at the start that of the step to come. On points that of now.
    pub fn pushes(&self) -> &[Vector<D>] {
        self.agents.pushes()
    }

    /// What solves the equations of motion; of points only.
    pub fn solver(&self) -> Option<Solver> {
        self.agents.solver()
    }

    /// The contacts so far.
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// The metrics of the state now.
    pub fn metrics(&self) -> Metrics {
        let mut metrics = measure(&self.world, &self.snapshot());
        let [agents, obstacles] = self.smallest_gaps();
        keep_least(&mut metrics.smallest_agent_gap, agents);
        keep_least(&mut metrics.smallest_obstacle_gap, obstacles);
        metrics
    }

    /// Between whom the smallest gaps were so far, and when: at any time, also within steps.
    pub fn gaps(&self) -> Gaps {
        self.agents.gaps()
    }

    /// How near the run came so far to what contacts can do at its step.
    pub fn strain(&self) -> Strain {
        self.agents.strain()
    }

    /// The smallest gaps so far, between agents and to obstacles: those on the way, and those of
    /// the states and contacts that were looked at.
    fn smallest_gaps(&self) -> [Option<f64>; 2] {
        let gaps = self.agents.gaps();
        let on_the_way = [gaps.agents, gaps.obstacles].map(|it| it.map(|it| it.gap));
        let in_frames = [self.smallest_agent_gap, self.smallest_obstacle_gap];
        let in_contact = [
            self.ledger.smallest_agent_gap(),
            self.ledger.smallest_obstacle_gap(),
        ];
        let mut least = on_the_way;
        for more in [in_frames, in_contact] {
            for (least, more) in least.iter_mut().zip(more) {
                keep_least(least, more);
            }
        }
        least
    }
}

/// Makes `least` the smaller of two, where there are any.
fn keep_least(least: &mut Option<f64>, value: Option<f64>) {
    *least = match (*least, value) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    };
}
