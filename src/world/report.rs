//! What is wrong with one world, said where it stands.

use std::collections::HashMap;
use std::fmt;
use std::ops::Range;

use ariadne::{Color, Config, IndexType, Label, ReportKind, Source};

use super::limits::MOST_PROBLEMS;
use super::path::{Path, Step};
use super::problem::Problem;
use super::set::Override;
use super::span::{Lines, Spots};
use super::syntax::{self, Found};
use super::words::shorten;

/// Problems beyond this number are counted, not shown.
const SHOWN: usize = 20;

/// Lines longer than this are not drawn: nobody could read them.
const WIDEST: usize = 160;

/// Everything that is wrong with one world, in the order of its file.
///
/// `Display` gives one line for each problem; [`render`](Self::render) shows the
/// lines of the file as well.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    name: String,
    text: String,
    entries: Vec<Entry>,
}

#[derive(Debug, Clone, PartialEq)]
struct Entry {
    place: Place,
    problem: Problem,
}

/// Where the value with a problem comes from.
#[derive(Debug, Clone, PartialEq)]
enum Place {
    /// An override, as the user gave it; whether it sets this very value.
    Override { text: String, itself: bool },
    /// Bytes of the file.
    File(Range<usize>),
    /// The default of something that these bytes, an object of the file, lack.
    Default(Range<usize>),
    /// Nowhere in particular.
    Nowhere,
}

impl Report {
    /// Places problems by their paths: on an override that sets the value, or in
    /// the file, or on the innermost object of the file that should hold it.
    pub(super) fn placed(
        name: &str,
        text: &str,
        overrides: &[Override],
        problems: Vec<Problem>,
    ) -> Self {
        let tree = syntax::tree(text).ok();
        let mut spots = tree.as_ref().map(Spots::new);
        let set = Overridden::by(overrides);
        let mut place = |problem: &Problem| {
            let Ok(path) = problem.path.parse::<Path>() else {
                return Place::Nowhere;
            };
            if let Some(set) = set.around(&path) {
                return on_override(set, &path);
            }
            let Some(spot) = spots.as_mut().map(|spots| spots.find(&path)) else {
                return Place::Nowhere;
            };
            match set.inside(&path) {
                Some(set) if !spot.whole => on_override(set, &path),
                None if !spot.whole => Place::Default(spot.value),
                _ if problem.name_is_wrong => Place::File(spot.name.unwrap_or(spot.value)),
                _ => Place::File(spot.value),
            }
        };
        let entries = problems.into_iter().map(|problem| Entry {
            place: place(&problem),
            problem,
        });
        Self::sorted(name, text, entries.collect())
    }

    /// Places problems by the bytes that they are about.
    pub(super) fn found(name: &str, text: &str, found: Vec<Found>) -> Self {
        let entries = found.into_iter().map(|(problem, bytes)| Entry {
            place: Place::File(bytes),
            problem,
        });
        Self::sorted(name, text, entries.collect())
    }

    fn sorted(name: &str, text: &str, mut entries: Vec<Entry>) -> Self {
        entries.sort_by_key(|entry| match &entry.place {
            Place::File(bytes) | Place::Default(bytes) => Some(bytes.start),
            Place::Override { .. } | Place::Nowhere => None,
        });
        Self {
            name: name.to_owned(),
            text: text.to_owned(),
            entries,
        }
    }

    /// The problems, in the order of the file; those of overrides come first.
    pub fn problems(&self) -> impl ExactSizeIterator<Item = &Problem> {
        self.entries.iter().map(|entry| &entry.problem)
    }

    /// The problems for a terminal, each with the line of the file that it is
    /// about, in colour or not.
    pub fn render(&self, color: bool) -> String {
        let mut out = String::new();
        let mut source = (self.name.as_str(), Source::from(self.text.as_str()));
        let lines = Lines::new(&self.text);
        for entry in self.shown() {
            let drawn = self.draw(entry, color, &mut source);
            out += &drawn.unwrap_or_else(|| format!("Error: {}\n", self.line(&lines, entry)));
        }
        if let Some(rest) = self.rest() {
            out += &rest;
            out.push('\n');
        }
        out
    }

    /// One problem with its line of the file; nothing where it has none, or one
    /// that is too long.
    fn draw<'a>(
        &'a self,
        entry: &Entry,
        color: bool,
        source: &mut (&'a str, Source<&str>),
    ) -> Option<String> {
        let (Place::File(bytes) | Place::Default(bytes)) = &entry.place else {
            return None;
        };
        let bytes = self.first_line(bytes);
        let line = self.line_around(bytes.start);
        if line.is_empty() || line.len() > WIDEST {
            return None;
        }
        let problem = &entry.problem;
        let config = Config::new()
            .with_color(color)
            .with_index_type(IndexType::Byte);
        let at = (self.name.as_str(), bytes);
        let subject = self.subject(entry);
        // Without a text of its own, the label would not be drawn.
        let (headline, label) = match subject.is_empty() {
            true => (problem.what.as_str(), "here"),
            false => (subject.as_str(), problem.what.as_str()),
        };
        let label = Label::new(at.clone()).with_message(label);
        let mut report = ariadne::Report::build(ReportKind::Error, at)
            .with_config(config)
            .with_message(headline)
            .with_label(label.with_color(Color::Red));
        if let Some(allowed) = extra_allowed(problem) {
            report = report.with_note(format!("allowed: {allowed}"));
        }
        if let Some(hint) = &problem.hint {
            report = report.with_help(hint);
        }
        let mut out = Vec::new();
        report.finish().write(&mut *source, &mut out).ok()?;
        String::from_utf8(out).ok()
    }

