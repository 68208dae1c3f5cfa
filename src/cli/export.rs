//! `volary export`: a trace, as tables and in the formats of other tools.

use std::io::{self, ErrorKind};
use std::num::NonZeroU64;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use volary::export::{Export, ExportError, Form, Selection, Table};
use volary::stop::Stop;
use volary::trace::{TraceError, TraceReader};

use super::values::number;
use super::{Refusal, files, note};

const HELP: &str = "\
Tables, a row for each frame and ...
  agents       agent: time, step, agent, group, x, y, (z,) vx, vy, (vz); where recorded angle
               (2-D) or rx, ry, rz (3-D, rotation vector), and acceleration.LAW.x, ...
  metrics      (one row for the frame): time, step, metrics.*, net.*, laws.*, as recorded
  contacts     (no frames: a row for each episode): agent, with, other, begin, end,
               open, steps, blow, blows, impulse, largest_impulse, mean_force, friction,
               deepest_penetration, approach_speed, push_speed, x, y, (z)
  edges, links, blocked
               pair: time, step, agent, other
  beta-agents  β-agent: time, step, agent, obstacle, part, x, y, (z,) vx, vy, (vz,) distance
  obstacles    obstacle that moves: time, step, obstacle, x, y, (z,) and angle or rx, ry, rz

Units are those of the world, angles are radians. Agents and obstacles are numbered from 0.
Numbers read back bit for bit; what is not defined is empty. Obstacles, contacts and metrics have
no place in .xyz. A trace needs no export for pandas, Polars and DuckDB, which read JSON Lines.

Examples:
  volary export my.jsonl.zst -o my.csv
  volary export my.jsonl.zst -o contacts.csv --table contacts
  volary export my.jsonl -o my.xyz --from 10 --to 20 --every 5
  volary export my.json -o my.jsonl.gz
  volary export my.jsonl -o - --as csv | head";

/// Arguments of `volary export`.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(super) struct ExportArguments {
    /// The trace, in any form that `volary run` writes
    trace: PathBuf,
    /// Write to this file: .csv, .xyz (extended XYZ, for OVITO),
    /// .jsonl, .ndjson or .json, also with .gz
    /// or .zst behind; - is standard output
    #[arg(short, long, value_name = "FILE")]
    out: PathBuf,
    /// Go by this ending instead of that of FILE, as in csv or jsonl.gz
    #[arg(long = "as", value_name = "ENDING")]
    ending: Option<String>,
    /// The table to write, in CSV; agents when absent
    #[arg(long, value_enum)]
    table: Option<TableName>,
    /// Leave out what was before this time
    #[arg(long, value_name = "TIME", value_parser = number, allow_negative_numbers = true)]
    from: Option<f64>,
    /// Leave out what came after this time
    #[arg(long, value_name = "TIME", value_parser = number, allow_negative_numbers = true)]
    to: Option<f64>,
    /// Take every Nth frame
    #[arg(long, value_name = "N", value_parser = every, allow_negative_numbers = true)]
    every: Option<NonZeroU64>,
    /// Overwrite a file that exists
    #[arg(long)]
    force: bool,
}

/// The tables.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum TableName {
    Agents,
    Metrics,
    Contacts,
    Edges,
    Links,
    Blocked,
    BetaAgents,
    Obstacles,
}

impl From<TableName> for Table {
    fn from(name: TableName) -> Self {
        match name {
            TableName::Agents => Self::Agents,
            TableName::Metrics => Self::Metrics,
            TableName::Contacts => Self::Contacts,
            TableName::Edges => Self::Edges,
            TableName::Links => Self::Links,
            TableName::Blocked => Self::Blocked,
            TableName::BetaAgents => Self::BetaAgents,
            TableName::Obstacles => Self::Obstacles,
        }
    }
}

fn every(text: &str) -> Result<NonZeroU64, String> {
    let problem = |_| format!("must be a whole number from 1 to {}", u64::MAX);
    text.parse().map_err(problem)
}

impl ExportArguments {
    /// What is asked for.
    fn export(&self) -> Result<Export, Refusal> {
        let (mut form, compression) = match &self.ending {
            Some(ending) => Form::of(Path::new(&format!(".{}", ending.trim_start_matches('.')))),
            None if self.to_standard_output() => {
                return Err(Refusal::bad_input(
                    "standard output has no ending; --as tells the form, as in --as csv",
                ));
            }
            None => Form::of(&self.out),
        }
        .map_err(Refusal::bad_input)?;
        match (&mut form, self.table) {
            (Form::Table(table), Some(name)) => *table = name.into(),
            (_, Some(_)) => {
                let problem = "--table is for .csv; other forms hold all that they can";
                return Err(Refusal::bad_input(problem));
            }
            (_, None) => {}
        }
        if let (Some(from), Some(to)) = (self.from, self.to)
            && from > to
        {
            let problem = format!("--from {from} lies behind --to {to}");
            return Err(Refusal::bad_input(problem));
        }
        Ok(Export {
            form,
            compression,
            selection: Selection {
                from: self.from,
                to: self.to,
                every: self.every,
            },
        })
    }

    fn to_standard_output(&self) -> bool {
        self.out == Path::new("-")
    }
}

/// Exports a trace.
pub(super) fn export(arguments: &ExportArguments, stop: &Stop) -> Result<(), Refusal> {
    let export = arguments.export()?;
    let (trace, out) = (&arguments.trace, &arguments.out);
    let to_file = !arguments.to_standard_output();
    files::apart(&[
        ("trace", Some(trace)),
        ("export", to_file.then_some(out.as_path())),
    ])?;
    let reader = TraceReader::open(trace).map_err(Refusal::bad_input)?;
    let stop = || stop.asked();
    let exported = match to_file {
        true => export.write(reader, out, arguments.force, stop),
        false => {
            let out = io::stdout().lock();
            match export.write_to(reader, out, "standard output", stop) {
                // A reader that has gone away, such as `head`.
                Err(ExportError::Trace(TraceError::Io { source, .. }))
                    if source.kind() == ErrorKind::BrokenPipe =>
                {
                    return Ok(());
                }
                exported => exported,
            }
        }
    }
    .map_err(refuse)?;
    let name = trace.display();
    if exported.truncated {
        note(format!(
            "{name} ends without its summary, for its run crashed or is not over, or the file \
             was cut; what is there was exported"
        ));
    }
    let selects = arguments.from.is_some() || arguments.to.is_some();
    if exported.frames == 0 && selects && export.form != Form::Table(Table::Contacts) {
        note(format!("{name} has no frame that was asked for"));
    }
    Ok(())
}

fn refuse(error: ExportError) -> Refusal {
    match error {
        ExportError::Stopped
        | ExportError::Trace(TraceError::Io {
            action: "read" | "write",
            ..
        }) => Refusal::failed(error),
        ExportError::Trace(error) => files::refuse(error),
        _ => Refusal::bad_input(error),
    }
}
