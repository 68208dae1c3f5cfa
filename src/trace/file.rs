//! Files to write: created with care for what is already there.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::TraceError;

/// The file of a trace. What an existing file held goes when the first new byte
/// comes, so that a run which never starts destroys nothing.
#[derive(Debug)]
pub struct TraceFile {
    file: File,
    /// Whether the file still holds something old.
    stale: bool,
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
        Ok(Self { file, stale })
    }
}

impl Write for TraceFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.stale {
            self.file.set_len(0)?;
            self.stale = false;
        }
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a whole file or none of it: to a neighbour first, which then takes the
/// name.
pub(super) fn write_whole(path: &Path, bytes: &[u8], overwrite: bool) -> Result<(), TraceError> {
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
pub(super) fn check_whole(path: &Path, overwrite: bool) -> Result<(), TraceError> {
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
pub(super) fn explain(path: &Path, action: &'static str, source: io::Error) -> TraceError {
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
