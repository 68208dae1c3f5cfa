//! The files that a run writes, looked at before it starts.

use std::path::{Path, PathBuf};

use volary::trace::{Format, TraceError, check_summary};

use super::Refusal;
use super::run::RunArguments;

/// Refuses, before anything is touched, files that cannot be written or that would
/// destroy one another or the world.
pub(super) fn check(arguments: &RunArguments) -> Result<(), Refusal> {
    let world = Path::new(&arguments.world);
    let (trace, summary) = (arguments.trace.as_deref(), arguments.summary.as_deref());
    for (what, path) in [("trace", trace), ("summary", summary)] {
        if let Some(path) = path.filter(|path| same(path, world)) {
            let name = path.display();
            return Err(Refusal::bad_input(format!(
                "{name}: the {what} would overwrite the world; give it another name"
            )));
        }
    }
    if let (Some(trace), Some(summary)) = (trace, summary)
        && same(trace, summary)
    {
        return Err(Refusal::bad_input(format!(
            "{}: trace and summary cannot share one file; give one of them another name",
            summary.display()
        )));
    }
    if let Some(path) = trace {
        Format::of(path).map_err(refuse)?;
    }
    match summary {
        Some(path) => check_summary(path, arguments.force).map_err(refuse),
        None => Ok(()),
    }
}

/// A file that cannot be written where it was asked for is bad input.
pub(super) fn refuse(error: TraceError) -> Refusal {
    match error {
        TraceError::Exists { .. } => Refusal::bad_input(format!("{error}; --force overwrites it")),
        _ => Refusal::bad_input(error),
    }
}

/// Whether two paths name one file, which need not be there yet.
fn same(a: &Path, b: &Path) -> bool {
    place(a) == place(b) || linked(a, b)
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

/// Whether two names stand for one file on disk.
#[cfg(unix)]
fn linked(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (a.metadata(), b.metadata()) {
        (Ok(a), Ok(b)) => (a.dev(), a.ino()) == (b.dev(), b.ino()),
        _ => false,
    }
}

/// Whether two names stand for one file on disk; not told apart here.
#[cfg(not(unix))]
fn linked(_: &Path, _: &Path) -> bool {
    false
}
