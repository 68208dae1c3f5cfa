//! Where the files of a run stand.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::trace::TracePosition;

/// What a run writes, and how far it has come with it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recording {
    trace: Option<(OsString, TracePosition)>,
    summary: Option<OsString>,
    every: u64,
    complete: bool,
}

impl Recording {
    /// Of a run that makes a checkpoint each time it has taken so many steps.
    pub fn new(every: u64) -> Self {
        Self {
            trace: None,
            summary: None,
            every,
            complete: false,
        }
    }

    /// The same, with a trace that stands there.
    pub fn with_trace(mut self, path: &Path, position: TracePosition) -> Self {
        self.trace = Some((path.as_os_str().to_owned(), position));
        self
    }

    /// The same, with a summary that will be written to this file.
    pub fn with_summary(mut self, path: &Path) -> Self {
        self.summary = Some(path.as_os_str().to_owned());
        self
    }

    /// The same, of a run that reached its end and has written everything.
    pub fn completed(mut self) -> Self {
        self.complete = true;
        self
    }

    /// The trace's file, and where the trace stands.
    pub fn trace(&self) -> Option<(PathBuf, &TracePosition)> {
        let (path, position) = self.trace.as_ref()?;
        Some((path.into(), position))
    }

    /// The file of the summary.
    pub fn summary(&self) -> Option<PathBuf> {
        self.summary.as_ref().map(PathBuf::from)
    }

    /// Number of steps between checkpoints.
    pub fn every(&self) -> u64 {
        self.every
    }

    /// Whether the run reached its end and everything is written.
    pub fn complete(&self) -> bool {
        self.complete
    }
}
