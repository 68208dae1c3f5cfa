//! Findings, counted.

use std::fmt;
use std::iter::Sum;
use std::ops::Add;

use super::words::plural;
use crate::claim::Verdict;
use crate::validate::report::{JudgedRun, Report};

/// How many findings came to what.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Tally {
    pub(super) holds: usize,
    pub(super) violated: usize,
    pub(super) violated_as_expected: usize,
    pub(super) unmet: usize,
    pub(super) undecided: usize,
    pub(super) unexpected: usize,
}

impl Tally {
    /// All findings of a report.
    pub(super) fn of(report: &Report) -> Self {
        let claims = report.worlds.iter().flat_map(|world| &world.claims);
        claims.flat_map(|it| &it.findings).map(Self::from).sum()
    }

    /// Whether nothing was found but hypotheses that are not met, as was to be expected.
    pub(super) fn is_silent(&self) -> bool {
        let unmet = Self {
            unmet: self.unmet,
            ..Self::default()
        };
        *self == unmet
    }

    pub(super) fn findings(self) -> usize {
        self.holds + self.violated + self.unmet + self.undecided
    }

    /// What there is of it, in words, violations first: "1 violated, 3 hold".
    pub(super) fn brief(self) -> String {
        let parts = [
            (self.violated, "violated"),
            (self.holds, if self.holds == 1 { "holds" } else { "hold" }),
            (self.undecided, "undecided"),
            (self.unmet, "not met"),
        ];
        let parts = parts.into_iter().filter(|(count, _)| *count > 0);
        let parts: Vec<_> = parts.map(|(n, what)| format!("{n} {what}")).collect();
        match parts.is_empty() {
            true => "–".to_owned(),
            false => parts.join(", "),
        }
    }
}

impl From<&JudgedRun> for Tally {
    fn from(run: &JudgedRun) -> Self {
        let mut one = Self::default();
        match run.finding.verdict {
            Verdict::Holds => one.holds = 1,
            Verdict::Violated => {
                one.violated = 1;
                one.violated_as_expected = usize::from(run.as_expected);
            }
            Verdict::HypothesisNotMet => one.unmet = 1,
            Verdict::Undecided => one.undecided = 1,
        }
        one.unexpected = usize::from(!run.as_expected);
        one
    }
}

impl Add for Tally {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            holds: self.holds + other.holds,
            violated: self.violated + other.violated,
            violated_as_expected: self.violated_as_expected + other.violated_as_expected,
            unmet: self.unmet + other.unmet,
            undecided: self.undecided + other.undecided,
            unexpected: self.unexpected + other.unexpected,
        }
    }
}

impl Sum for Tally {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}

/// One line that says everything.
impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verb = if self.holds == 1 { "holds" } else { "hold" };
        let hypotheses = match self.unmet {
            1 => "hypothesis",
            _ => "hypotheses",
        };
        write!(
            f,
            "{}: {} {verb}, {} violated ({} expected), {} {hypotheses} not met, {} undecided; \
             {} not as expected",
            plural(self.findings(), "finding"),
            self.holds,
            self.violated,
            self.violated_as_expected,
            self.unmet,
            self.undecided,
            self.unexpected
        )
    }
}
