//! Reading a trace, record by record.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, ErrorKind, Read};
use std::iter::FusedIterator;
use std::path::Path;

use flate2::read::MultiGzDecoder;
use serde::Deserialize;
use serde_json::Value;
use serde_json::error::Category;
use zstd::stream::read::Decoder as ZstdDecoder;

use super::TraceError;
use super::format::Layout;
use super::record::{FORMAT, Header, Record, VERSION};
use super::split::{Fault, Piece, Splitter};
use crate::file;

/// Reads a trace as a stream: the header when it is opened, then an iterator over
/// the records behind it.
///
/// A trace may end anywhere, inside a record or inside the compressed stream: every
/// whole record is read, and then the iterator ends. A record is whole when its
/// last brace is there, with or without the end of the line. Whole text that is no
/// record is an error, and the iterator ends behind it.
///
/// Compression and layout are told by the contents, never by the name.
pub struct TraceReader {
    name: String,
    pieces: Splitter<Box<dyn BufRead + Send>>,
    header: Header,
    /// Whether the summary was read.
    complete: bool,
    /// Whether there is nothing more to read.
    ended: bool,
}

impl TraceReader {
    /// Opens a trace and reads its header.
    pub fn open(path: &Path) -> Result<Self, TraceError> {
        let file = File::open(path).map_err(|e| file::explain(path, "open", e))?;
        if path.is_dir() {
            return Err(file::explain(path, "open", ErrorKind::IsADirectory.into()).into());
        }
        Self::new(file, path.display().to_string())
    }

    /// Reads a trace from any source, and its header at once. Errors call the
    /// source by its `name`.
    pub fn new(source: impl Read + Send + 'static, name: String) -> Result<Self, TraceError> {
        let mut input = match decompress(source) {
            Ok(input) => input,
            Err(source) => return Err(cannot_read(&name, source)),
        };
        let layout = match input.fill_buf() {
            Ok([b'[', ..]) => Layout::Array,
            Ok([b'{' | b' ' | b'\t' | b'\r' | b'\n', ..]) => Layout::Lines,
            Ok([]) => return Err(not_a_trace(name, "it holds no data")),
            Ok(_) => return Err(not_a_trace(name, "it does not begin with a JSON object")),
            Err(source) => return Err(cannot_read(&name, source)),
        };
        let mut pieces = Splitter::new(input, layout);
        let header = match pieces.next() {
            Ok(Some(piece)) => read_header(&name, &piece)?,
            Ok(None) => return Err(not_a_trace(name, "it holds no records")),
            Err(Fault::Io(source)) => return Err(cannot_read(&name, source)),
            Err(Fault::Stray { problem, .. }) => return Err(not_a_trace(name, &problem)),
        };
        Ok(Self {
            name,
            pieces,
            header,
            complete: false,
            ended: false,
        })
    }

    /// What errors call the trace: its path, where it is a file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The header.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Whether the trace ends without its summary: its run crashed or is still
    /// going on, or the file was cut. Known when the iterator has ended.
    pub fn truncated(&self) -> bool {
        self.ended && !self.complete
    }

    fn read(&mut self) -> Result<Option<Record>, TraceError> {
        let name = &self.name;
        let piece = match self.pieces.next() {
            Ok(Some(piece)) => piece,
            Ok(None) => return Ok(None),
            Err(Fault::Io(source)) => return Err(cannot_read(name, source)),
            Err(Fault::Stray { line, problem }) => return Err(bad_record(name, line, problem)),
        };
        let problem = match serde_json::from_slice(piece.text) {
            Err(e) if !piece.closed && e.classify() != Category::Data => return Ok(None),
            Err(e) => explain(&e),
            Ok(_) if self.complete => "the trace goes on behind its summary".to_owned(),
            Ok(Record::Header(_)) => "a second header".to_owned(),
            Ok(record) => {
                self.complete = matches!(record, Record::Summary(_));
                return Ok(Some(record));
            }
        };
        Err(bad_record(name, piece.line, problem))
    }
}

impl Iterator for TraceReader {
    type Item = Result<Record, TraceError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let record = self.read().transpose();
        self.ended = !matches!(record, Some(Ok(_)));
        record
    }
}

impl FusedIterator for TraceReader {}

impl std::fmt::Debug for TraceReader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TraceReader")
            .field("name", &self.name)
            .field("header", &self.header)
            .finish_non_exhaustive()
    }
}

/// What makes a record a header; read before the rest, which other versions may
/// hold in other shapes.
#[derive(Deserialize)]
struct Claim {
    record: Value,
    format: Value,
    version: Value,
}

fn read_header(name: &str, piece: &Piece<'_>) -> Result<Header, TraceError> {
    let claim: Claim = match serde_json::from_slice(piece.text) {
        Ok(claim) => claim,
        Err(e) if e.is_eof() && !piece.closed => {
            return Err(not_a_trace(
                name.to_owned(),
                "it ends inside its first record",
            ));
        }
        Err(_) => {
            let found = "its first record is no header, which has record, format and version";
            return Err(not_a_trace(name.to_owned(), found));
        }
    };
    if claim.format != FORMAT {
        return Err(TraceError::Format {
            name: name.to_owned(),
            found: claim.format.to_string(),
        });
    }
    if claim.version != VERSION {
        return Err(TraceError::Version {
            name: name.to_owned(),
            found: claim.version.to_string(),
        });
    }
    if claim.record != "header" {
        return Err(not_a_trace(
            name.to_owned(),
            "its first record is no header",
        ));
    }
    serde_json::from_slice(piece.text).map_err(|e| bad_record(name, piece.line, explain(&e)))
}

/// serde_json's message without the line, which it counts from the record's start.
fn explain(e: &serde_json::Error) -> String {
    let message = e.to_string();
    let short = message.split(" at line ").next().unwrap_or_default();
    format!("not a trace record: {short}")
}

fn not_a_trace(name: String, found: &str) -> TraceError {
    TraceError::NotATrace {
        name,
        found: found.to_owned(),
    }
}

fn bad_record(name: &str, line: u64, problem: String) -> TraceError {
    TraceError::BadRecord {
        name: name.to_owned(),
        line,
        problem,
    }
}

fn cannot_read(name: &str, source: io::Error) -> TraceError {
    TraceError::Io {
        action: "read",
        name: name.to_owned(),
        source,
    }
}

/// Finds out by the first bytes how a source is compressed.
fn decompress(mut source: impl Read + Send + 'static) -> io::Result<Box<dyn BufRead + Send>> {
    let mut magic = Vec::new();
    source.by_ref().take(4).read_to_end(&mut magic)?;
    let whole = Cursor::new(magic.clone()).chain(source);
    Ok(match magic[..] {
        [0x1f, 0x8b, ..] => Box::new(BufReader::new(CutIsEnd(MultiGzDecoder::new(whole)))),
        [0x28, 0xb5, 0x2f, 0xfd] => Box::new(BufReader::new(CutIsEnd(ZstdDecoder::new(whole)?))),
        _ => Box::new(BufReader::new(CutIsEnd(whole))),
    })
}

/// A source that ends where a decompressor finds its input cut.
struct CutIsEnd<R>(R);

impl<R: Read> Read for CutIsEnd<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            match self.0.read(buffer) {
                Err(e) if e.kind() == ErrorKind::Interrupted => {}
                Err(e) if e.kind() == ErrorKind::UnexpectedEof => return Ok(0),
                result => return result,
            }
        }
    }
}
