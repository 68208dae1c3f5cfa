//! Figures in a folder.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::{Entry, Figure, html, markdown, sketches};
use crate::file::{FileError, check_whole, explain, write_whole};
use crate::picture::{FileKind, PictureError, Theme};

/// The pages that show all figures of a folder.
const PAGES: [&str; 2] = ["index.html", "index.md"];

/// The file of a figure.
fn name(id: &str, kind: FileKind) -> Result<String, FileError> {
    match kind {
        FileKind::Svg => Ok(format!("{id}.svg")),
        FileKind::Png => Ok(format!("{id}.png")),
        _ => Err(FileError::BadPath {
            name: id.to_owned(),
            problem: format!("figures are stills: {}", FileKind::STILLS),
        }),
    }
}

/// Makes the folder where it is missing, and finds out whether these figures could be written to
/// it now, without changing a file: better before the runs than after them.
///
/// # Errors
/// As [`write()`]; and [`FileError::BadPath`] where something that is no folder has its name.
pub fn check(
    folder: &Path,
    entries: &[Entry],
    kind: FileKind,
    overwrite: bool,
) -> Result<(), FileError> {
    fs::create_dir_all(folder).map_err(|error| match error.kind() {
        // A file, or a link that leads nowhere; nothing may overwrite it.
        ErrorKind::AlreadyExists => FileError::BadPath {
            name: folder.display().to_string(),
            problem: "this is no folder".to_owned(),
        },
        _ => explain(folder, "create", error),
    })?;
    let figures = entries.iter().map(|entry| name(entry.id, kind));
    let mut names = figures.chain(PAGES.map(|page| Ok(page.to_owned())));
    names.try_for_each(|name| check_whole(&folder.join(name?), overwrite))
}

/// Writes figures to a folder, each to a file of its own, and the pages `index.html` and `index.md`
/// that show them, last, in the colours of a theme. Each file appears whole or not at all. Returns
/// the page of HTML.
///
/// # Errors
/// [`FileError::Exists`] for a file that is there already, without `overwrite`;
/// [`FileError::BadPath`] for a kind of film; and what the system says.
pub fn write(
    folder: &Path,
    figures: &[Figure],
    kind: FileKind,
    theme: &Theme,
    overwrite: bool,
) -> Result<PathBuf, FileError> {
    let mut shown = Vec::new();
    for figure in figures {
        let name = name(figure.id, kind)?;
        let path = folder.join(&name);
        let written = figure.picture.write(&path, overwrite);
        written.map_err(|problem| match problem {
            PictureError::File(error) => error,
            problem => FileError::BadPath {
                name: path.display().to_string(),
                problem: problem.to_string(),
            },
        })?;
        shown.push((figure, name));
    }
    let beside = sketches(figures.iter().map(|figure| figure.id));
    let pages = [html(&shown, &beside, theme), markdown(&shown, &beside)];
    for (name, text) in PAGES.iter().zip(pages) {
        write_whole(&folder.join(name), text.as_bytes(), overwrite)?;
    }
    Ok(folder.join(PAGES[0]))
}
