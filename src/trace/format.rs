//! The shape of a trace, told by its file name.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::TraceError;

/// How the records of a trace are laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Layout {
    /// JSON Lines: one record per line (`.jsonl`, `.ndjson`).
    #[default]
    Lines,
    /// One JSON document: an array of the records, each on its own line (`.json`).
    Array,
}

/// How the bytes of a trace are compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Compression {
    /// Not at all.
    #[default]
    None,
    /// gzip (`.gz`).
    Gzip,
    /// Zstandard (`.zst`).
    Zstd,
}

impl Compression {
    /// The compression that a file's name asks for, in any case, and the name in front of its
    /// ending, in lower case.
    pub(crate) fn of(path: &Path) -> (String, Self) {
        let file = path.file_name().unwrap_or_default();
        let name = file.to_string_lossy().to_lowercase();
        for (ending, compression) in [(".gz", Self::Gzip), (".zst", Self::Zstd)] {
            if let Some(stem) = name.strip_suffix(ending) {
                return (stem.to_owned(), compression);
            }
        }
        (name, Self::None)
    }
}

/// Layout and compression of a trace; plain JSON Lines by default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Format {
    /// How the records are laid out.
    pub layout: Layout,
    /// How the bytes are compressed.
    pub compression: Compression,
}

impl Format {
    /// The endings that [`Format::of`] knows, in words.
    pub const ENDINGS: &'static str =
        ".jsonl, .ndjson or .json, each also with .gz or .zst behind it";

    /// The format that a file's name asks for, in any case: `run.jsonl`,
    /// `run.json.gz`, `run.ndjson.zst`. A name with nothing but `.gz` or `.zst`
    /// means JSON Lines.
    pub fn of(path: &Path) -> Result<Self, TraceError> {
        let (stem, compression) = Compression::of(path);
        let layout = match stem.rsplit_once('.') {
            Some((_, "jsonl" | "ndjson")) => Layout::Lines,
            Some((_, "json")) => Layout::Array,
            None if compression != Compression::None => Layout::Lines,
            _ => {
                return Err(TraceError::UnknownFormat {
                    name: path.display().to_string(),
                });
            }
        };
        Ok(Self {
            layout,
            compression,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn follows_the_name() {
        use {Compression as C, Layout as L};
        for (name, layout, compression) in [
            ("a.jsonl", L::Lines, C::None),
            ("a.NDJSON", L::Lines, C::None),
            ("dir.json/a.ndjson.gz", L::Lines, C::Gzip),
            ("a.b.jsonl.zst", L::Lines, C::Zstd),
            ("a.json", L::Array, C::None),
            ("a.Json.GZ", L::Array, C::Gzip),
            ("a.json.Zst", L::Array, C::Zstd),
            ("a.gz", L::Lines, C::Gzip),
            ("a.zst", L::Lines, C::Zstd),
        ] {
            let expected = Format {
                layout,
                compression,
            };
            assert_eq!(Format::of(Path::new(name)).unwrap(), expected, "{name}");
        }
    }

    #[test]
    fn refuses_other_names_and_lists_the_known_ones() {
        for name in ["a", "a.csv", "a.csv.gz", "a.gz.zst", "json", "a.json."] {
            let message = Format::of(Path::new(name)).unwrap_err().to_string();
            assert!(message.starts_with(name), "{message}");
            assert!(message.contains(".ndjson"), "{message}");
        }
    }
}
