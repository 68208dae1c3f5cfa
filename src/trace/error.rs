//! What can go wrong with a trace.

use std::io;

use super::format::Format;
use super::record::{FORMAT, VERSION};
use crate::file::FileError;

/// Why a trace or a summary could not be written or read. Each message names the
/// file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TraceError {
    /// The file's name does not tell the format.
    #[error("{name}: the name of a trace ends in {}", Format::ENDINGS)]
    UnknownFormat {
        /// The file.
        name: String,
    },
    /// The file must not be overwritten, or its path is unfit.
    #[error(transparent)]
    File(FileError),
    /// The file could not be created, written, opened or read.
    #[error("cannot {action} {name}: {source}")]
    Io {
        /// What was tried: "create", "write", "open", "read" or "take up".
        action: &'static str,
        /// The file.
        name: String,
        /// What the system says.
        source: io::Error,
    },
    /// Another run is writing the file.
    #[error("{name} is being written by another run")]
    InUse {
        /// The file.
        name: String,
    },
    /// The trace to go on with is not what it was.
    #[error("{name} is not the trace that was being written: {problem}")]
    NotTheSame {
        /// The file.
        name: String,
        /// What is different.
        problem: String,
    },
    /// A record holds a number that JSON cannot hold; nothing of it was written.
    #[error("{name}: {record} cannot be written: {problem}")]
    NotFinite {
        /// The file.
        name: String,
        /// The record.
        record: String,
        /// The field and its value.
        problem: String,
    },
    /// The file is something else, or too short to tell.
    #[error("{name} is not a trace: {found}")]
    NotATrace {
        /// The file.
        name: String,
        /// What is there instead.
        found: String,
    },
    /// The header names another format.
    #[error("{name} is not a trace: its format is {found}, not \"{}\"", FORMAT)]
    Format {
        /// The file.
        name: String,
        /// The format's name, as JSON.
        found: String,
    },
    /// The trace has a version that this program cannot read.
    #[error(
        "{name} has version {found} of the trace format; only version {} is supported",
        VERSION
    )]
    Version {
        /// The file.
        name: String,
        /// The trace's version, as JSON.
        found: String,
    },
    /// A line is whole, but not a record that may stand there.
    #[error("{name}, line {line}: {problem}")]
    BadRecord {
        /// The file.
        name: String,
        /// Line of the (uncompressed) file, counted from 1.
        line: u64,
        /// What is wrong with it.
        problem: String,
    },
}

impl From<FileError> for TraceError {
    fn from(error: FileError) -> Self {
        match error {
            // What the system says comes in one way, whether of a path or of what is inside.
            FileError::Io {
                action,
                name,
                source,
            } => Self::Io {
                action,
                name,
                source,
            },
            error => Self::File(error),
        }
    }
}
