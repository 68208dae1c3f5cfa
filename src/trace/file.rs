//! Files to write: created with care for what is already there.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use crc32fast::Hasher;
use serde::{Deserialize, Serialize};

use super::TraceError;

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
                Err(e) => return Err(explain(path, "read", e)),
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

/// Writes a whole file or none of it: to a neighbour first, which then takes the
/// name.
pub(crate) fn write_whole(path: &Path, bytes: &[u8], overwrite: bool) -> Result<(), TraceError> {
    let Some(path) = to_replace(path, overwrite)? else {
        // A device or a pipe must not be replaced by a file.
        return fs::write(path, bytes).map_err(|e| explain(path, "write", e));
    };
    let (part, mut file) = create_part(&path)?;
    let written = file
        .write_all(bytes)
        .and_then(|()| file.sync_all())
        .and_then(|()| rename(&part, &path, overwrite));
    if written.is_err() {
        // Best effort: the error to report is the one above.
        let _ = fs::remove_file(&part);
    }
    written.map_err(|e| explain(&path, "write", e))
}

/// Whether [`write_whole`] could begin, found out without changing what is there.
pub(crate) fn check_whole(path: &Path, overwrite: bool) -> Result<(), TraceError> {
    if let Some(path) = to_replace(path, overwrite)? {
        let (part, _) = create_part(&path)?;
        // Best effort: the next process with the same number removes it as well.
        let _ = fs::remove_file(part);
    }
    Ok(())
}

/// The file that a new one may take the place of; none for a device or a pipe, which
/// is written to as it is.
fn to_replace(path: &Path, overwrite: bool) -> Result<Option<PathBuf>, TraceError> {
    let there = fs::metadata(path).ok();
    // A link that leads nowhere is something as well.
    let taken = fs::symlink_metadata(path).is_ok();
    if there.as_ref().is_some_and(|data| data.is_dir()) || (taken && !overwrite) {
        return Err(explain(path, "create", io::ErrorKind::AlreadyExists.into()));
    }
    if there.is_some_and(|data| !data.is_file()) {
        return Ok(None);
    }
    // Through a symbolic link, to the file that it names.
    Ok(Some(
        fs::canonicalize(path).unwrap_or_else(|_| path.to_owned()),
    ))
}

/// Creates the neighbour that a whole file is written to first.
fn create_part(path: &Path) -> Result<(PathBuf, File), TraceError> {
    let part = part_of(path);
    // Only a crash of a process with the same number can have left it.
    let _ = fs::remove_file(&part);
    let file = File::create_new(&part).map_err(|e| explain(path, "create", e))?;
    Ok((part, file))
}

/// A neighbour's name that no other process uses.
fn part_of(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    path.with_file_name(name)
}

/// Renames; without `overwrite`, a file that came in between stays.
fn rename(from: &Path, to: &Path, overwrite: bool) -> io::Result<()> {
    if overwrite {
        return fs::rename(from, to);
    }
    match fs::hard_link(from, to) {
        Ok(()) => fs::remove_file(from),
        Err(e) if e.kind() == io::ErrorKind::AlreadyExists => Err(e),
        // Not every file system has hard links.
        Err(_) => fs::rename(from, to),
    }
}

/// An error that says what is wrong with the path, where the system's words leave
/// one guessing.
pub(crate) fn explain(path: &Path, action: &'static str, source: io::Error) -> TraceError {
    let name = path.display().to_string();
    let parent = path
        .parent()
        .filter(|parent| !parent.as_os_str().is_empty());
    let problem = if path.is_dir() {
        "this is a folder".to_owned()
    } else if source.kind() == io::ErrorKind::AlreadyExists {
        return TraceError::Exists { name };
    } else if let Some(parent) = parent.filter(|parent| !parent.exists()) {
        format!("the folder {} does not exist", parent.display())
    } else {
        return TraceError::Io {
            action,
            name,
            source,
        };
    };
    TraceError::BadPath { name, problem }
}
