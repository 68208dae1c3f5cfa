//! `volary figures`: the papers' figures, made anew.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use volary::figure::{Entry, catalogue, check, make, sketches, steps, write};
use volary::picture::FileKind;
use volary::world::nearest_path;

use super::drive::Threads;
use super::progress::Progress;
use super::values::Page;
use super::{Refusal, files, print};

const EXAMPLES: &str = "\
Examples:
  volary figures --list
  volary figures out
  volary figures out --only olfati-saber-2003-4 --only song-2013 --format png

A name that ends before the number stands for all figures of that paper. All runs are taken
in their shipped worlds; all of them take some seconds to a minute.";

/// Arguments of `volary figures`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct FiguresArguments {
    /// The folder that the pictures go to, with the pages index.html and index.md
    #[arg(value_name = "OUTDIR", required_unless_present = "list")]
    folder: Option<PathBuf>,
    /// Make these alone: names of figures, or of papers for all of theirs; may be repeated
    #[arg(long, value_name = "ID")]
    only: Vec<String>,
    /// How pictures are written
    #[arg(long, value_enum, default_value_t = Form::Svg)]
    format: Form,
    /// The colours of the pictures
    #[arg(long, value_enum, default_value_t = Page::Light)]
    theme: Page,
    /// Print the names of the figures, with what the papers show, and make none
    #[arg(long, conflicts_with_all = ["folder", "force"])]
    list: bool,
    #[command(flatten)]
    threads: Threads,
    /// Overwrite files that exist
    #[arg(long)]
    force: bool,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// How pictures are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Form {
    /// Lines and letters that can be enlarged
    Svg,
    /// Pixels
    Png,
}

/// Makes figures and prints what they show, or lists them.
pub(super) fn figures(arguments: &FiguresArguments) -> Result<(), Refusal> {
    let entries = chosen(&arguments.only)?;
    let Some(folder) = &arguments.folder else {
        return print(&list(&entries));
    };
    let kind = match arguments.format {
        Form::Svg => FileKind::Svg,
        Form::Png => FileKind::Png,
    };
    let theme = arguments.theme.theme();
    check(folder, &entries, kind, arguments.force).map_err(files::refuse_file)?;
    let total = steps(&entries).map_err(Refusal::failed)?;
    let progress = Progress::of_runs(total, arguments.quiet);
    let made = arguments
        .threads
        .install(|| make(&entries, &theme, &|| progress.advance()).map_err(Refusal::failed));
    progress.finish();
    let made = made?;
    let page = write(folder, &made, kind, &theme, arguments.force).map_err(Refusal::failed)?;
    if arguments.quiet {
        return Ok(());
    }
    let mut text = String::new();
    for figure in &made {
        text += &entry(figure.id, figure.source, figure.caption);
        text += &format!("    Ours: {}\n", figure.finding);
    }
    print(&format!("{text}\nAll are shown in {}\n", page.display()))
}

/// The figures of these names, in the order of the catalogue; all, where there are no names.
fn chosen(names: &[String]) -> Result<Vec<Entry>, Refusal> {
    let all = catalogue();
    for name in names {
        if !all.iter().any(|entry| is_named(entry, name)) {
            return Err(unknown(&all, name));
        }
    }
    let asked = |entry: &Entry| names.is_empty() || names.iter().any(|it| is_named(entry, it));
    Ok(all.into_iter().filter(asked).collect())
}

/// Whether a name is that of the figure, or of its paper, or of its number in several versions.
fn is_named(entry: &Entry, name: &str) -> bool {
    let rest = entry.id.strip_prefix(name);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
}

fn unknown(all: &[Entry], name: &str) -> Refusal {
    let names: Vec<&str> = all.iter().map(|entry| entry.id).collect();
    let hint = match nearest_path(name, &names) {
        Some(near) => format!("did you mean {near}?"),
        None => "`volary figures --list` lists them".to_owned(),
    };
    Refusal::bad_input(format!("{name}: no figure or paper of that name; {hint}"))
}

fn list(entries: &[Entry]) -> String {
    let mut text = String::new();
    for it in entries {
        text += &entry(it.id, it.source, it.caption);
    }
    let sketches = sketches(entries.iter().map(|entry| entry.id));
    if !sketches.is_empty() {
        text += "\nSketches, which show no result:\n";
    }
    for sketch in sketches {
        text += &format!("    {}: {}\n", sketch.source, sketch.reason);
    }
    text
}

fn entry(id: &str, source: &str, caption: &str) -> String {
    format!("{id}\n    {source}\n    Paper: {caption}\n")
}
