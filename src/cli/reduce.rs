//! `volary reduce`: the reduced model of fast flocking.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;
use volary::reduced::{FastFlocking, NoReduction, write_leading};
use volary::world::{AnyWorld, World};

use super::{Refusal, files, load, print};

const EXAMPLES: &str = "\
Examples:
  volary reduce djokam-rathinam/fast-0.1
  volary reduce my.json --out leading.csv --set record.every=0.5";

/// Arguments of `volary reduce`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct ReduceArguments {
    /// A world file, or the name of a shipped world, with one alignment law
    world: String,
    /// Set any field of the world, as in laws[1].tracking.velocity_gain=2; may be repeated
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Print one JSON object, with the influences P and the rates Q
    #[arg(long)]
    json: bool,
    /// Write the leading order at the world's record times to this file: a table where it
    /// ends in .csv, otherwise JSON Lines
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrite a file that exists
    #[arg(long, requires = "out")]
    force: bool,
}

/// Prints the reduced model of a world, and writes its leading order where asked to.
pub(super) fn reduce(arguments: &ReduceArguments) -> Result<(), Refusal> {
    files::apart(&[
        ("world", Some(Path::new(&arguments.world))),
        ("leading order", arguments.out.as_deref()),
    ])?;
    match load::load(&arguments.world, load::overrides(&arguments.set)?, false)? {
        AnyWorld::Plane(world) => reduce_world(arguments, &world),
        AnyWorld::Space(world) => reduce_world(arguments, &world),
    }
}

fn reduce_world<const D: usize>(
    arguments: &ReduceArguments,
    world: &World<D>,
) -> Result<(), Refusal> {
    let refuse = |problem: NoReduction| {
        let message = format!("{}: {problem}", arguments.world);
        match problem {
            NoReduction::Endless { .. } | NoReduction::Stuck(_) => Refusal::failed(message),
            _ => Refusal::bad_input(message),
        }
    };
    let mut reduced = FastFlocking::new(world).map_err(refuse)?;
    if let Some(path) = &arguments.out {
        let course = reduced.recorded().map_err(refuse)?;
        write_leading(path, &course, arguments.force).map_err(files::refuse_file)?;
    }
    print(&match arguments.json {
        true => object(&arguments.world, &reduced),
        false => table(&arguments.world, &reduced),
    })
}

/// For people.
fn table<const D: usize>(name: &str, reduced: &FastFlocking<'_, D>) -> String {
    let vector = |numbers: &[f64]| {
        let numbers: Vec<String> = numbers.iter().map(|x| format!("{x:.6}")).collect();
        format!("({})", numbers.join(", "))
    };
    let mut text = format!("{name}: the reduced model of fast flocking\n\n");
    for (what, value, meaning) in [
        (
            "v^f(0)",
            reduced.start,
            "limit of the transient layer, (4.23)",
        ),
        (
            "v^f(0) as printed",
            reduced.printed,
            "mean of the velocities by the weights, (4.25)",
        ),
    ] {
        let value = vector(value.as_slice());
        let _ = writeln!(text, "  {what:<20}{value}   {meaning}");
    }
    text += "\n  weight of each agent in the flock's velocity\n";
    for (agent, weight) in reduced.weights.iter().enumerate() {
        let _ = writeln!(text, "  {agent:<20}{weight:.6}");
    }
    text
}

/// For programs.
fn object<const D: usize>(name: &str, reduced: &FastFlocking<'_, D>) -> String {
    let rows = |matrix: &nalgebra::DMatrix<f64>| -> Vec<Vec<f64>> {
        let rows = matrix.row_iter();
        rows.map(|row| row.iter().copied().collect()).collect()
    };
    let object = json!({
        "world": name,
        "start": reduced.start.as_slice(),
        "printed_start": reduced.printed.as_slice(),
        "weights": reduced.weights,
        "influences": rows(&reduced.influences),
        "rates": rows(&reduced.rates),
    });
    format!("{object:#}\n")
}
