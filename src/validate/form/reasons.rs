//! Why a claim came to anything but a plain "holds".

use super::words::{dynamics, expectation};
use crate::claim::Verdict;
use crate::validate::report::{ClaimReport, JudgedRun};

/// A reason, and what it is about: "points", "bodies, not as expected (holds)", "both".
#[derive(Debug, PartialEq)]
pub(super) struct Reason<'a> {
    pub(super) about: String,
    pub(super) text: &'a str,
}

/// The reasons that a reader asks for: of all findings but those that hold as expected.
/// Points and bodies share one where it is the same.
pub(super) fn reasons(claim: &ClaimReport) -> Vec<Reason<'_>> {
    let speaks = |run: &&JudgedRun| run.finding.verdict != Verdict::Holds || !run.as_expected;
    let mut runs: Vec<&JudgedRun> = claim.findings.iter().filter(speaks).collect();
    let both = match runs.as_slice() {
        [one, other] => {
            one.finding.reason == other.finding.reason && standing(one) == standing(other)
        }
        _ => false,
    };
    if both {
        runs.truncate(1);
    }
    let reason = |run: &'_ &JudgedRun| match both {
        true => "both",
        false => dynamics(run.dynamics),
    };
    let reasons = runs.iter().map(|run| Reason {
        about: format!("{}{}", reason(run), standing(run)),
        text: &run.finding.reason,
    });
    reasons.collect()
}

/// Whether a finding was expected, where that needs saying.
pub(super) fn standing(run: &JudgedRun) -> String {
    match (run.as_expected, run.expected) {
        (false, expected) => format!(", not as expected ({})", expectation(expected)),
        (true, Some(_)) => ", as expected".to_owned(),
        (true, None) => String::new(),
    }
}
