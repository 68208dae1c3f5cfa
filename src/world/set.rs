//! Values set from outside the file: `--set laws[0].alpha_interaction.range=9`.

use std::fmt;
use std::str::FromStr;

use serde_json::{Map, Value};
use thiserror::Error;

use super::limits::{MOST_BYTES_OF_A_PATH, MOST_STEPS_OF_A_PATH};
use super::path::{Path, PathError, Step};
use super::problem::Problem;
use super::words::{did_you_mean, shorten};

/// A value that replaces, or adds, one in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Override {
    path: Path,
    value: Value,
    text: String,
}

/// Why a text is not an override.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum OverrideError {
    /// Nothing parts the path from the value.
    #[error("`{0}` lacks an equals sign; write path=value, as in time.end=10")]
    NoEquals(String),
    /// Nothing stands before the equals sign.
    #[error("`{0}` lacks a path before its equals sign, as in time.end=10")]
    NoPath(String),
    /// The path leads deeper than any field lies.
    #[error(
        "the path `{path}` has {steps} parts; allowed: at most {MOST_STEPS_OF_A_PATH}, which is \
         deeper than any field lies"
    )]
    TooDeep {
        /// The path, shortened.
        path: String,
        /// How many parts it has.
        steps: usize,
    },
    /// The path is longer than any path to a field.
    #[error("the path `{0}` is too long; allowed: at most {MOST_BYTES_OF_A_PATH} bytes")]
    TooLong(String),
    /// What stands before the equals sign is not a path.
    #[error(transparent)]
    Path(#[from] PathError),
}

impl Override {
    /// The path it sets.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Sets the value, or says why the world has no such place. Objects that are
    /// missing on the way are made, since those left out hold their defaults;
    /// entries of lists are not.
    pub fn apply(&self, world: &mut Value) -> Result<(), Problem> {
        let mut place = world;
        for (done, step) in self.path.0.iter().enumerate() {
            let so_far = || match done {
                0 => "the world".to_owned(),
                _ => format!("`{}`", Path(self.path.0[..done].to_vec())),
            };
            place = match (step, place) {
                (Step::Field(name), Value::Object(fields)) => {
                    let wants_list = matches!(self.path.0.get(done + 1), Some(Step::Entry(_)));
                    if wants_list && !fields.contains_key(name) {
                        // Of a world with more fields than these, most are unknown.
                        let known = fields.keys().map(String::as_str).take(100);
                        let hint = did_you_mean(name, known);
                        let problem = self.problem(format!("{} has no list `{name}`", so_far()));
                        return Err(Problem { hint, ..problem });
                    }
                    let made = || Value::Object(Map::new());
                    fields.entry(name.as_str()).or_insert_with(made)
                }
                (Step::Entry(index), Value::Array(entries)) => match entries.len() {
                    0 => return Err(self.problem(format!("{} is an empty list", so_far()))),
                    length if *index >= length => {
                        let what = format!("{} has no entry {index}", so_far());
                        let allowed = match length {
                            1 => "0".to_owned(),
                            _ => format!("0 to {}", length - 1),
                        };
                        return Err(self.problem(what).allowed(allowed));
                    }
                    _ => &mut entries[*index],
                },
                (Step::Field(name), other) => {
                    let what = format!(
                        "{} is {}, so it has no field `{name}`",
                        so_far(),
                        kind(other)
                    );
                    return Err(self.problem(what));
                }
                (Step::Entry(index), other) => {
                    let what = format!(
                        "{} is {}, so it has no entry {index}",
                        so_far(),
                        kind(other)
                    );
                    return Err(self.problem(what));
                }
            };
        }
        *place = self.value.clone();
        Ok(())
    }

    fn problem(&self, what: String) -> Problem {
        Problem::new(self.path.to_string(), what)
    }
}

impl FromStr for Override {
    type Err = OverrideError;

