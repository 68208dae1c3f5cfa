//! A run on its way: from a simulation, new or taken up again, to its files.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use volary::checkpoint::{Checkpoint, Recording};
use volary::dynamics::Snapshot;
use volary::simulation::{Pause, Simulation};
use volary::stop::Stop;
use volary::trace::record::{Outcome, Record, Summary};
use volary::trace::{BackgroundWriter, TraceError, write_summary};

use super::progress::Progress;
use super::{Refusal, files, interrupt, print, profile, strain, summary};

/// A simulation, and the files that it writes.
pub(super) struct Drive<'a, const D: usize> {
    /// What messages call it.
    pub(super) name: &'a str,
    pub(super) begin: Instant,
    /// Whether someone wants it to stop.
    pub(super) stop: Stop,
    pub(super) simulation: Simulation<D>,
    pub(super) trace: Option<(PathBuf, BackgroundWriter)>,
    /// The file of the summary, and whether it may overwrite another.
    pub(super) summary: Option<(PathBuf, bool)>,
    pub(super) keeper: Option<Keeper>,
    pub(super) quiet: bool,
    /// Whether to tell where the time went.
    pub(super) profile: bool,
}

/// Where checkpoints go, and when.
pub(super) struct Keeper {
    pub(super) path: PathBuf,
    /// Steps between them.
    pub(super) every: u64,
    /// Whether the first may overwrite what is there.
    pub(super) overwrite: bool,
}

impl<const D: usize> Drive<'_, D> {
    /// Runs a new simulation to its end.
    pub(super) fn start(mut self) -> Result<(), Refusal> {
        let begun = self.simulation.begin(&mut recorder(&mut self.trace));
        begun.map_err(Refusal::failed)?;
        self.keep_checkpoint(false)?;
        self.go_on()
    }

    /// Takes a simulation to its end, writes what was asked for and prints a summary.
    pub(super) fn go_on(mut self) -> Result<(), Refusal> {
        interrupt::looks();
        self.simulation.heed(self.stop.clone());
        self.simulation.measure(self.profile);
        let world = self.simulation.world();
        let progress = Progress::new(world.steps(), world.spec.time.step, self.quiet);
        let done = self.run(&progress);
        progress.finish();
        let done = done?;
        if let Some((_, writer)) = self.trace.take() {
            writer.finish().map_err(Refusal::failed)?;
        }
        if let Some((path, overwrite)) = &self.summary {
            write_summary(path, &done, *overwrite).map_err(Refusal::failed)?;
        }
        if done.outcome == Outcome::Completed {
            self.keep_checkpoint(true)?;
        }
        if !self.quiet {
            let solver = self.simulation.solver();
            let step = self.simulation.world().spec.time.step;
            print(&summary::table(&done, solver, self.begin.elapsed()))?;
            print(&strain::after(&done, step))?;
        }
        if self.profile {
            print(&profile::table(
                &self.simulation.profile(),
                self.begin.elapsed(),
            ))?;
        }
        self.judge(&done)
    }

    fn run(&mut self, progress: &Progress) -> Result<Summary, Refusal> {
        let stop = self.stop.clone();
        let steps = self.simulation.world().steps();
        let pause = loop {
            let taken = self.simulation.snapshot().step;
            let every = self.keeper.as_ref().map_or(u64::MAX, |keeper| keeper.every);
            let end = (taken / every + 1).saturating_mul(every).min(steps);
            let mut watch = |state: &Snapshot<'_, D>| {
                progress.show(state.step);
                match stop.asked() {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                }
            };
            let advanced = self
                .simulation
                .advance(end, &mut recorder(&mut self.trace), &mut watch);
            let pause = advanced.map_err(Refusal::failed)?;
            if pause == Pause::Stopped {
                // What is left is a last frame, and a checkpoint where there are to be any.
                interrupt::saves();
            }
            // A state that fails fails again; one at the end has nothing before it.
            if matches!(pause, Pause::Failed(_)) || self.simulation.snapshot().step >= steps {
                break pause;
            }
            self.keep_checkpoint(false)?;
            if pause == Pause::Stopped {
                break pause;
            }
        };
        let done = self
            .simulation
            .finish(pause, &mut recorder(&mut self.trace));
        done.map_err(Refusal::failed)
    }

    /// Makes a checkpoint, where there are to be any.
    fn keep_checkpoint(&mut self, complete: bool) -> Result<(), Refusal> {
        let Some(keeper) = &mut self.keeper else {
            return Ok(());
        };
        let mut recording = Recording::new(keeper.every);
        if let Some((path, writer)) = &mut self.trace {
            let position = writer.position().map_err(Refusal::failed)?;
            recording = recording.with_trace(&files::absolute(path), position);
        }
        if let Some((path, _)) = &self.summary {
            recording = recording.with_summary(&files::absolute(path));
        }
        if complete {
            recording = recording.completed();
        }
        let checkpoint = Checkpoint::of(&self.simulation).map_err(Refusal::failed)?;
        let written = checkpoint
            .with_recording(recording)
            .write(&keeper.path, keeper.overwrite);
        keeper.overwrite = true;
        written.map_err(Refusal::failed)
    }

    fn judge(&self, done: &Summary) -> Result<(), Refusal> {
        match done.outcome {
            Outcome::Completed => Ok(()),
            Outcome::Interrupted => {
                let resume = self
                    .keeper
                    .as_ref()
                    .map(|keeper| format!(" `volary resume {}` goes on.", keeper.path.display()));
                Err(Refusal::Failed(format!(
                    "Stopped at time {}; what was written is whole up to there.{}",
                    summary::time(done.time),
                    resume.unwrap_or_default()
                )))
            }
            Outcome::Failed => Err(Refusal::failed(format!(
                "{} cannot go on: {}",
                self.name,
                done.error.as_deref().unwrap_or("for an unknown reason")
            ))),
        }
    }
}

/// What takes the records of a run: its trace, or nothing.
fn recorder(
    trace: &mut Option<(PathBuf, BackgroundWriter)>,
) -> impl FnMut(Record) -> Result<(), TraceError> {
    |record| match trace {
        Some((_, writer)) => writer.write(record),
        None => Ok(()),
    }
}

/// How many threads a command may use.
#[derive(Debug, Args)]
pub(super) struct Threads {
    /// Number of threads that compute, all cores when absent; the result is the same on any
    /// number. A trace is written by one more
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u16).range(1..=1024),
        allow_negative_numbers = true
    )]
    threads: Option<u16>,
}

impl Threads {
    /// Does something on them.
    pub(super) fn install<T: Send>(
        &self,
        work: impl FnOnce() -> Result<T, Refusal> + Send,
    ) -> Result<T, Refusal> {
        let threads = usize::from(self.threads.unwrap_or(0));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(Refusal::failed)?.install(work)
    }
}
