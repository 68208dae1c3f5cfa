//! The command line: arguments, and what each command prints and returns.
//!
//! Exit codes: 0 done, 1 failed or stopped, 2 bad input.

mod check;
mod claims;
mod drive;
mod export;
mod figures;
mod files;
mod interrupt;
mod load;
mod plot;
mod profile;
mod progress;
mod reduce;
mod render;
mod resume;
mod run;
mod schema;
mod strain;
mod summary;
mod validate;
mod values;
mod worlds;

use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;
use std::thread::JoinHandle;

use clap::{Parser, Subcommand};

const EXAMPLES: &str = "\
Examples:
  volary worlds                                        What can be run as it is
  volary run olfati-saber-2003/six-obstacles           Run a shipped world
  volary worlds olfati-saber-2003/six-obstacles > my.json
                                                       Start a world of your own
  volary check my.json                                 See what is wrong with it
  volary run my.json --trace my.jsonl.zst              Run it, keep every frame
  volary run my.json --checkpoint my.ckpt --every 10   Run it, able to go on after a crash
  volary resume my.ckpt                                Go on
  volary render my.jsonl.zst -o my.gif                 See what happened

Exit codes: 0 done, 1 failed or stopped, 2 bad input.";

/// Flocks with bodies: flocking and steering laws as forces on rigid bodies.
#[derive(Debug, Parser)]
#[command(
    name = "volary",
    version,
    about,
    max_term_width = 100,
    after_help = EXAMPLES
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// What can be asked for.
#[derive(Debug, Subcommand)]
enum Command {
    /// Run a world and print how it went
    Run(run::RunArguments),
    /// Go on with a run from its last checkpoint
    Resume(resume::ResumeArguments),
    /// Run worlds, and tell what the papers' claims come to in them
    Validate(validate::ValidateArguments),
    /// Check worlds without running them
    Check(check::CheckArguments),
    /// Work out the reduced model of fast flocking
    Reduce(reduce::ReduceArguments),
    /// Draw what happens in a trace
    Render(render::RenderArguments),
    /// Draw what traces record over time, and where agents go
    Plot(plot::PlotArguments),
    /// Turn a trace into tables, or into the formats of other tools
    Export(export::ExportArguments),
    /// Make the papers' figures anew
    Figures(figures::FiguresArguments),
    /// List the papers' claims, or print some in full
    Claims(claims::ClaimsArguments),
    /// List the shipped worlds, or print one
    Worlds(worlds::WorldsArguments),
    /// Print the JSON Schema of a file format
    Schema(schema::SchemaArguments),
}

/// Why a command did not do what it was asked to.
#[derive(Debug)]
enum Refusal {
    /// Something went wrong on the way: exit code 1.
    Failed(String),
    /// What was asked for makes no sense: exit code 2.
    BadInput(String),
}

impl Refusal {
    fn failed(message: impl Display) -> Self {
        Self::Failed(format!("Error: {message}"))
    }

    fn bad_input(message: impl Display) -> Self {
        Self::BadInput(format!("Error: {message}"))
    }
}

/// Stack of the thread that commands run on. That of the main thread is as small as whoever
/// starts the program likes, and too small for much that is read or built inside one another.
const STACK: usize = 64 << 20;

/// Parses the arguments, does what they say and returns the exit code.
pub fn main() -> ExitCode {
    let thread = std::thread::Builder::new().stack_size(STACK);
    match thread.spawn(obey).map(JoinHandle::join) {
        Ok(Ok(code)) => code,
        Ok(Err(panic)) => std::panic::resume_unwind(panic),
        // Without a thread, here.
        Err(_) => obey(),
    }
}

fn obey() -> ExitCode {
    let command = Arguments::parse().command;
    let stop = &interrupt::heed_signals();
    let done = match command {
        Command::Run(arguments) => run::run(&arguments, stop),
        Command::Resume(arguments) => resume::resume(&arguments, stop),
        Command::Validate(arguments) => validate::validate(&arguments),
        Command::Check(arguments) => check::check(&arguments),
        Command::Reduce(arguments) => reduce::reduce(&arguments),
        Command::Render(arguments) => render::render(&arguments, stop),
        Command::Plot(arguments) => plot::plot(&arguments),
        Command::Export(arguments) => export::export(&arguments, stop),
        Command::Figures(arguments) => figures::figures(&arguments),
        Command::Claims(arguments) => claims::claims(&arguments),
        Command::Worlds(arguments) => worlds::worlds(&arguments),
        Command::Schema(arguments) => schema::schema(&arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(Refusal::Failed(message)) => complain(&message, 1),
        Err(Refusal::BadInput(message)) => complain(&message, 2),
    }
}

/// The one place that prints errors.
fn complain(message: &str, code: u8) -> ExitCode {
    // Nobody is left to tell where standard error is gone.
    let _ = writeln!(std::io::stderr(), "{}", message.trim_end());
    ExitCode::from(code)
}

/// Says what people should know, beside what they asked for.
fn note(text: impl Display) {
    // Nobody is left to tell where standard error is gone.
    let _ = writeln!(std::io::stderr(), "Note: {text}");
}

/// Prints to standard output; a reader that has gone away, such as `head`, is no error.
fn print(text: &str) -> Result<(), Refusal> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Refusal::failed(format!(
            "cannot write to standard output: {error}"
        ))),
        _ => Ok(()),
    }
}
