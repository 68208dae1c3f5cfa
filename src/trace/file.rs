//! The file of a trace: created with care for what is already there, and taken up again.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::Path;

use crc32fast::Hasher;
use serde::{Deserialize, Serialize};

use super::TraceError;
use crate::file::explain;

/// The file of a trace. What an existing file held goes when the first new byte
/// comes, so that a run which never starts destroys nothing.
#[derive(Debug)]
pub struct TraceFile {
    file: File,
    /// Length to cut the file to before the first write.
    cut: Option<u64>,
    length: u64,
    sum: Hasher,
}

/// What a file holds: its length, and the CRC-32 of all its bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(super) struct Mark {
    length: u64,
    sum: u32,
}

impl TraceFile {
    /// Opens a file to write. Without `overwrite` it must not exist yet; nobody
    /// else can create it in between.
    pub(super) fn open(path: &Path, overwrite: bool) -> Result<Self, TraceError> {
        let mut options = OpenOptions::new();
        options.write(true);
        if overwrite {
            options.create(true).truncate(false);
        } else {
            options.create_new(true);
        }
        let file = options.open(path).map_err(|e| explain(path, "create", e))?;
        // Devices and pipes have no length to cut.
        let stale = file
            .metadata()
            .is_ok_and(|data| data.is_file() && data.len() > 0);
        Ok(Self {
            file,
            cut: stale.then_some(0),
            length: 0,
            sum: Hasher::new(),
        })
    }

    /// Opens a file to go on behind `mark`, up to which it must hold what it held then.
    pub(super) fn reopen(path: &Path, mark: &Mark) -> Result<Self, TraceError> {
        let other = |problem: String| TraceError::NotTheSame {
            name: path.display().to_string(),
            problem,
        };
        if path.exists() && !path.is_file() && !path.is_dir() {
            return Err(other("it is no regular file".to_owned()));
        }
        let mut options = OpenOptions::new();
        let file = options.read(true).write(true).open(path);
        let mut file = file.map_err(|e| explain(path, "open", e))?;
        lock(&file, path)?;
        let (mut sum, mut left) = (Hasher::new(), mark.length);
        let mut buffer = vec![0; 1 << 16];
        while left > 0 {
            let most = buffer
                .len()
                .min(usize::try_from(left).unwrap_or(usize::MAX));
            match file.read(&mut buffer[..most]) {
                Ok(0) => {
                    let (found, held) = (mark.length - left, mark.length);
                    return Err(other(format!(
                        "it has {found} bytes, and had {held} already"
                    )));
                }
                Ok(count) => {
                    sum.update(&buffer[..count]);
                    left -= count as u64;
                }
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                Err(e) => return Err(explain(path, "read", e).into()),
            }
        }
        if sum.clone().finalize() != mark.sum {
            let held = mark.length;
            return Err(other(format!("its first {held} bytes have changed")));
        }
        Ok(Self {
            file,
            cut: Some(mark.length),
            length: mark.length,
            sum,
        })
    }

    /// Keeps other runs from writing the file, as far as the system can.
    pub(super) fn lock(&self, path: &Path) -> Result<(), TraceError> {
        lock(&self.file, path)
    }

    /// What was written so far; it is safe on the disk when this returns.
    pub(super) fn mark(&self) -> io::Result<Mark> {
        self.file.sync_data()?;
        Ok(Mark {
            length: self.length,
            sum: self.sum.clone().finalize(),
        })
    }
}

impl Write for TraceFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if let Some(length) = self.cut {
            self.file.set_len(length)?;
            self.cut = None;
        }
        let written = self.file.write(bytes)?;
        self.length += written as u64;
        self.sum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

fn lock(file: &File, path: &Path) -> Result<(), TraceError> {
    if cfg!(windows) {
        // There a lock would keep others from reading as well.
        return Ok(());
    }
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(TraceError::InUse {
            name: path.display().to_string(),
        }),
        // Not every file system has locks.
        _ => Ok(()),
    }
}
