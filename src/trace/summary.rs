//! Summary files.

use std::path::Path;

use serde::Serialize;

use super::record::Summary;
use super::{TraceError, finite};
use crate::file;

/// Finds out whether a summary could be written to this file now, without changing
/// what is there: better before a run than after it.
pub fn check_summary(path: &Path, overwrite: bool) -> Result<(), TraceError> {
    Ok(file::check_whole(path, overwrite)?)
}

/// Writes a summary to a file of its own, as one JSON object. The file appears
/// whole or not at all; an existing one is refused without `overwrite`.
pub fn write_summary(path: &Path, summary: &Summary, overwrite: bool) -> Result<(), TraceError> {
    write_json(path, "the summary", summary, overwrite)
}

/// Writes what is one JSON object to a file of its own, whole or not at all; `what` is what
/// messages call it. An existing file is refused without `overwrite`.
pub(crate) fn write_json(
    path: &Path,
    what: &str,
    value: &impl Serialize,
    overwrite: bool,
) -> Result<(), TraceError> {
    let name = || path.display().to_string();
    finite::check(value).map_err(|flaw| TraceError::NotFinite {
        name: name(),
        record: what.to_owned(),
        problem: flaw.to_string(),
    })?;
    let mut text = serde_json::to_vec_pretty(value).map_err(|e| TraceError::Io {
        action: "write",
        name: name(),
        source: e.into(),
    })?;
    text.push(b'\n');
    Ok(file::write_whole(path, &text, overwrite)?)
}
