//! The files that a run writes, looked at before it starts.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use volary::checkpoint::{Checkpoint, CheckpointError};
use volary::file::FileError;
use volary::trace::{Format, TraceError, check_summary};

use super::Refusal;
use super::run::RunArguments;

/// Refuses, before anything is touched, files that cannot be written or that would
/// destroy one another or the world.
pub(super) fn check(arguments: &RunArguments) -> Result<(), Refusal> {
    let checkpoint = arguments.checkpoint.as_deref();
    let (trace, summary) = (arguments.trace.as_deref(), arguments.summary.as_deref());
    apart(&[
        ("world", Some(Path::new(&arguments.world))),
        ("trace", trace),
        ("summary", summary),
        ("checkpoint", checkpoint),
    ])?;
    if let Some(path) = trace {
        Format::of(path).map_err(refuse)?;
        if checkpoint.is_some() && path.exists() && !path.is_file() && !path.is_dir() {
            return Err(Refusal::bad_input(format!(
                "{}: a trace must be a regular file to go on from a checkpoint",
                path.display()
            )));
        }
    }
    if let Some(path) = summary {
        check_summary(path, arguments.force).map_err(refuse)?;
    }
    if let Some(path) = checkpoint {
        Checkpoint::check_writable(path, arguments.force).map_err(refuse_checkpoint)?;
    }
    Ok(())
}

/// Refuses files, each with what it is, of which two are the same; those further back
/// give way.
pub(super) fn apart(files: &[(&str, Option<&Path>)]) -> Result<(), Refusal> {
    let files: Vec<_> = files
        .iter()
        .filter_map(|(what, path)| Some((*what, (*path)?)))
        .collect();
    // Where each file lies, and which it is on the disk: what it was first called.
    let (mut places, mut linked) = (HashMap::new(), HashMap::new());
    for (order, (what, path)) in files.iter().enumerate() {
        let first = (order, *what);
        let by_place = *places.entry(place(path)).or_insert(first);
        let by_link = link(path).map(|link| *linked.entry(link).or_insert(first));
        let taken = [Some(by_place), by_link].into_iter().flatten().min();
        let name = path.display();
        match taken
            .filter(|(earlier, _)| *earlier != order)
            .map(|(_, other)| other)
        {
            None => {}
            Some("world") => {
                return Err(Refusal::bad_input(format!(
                    "{name}: the {what} would overwrite the world; give it another name"
                )));
            }
            Some(other) => {
                return Err(Refusal::bad_input(format!(
                    "{name}: {other} and {what} cannot share one file; give one of them \
                     another name"
                )));
            }
        }
    }
    Ok(())
}

/// As [`refuse`], for a checkpoint.
pub(super) fn refuse_checkpoint(error: CheckpointError) -> Refusal {
    match error {
        CheckpointError::File(error) => refuse_file(error),
        _ => Refusal::bad_input(error),
    }
}

/// A file that cannot be written where it was asked for is bad input.
pub(super) fn refuse(error: TraceError) -> Refusal {
    match error {
        TraceError::File(error) => refuse_file(error),
        _ => Refusal::bad_input(error),
    }
}

/// As [`refuse`], for any file.
pub(super) fn refuse_file(error: FileError) -> Refusal {
    match error {
        FileError::Exists { .. } => Refusal::bad_input(format!("{error}; --force overwrites it")),
        _ => Refusal::bad_input(error),
    }
}

/// The path from the root, so that it holds in any folder.
pub(super) fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// The path without links and dots, as far as it exists.
fn place(path: &Path) -> Option<PathBuf> {
    path.canonicalize().ok().or_else(|| {
        let parent = match path.parent()? {
            here if here.as_os_str().is_empty() => Path::new("."),
            parent => parent,
        };
        let parent = parent.canonicalize().unwrap_or_else(|_| parent.to_owned());
        Some(parent.join(path.file_name()?))
    })
}

/// What two names of one file on disk have in common.
#[cfg(unix)]
fn link(path: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    let data = path.metadata().ok()?;
    Some((data.dev(), data.ino()))
}

/// What two names of one file on disk have in common; not told apart here.
#[cfg(not(unix))]
fn link(_: &Path) -> Option<(u64, u64)> {
    None
}
