//! Files that appear whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::stop::Loose;

/// Why a file could not be written or read. Each message names it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file is there already and must not be overwritten.
    #[error("{name} exists already")]
    Exists {
        /// The file.
        name: String,
    },
    /// The path is unfit for a file: a folder, inside a missing one, or with an ending that says
    /// nothing.
    #[error("{name}: {problem}")]
    BadPath {
        /// The file.
        name: String,
        /// What is wrong with the path.
        problem: String,
    },
    /// The file could not be created, written, opened or read.
    #[error("cannot {action} {name}: {source}")]
    Io {
        /// What was tried: "create", "write", "open" or "read".
        action: &'static str,
        /// The file.
        name: String,
        /// What the system says.
        source: io::Error,
    },
}

/// A file on its way: what is written goes to a neighbour, which takes the name when all is
/// there. Dropped before [`WholeFile::finish`], it leaves nothing.
#[derive(Debug)]
pub struct WholeFile {
    file: File,
    /// What messages call it.
    path: PathBuf,
    /// The neighbour, until it is gone; none for a device or a pipe, which is written to as it
    /// is.
    part: Option<PathBuf>,
    /// Has the neighbour removed if the process ends early.
    loose: Option<Loose>,
    overwrite: bool,
}

impl WholeFile {
    /// Begins a file. What is there under this name stays until the new one is whole.
    ///
    /// # Errors
    /// [`FileError::Exists`] without `overwrite`, where something has this name already;
    /// [`FileError::BadPath`] for a folder, or inside a missing one; and what the system says.
    pub fn create(path: &Path, overwrite: bool) -> Result<Self, FileError> {
        let (file, path, part, loose) = match to_replace(path, overwrite)? {
            None => {
                let file = File::create(path).map_err(|e| explain(path, "write", e))?;
                (file, path.to_owned(), None, None)
            }
            Some(path) => {
                let part = part_of(&path);
                let begin = || {
                    // Only a crash of a process with the same number can have left it.
                    let _ = fs::remove_file(&part);
                    File::create_new(&part)
                };
                let own = part.clone();
                let remove = |_: &File| -> Box<dyn FnOnce() + Send> {
                    Box::new(move || {
                        // Best effort, as when it is dropped.
                        let _ = fs::remove_file(&own);
                    })
                };
                let begun = Loose::end(begin, remove);
                let (file, loose) = begun.map_err(|e| explain(&path, "create", e))?;
                (file, path, Some(part), Some(loose))
            }
        };
        Ok(Self {
            file,
            path,
            part,
            loose,
            overwrite,
        })
    }

    /// Gives the file its name, once it is safe on the disk.
    ///
    /// # Errors
    /// [`FileError::Exists`] where, without `overwrite`, another file took the name meanwhile;
    /// and what the system says. Then nothing is left of it.
    pub fn finish(mut self) -> Result<(), FileError> {
        let Some(part) = &self.part else {
            return Ok(());
        };
        self.file.sync_all().map_err(|e| self.failure(e))?;
        let name = || rename(part, &self.path, self.overwrite);
        let named = match self.loose.take() {
            Some(loose) => loose.settle(name),
            None => name(),
        };
        named.map_err(|e| self.failure(e))?;
        self.part = None;
        Ok(())
    }

    /// An error of writing, in words that name the file.
    pub fn failure(&self, source: io::Error) -> FileError {
        explain(&self.path, "write", source)
    }

    /// The same file once more, for encoders that keep what they write to.
    ///
    /// # Errors
    /// What the system says.
    pub fn handle(&self) -> Result<File, FileError> {
        self.file.try_clone().map_err(|e| self.failure(e))
    }

    /// Where the bytes lie until the file has its name, for programs that write them; the file
    /// itself for a device or a pipe.
    pub fn place(&self) -> &Path {
        self.part.as_deref().unwrap_or(&self.path)
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        if let Some(part) = &self.part {
            // Best effort: the next process with the same number removes it as well.
            let _ = fs::remove_file(part);
        }
    }
}

