//! `volary validate`: what the papers' claims come to in some worlds.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use rayon::prelude::*;
use volary::dynamics::{Accuracy, Engine};
use volary::shape::In;
use volary::validate::report::{Report, WorldReport};
use volary::validate::{Wanted, form, report, validate as judge};
use volary::world::spec::LawSpec;
use volary::world::{AnyWorld, World, shipped};

use super::drive::Threads;
use super::{Refusal, files, load, print, run};

const EXAMPLES: &str = "\
Examples:
  volary validate song-2013/example-18
  volary validate song-2013 shi-wang-chu --report claims.html --report claims.json
  volary validate my.json --dynamics points --accuracy 1e-12

A name that ends before the slash stands for all shipped worlds of that paper.

Exit codes: 0 every finding is as expected, 1 some are not, 2 bad input. Where a world
expects nothing in particular of a claim, it must not be violated.";

/// Arguments of `volary validate`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct ValidateArguments {
    /// World files, or names of shipped worlds or of papers
    #[arg(required = true, value_name = "WORLD")]
    worlds: Vec<String>,
    /// What moves the agents
    #[arg(long, value_enum, default_value_t = Kind::Both)]
    dynamics: Kind,
    /// Largest error of one step of the solver of points, as a share of the largest position
    /// and velocity so far; 1e-10 when absent
    #[arg(
        long,
        value_name = "SHARE",
        value_parser = run::accuracy,
        allow_negative_numbers = true
    )]
    accuracy: Option<f64>,
    /// Set any field of every world, as in agents[0].radius=0.4; may be repeated
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Write a report to this file: .html, .md or .json; may be repeated
    #[arg(long, value_name = "FILE")]
    report: Vec<PathBuf>,
    #[command(flatten)]
    threads: Threads,
    /// Overwrite a report that exists
    #[arg(long, requires = "report")]
    force: bool,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// What moves the agents.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Rigid bodies
    Bodies,
    /// Point masses
    Points,
    /// Each in a run of its own
    Both,
}

/// Validates worlds, writes the reports asked for and prints one.
pub(super) fn validate(arguments: &ValidateArguments) -> Result<(), Refusal> {
    let mut known = HashSet::new();
    let names = arguments.worlds.iter().flat_map(|name| expanded(name));
    let names: Vec<String> = names.filter(|name| known.insert(name.clone())).collect();
    check_files(arguments, &names)?;
    let mut worlds = Vec::new();
    for name in &names {
        let overrides = load::overrides(&arguments.set)?;
        worlds.push((name, load::load(name, overrides, arguments.quiet)?));
    }
    for (name, world) in &worlds {
        fits(name, world)?;
    }
    let wanted = Wanted {
        points: (arguments.dynamics != Kind::Bodies).then(|| {
            let accuracy = arguments.accuracy.map(|relative| Accuracy { relative });
            accuracy.unwrap_or_default()
        }),
        bodies: arguments.dynamics != Kind::Points,
    };
    if wanted.points.is_none() && arguments.accuracy.is_some() {
        return Err(Refusal::bad_input(
            "--accuracy is that of points, which --dynamics bodies does without",
        ));
    }
    let reports: Vec<_> = arguments.threads.install(|| {
        let judged = worlds.par_iter().map(|(name, world)| match world {
            AnyWorld::Plane(world) => one(name, world, wanted),
            AnyWorld::Space(world) => one(name, world, wanted),
        });
        judged.collect()
    })?;
    let report = report(reports);
    for path in &arguments.report {
        form::write(path, &report, arguments.force).map_err(files::refuse)?;
    }
    if !arguments.quiet {
        print(&form::table(&report))?;
    }
    verdict(&report)
}

fn one<const D: usize>(name: &str, world: &World<D>, wanted: Wanted) -> Result<WorldReport, Refusal>
where
    In<D>: Engine<D>,
{
    judge(world, wanted).map_err(|failure| match failure.is_bad_input() {
        true => Refusal::bad_input(format!(
            "{name}: {failure}; --dynamics bodies does without points"
        )),
        false => Refusal::failed(format!("{name}: {failure}")),
    })
}

/// Numbers that the observations of a run may hold, all of which are kept: 4 GiB.
const MOST_NUMBERS: u64 = 1 << 29;

/// Refuses a world whose observations would fill the memory.
fn fits(name: &str, world: &AnyWorld) -> Result<(), Refusal> {
    match world {
        AnyWorld::Plane(world) => fits_in_memory(name, world),
        AnyWorld::Space(world) => fits_in_memory(name, world),
    }
}

fn fits_in_memory<const D: usize>(name: &str, world: &World<D>) -> Result<(), Refusal> {
    let agents = world.agents.len() as u64;
    let aligns = |(_, law): &(_, &LawSpec)| matches!(law, LawSpec::Alignment(_));
    let (laws, aligning) = (world.laws().count(), world.laws().filter(aligns).count());
    // Position, velocity, acceleration, jerk and what each law adds; influences of all on all.
    let each = (4 + laws as u64) * D as u64 * agents + aligning as u64 * agents * agents;
    let most = MOST_NUMBERS / each.max(1);
    let observations = world.steps() / world.frame_steps() + 1;
    match observations <= most {
        true => Ok(()),
        false => Err(Refusal::bad_input(format!(
            "{name}: {observations} observations of {agents} agents do not fit in memory; allowed: \
             at most {most}; record.every is the time between them"
        ))),
    }
}

/// The exit code's reason.
fn verdict(report: &Report) -> Result<(), Refusal> {
    let worlds = report.worlds.iter().filter(|world| !world.as_expected());
    let worlds: Vec<&str> = worlds.map(|world| world.world.as_str()).collect();
    match worlds.is_empty() {
        true => Ok(()),
        false => Err(Refusal::failed(format!(
            "not as expected: {}",
            worlds.join(", ")
        ))),
    }
}

/// The shipped worlds of a paper, or the name as it is.
fn expanded(name: &str) -> Vec<String> {
    let folder = format!("{}/", name.trim_end_matches('/'));
    let mut names = shipped::names();
    names.retain(|it| it.starts_with(&folder));
    match names.is_empty() || Path::new(name).is_file() {
        true => vec![name.to_owned()],
        false => names,
    }
}

/// Refuses, before anything runs, reports that cannot be written.
fn check_files(arguments: &ValidateArguments, worlds: &[String]) -> Result<(), Refusal> {
    let worlds = worlds.iter().map(|name| ("world", Some(Path::new(name))));
    let reports = arguments.report.iter();
    let reports = reports.map(|path| ("report", Some(path.as_path())));
    let all: Vec<_> = worlds.chain(reports).collect();
    files::apart(&all)?;
    for path in &arguments.report {
        form::check(path, arguments.force).map_err(files::refuse)?;
    }
    Ok(())
}
