//! Writing a trace, record by record.

use std::fmt;
use std::io::{self, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::file::{Mark, TraceFile};
use super::format::{Compression, Format, Layout};
use super::record::{Partner, Record};
use super::sink::Sink;
use super::{TraceError, finite};

/// Compressed output is flushed when this much text waits in the compressor, so
/// that a crash costs little. Fixed by the amount of text alone, never by the
/// clock: the same run leaves the same bytes.
const FLUSH_EVERY: usize = 64 * 1024;

/// Writes a trace while it happens.
///
/// The header comes first, then frames and contacts, the summary last; the writer
/// keeps the order that it is given. A writer dropped before [`finish`] leaves a
/// trace whose records can all be read.
///
/// [`finish`]: TraceWriter::finish
pub struct TraceWriter<W: Write = TraceFile> {
    /// What errors call the trace.
    name: String,
    format: Format,
    /// Where the trace goes, until the first record opens the sink.
    target: Option<W>,
    sink: Option<Sink<W>>,
    /// Whether the trace can be taken up again at any of its records.
    resumable: bool,
    /// The text of one record, kept to save allocations.
    text: Vec<u8>,
    /// Bytes of text since the last flush.
    waiting: usize,
}

/// Where a resumable trace stands between two records: what its file holds so far, and
/// what will come next of the records written already.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TracePosition {
    format: Format,
    mark: Mark,
    /// Text of records that is not in the file yet: what is compressed comes in pieces.
    waiting: Vec<u8>,
}

impl TraceWriter {
    /// Creates the file of a trace; its name tells the [`Format`]. An existing file
    /// is refused, or with `overwrite` loses its contents to the first record.
    pub fn create(path: &Path, overwrite: bool) -> Result<Self, TraceError> {
        let format = Format::of(path)?;
        let file = TraceFile::open(path, overwrite)?;
        Ok(Self::named(path.display().to_string(), file, format))
    }

    /// As [`TraceWriter::create`], for a trace that can be taken up again after a crash:
    /// see [`TraceWriter::position`]. Where it is compressed, it is written as a sequence
    /// of gzip members or zstd frames rather than as one; readers join them. The bytes do
    /// not depend on whether, where and how often the trace is taken up again.
    pub fn create_resumable(path: &Path, overwrite: bool) -> Result<Self, TraceError> {
        let mut writer = Self::create(path, overwrite)?;
        if let Some(file) = &writer.target {
            file.lock(path)?;
        }
        writer.resumable = true;
        Ok(writer)
    }

    /// Goes on where a resumable trace stood, and takes away what its file holds beyond
    /// that with the next record. The format is the position's, whatever the file's name.
    ///
    /// # Errors
    /// [`TraceError::NotTheSame`] where the file does not hold what it held then.
    pub fn resume(path: &Path, position: &TracePosition) -> Result<Self, TraceError> {
        let TracePosition {
            format,
            mark,
            waiting,
        } = position;
        let file = TraceFile::reopen(path, mark)?;
        let mut writer = Self::named(path.display().to_string(), file, *format);
        writer.resumable = true;
        writer.waiting = waiting.len();
        if *mark != Mark::default()
            && let Some(file) = writer.target.take()
        {
            let sink = Sink::resumable(file, format.compression, waiting.clone());
            writer.sink = Some(sink);
        }
        Ok(writer)
    }

    /// Where the trace stands now. What the file holds up to there is safe on the disk
    /// when this returns.
    ///
    /// # Errors
    /// Where the disk fails, where an earlier record could not be written, and for
    /// compressed traces that were not made by [`TraceWriter::create_resumable`].
    pub fn position(&mut self) -> Result<TracePosition, TraceError> {
        let state = match (&self.sink, &self.target) {
            (Some(sink), _) => sink.state(),
            (None, target) => target.as_ref().map(|file| (file, &[][..])),
        };
        let Some((file, waiting)) = state else {
            return Err(TraceError::Io {
                action: "take up",
                name: self.name.clone(),
                source: io::Error::other("it is one compressed stream, or broken"),
            });
        };
        match file.mark() {
            Ok(mark) => Ok(TracePosition {
                format: self.format,
                mark,
                waiting: waiting.to_vec(),
            }),
            Err(e) => Err(self.failure(e)),
        }
    }
}

