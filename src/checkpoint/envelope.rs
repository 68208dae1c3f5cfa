//! The bytes around a checkpoint's content, by which a file is known, checked and told from
//! those of other programs.
//!
//! | bytes | what |
//! |---|---|
//! | 18 | `volary checkpoint` and a line end |
//! | 8 | length of everything behind the checksum |
//! | 4 | CRC-32 of the same |
//! | 4 | version of the format |
//! | | program and machine, and a line end |
//! | | the content |
//!
//! Numbers are little-endian. All but the content is the same in every version.

use std::env::consts::{ARCH, OS};
use std::io::{self, Read};

use super::CheckpointError;

/// The first bytes of every checkpoint.
const MAGIC: &[u8; 18] = b"volary checkpoint\n";

/// Version of the format.
pub(super) const VERSION: u32 = 2;

/// Why a source has no content to read.
pub(super) enum Fault {
    Io(io::Error),
    Bad(CheckpointError),
}

impl From<io::Error> for Fault {
    fn from(e: io::Error) -> Self {
        Self::Io(e)
    }
}

/// What must be the same for a run to go on bit for bit: the program's version, and the kind
/// of machine, whose C library computes exponentials.
fn program() -> String {
    format!("volary {} on {ARCH} {OS}", env!("CARGO_PKG_VERSION"))
}

/// The bytes of the file with this content.
pub(super) fn wrap(content: &[u8]) -> Vec<u8> {
    let mut body = VERSION.to_le_bytes().to_vec();
    body.extend_from_slice(program().as_bytes());
    body.push(b'\n');
    body.extend_from_slice(content);
    let mut bytes = MAGIC.to_vec();
    bytes.extend_from_slice(&(body.len() as u64).to_le_bytes());
    bytes.extend_from_slice(&crc32fast::hash(&body).to_le_bytes());
    bytes.extend_from_slice(&body);
    bytes
}

/// The content of a file, once everything around it is found to be right. No more is read
/// than there is, whatever the file says of its length.
pub(super) fn read(mut source: impl Read, file: &str) -> Result<Vec<u8>, Fault> {
    let file = || file.to_owned();
    let damaged = |problem: String| {
        Fault::Bad(CheckpointError::Damaged {
            file: file(),
            problem,
        })
    };
    let mut head = Vec::new();
    source.by_ref().take(30).read_to_end(&mut head)?;
    if !head.starts_with(MAGIC) {
        return Err(Fault::Bad(CheckpointError::NotACheckpoint { file: file() }));
    }
    let numbers = head[MAGIC.len()..].split_first_chunk::<8>();
    let Some((length, Ok(sum))) = numbers.map(|(a, b)| (a, <[u8; 4]>::try_from(b))) else {
        return Err(damaged("it ends too early".to_owned()));
    };
    let length = u64::from_le_bytes(*length);
    let mut body = Vec::new();
    source
        .take(length.saturating_add(1))
        .read_to_end(&mut body)?;
    if body.len() as u64 != length {
        let how = if (body.len() as u64) < length {
            "early"
        } else {
            "late"
        };
        return Err(damaged(format!("it ends too {how}")));
    }
    if crc32fast::hash(&body) != u32::from_le_bytes(sum) {
        return Err(damaged("its checksum is wrong".to_owned()));
    }
    let Some((version, body)) = body.split_first_chunk::<4>() else {
        return Err(damaged("it holds nothing".to_owned()));
    };
    let found = u32::from_le_bytes(*version);
    if found != VERSION {
        return Err(Fault::Bad(CheckpointError::Version {
            file: file(),
            found,
        }));
    }
    let Some(end) = body.iter().position(|&byte| byte == b'\n') else {
        return Err(damaged("it does not name its program".to_owned()));
    };
    let (found, content) = (String::from_utf8_lossy(&body[..end]), &body[end + 1..]);
    let here = program();
    if found != here {
        return Err(Fault::Bad(CheckpointError::Program {
            file: file(),
            found: found.into_owned(),
            here,
        }));
    }
    Ok(content.to_vec())
}
