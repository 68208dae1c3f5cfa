//! `volary plot`: quantities along traces, drawn.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use volary::file::check_whole;
use volary::picture::{FileKind, PictureError, Theme};
use volary::plot::{Kind, Plot, Sheet};
use volary::series::{
    Extent, Listing, Motion, OverTime, Probe, Quantity, Reading, Run, SeriesError, Span, agents_of,
    component_probes, components, demand, drop_undefined, over_time, trajectories,
    trajectory_probes,
};

use super::progress::Progress;
use super::values::{Page, number, size};
use super::{Refusal, files, note, print};

const EXAMPLES: &str = "\
Examples:
  volary plot run.jsonl -o run.svg
  volary plot run.jsonl --list
  volary plot run.jsonl -o density.png --metric density --metric agent_gap
  volary plot a.jsonl b.jsonl -o energies.svg --metric laws.energy --log y
  volary plot run.jsonl -o paths.svg --trajectories --agents 0-6
  volary plot run.jsonl -o velocities.svg --components velocities --theme dark

A metric is a path in a frame of the trace, such as metrics.density or
laws.laws[0].position_error; metrics., laws. and net. may be left out. d_X, d_V, mean_speed,
target_error and, of balls, agent_gap are there whether recorded or not.";

/// Arguments of `volary plot`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct PlotArguments {
    /// Traces; several are drawn on the same axes
    #[arg(required = true, value_name = "TRACE")]
    traces: Vec<PathBuf>,
    /// The file to write: .svg or .png
    #[arg(short, long, value_name = "FILE", required_unless_present = "list")]
    out: Option<PathBuf>,
    /// Something recorded, over time; may be repeated, for a plot each. Diameters of positions
    /// and velocities and the smallest gap where nothing is asked for
    #[arg(long, value_name = "NAME", value_parser = metric)]
    metric: Vec<String>,
    /// Put all metrics on the same axes
    #[arg(long, requires = "metric")]
    together: bool,
    /// Where agents go: position space and velocity space
    #[arg(long, conflicts_with_all = ["metric", "components"])]
    trajectories: bool,
    /// Each component of positions or velocities over time
    #[arg(long, value_enum, conflicts_with = "metric")]
    components: Option<States>,
    /// The agents to draw, as in 0,2,5-9; all when absent
    #[arg(long, value_name = "LIST", value_parser = list)]
    agents: Option<List>,
    /// List what the traces record instead of drawing it
    #[arg(long, conflicts_with_all = ["out", "metric", "trajectories", "components"])]
    list: bool,
    /// A line across, to compare with; may be repeated
    #[arg(
        long,
        value_name = "VALUE[=NAME]",
        value_parser = level,
        allow_negative_numbers = true
    )]
    level: Vec<Level>,
    /// Logarithmic axes; when absent, that of metrics is where they differ by more than a
    /// thousand times
    #[arg(long, value_enum, value_name = "AXES")]
    log: Option<Logarithmic>,
    /// First time to show
    #[arg(long, value_name = "TIME", value_parser = number, allow_negative_numbers = true)]
    from: Option<f64>,
    /// Last time to show
    #[arg(long, value_name = "TIME", value_parser = number, allow_negative_numbers = true)]
    to: Option<f64>,
    /// Width and height in pixels, as in 800x500
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    size: Option<[f64; 2]>,
    /// Colours
    #[arg(long, value_enum, default_value_t = Page::Light)]
    theme: Page,
    /// What stands above; the name of the world when absent
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// Overwrite a file that exists
    #[arg(long)]
    force: bool,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Positions or velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum States {
    /// Where agents are
    Positions,
    /// How they move
    Velocities,
}

/// Axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Logarithmic {
    /// The axis of time
    X,
    /// That of metrics
    Y,
    /// Both
    Xy,
    /// None of them
    None,
}

/// Agents, by index.
#[derive(Debug, Clone)]
struct List(Vec<usize>);

/// A value, and what it is called.
#[derive(Debug, Clone)]
struct Level(f64, Option<String>);

fn metric(text: &str) -> Result<String, String> {
    match text.trim() {
        "" => Err("a metric needs a name".to_owned()),
        name => Ok(name.to_owned()),
    }
}

fn level(text: &str) -> Result<Level, String> {
    match text.split_once('=') {
        Some((value, name)) => Ok(Level(number(value)?, Some(name.to_owned()))),
        None => Ok(Level(number(text)?, None)),
    }
}

/// Agents that can be asked for, repetitions counted.
const MOST_AGENTS: usize = 1_000_000;

