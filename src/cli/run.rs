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
use volary::trace::{TraceWriter, write_summary};
use volary::world::{AnyWorld, Override, World};

use super::progress::Progress;
use super::{Refusal, files, load, print, summary};

const EXAMPLES: &str = "\
Examples:
  volary run my.json
  volary run my.json --seed 7 --until 20 --summary seven.json
  volary run my.json --trace my.jsonl.zst --set record.every=0.05 --set record.edges=true

Ctrl-C stops a run in good order: trace and summary are whole up to there.";

/// Arguments of `volary run`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct RunArguments {
    /// A world file, or the name of a shipped world
    pub(super) world: String,
    /// Seed of every random draw, instead of the world's
    #[arg(long, value_parser = seed, allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Time to end at, instead of the world's; a whole number of steps
    #[arg(long, value_name = "TIME", value_parser = time, allow_negative_numbers = true)]
    until: Option<f64>,
    /// Step size, instead of the world's
    #[arg(long, value_name = "TIME", value_parser = time, allow_negative_numbers = true)]
    step: Option<f64>,
    /// Set any field of the world, as in laws[0].alpha_interaction.damping=2; may be repeated
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Write the trace to this file: .jsonl or .json, also with .gz or .zst behind
    #[arg(long, value_name = "FILE")]
    pub(super) trace: Option<PathBuf>,
    /// Write the summary to this file, as JSON
    #[arg(long, value_name = "FILE")]
    pub(super) summary: Option<PathBuf>,
    /// Number of threads, all cores when absent; the result is the same on any number
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u16).range(1..=1024),
        allow_negative_numbers = true
    )]
    threads: Option<u16>,
    /// Overwrite a trace or summary that exists
    #[arg(long)]
    pub(super) force: bool,
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
            .map(|setting| {
                let parsed: Result<Override, _> = setting.parse();
                parsed.map_err(|error| Refusal::bad_input(format!("--set: {error}")))
            })
            .collect()
    }
}

fn seed(text: &str) -> Result<u64, String> {
    let problem = |_| format!("must be a whole number from 0 to {}", u64::MAX);
    text.parse().map_err(problem)
}

fn time(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if time.is_finite() => Ok(time),
        _ => Err("must be a number, and finite".to_owned()),
    }
}

/// Runs a world, writes what was asked for and prints a summary.
pub(super) fn run(arguments: &RunArguments) -> Result<(), Refusal> {
    files::check(arguments)?;
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
    let stop = stop_on_interrupt();
    let mut simulation = Simulation::new(world).map_err(|failure| {
        Refusal::failed(format!("{} cannot start: {failure}", arguments.world))
    })?;
    let mut writer = match &arguments.trace {
        Some(path) => Some(TraceWriter::create(path, arguments.force).map_err(files::refuse)?),
        None => None,
    };
    let (steps, step_size) = (
        simulation.world().steps(),
        simulation.world().spec.time.step,
    );
    let progress = Progress::new(steps, step_size, arguments.quiet);
    let done = simulation.run(
        |record: Record| match &mut writer {
            Some(writer) => writer.write(&record),
            None => Ok(()),
        },
        |state| {
            progress.show(state.step);
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
        write_summary(path, &done, arguments.force).map_err(Refusal::failed)?;
    }
    if !arguments.quiet {
        print(&summary::table(&done, begin.elapsed()))?;
    }
    judge(&arguments.world, &done)
}

fn judge(world: &str, done: &Summary) -> Result<(), Refusal> {
    match done.outcome {
        Outcome::Completed => Ok(()),
        Outcome::Interrupted => Err(Refusal::Failed(format!(
            "Stopped at time {}; what was written is whole up to there.",
            summary::time(done.time)
        ))),
        Outcome::Failed => Err(Refusal::failed(format!(
            "{world} cannot go on: {}",
            done.error.as_deref().unwrap_or("for an unknown reason")
        ))),
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
