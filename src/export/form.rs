//! What a trace is exported to, told by the file's name.

use std::path::Path;

use super::ExportError;
use crate::trace::{Compression, Format, Layout};

/// What a trace is exported to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A table in CSV.
    Table(Table),
    /// Extended XYZ, as OVITO reads it.
    Xyz,
    /// A trace again, in this layout.
    Trace(Layout),
}

/// The tables that a trace holds; see the [module](super) for their columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Table {
    /// One row for each agent and frame.
    #[default]
    Agents,
    /// One row for each frame: its metrics, the analysis of its net, and what its laws are about.
    Metrics,
    /// One row for each contact episode.
    Contacts,
    /// One row for each edge of the proximity net and frame.
    Edges,
    /// One row for each agent that perceives another and frame.
    Links,
    /// One row for each line of sight that something weakens or blocks and frame.
    Blocked,
    /// One row for each β-agent and frame.
    BetaAgents,
    /// One row for each moving obstacle and frame.
    Obstacles,
}

impl Form {
    /// The endings that [`Form::of`] knows, in words.
    pub const ENDINGS: &'static str =
        ".csv, .xyz, .jsonl, .ndjson or .json, each also with .gz or .zst behind it";

    /// The form and compression that a file's name asks for, in any case; a table is that of
    /// the agents.
    ///
    /// # Errors
    /// Where the ending is none of [`Form::ENDINGS`].
    pub fn of(path: &Path) -> Result<(Self, Compression), ExportError> {
        let (stem, compression) = Compression::of(path);
        let form = match stem.rsplit_once('.') {
            Some((_, "csv")) => Self::Table(Table::default()),
            Some((_, "xyz")) => Self::Xyz,
            _ => match Format::of(path) {
                Ok(format) => Self::Trace(format.layout),
                Err(_) => {
                    let name = path.display().to_string();
                    return Err(ExportError::UnknownForm { name });
                }
            },
        };
        Ok((form, compression))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn follows_the_name() {
        use Compression::{Gzip, None, Zstd};
        let agents = Form::Table(Table::Agents);
        for (name, form, compression) in [
            ("a.csv", agents, None),
            ("a.jsonl.CSV.GZ", agents, Gzip),
            ("a.xyz", Form::Xyz, None),
            ("a.b.xyz.zst", Form::Xyz, Zstd),
            ("a.json.gz", Form::Trace(Layout::Array), Gzip),
            ("a.csv.ndjson", Form::Trace(Layout::Lines), None),
        ] {
            let found = Form::of(Path::new(name)).unwrap();
            assert_eq!(found, (form, compression), "{name}");
        }
        for name in ["a", "csv", "a.txt", "a.csv.zip", "-"] {
            let message = Form::of(Path::new(name)).unwrap_err().to_string();
            assert!(message.starts_with(&format!("{name}: ")), "{message}");
            assert!(message.contains(".csv, .xyz"), "{message}");
        }
    }
}
