//! `volary run`: a world, from file to trace.

use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};
use volary::dynamics::{Accuracy, Dynamics, Engine};
use volary::shape::In;
use volary::simulation::Simulation;
use volary::stop::Stop;
use volary::trace::{BackgroundWriter, TraceWriter};
use volary::world::check::{Motion, on_a_step};
use volary::world::{AnyWorld, Override, World};

use super::drive::{Drive, Keeper, Threads};
use super::progress::Progress;
use super::values::number;
use super::{Refusal, files, load};

const EXAMPLES: &str = "\
Examples:
  volary run my.json
  volary run my.json --seed 7 --until 20 --summary seven.json
  volary run my.json --trace my.jsonl.zst --set record.every=0.05 --set record.edges=true
  volary run my.json --trace my.jsonl --checkpoint my.ckpt --every 10
  volary run my.json --dynamics points --accuracy 1e-12

Ctrl-C stops a run in good order: trace and summary are whole up to there. With --checkpoint
it makes one last checkpoint, too, and `volary resume` goes on from it.";

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
    #[arg(long, value_name = "TIME", value_parser = number, allow_negative_numbers = true)]
    until: Option<f64>,
    /// Step size, instead of the world's
    #[arg(long, value_name = "TIME", value_parser = number, allow_negative_numbers = true)]
    step: Option<f64>,
    /// Set any field of the world, as in laws[0].alpha_interaction.damping=2; may be repeated
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// What moves the agents
    #[arg(long, value_enum, default_value_t = Kind::Bodies)]
    dynamics: Kind,
    /// Largest error of one step of the solver of points, as a share of the largest position
    /// and velocity so far; 1e-10 when absent
    #[arg(
        long,
        value_name = "SHARE",
        value_parser = accuracy,
        allow_negative_numbers = true
    )]
    accuracy: Option<f64>,
    /// Write the trace to this file: .jsonl or .json, also with .gz or .zst behind
    #[arg(long, value_name = "FILE")]
    pub(super) trace: Option<PathBuf>,
    /// Write the summary to this file, as JSON
    #[arg(long, value_name = "FILE")]
    pub(super) summary: Option<PathBuf>,
    /// Keep a checkpoint in this file, for `volary resume` to go on from after a crash
    #[arg(long, value_name = "FILE", requires = "every")]
    pub(super) checkpoint: Option<PathBuf>,
    /// Simulated time between checkpoints; a whole number of steps
    #[arg(
        long,
        value_name = "TIME",
        value_parser = number,
        allow_negative_numbers = true,
        requires = "checkpoint"
    )]
    every: Option<f64>,
    #[command(flatten)]
    threads: Threads,
    /// Overwrite a trace, summary or checkpoint that exists
    #[arg(long)]
    pub(super) force: bool,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
    /// Tell where the time went: senses, each law, engine, contacts, metrics, trace
    #[arg(long)]
    profile: bool,
}

/// What moves the agents.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Rigid bodies that push, block and touch each other
    Bodies,
    /// Point masses that pass through everything, integrated to an accuracy
    Points,
}

impl RunArguments {
    fn dynamics(&self) -> Result<Dynamics, Refusal> {
        match (self.dynamics, self.accuracy) {
            (Kind::Bodies, None) => Ok(Dynamics::Bodies),
            (Kind::Bodies, Some(_)) => Err(Refusal::bad_input(
                "--accuracy is for --dynamics points: the accuracy of bodies is that of --step",
            )),
            (Kind::Points, relative) => {
                let accuracy = relative.map(|relative| Accuracy { relative });
                Ok(Dynamics::Points(accuracy.unwrap_or_default()))
            }
        }
    }

    /// Which steps are short enough depends on it.
    fn motion(&self) -> Motion {
        match self.dynamics {
            Kind::Bodies => Motion::OfBodies,
            Kind::Points => Motion::OfPoints,
        }
    }

