//! `volary run`: a world, from file to trace.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use clap::Args;
use volary::dynamics::Engine;
use volary::shape::In;
use volary::simulation::Simulation;
use volary::trace::record::{Outcome, Record, Summary};
use volary::trace::{TraceError, TraceWriter, write_summary};
use volary::world::{AnyWorld, Override, World};

use super::progress::Progress;
use super::{Refusal, load, print, summary};

/// Arguments of `volary run`.
#[derive(Debug, Args)]
pub(super) struct RunArguments {
    /// A world file, or the name of a shipped world
    world: String,
    /// Seed of every random draw, instead of the world's
    #[arg(long)]
    seed: Option<u64>,
    /// Time to end at, instead of the world's
    #[arg(long, value_name = "TIME")]
    until: Option<f64>,
    /// Step size, instead of the world's
    #[arg(long, value_name = "TIME")]
    step: Option<f64>,
    /// Set any field of the world: laws[0].alpha_interaction.damping=2
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Write the trace to this file: .jsonl or .json, also with .gz or .zst behind
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Write the summary to this file, as JSON
    #[arg(long, value_name = "FILE")]
    summary: Option<PathBuf>,
    /// Threads to compute on; all cores when absent. The result is the same on any number.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Overwrite files that exist
    #[arg(long)]
    force: bool,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

impl RunArguments {
    /// Everything that replaces a value of the file; what comes last wins.
    fn overrides(&self) -> Result<Vec<Override>, Refusal> {
        let named = [
            self.seed.map(|seed| format!("seed={seed}")),
            self.until.map(|time| format!("time.end={time}")),
            self.step.map(|time| format!("time.step={time}")),
        ];
        let settings = named.into_iter().flatten().chain(self.set.iter().cloned());
        settings
            .map(|setting| setting.parse().map_err(Refusal::bad_input))
            .collect()
    }
}

/// Runs a world, writes what was asked for and prints a summary.
pub(super) fn run(arguments: &RunArguments) -> Result<(), Refusal> {
    let world = load::load(&arguments.world, arguments.overrides()?)?;
    let threads = usize::from(arguments.threads.unwrap_or(0));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(Refusal::failed)?.install(|| match world {
        AnyWorld::Plane(world) => run_world(arguments, world),
        AnyWorld::Space(world) => run_world(arguments, world),
    })
}

fn run_world<const D: usize>(arguments: &RunArguments, world: World<D>) -> Result<(), Refusal>
where
    In<D>: Engine<D>,
{
    let begin = Instant::now();
    if let Some(path) = &arguments.summary
        && path.exists()
        && !arguments.force
    {
        let name = path.display().to_string();
        return Err(refuse_file(TraceError::Exists { name }));
    }
    let mut simulation = Simulation::new(world).map_err(Refusal::failed)?;
    let mut writer = match &arguments.trace {
        Some(path) => Some(TraceWriter::create(path, arguments.force).map_err(refuse_file)?),
        None => None,
    };
    let stop = stop_on_interrupt();
    let progress = Progress::new(simulation.world().steps(), arguments.quiet);
    let done = simulation.run(
        |record: Record| match &mut writer {
            Some(writer) => writer.write(&record),
            None => Ok(()),
        },
        |state| {
            progress.show(state.step, state.time);
            if stop.load(Ordering::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        },
    );
    progress.finish();
    let done = done.map_err(Refusal::failed)?;
    if let Some(writer) = writer {
        writer.finish().map_err(Refusal::failed)?;
    }
    if let Some(path) = &arguments.summary {
        write_summary(path, &done, arguments.force).map_err(refuse_file)?;
    }
    if !arguments.quiet {
        print(&summary::table(&done, begin.elapsed()));
    }
    judge(&done)
}

fn judge(summary: &Summary) -> Result<(), Refusal> {
    match summary.outcome {
        Outcome::Completed => Ok(()),
        Outcome::Interrupted => Err(Refusal::failed(format!(
            "stopped at time {}; what was written is whole up to there",
            summary.time
        ))),
        Outcome::Failed => Err(Refusal::failed(format!(
            "failed at time {}: {}",
            summary.time,
            summary.error.as_deref().unwrap_or("for an unknown reason")
        ))),
    }
}

/// A file that cannot be written where it was asked for is bad input.
fn refuse_file(error: TraceError) -> Refusal {
    match error {
        TraceError::Exists { .. } => Refusal::bad_input(format!("{error}; --force overwrites it")),
        _ => Refusal::bad_input(error),
    }
}

/// A flag that the first Ctrl-C raises; the second ends the program at once.
fn stop_on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    // Without a handler Ctrl-C ends the program at once, which loses the summary only.
    let _ = ctrlc::set_handler(move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(1);
        }
    });
    stop
}
