//! Traces: what a run leaves behind.
//!
//! A trace is a file of [`Record`]s: a [`Header`](record::Header) with the whole
//! world, then [`Frame`](record::Frame)s and [`Contact`](record::Contact)s as they
//! happen, and a [`Summary`](record::Summary) last. It is written while the run
//! goes on, and can be read up to the last whole record at any time, also after a
//! crash. Its name tells the [`Format`]: JSON Lines or one JSON document,
//! compressed or not. Numbers read back bit for bit.
//!
//! ```
//! use volary::trace::{Record, TraceReader, TraceWriter};
//! # use volary::trace::record::{Bodies, Frame, FORMAT, Header, VERSION};
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("run.jsonl.zst");
//! # let header = Header {
//! #     format: FORMAT.into(),
//! #     version: VERSION,
//! #     program: "an example".into(),
//! #     dynamics: "bodies".into(),
//! #     solver: None,
//! #     name: "one agent".into(),
//! #     world: serde_json::from_str(
//! #         r#"{"dimension": 2, "time": {"end": 1}, "agents": []}"#,
//! #     )?,
//! #     bodies: Bodies::default(),
//! # };
//! # let frame = Frame {
//! #     positions: vec![vec![0.5, -1.0]],
//! #     velocities: vec![vec![0.0, 2.0]],
//! #     ..Frame::default()
//! # };
//! # let mut writer = TraceWriter::create(&path, false)?;
//! # writer.write(&Record::Header(Box::new(header)))?;
//! # writer.write(&Record::Frame(frame))?;
//! # writer.finish()?;
//! let mut trace = TraceReader::open(&path)?;
//! println!("{} in {} dimensions", trace.header().name, trace.header().world.dimension);
//! # let mut frames = 0;
//! for record in &mut trace {
//!     if let Record::Frame(frame) = record? {
//!         println!("at time {} agent 0 is at {:?}", frame.time, frame.positions[0]);
//! #       frames += 1;
//!     }
//! }
//! if trace.truncated() {
//!     println!("the run did not reach its end");
//! }
//! # assert_eq!((frames, trace.truncated()), (1, true));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod background;
mod error;
mod file;
mod finite;
mod format;
mod reader;
pub mod record;
mod sink;
mod split;
mod summary;
mod writer;

pub use background::BackgroundWriter;
pub use error::TraceError;
pub use file::TraceFile;
pub use format::{Compression, Format, Layout};
pub use reader::TraceReader;
pub use record::Record;
pub(crate) use sink::Sink;
pub(crate) use summary::write_json;
pub use summary::{check_summary, write_summary};
pub use writer::{TracePosition, TraceWriter};