fn list(text: &str) -> Result<List, String> {
    let problem = || "must be indices and ranges, as in 0,2,5-9".to_owned();
    let index = |text: &str| text.trim().parse::<usize>().map_err(|_| problem());
    let mut agents = Vec::new();
    for part in text.split(',') {
        let (first, last) = match part.split_once('-') {
            Some((first, last)) => (index(first)?, index(last)?),
            None => (index(part)?, index(part)?),
        };
        if first > last {
            return Err(problem());
        }
        // More than any trace holds would only fill the memory.
        if last - first >= MOST_AGENTS - agents.len().min(MOST_AGENTS) {
            return Err(format!("must be at most {MOST_AGENTS} agents"));
        }
        agents.extend(first..=last);
    }
    agents.sort_unstable();
    agents.dedup();
    Ok(List(agents))
}

/// Draws what was asked for, or lists what there is.
pub(super) fn plot(arguments: &PlotArguments) -> Result<(), Refusal> {
    let Some(out) = &arguments.out else {
        return list_all(arguments);
    };
    check_files(arguments, out)?;
    if let (Some(from), Some(to)) = (arguments.from, arguments.to)
        && from >= to
    {
        return Err(Refusal::bad_input(format!(
            "--from {from} is not before --to {to}"
        )));
    }
    let theme = arguments.theme.theme();
    let (runs, plots, columns) = plots(arguments, &theme)?;
    let rows = plots.len().div_ceil(columns);
    let several = plots.len() > 1;
    let sheet = Sheet {
        title: arguments.title.clone().unwrap_or_else(|| title(&runs)),
        letters: several && columns > 1,
        shared_x: several && columns == 1,
        columns,
        plots,
    };
    let size = match arguments.size {
        Some(size) => size,
        None if columns > 1 => [80.0 + 440.0 * columns as f64, 40.0 + 440.0 * rows as f64],
        None => [860.0, 160.0 + 220.0 * rows as f64],
    };
    if arguments.size.is_some() && !sheet.has_room(size) {
        let [width, height] = size;
        return Err(Refusal::bad_input(format!(
            "--size leaves no room for {} between axes and words on {width} x {height} pixels",
            if several { "the plots" } else { "the plot" },
        )));
    }
    let picture = sheet.draw(size, &theme);
    picture.write(out, arguments.force).map_err(refuse_picture)
}

/// What was read, the plots, and how many of them stand side by side.
fn plots(
    arguments: &PlotArguments,
    theme: &Theme,
) -> Result<(Vec<Run>, Vec<Plot>, usize), Refusal> {
    let readings = arguments.traces.iter().map(|path| Reading::open(path));
    let readings: Vec<Reading> = readings.collect::<Result<_, _>>().map_err(refuse)?;
    let dimension = readings[0].header().world.dimension;
    if arguments.trajectories || arguments.components.is_some() {
        if arguments.log.is_some_and(|it| it != Logarithmic::None) {
            return Err(Refusal::bad_input("--log is for metrics"));
        }
        if !arguments.level.is_empty() {
            return Err(Refusal::bad_input("--level is for metrics"));
        }
        let other = readings
            .iter()
            .find(|it| it.header().world.dimension != dimension);
        if let Some(other) = other {
            let (first, own) = (readings[0].name(), other.header().world.dimension);
            return Err(Refusal::bad_input(format!(
                "{} has {own} dimensions, {first} has {dimension}: draw them one by one",
                other.name()
            )));
        }
        return states(arguments, readings, dimension, theme);
    }
    if arguments.agents.is_some() {
        return Err(Refusal::bad_input(
            "--agents is for --trajectories and --components",
        ));
    }
    let mut quantities: Vec<Quantity> = match arguments.metric.is_empty() {
        false => arguments.metric.iter().map(Quantity::new).collect(),
        true => {
            let pairs = readings
                .iter()
                .all(|it| it.header().bodies.radius.len() > 1);
            let names: &[&str] = match pairs {
                true => &["d_X", "d_V", "agent_gap"],
                false => &["mean_speed"],
            };
            names.iter().map(|name| Quantity::new(*name)).collect()
        }
    };
    let probes: Vec<Probe> = quantities.iter().cloned().map(Probe::Quantity).collect();
    let runs = readings.into_iter().map(|it| keep(it, &probes, arguments));
    let mut runs: Vec<Run> = runs.collect::<Result<_, _>>()?;
    match arguments.metric.is_empty() {
        true => drop_undefined(&mut runs, &mut quantities),
        false => demand(&runs, &quantities),
    }
    .map_err(refuse)?;
    let kind = |forced: [Logarithmic; 2]| match arguments.log {
        Some(log) if forced.contains(&log) => Kind::Logarithmic,
        Some(_) => Kind::Linear,
        None => Kind::Auto,
    };
    let how = OverTime {
        together: arguments.together,
        time: kind([Logarithmic::X, Logarithmic::Xy]),
        values: kind([Logarithmic::Y, Logarithmic::Xy]),
        levels: arguments
            .level
            .iter()
            .map(|Level(value, name)| (*value, name.clone()))
            .collect(),
        to: arguments.to,
    };
    let plots = over_time(&runs, &quantities, &how, theme).map_err(refuse)?;
    Ok((runs, plots, 1))
}

