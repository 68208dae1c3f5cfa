//! Where the text of a trace goes: a compressor, or none.

use std::io::{self, Write};

use flate2::write::GzEncoder;
use zstd::stream::write::Encoder as ZstdEncoder;

use super::format::Compression;

/// A target, behind a compressor or none.
pub(crate) enum Sink<W: Write> {
    Plain(W),
    Gzip(GzEncoder<W>),
    Zstd(ZstdEncoder<'static, W>),
    Members(Members<W>),
}

impl<W: Write> Sink<W> {
    /// One compressed stream from the first byte to the last.
    pub fn new(target: W, compression: Compression) -> io::Result<Self> {
        Ok(match compression {
            Compression::None => Self::Plain(target),
            // Digits hardly compress better with more effort: 7 % for seven times the time.
            Compression::Gzip => Self::Gzip(GzEncoder::new(target, flate2::Compression::fast())),
            Compression::Zstd => {
                let mut encoder = ZstdEncoder::new(target, zstd::DEFAULT_COMPRESSION_LEVEL)?;
                encoder.include_checksum(true)?;
                Self::Zstd(encoder)
            }
        })
    }

    /// A sink that can be taken up again later: compressed, it is a sequence of members.
    /// `waiting` is text that an earlier sink had not written yet.
    pub fn resumable(target: W, compression: Compression, waiting: Vec<u8>) -> Self {
        match compression {
            Compression::None => Self::Plain(target),
            _ => Self::Members(Members {
                target,
                compression,
                waiting,
            }),
        }
    }

    /// The target, and the text that it will get later; none where a compressor's inside
    /// is part of the state.
    pub fn state(&self) -> Option<(&W, &[u8])> {
        match self {
            Self::Plain(target) => Some((target, &[])),
            Self::Members(members) => Some((&members.target, &members.waiting)),
            Self::Gzip(_) | Self::Zstd(_) => None,
        }
    }

    pub fn write_all(&mut self, text: &[u8]) -> io::Result<()> {
        match self {
            Self::Plain(target) => target.write_all(text),
            Self::Gzip(encoder) => encoder.write_all(text),
            Self::Zstd(encoder) => encoder.write_all(text),
            Self::Members(members) => {
                members.waiting.extend_from_slice(text);
                Ok(())
            }
        }
    }

    pub fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Plain(target) => target.flush(),
            Self::Gzip(encoder) => encoder.flush(),
            Self::Zstd(encoder) => encoder.flush(),
            Self::Members(members) => members.flush(),
        }
    }

    /// Ends the stream and hands the target back.
    pub fn finish(self) -> io::Result<W> {
        let mut target = match self {
            Self::Plain(target) => target,
            Self::Gzip(encoder) => encoder.finish()?,
            Self::Zstd(encoder) => encoder.finish()?,
            Self::Members(mut members) => {
                members.flush()?;
                members.target
            }
        };
        target.flush()?;
        Ok(target)
    }
}

/// A sequence of gzip members or zstd frames, which readers take for one stream. Each
/// flush ends a member, and each member is compressed as a whole: what it looks like
/// depends on its text alone, not on what came before or on where the run was stopped.
pub(crate) struct Members<W: Write> {
    target: W,
    compression: Compression,
    waiting: Vec<u8>,
}

impl<W: Write> Members<W> {
    fn flush(&mut self) -> io::Result<()> {
        if !self.waiting.is_empty() {
            let mut member = Sink::new(Vec::new(), self.compression)?;
            member.write_all(&self.waiting)?;
            // In one piece, so that a crash rarely finds it half written.
            self.target.write_all(&member.finish()?)?;
            self.waiting.clear();
        }
        self.target.flush()
    }
}