impl<W: Write> TraceWriter<W> {
    /// Writes a trace to any sink. Each record comes in one piece, so a plain file
    /// needs no buffer.
    pub fn new(target: W, format: Format) -> Self {
        Self::named("the trace".to_owned(), target, format)
    }

    /// As [`TraceWriter::new`], with a name for errors to call the trace by.
    pub(crate) fn named(name: String, target: W, format: Format) -> Self {
        Self {
            name,
            format,
            target: Some(target),
            sink: None,
            resumable: false,
            text: Vec::new(),
            waiting: 0,
        }
    }

    /// Writes one record. A record with a number that is not finite is refused as a
    /// whole; the trace can go on after that, but not after any other error.
    pub fn write(&mut self, record: &Record) -> Result<(), TraceError> {
        finite::check(record).map_err(|flaw| TraceError::NotFinite {
            name: self.name.clone(),
            record: describe(record),
            problem: flaw.to_string(),
        })?;
        self.text.clear();
        let first = self.sink.is_none();
        if self.format.layout == Layout::Array {
            self.text
                .extend_from_slice(if first { b"[\n" } else { b",\n" });
        }
        serde_json::to_writer(&mut self.text, record).map_err(|e| self.failure(e.into()))?;
        if self.format.layout == Layout::Lines {
            self.text.push(b'\n');
        }
        self.put().map_err(|e| self.failure(e))
    }

    /// Closes the trace, and reports what could not be written. Without this the
    /// trace is readable but not whole. A writer that was given no record leaves an
    /// existing file alone.
    pub fn finish(mut self) -> Result<(), TraceError> {
        if self.target.is_some() {
            return Ok(());
        }
        if self.format.layout == Layout::Array {
            self.text.clear();
            self.text.extend_from_slice(b"\n]\n");
            self.put().map_err(|e| self.failure(e))?;
        }
        let sink = self.sink.take().ok_or_else(broken);
        sink.and_then(Sink::finish)
            .map_err(|e| self.failure(e))
            .map(drop)
    }

    /// Hands on all that was written, as far as that can be done.
    pub(super) fn flush(&mut self) {
        if let Some(sink) = &mut self.sink {
            // Whatever fails fails again at the next record, which tells of it.
            let _ = sink.flush();
        }
    }

    /// Hands the text to the sink, which the first call opens.
    fn put(&mut self) -> io::Result<()> {
        if let Some(target) = self.target.take() {
            let compression = self.format.compression;
            self.sink = Some(match self.resumable {
                true => Sink::resumable(target, compression, Vec::new()),
                false => Sink::new(target, compression)?,
            });
            // The header alone already says what ran.
            self.waiting = FLUSH_EVERY;
        }
        let sink = self.sink.as_mut().ok_or_else(broken)?;
        sink.write_all(&self.text)?;
        self.waiting += self.text.len();
        if self.format.compression == Compression::None || self.waiting >= FLUSH_EVERY {
            self.waiting = 0;
            sink.flush()?;
        }
        Ok(())
    }

    /// Wraps an error of the sink, and closes it: it may hold part of a record, and
    /// a record behind that would be garbage.
    fn failure(&mut self, source: io::Error) -> TraceError {
        self.sink = None;
        TraceError::Io {
            action: "write",
            name: self.name.clone(),
            source,
        }
    }
}

impl<W: Write> Drop for TraceWriter<W> {
    fn drop(&mut self) {
        if let Some(sink) = &mut self.sink {
            // There is nobody left to tell; `finish` is for those who want to know.
            let _ = sink.flush();
        }
    }
}

impl<W: Write> fmt::Debug for TraceWriter<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TraceWriter")
            .field("name", &self.name)
            .field("format", &self.format)
            .finish_non_exhaustive()
    }
}

fn broken() -> io::Error {
    io::Error::other("nothing more can be written after an error")
}

/// What a record is called in errors.
fn describe(record: &Record) -> String {
    match record {
        Record::Header(_) => "the header".to_owned(),
        Record::Frame(frame) => format!("the frame at time {} (step {})", frame.time, frame.step),
        Record::Contact(contact) => {
            let partner = match contact.with {
                Partner::Agent => "agent",
                Partner::Obstacle => "obstacle",
            };
            format!(
                "the contact of agent {} with {partner} {} at time {}",
                contact.agent, contact.other, contact.begin
            )
        }
        Record::Summary(_) => "the summary".to_owned(),
    }
}
