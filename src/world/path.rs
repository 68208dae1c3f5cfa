//! Paths into a world file: `laws[0].alpha_interaction.range`.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// One step of a path.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Step {
    /// Into the field of an object.
    Field(String),
    /// Into an entry of a list, counted from 0.
    Entry(usize),
}

/// A path from the whole file to one of its values; the empty path is the file.
///
/// Names that would be mistaken for something else are written in brackets and
/// quotes: `notes["a b"]`.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub struct Path(pub Vec<Step>);

/// Why a text is not a path.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PathError {
    /// A name is missing, as in `a..b` or `a.`.
    #[error("the path `{0}` lacks a name")]
    NoName(String),
    /// A bracket holds neither a number nor a quoted name, or is never closed.
    #[error("the path `{0}` has a bracket without an index, as in `laws[0]`")]
    BadBracket(String),
}

impl Path {
    /// Whether this path leads to `other` or to something that holds it.
    pub fn leads_to(&self, other: &Path) -> bool {
        other.0.starts_with(&self.0)
    }

    /// The last field on the way, if any.
    pub fn last_field(&self) -> Option<&str> {
        self.0.iter().rev().find_map(|step| match step {
            Step::Field(name) => Some(name.as_str()),
            Step::Entry(_) => None,
        })
    }

    /// The path of a field of the object at this path.
    pub fn field(&self, name: &str) -> Path {
        let mut steps = self.0.clone();
        steps.push(Step::Field(name.to_owned()));
        Path(steps)
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, step) in self.0.iter().enumerate() {
            match step {
                Step::Entry(index) => write!(f, "[{index}]")?,
                Step::Field(name) if !is_plain(name) => {
                    write!(f, "[{}]", serde_json::Value::from(name.as_str()))?
                }
                Step::Field(name) if at == 0 => f.write_str(name)?,
                Step::Field(name) => write!(f, ".{name}")?,
            }
        }
        Ok(())
    }
}

impl FromStr for Path {
    type Err = PathError;

    fn from_str(text: &str) -> Result<Self, PathError> {
        let mut steps = Vec::new();
        let mut rest = text;
        while !rest.is_empty() {
            if let Some(inside) = rest.strip_prefix('[') {
                let (step, after) =
                    bracket(inside).ok_or_else(|| PathError::BadBracket(text.into()))?;
                steps.push(step);
                rest = after;
                continue;
            }
            if !steps.is_empty() {
                rest = rest
                    .strip_prefix('.')
                    .ok_or_else(|| PathError::NoName(text.into()))?;
            }
            let end = rest.find(['.', '[']).unwrap_or(rest.len());
            if end == 0 {
                return Err(PathError::NoName(text.into()));
            }
            steps.push(Step::Field(rest[..end].to_owned()));
            rest = &rest[end..];
        }
        Ok(Path(steps))
    }
}

/// Reads `0]…` or `"name"]…`: the step, and what follows the bracket.
fn bracket(inside: &str) -> Option<(Step, &str)> {
    if inside.starts_with('"') {
        let mut names = serde_json::Deserializer::from_str(inside).into_iter::<String>();
        let name = names.next()?.ok()?;
        let after = inside.get(names.byte_offset()..)?.strip_prefix(']')?;
        return Some((Step::Field(name), after));
    }
    let (index, after) = inside.split_once(']')?;
    Some((Step::Entry(index.parse().ok()?), after))
}

fn is_plain(name: &str) -> bool {
    !name.is_empty()
        && !name.contains(|c: char| ".[]\"=".contains(c) || c.is_whitespace() || c.is_control())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_it_writes() {
        for text in [
            "",
            "time",
            "$schema",
            "laws[0].alpha_interaction.range",
            "agents[12].positions.explicit[3][1]",
            r#"["a.b"][0]["say \"]\""].plain"#,
        ] {
            let path: Path = text.parse().unwrap();
            assert_eq!(path.to_string(), text);
        }
    }

    #[test]
    fn refuses_half_a_path() {
        for text in ["a..b", "a.", ".a", "a[0]b", "a.[0]"] {
            assert_eq!(
                text.parse::<Path>(),
                Err(PathError::NoName(text.into())),
                "{text}"
            );
        }
        for text in ["a[", "a[]", "a[x]", "a[-1]", "a[0", r#"a["b"#, r#"a["b"x]"#] {
            assert_eq!(
                text.parse::<Path>(),
                Err(PathError::BadBracket(text.into())),
                "{text}"
            );
        }
    }
}
