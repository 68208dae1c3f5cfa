//! Traces as tables and in the formats of other tools.
//!
//! [`Form::of`] tells by a file's name what a trace becomes: a table in CSV, extended XYZ, or a
//! trace in the other layout. Each may be compressed. Records are taken one by one, so that a
//! trace may be larger than the memory. Units are those of the world, angles are radians.
//!
//! # Tables
//!
//! A line of names, then rows. Numbers have the fewest digits that read back bit for bit; what a
//! world or state does not define is empty. Agents and obstacles are numbered as in the header,
//! from 0. Which columns there are depends on what the first selected frame records, never on values.
//!
//! | [`Table`] | a row for | columns |
//! |---|---|---|
//! | `Agents` | frame and agent | `time step agent group`, position `x y z`, velocity `vx vy vz`; where bodies can turn `angle` in 2-D, the rotation vector `rx ry rz` in 3-D; where recorded `acceleration.LAW.x`, `.y`, `.z` of each law, before the actuator limit |
//! | `Metrics` | frame | `time step`, then in alphabetical order what was recorded: `metrics.*`, `net.*`, `laws.*`, and `laws.LAW.*` of each law; vectors as `.x`, `.y`, `.z` |
//! | `Contacts` | episode | `agent with other begin end open steps blow blows impulse largest_impulse mean_force friction deepest_penetration approach_speed push_speed`, and the agent's position `x y z` when they began to touch |
//! | `Edges`, `Links`, `Blocked` | frame and pair | `time step agent other`; of links and lines of sight the agent is the one that looks |
//! | `BetaAgents` | frame and β-agent | `time step agent obstacle part`, position `x y z`, velocity `vx vy vz`, `distance` |
//! | `Obstacles` | frame and moving obstacle | `time step obstacle`, position `x y z`, and `angle` or `rx ry rz` |
//!
//! In 2-D there is no `z`. A second law of the same name is `LAW_2`, a group without a name
//! `group_0`, by its place in the world. What the columns mean is told where the record's fields
//! are: [`Frame`], [`Metrics`], [`NetRecord`], [`LawsRecord`], [`Contact`].
//!
//! # Extended XYZ
//!
//! For each frame the number of agents, a line with `Properties`, `Time`, `Step` and `pbc`, and a
//! line for each agent: `species`, its group as one word; `pos` and `velo`, with z = 0 in 2-D;
//! `id`, the agent; `radius`, of the ball that holds the body; `mass`; and `orientation`, a
//! quaternion x, y, z, w, where bodies can turn. Obstacles, contacts and metrics have no place in
//! it, and bodies that are not round show by orientation and radius only.
//!
//! # Traces
//!
//! The same records in the same order, in the bytes that a run writes. Of a selection the header
//! and the summary stay as they are: the summary is that of the whole run.
//!
//! [`Frame`]: crate::trace::record::Frame
//! [`Metrics`]: crate::trace::record::Metrics
//! [`NetRecord`]: crate::trace::record::NetRecord
//! [`LawsRecord`]: crate::trace::record::LawsRecord
//! [`Contact`]: crate::trace::record::Contact

mod cast;
mod error;
mod form;
mod selection;
mod table;
mod xyz;

pub use error::ExportError;
pub use form::{Form, Table};
pub use selection::Selection;

use std::io::Write;
use std::path::Path;

use crate::file::WholeFile;
use crate::trace::{Compression, Format, Record, Sink, TraceError, TraceReader, TraceWriter};
use cast::Cast;
use selection::Selecting;
use table::TableWriter;
use xyz::XyzWriter;

/// What is wanted of a trace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Export {
    /// What it becomes.
    pub form: Form,
    /// How that is compressed.
    pub compression: Compression,
    /// Which part of it.
    pub selection: Selection,
}

/// What came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Exported {
    /// The frames that were selected.
    pub frames: u64,
    /// Whether the trace ended without its summary.
    pub truncated: bool,
}