/// Plots of positions and velocities.
fn states(
    arguments: &PlotArguments,
    readings: Vec<Reading>,
    dimension: usize,
    theme: &Theme,
) -> Result<(Vec<Run>, Vec<Plot>, usize), Refusal> {
    let motion = arguments.components.map(|states| match states {
        States::Positions => Motion::Positions,
        States::Velocities => Motion::Velocities,
    });
    let (mut runs, mut chosen) = (Vec::new(), Vec::new());
    for reading in readings {
        let count = reading.header().bodies.radius.len();
        let asked = arguments.agents.as_ref().map(|list| list.0.as_slice());
        let agents = agents_of(reading.name(), count, asked).map_err(refuse)?;
        let probes = match motion {
            Some(motion) => component_probes(dimension, motion, &agents),
            None => trajectory_probes(dimension, &agents),
        };
        runs.push(keep(reading, &probes, arguments)?);
        chosen.push(agents);
    }
    let plots = match motion {
        Some(motion) => components(&runs, motion, &chosen, theme),
        None => trajectories(&runs, &chosen, theme),
    };
    let columns = match motion {
        Some(_) => 1,
        None => plots.len().min(dimension),
    };
    Ok((runs, plots, columns))
}

/// Reads a trace, with a bar for who watches, and tells where it was cut.
fn keep(reading: Reading, probes: &[Probe], arguments: &PlotArguments) -> Result<Run, Refusal> {
    let span = Span {
        from: arguments.from,
        to: arguments.to,
    };
    let bar = bar(&reading, arguments.quiet);
    let run = reading.keep(probes, span, |steps| bar.show(steps));
    bar.finish();
    let run = run.map_err(refuse)?;
    if run.truncated && !arguments.quiet {
        let (name, end) = (&run.name, run.times[1]);
        note(format!(
            "{name}: the trace ends at t = {end}, without its summary"
        ));
    }
    Ok(run)
}

fn bar(reading: &Reading, quiet: bool) -> Progress {
    let time = &reading.header().world.time;
    Progress::new((time.end / time.step) as u64, time.step, quiet)
}

/// The world's name, where all runs have the same.
fn title(runs: &[Run]) -> String {
    let name = &runs[0].header.name;
    match runs.iter().all(|run| run.header.name == *name) {
        true => name.clone(),
        false => String::new(),
    }
}

fn refuse(error: SeriesError) -> Refusal {
    match error {
        SeriesError::Trace(error) => files::refuse(error),
        _ => Refusal::bad_input(error),
    }
}

fn refuse_picture(error: PictureError) -> Refusal {
    match error {
        PictureError::File(error) => files::refuse_file(error),
        _ => Refusal::bad_input(error),
    }
}

/// Refuses, before anything is read, a file that cannot be written.
fn check_files(arguments: &PlotArguments, out: &Path) -> Result<(), Refusal> {
    let traces = arguments.traces.iter();
    let traces = traces.map(|path| ("trace", Some(path.as_path())));
    // Which traces there are is up to whoever names them, twice the same included.
    for trace in traces {
        files::apart(&[trace, ("plot", Some(out))])?;
    }
    if FileKind::of(out).map_err(refuse_picture)?.is_film() {
        let name = out.display().to_string();
        return Err(refuse_picture(PictureError::Film { name }));
    }
    check_whole(out, arguments.force).map_err(files::refuse_file)
}

/// Prints what the traces record.
fn list_all(arguments: &PlotArguments) -> Result<(), Refusal> {
    for path in &arguments.traces {
        let reading = Reading::open(path).map_err(refuse)?;
        let bar = bar(&reading, arguments.quiet);
        let listing = reading.list(|steps| bar.show(steps));
        bar.finish();
        let listing = listing.map_err(refuse)?;
        print(&table(&path.display().to_string(), &listing))?;
    }
    Ok(())
}

fn table(name: &str, listing: &Listing) -> String {
    let cut = if listing.truncated { ", cut" } else { "" };
    let mut text = format!("{name}: {} frames{cut}\n", listing.frames);
    let all = || listing.recorded.iter().chain(&listing.derived);
    let width = all().map(|(name, _)| name.len()).max().unwrap_or(0);
    for (what, extents) in [
        ("recorded", &listing.recorded),
        (
            "follows from positions, velocities and the world",
            &listing.derived,
        ),
    ] {
        if extents.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{what}");
        for (name, extent) in extents {
            let _ = writeln!(text, "  {name:<width$}  {}", range(extent, listing.frames));
        }
    }
    text
}

fn range(extent: &Extent, frames: u64) -> String {
    match extent.frames {
        some if some == frames || some == 0 => extent.to_string(),
        some => format!("{extent}, in {some} frames"),
    }
}