/// Writes a whole file or none of it.
///
/// # Errors
/// As [`WholeFile::create`] and [`WholeFile::finish`].
pub fn write_whole(path: &Path, bytes: &[u8], overwrite: bool) -> Result<(), FileError> {
    let mut file = WholeFile::create(path, overwrite)?;
    file.write_all(bytes).map_err(|e| file.failure(e))?;
    file.finish()
}

/// Whether [`WholeFile::create`] would succeed, found out without changing what is there.
///
/// # Errors
/// As [`WholeFile::create`].
pub fn check_whole(path: &Path, overwrite: bool) -> Result<(), FileError> {
    if to_replace(path, overwrite)?.is_some() {
        WholeFile::create(path, overwrite)?;
    }
    Ok(())
}

/// The file that a new one may take the place of; none for a device or a pipe, which
/// is written to as it is.
fn to_replace(path: &Path, overwrite: bool) -> Result<Option<PathBuf>, FileError> {
    let there = fs::metadata(path).ok();
    // A link that leads nowhere is something as well.
    let taken = fs::symlink_metadata(path).is_ok();
    if there.as_ref().is_some_and(|data| data.is_dir()) || (taken && !overwrite) {
        return Err(explain(path, "create", io::ErrorKind::AlreadyExists.into()));
    }
    if there.is_some_and(|data| !data.is_file()) {
        return Ok(None);
    }
    // Through a symbolic link, to the file that it names, where there is one.
    Ok(Some(
        fs::canonicalize(path).unwrap_or_else(|_| path.to_owned()),
    ))
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
pub(crate) fn explain(path: &Path, action: &'static str, source: io::Error) -> FileError {
    let name = path.display().to_string();
    let parent = path
        .parent()
        .filter(|parent| !parent.as_os_str().is_empty());
    let problem = if path.is_dir() {
        "this is a folder".to_owned()
    } else if source.kind() == io::ErrorKind::AlreadyExists {
        return FileError::Exists { name };
    } else if let Some(parent) = parent.filter(|parent| !parent.exists()) {
        format!("the folder {} does not exist", parent.display())
    } else {
        return FileError::Io {
            action,
            name,
            source,
        };
    };
    FileError::BadPath { name, problem }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn has_its_name_when_it_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.gif");
        let mut file = WholeFile::create(&path, false).unwrap();
        file.write_all(b"one ").unwrap();
        file.write_all(b"two").unwrap();
        assert!(!path.exists());
        assert_eq!(fs::read(file.place()).unwrap(), b"one two");
        file.finish().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"one two");
        assert_eq!(names(folder.path()), ["a.gif"]);
    }

    #[test]
    fn leaves_nothing_when_it_is_dropped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.gif");
        fs::write(&path, "before").unwrap();
        let mut file = WholeFile::create(&path, true).unwrap();
        file.write_all(b"half").unwrap();
        drop(file);
        assert_eq!(fs::read(&path).unwrap(), b"before");
        assert_eq!(names(folder.path()), ["a.gif"]);
        check_whole(&path, true).unwrap();
        assert_eq!(names(folder.path()), ["a.gif"]);
    }

    #[test]
    fn does_not_overwrite_what_came_in_between() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.gif");
        let mut file = WholeFile::create(&path, false).unwrap();
        file.write_all(b"mine").unwrap();
        fs::write(&path, "theirs").unwrap();
        let error = file.finish().unwrap_err();
        assert!(matches!(error, FileError::Exists { .. }), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"theirs");
        assert_eq!(names(folder.path()), ["a.gif"]);
    }

    #[test]
    fn refuses_what_no_file_can_be() {
        let folder = tempfile::tempdir().unwrap();
        let there = folder.path().join("there");
        fs::write(&there, "").unwrap();
        let missing = folder.path().join("missing").join("a.gif");
        for (path, overwrite, expected) in [
            (there.as_path(), false, "there exists already"),
            (folder.path(), true, ": this is a folder"),
            (missing.as_path(), true, "missing does not exist"),
        ] {
            for message in [
                WholeFile::create(path, overwrite).map(drop),
                check_whole(path, overwrite),
                write_whole(path, b"", overwrite),
            ]
            .map(|result| result.unwrap_err().to_string())
            {
                assert!(message.ends_with(expected), "{message}");
            }
        }
        assert_eq!(names(folder.path()), ["there"]);
    }
}