    /// Everything that replaces a value of the file; what comes last wins.
    fn overrides(&self) -> Result<Vec<Override>, Refusal> {
        let named = [
            self.seed.map(|seed| format!("seed={seed}")),
            self.until.map(|time| format!("time.end={time}")),
            self.step.map(|time| format!("time.step={time}")),
        ];
        let settings = named.into_iter().flatten().chain(self.set.iter().cloned());
        load::overrides(&settings.collect::<Vec<_>>())
    }
}

fn seed(text: &str) -> Result<u64, String> {
    let problem = |_| format!("must be a whole number from 0 to {}", u64::MAX);
    text.parse().map_err(problem)
}

pub(super) fn accuracy(text: &str) -> Result<f64, String> {
    let range = Accuracy::FINEST..=Accuracy::COARSEST;
    match text.parse::<f64>() {
        Ok(accuracy) if range.contains(&accuracy) => Ok(accuracy),
        _ => Err(format!(
            "must be a number from {:e} to {:e}",
            range.start(),
            range.end()
        )),
    }
}

/// Runs a world, writes what was asked for and prints a summary.
pub(super) fn run(arguments: &RunArguments, stop: &Stop) -> Result<(), Refusal> {
    files::check(arguments)?;
    let (overrides, motion) = (arguments.overrides()?, arguments.motion());
    let world = load::load_moved(&arguments.world, overrides, motion, arguments.quiet)?;
    arguments.threads.install(|| match world {
        AnyWorld::Plane(world) => run_world(arguments, world, stop),
        AnyWorld::Space(world) => run_world(arguments, world, stop),
    })
}

fn run_world<const D: usize>(
    arguments: &RunArguments,
    world: World<D>,
    stop: &Stop,
) -> Result<(), Refusal>
where
    In<D>: Engine<D>,
{
    let begin = Instant::now();
    let every = every(arguments, &world)?;
    let (dynamics, quiet) = (arguments.dynamics()?, arguments.quiet);
    let progress = Progress::of_preparation(format!("starting {}", arguments.world), quiet);
    let simulation = Simulation::with_dynamics(world, Vec::new(), dynamics);
    progress.finish();
    let simulation = simulation.map_err(|failure| match failure.is_bad_input() {
        true => Refusal::bad_input(format!("{}: {failure}", arguments.world)),
        false => Refusal::failed(format!("{} cannot start: {failure}", arguments.world)),
    })?;
    let create = match every {
        Some(_) => TraceWriter::create_resumable,
        None => TraceWriter::create,
    };
    let trace = match &arguments.trace {
        Some(path) => {
            let writer = create(path, arguments.force)
                .and_then(|writer| BackgroundWriter::new(writer, path));
            Some((path.clone(), writer.map_err(files::refuse)?))
        }
        None => None,
    };
    let summary = arguments.summary.clone();
    let keeper = arguments.checkpoint.as_ref().zip(every);
    Drive {
        name: &arguments.world,
        begin,
        stop: stop.clone(),
        simulation,
        trace,
        summary: summary.map(|path| (path, arguments.force)),
        keeper: keeper.map(|(path, every)| Keeper {
            path: path.clone(),
            every,
            overwrite: arguments.force,
        }),
        quiet: arguments.quiet,
        profile: arguments.profile,
    }
    .start()
}

/// The number of steps between checkpoints, if there are to be any.
fn every<const D: usize>(
    arguments: &RunArguments,
    world: &World<D>,
) -> Result<Option<u64>, Refusal> {
    let Some(time) = arguments.every else {
        return Ok(None);
    };
    match on_a_step("--every", time, world.spec.time.step, 1) {
        Ok(steps) => Ok(Some(steps)),
        Err(problem) => {
            let hint = problem.hint.map(|hint| format!("; {hint}"));
            let (what, hint) = (problem.what, hint.unwrap_or_default());
            Err(Refusal::bad_input(format!("--every {time}: {what}{hint}")))
        }
    }
}
