//! Why a trace could not be exported.

use super::Form;
use crate::trace::TraceError;

/// Why a trace could not be exported. Each message names the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The trace cannot be read, or the export cannot be written.
    #[error(transparent)]
    Trace(#[from] TraceError),
    /// The file's name does not tell the form.
    #[error("{name}: the name of an export ends in {}", Form::ENDINGS)]
    UnknownForm {
        /// The file.
        name: String,
    },
    /// The trace holds nothing of a table.
    #[error("{name} records no {table}{hint}")]
    NotRecorded {
        /// The trace.
        name: String,
        /// The table.
        table: &'static str,
        /// What to do about it.
        hint: &'static str,
    },
    /// A record does not fit the header or the first frame, so it has no place in a table.
    #[error("{name}: {record} {problem}")]
    Uneven {
        /// The trace.
        name: String,
        /// The record.
        record: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// Someone stopped the export.
    #[error("stopped before the end of the trace")]
    Stopped,
}