    /// Reads `path=value`; a value that is not JSON is taken as text.
    fn from_str(text: &str) -> Result<Self, OverrideError> {
        // A quoted name may hold an equals sign, so the path ends at the first one
        // that leaves a path before it.
        let mut ends = text.match_indices('=').map(|(end, _)| end);
        let first = ends
            .next()
            .ok_or_else(|| OverrideError::NoEquals(shorten(text)))?;
        if first > MOST_BYTES_OF_A_PATH {
            return Err(OverrideError::TooLong(shorten(text)));
        }
        let end = std::iter::once(first)
            .chain(ends)
            .take_while(|&end| end <= MOST_BYTES_OF_A_PATH)
            .take(MOST_STEPS_OF_A_PATH)
            .find(|&end| text[..end].parse::<Path>().is_ok())
            .unwrap_or(first);
        let path: Path = text[..end].parse()?;
        if path.0.is_empty() {
            return Err(OverrideError::NoPath(text.into()));
        }
        if path.0.len() > MOST_STEPS_OF_A_PATH {
            return Err(OverrideError::TooDeep {
                path: shorten(&text[..end]),
                steps: path.0.len(),
            });
        }
        let value = &text[end + 1..];
        Ok(Self {
            path,
            value: serde_json::from_str(value).unwrap_or_else(|_| value.into()),
            text: text.to_owned(),
        })
    }
}

impl fmt::Display for Override {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "--set {}", shorten(&self.text))
    }
}

/// What kind of value this is, with its article.
pub(super) fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "a string",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn set(text: &str) -> Result<Value, String> {
        let mut world = json!({"time": {"end": 60}, "laws": [{"a": {"range": 1}}], "none": []});
        let change: Override = text
            .parse()
            .map_err(|error: OverrideError| error.to_string())?;
        change.apply(&mut world).map_err(|problem| problem.what)?;
        Ok(world)
    }

    #[test]
    fn replaces_and_adds() {
        assert_eq!(set("time.end=10").unwrap()["time"], json!({"end": 10}));
        assert_eq!(
            set("laws[0].a.range=8.5").unwrap()["laws"][0]["a"]["range"],
            json!(8.5)
        );
        assert_eq!(
            set("time.step=0.01").unwrap()["time"],
            json!({"end": 60, "step": 0.01})
        );
        assert_eq!(
            set("physics.friction=1").unwrap()["physics"],
            json!({"friction": 1})
        );
        assert_eq!(set("none=[1, 2]").unwrap()["none"], json!([1, 2]));
        assert_eq!(set(r#"["a=b"]=1"#).unwrap()["a=b"], json!(1));
    }

    #[test]
    fn takes_bare_words_as_text() {
        assert_eq!(
            set("description=a = b").unwrap()["description"],
            json!("a = b")
        );
        assert_eq!(set("description=\"5\"").unwrap()["description"], json!("5"));
        assert_eq!(set("description=").unwrap()["description"], json!(""));
    }

    #[test]
    fn refuses_places_that_do_not_exist() {
        let bad = |text| set(text).unwrap_err();
        assert_eq!(bad("laws[1].a=1"), "`laws` has no entry 1");
        assert_eq!(bad("none[0]=1"), "`none` is an empty list");
        assert_eq!(bad("lawz[0].a=1"), "the world has no list `lawz`");
        assert_eq!(
            bad("time.end.x=1"),
            "`time.end` is a number, so it has no field `x`"
        );
        assert_eq!(bad("laws.a=1"), "`laws` is a list, so it has no field `a`");
        assert_eq!(bad("[0]=1"), "the world is an object, so it has no entry 0");
    }

    #[test]
    fn refuses_what_is_no_override() {
        let bad = |text| set(text).unwrap_err();
        assert_eq!(
            bad("time.end"),
            "`time.end` lacks an equals sign; write path=value, as in time.end=10"
        );
        assert_eq!(
            bad("=1"),
            "`=1` lacks a path before its equals sign, as in time.end=10"
        );
        assert_eq!(bad("a..b=1"), "the path `a..b` lacks a name");
        assert_eq!(
            bad("a[x]=1"),
            "the path `a[x]` has a bracket without an index, as in `laws[0]`"
        );
    }
}
