//! Reports in files.

use std::path::Path;

use super::{html, markdown};
use crate::file::{FileError, check_whole, write_whole};
use crate::trace::{TraceError, write_json};
use crate::validate::report::Report;

/// The form that a file's name asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Json,
    Markdown,
    Html,
}

impl Form {
    fn of(path: &Path) -> Result<Self, FileError> {
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        match ending.to_str() {
            Some("json") => Ok(Self::Json),
            Some("md") => Ok(Self::Markdown),
            Some("html") => Ok(Self::Html),
            _ => Err(FileError::BadPath {
                name: path.display().to_string(),
                problem: "the name of a report ends in .json, .md or .html".to_owned(),
            }),
        }
    }
}

/// Finds out whether a report could be written to this file now, without changing what is
/// there: better before the runs than after them.
///
/// # Errors
///
/// As [`write()`].
pub fn check(path: &Path, overwrite: bool) -> Result<(), TraceError> {
    Form::of(path)?;
    Ok(check_whole(path, overwrite)?)
}

/// Writes a report to a file of its own, in the form that its name asks for: `.json`, `.md` or
/// `.html`. The file appears whole or not at all.
///
/// # Errors
///
/// [`FileError::BadPath`] for another ending; [`FileError::Exists`] for a file that is there
/// already, without `overwrite`; [`TraceError::NotFinite`] where JSON cannot hold a number of
/// the report; and what the system says.
pub fn write(path: &Path, report: &Report, overwrite: bool) -> Result<(), TraceError> {
    let text = match Form::of(path)? {
        Form::Json => return write_json(path, "the report", report, overwrite),
        Form::Markdown => markdown(report),
        Form::Html => html(report),
    };
    Ok(write_whole(path, text.as_bytes(), overwrite)?)
}