impl Export {
    /// Exports a trace to a file, which appears whole or not at all; an existing one is refused
    /// without `overwrite`. Where `stop` says so between two records, there is no file.
    ///
    /// # Errors
    /// Where the trace cannot be read or does not hold what is asked for, or the file cannot be
    /// written.
    pub fn write(
        &self,
        trace: TraceReader,
        path: &Path,
        overwrite: bool,
        stop: impl Fn() -> bool,
    ) -> Result<Exported, ExportError> {
        let mut file = WholeFile::create(path, overwrite).map_err(TraceError::from)?;
        let name = path.display().to_string();
        let exported = self.write_to(trace, &mut file, &name, stop)?;
        file.finish().map_err(TraceError::from)?;
        Ok(exported)
    }

    /// Exports a trace to any sink, which errors call by its `name`.
    ///
    /// # Errors
    /// As [`Export::write`].
    pub fn write_to(
        &self,
        mut trace: TraceReader,
        target: impl Write,
        name: &str,
        stop: impl Fn() -> bool,
    ) -> Result<Exported, ExportError> {
        let header = trace.header().clone();
        let mut selecting = Selecting::new(&self.selection, header.world.time.step);
        let mut output = self.output(&trace, target, name)?;
        let mut exported = Exported::default();
        output.write(&Record::Header(Box::new(header)))?;
        for record in &mut trace {
            let record = record?;
            if stop() {
                return Err(ExportError::Stopped);
            }
            if selecting.takes(&record) {
                exported.frames += u64::from(matches!(record, Record::Frame(_)));
                output.write(&record)?;
            }
        }
        exported.truncated = trace.truncated();
        output.finish()?;
        Ok(exported)
    }

    fn output<W: Write>(
        &self,
        trace: &TraceReader,
        target: W,
        name: &str,
    ) -> Result<Output<W>, ExportError> {
        let compression = self.compression;
        let cast = || Cast::new(trace.name(), trace.header());
        let writer = match self.form {
            Form::Trace(layout) => {
                let format = Format {
                    layout,
                    compression,
                };
                let writer = TraceWriter::named(name.to_owned(), target, format);
                return Ok(Output::Trace(writer));
            }
            Form::Table(table) => TextWriter::Table(TableWriter::new(table, cast()?)),
            Form::Xyz => TextWriter::Xyz(XyzWriter::new(cast()?)),
        };
        let sink = Sink::new(target, compression);
        Ok(Output::Text {
            sink: sink.map_err(|source| cannot_write(name, source))?,
            writer,
            name: name.to_owned(),
            text: Vec::new(),
        })
    }
}

/// Where records go.
enum Output<W: Write> {
    Trace(TraceWriter<W>),
    Text {
        sink: Sink<W>,
        writer: TextWriter,
        /// What errors call it.
        name: String,
        /// The text of one record, kept to save allocations.
        text: Vec<u8>,
    },
}

/// What turns records into text.
enum TextWriter {
    Table(TableWriter),
    Xyz(XyzWriter),
}

impl<W: Write> Output<W> {
    fn write(&mut self, record: &Record) -> Result<(), ExportError> {
        match self {
            Self::Trace(trace) => Ok(trace.write(record)?),
            Self::Text {
                sink,
                writer,
                name,
                text,
            } => {
                text.clear();
                match (writer, record) {
                    (TextWriter::Table(table), _) => table.write(record, text)?,
                    (TextWriter::Xyz(xyz), Record::Frame(frame)) => {
                        xyz.cast().check(frame)?;
                        xyz.write(frame, text);
                    }
                    _ => {}
                }
                let written = sink.write_all(text);
                Ok(written.map_err(|source| cannot_write(name, source))?)
            }
        }
    }

    fn finish(self) -> Result<(), ExportError> {
        match self {
            Self::Trace(trace) => Ok(trace.finish()?),
            Self::Text {
                mut sink,
                writer,
                name,
                mut text,
            } => {
                text.clear();
                if let TextWriter::Table(mut table) = writer {
                    table.finish(&mut text);
                }
                let finished = sink.write_all(&text).and_then(|()| sink.finish());
                finished.map_err(|source| cannot_write(&name, source))?;
                Ok(())
            }
        }
    }
}

fn cannot_write(name: &str, source: std::io::Error) -> TraceError {
    TraceError::Io {
        action: "write",
        name: name.to_owned(),
        source,
    }
}

#[cfg(test)]
mod tests;
