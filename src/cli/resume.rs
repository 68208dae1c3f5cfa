//! `volary resume`: a run that goes on from its last checkpoint.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use volary::checkpoint::{Checkpoint, Recording};
use volary::dynamics::Engine;
use volary::shape::In;
use volary::stop::Stop;
use volary::trace::{BackgroundWriter, TraceWriter, check_summary};

use super::drive::{Drive, Keeper, Threads};
use super::{Refusal, files, print, summary};

const EXAMPLES: &str = "\
Examples:
  volary run my.json --trace my.jsonl --checkpoint my.ckpt --every 10
  volary resume my.ckpt
  volary resume moved/my.ckpt --trace moved/my.jsonl

The run goes on bit for bit as if it had never stopped: what the trace holds beyond the
checkpoint is taken away and written again. Further checkpoints go to the same file.";

/// Arguments of `volary resume`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct ResumeArguments {
    /// A checkpoint that `volary run --checkpoint` made
    checkpoint: PathBuf,
    /// Where the trace is now, if it is no longer where it was
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Write the summary to this file, instead of where it was to go
    #[arg(long, value_name = "FILE")]
    summary: Option<PathBuf>,
    #[command(flatten)]
    threads: Threads,
    /// Overwrite a file that exists with the summary, where --summary names one
    #[arg(long)]
    force: bool,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
    /// Tell where the time went: senses, each law, engine, contacts, metrics, trace
    #[arg(long)]
    profile: bool,
}

/// Goes on with a run.
pub(super) fn resume(arguments: &ResumeArguments, stop: &Stop) -> Result<(), Refusal> {
    let path = &arguments.checkpoint;
    let checkpoint = Checkpoint::read(path).map_err(files::refuse_checkpoint)?;
    let Some(recording) = checkpoint.recording() else {
        return Err(Refusal::bad_input(format!(
            "{}: a program of its own made this checkpoint, and must go on with it",
            path.display()
        )));
    };
    if recording.complete() {
        return completed(arguments, &checkpoint);
    }
    arguments
        .threads
        .install(|| match checkpoint.world().dimension {
            2 => resume_world::<2>(arguments, &checkpoint, recording, stop),
            _ => resume_world::<3>(arguments, &checkpoint, recording, stop),
        })
}

fn completed(arguments: &ResumeArguments, checkpoint: &Checkpoint) -> Result<(), Refusal> {
    if arguments.quiet {
        return Ok(());
    }
    let time = checkpoint.step() as f64 * checkpoint.world().time.step;
    print(&format!(
        "{} ran to its end at time {} already; there is nothing left to do.\n",
        checkpoint.name(),
        summary::time(time)
    ))
}

fn resume_world<const D: usize>(
    arguments: &ResumeArguments,
    checkpoint: &Checkpoint,
    recording: &Recording,
    stop: &Stop,
) -> Result<(), Refusal>
where
    In<D>: Engine<D>,
{
    let begin = Instant::now();
    let simulation = checkpoint
        .simulation::<D>(Vec::new())
        .map_err(files::refuse_checkpoint)?;
    let trace = trace(arguments, recording)?;
    let summary = match &arguments.summary {
        Some(path) => Some((path.clone(), arguments.force)),
        // What is there is of this run.
        None => recording.summary().map(|path| (path, true)),
    };
    files::apart(&[
        ("checkpoint", Some(&arguments.checkpoint)),
        ("trace", trace.as_ref().map(|(path, _)| path.as_path())),
        ("summary", summary.as_ref().map(|(path, _)| path.as_path())),
    ])?;
    if let Some((path, overwrite)) = &summary {
        check_summary(path, *overwrite).map_err(files::refuse)?;
    }
    Drive {
        name: checkpoint.name(),
        begin,
        stop: stop.clone(),
        simulation,
        trace,
        summary,
        keeper: Some(Keeper {
            path: arguments.checkpoint.clone(),
            every: recording.every(),
            overwrite: true,
        }),
        quiet: arguments.quiet,
        profile: arguments.profile,
    }
    .go_on()
}

/// The trace, where there is one, at the place where it goes on.
fn trace(
    arguments: &ResumeArguments,
    recording: &Recording,
) -> Result<Option<(PathBuf, BackgroundWriter)>, Refusal> {
    let moved: Option<&Path> = arguments.trace.as_deref();
    match (recording.trace(), moved) {
        (None, None) => Ok(None),
        (None, Some(path)) => Err(Refusal::bad_input(format!(
            "{}: the run writes no trace, and cannot begin one now",
            path.display()
        ))),
        (Some((path, position)), moved) => {
            let hint = match moved {
                None if !path.exists() => "; --trace says where it is now",
                _ => "",
            };
            let path = moved.map_or(path, Path::to_owned);
            let writer = TraceWriter::resume(&path, position);
            match writer.and_then(|writer| BackgroundWriter::new(writer, &path)) {
                Ok(writer) => Ok(Some((path, writer))),
                Err(error) => Err(Refusal::bad_input(format!("{error}{hint}"))),
            }
        }
    }
}