    /// One problem on one line, with everything that is known about it.
    fn line(&self, lines: &Lines, entry: &Entry) -> String {
        let mut line = match &entry.place {
            Place::File(bytes) | Place::Default(bytes) => {
                let (line, column) = lines.place(bytes.start);
                format!("{}:{line}:{column}: ", self.name)
            }
            Place::Override { text, .. } => format!("{}: {text}: ", self.name),
            Place::Nowhere => format!("{}: ", self.name),
        };
        let subject = self.subject(entry);
        if !subject.is_empty() {
            line += &format!("{subject}: ");
        }
        line += &entry.problem.what;
        if let Some(allowed) = extra_allowed(&entry.problem) {
            line += &format!("; allowed: {allowed}");
        }
        if let Some(hint) = &entry.problem.hint {
            line += &format!("; {hint}");
        }
        line
    }

    /// The path, and the value as written where it is short enough to help.
    fn subject(&self, entry: &Entry) -> String {
        let path = &entry.problem.path;
        match &entry.place {
            Place::Override { itself: true, .. } => String::new(),
            Place::Default(_) => format!("{path} (by default)"),
            Place::File(bytes) if !entry.problem.name_is_wrong && !path.is_empty() => {
                match self.text.get(bytes.clone()) {
                    Some(value) if !value.contains('{') => {
                        format!("{path} = {}", shorten(value))
                    }
                    _ => path.clone(),
                }
            }
            _ => path.clone(),
        }
    }

    /// The bytes up to the end of their line; just the bracket of what goes on.
    fn first_line(&self, bytes: &Range<usize>) -> Range<usize> {
        match self.text.get(bytes.clone()) {
            Some(value) if value.contains('\n') => bytes.start..bytes.start + 1,
            _ => bytes.clone(),
        }
    }

    /// The line that holds a byte.
    fn line_around(&self, byte: usize) -> &str {
        let byte = self.text.floor_char_boundary(byte);
        let start = self.text[..byte]
            .rfind('\n')
            .map_or(0, |newline| newline + 1);
        let end = self.text[byte..]
            .find('\n')
            .map_or(self.text.len(), |length| byte + length);
        &self.text[start..end]
    }

    fn shown(&self) -> &[Entry] {
        &self.entries[..self.entries.len().min(SHOWN)]
    }

    /// How many problems are not shown.
    fn rest(&self) -> Option<String> {
        match self.entries.len() - self.shown().len() {
            0 => None,
            // Who looked stopped there.
            _ if self.entries.len() >= MOST_PROBLEMS => Some(format!(
                "{}: and more than {} others",
                self.name,
                MOST_PROBLEMS - SHOWN - 1
            )),
            rest => Some(format!("{}: and {rest} more", self.name)),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let places = Lines::new(&self.text);
        let lines = self.shown().iter().map(|entry| self.line(&places, entry));
        let lines: Vec<String> = lines.chain(self.rest()).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl std::error::Error for Report {}

/// What overrides set, to be looked up.
struct Overridden<'a> {
    overrides: &'a [Override],
    /// The place of the last override of each path.
    at: HashMap<&'a [Step], usize>,
    /// The place of the last override of something that a path leads to.
    below: HashMap<&'a [Step], usize>,
}

impl<'a> Overridden<'a> {
    fn by(overrides: &'a [Override]) -> Self {
        let (mut at, mut below) = (HashMap::new(), HashMap::new());
        for (index, set) in overrides.iter().enumerate() {
            let steps = set.path().0.as_slice();
            at.insert(steps, index);
            below.extend((0..=steps.len()).map(|length| (&steps[..length], index)));
        }
        Self {
            overrides,
            at,
            below,
        }
    }

    /// The last override that sets the value at a path, or something that holds it.
    fn around(&self, path: &Path) -> Option<&'a Override> {
        let holders = (0..=path.0.len()).map(|length| &path.0[..length]);
        let last = holders.filter_map(|steps| self.at.get(steps)).max()?;
        Some(&self.overrides[*last])
    }

    /// The last override that sets something inside the value at a path.
    fn inside(&self, path: &Path) -> Option<&'a Override> {
        let last = self.below.get(path.0.as_slice())?;
        Some(&self.overrides[*last])
    }
}

fn on_override(set: &Override, path: &Path) -> Place {
    Place::Override {
        text: set.to_string(),
        itself: set.path() == path,
    }
}

/// What is allowed, unless the problem itself says so already.
fn extra_allowed(problem: &Problem) -> Option<&str> {
    let allowed = problem.allowed.as_deref()?;
    (!problem.what.contains(allowed)).then_some(allowed)
}
