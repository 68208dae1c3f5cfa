//! Words, numbers and names that all forms share.

use crate::claim::{Reading, Verdict};
use crate::math::digits;
use crate::validate::report::{ClaimReport, ClosestReport, ContactOutcome, JudgedRun, RunReport};
use crate::world::spec::DynamicsName;

/// What moves agents, in the order of the columns.
pub(super) const DYNAMICS: [DynamicsName; 2] = [DynamicsName::Points, DynamicsName::Bodies];

/// Characters in a line of text.
pub(super) const WIDTH: usize = 100;

pub(super) fn dynamics(name: DynamicsName) -> &'static str {
    match name {
        DynamicsName::Points => "points",
        DynamicsName::Bodies => "bodies",
    }
}

pub(super) fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "holds",
        Verdict::Violated => "violated",
        Verdict::HypothesisNotMet => "not met",
        Verdict::Undecided => "undecided",
    }
}

pub(super) fn reading(reading: Reading) -> &'static str {
    match reading {
        Reading::Printed => "printed",
        Reading::Misprinted => "misprinted",
        Reading::Corrected => "corrected",
        Reading::Sharpened => "sharpened",
    }
}

pub(super) fn outcome(outcome: ContactOutcome) -> &'static str {
    match outcome {
        ContactOutcome::ExcludedAndNoneSeen => "theory excludes contacts, and none is seen",
        ContactOutcome::ExcludedYetSeen => {
            "theory excludes contacts, yet some are seen: a defect of the program or of the theorem"
        }
        ContactOutcome::AllowedAndSeen => "theory allows contacts, and some are seen",
        ContactOutcome::AllowedAndNoneSeen => "theory allows contacts, and none is seen",
        ContactOutcome::ObstacleMetFirst => {
            "an obstacle was met first, of which theory says nothing"
        }
    }
}

/// The expectation that a finding is measured by.
pub(super) fn expectation(expected: Option<Verdict>) -> &'static str {
    expected.map_or("no violation", verdict)
}

/// The run of one dynamics among the findings of a claim.
pub(super) fn on(claim: &ClaimReport, dynamics: DynamicsName) -> Option<&JudgedRun> {
    claim.findings.iter().find(|it| it.dynamics == dynamics)
}

/// The paper in the name of a claim, and the rest of it.
pub(super) fn paper(name: &str) -> (&str, &str) {
    name.split_once('/').unwrap_or(("", name))
}

/// The contacts of a run, and when the first began.
pub(super) fn contacts(run: &RunReport) -> String {
    let parts: Vec<String> = [
        (run.agent_contacts, "between agents"),
        (run.obstacle_contacts, "with obstacles"),
    ]
    .into_iter()
    .filter(|(count, _)| *count > 0)
    .map(|(count, what)| format!("{} {what}", plural(count, "contact")))
    .collect();
    match (parts.is_empty(), run.first_contact) {
        (true, None) => "no contact".to_owned(),
        (true, Some(time)) => format!("first contact at time {}", number(time)),
        (false, None) => parts.join(", "),
        (false, Some(time)) => format!("{}, the first at time {}", parts.join(", "), number(time)),
    }
}

/// Two agents when they came closest.
pub(super) fn closest(closest: &ClosestReport) -> String {
    let [i, j] = closest.agents;
    format!(
        "{} between agents {i} and {j} at time {}",
        number(closest.distance),
        number(closest.time)
    )
}

/// So many of a thing.
pub(super) fn plural(count: usize, thing: &str) -> String {
    match count {
        1 => format!("1 {thing}"),
        _ => format!("{count} {thing}s"),
    }
}

/// A number in four digits.
pub(super) fn number(value: f64) -> String {
    digits(value, 4)
}

/// A number that may be missing.
pub(super) fn number_or_dash(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), number)
}

/// A text in lines of [`WIDTH`] characters, the first behind `head`, the rest indented by as
/// many spaces as `indent` says.
pub(super) fn wrap(head: &str, indent: usize, text: &str) -> String {
    let mut out = head.to_owned();
    let mut width = head.chars().count();
    let mut begins = true;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if !begins && width + 1 + length > WIDTH {
            out += &format!("\n{}", " ".repeat(indent));
            width = indent;
        } else if !begins {
            out.push(' ');
            width += 1;
        }
        out += word;
        width += length;
        begins = false;
    }
    out.push('\n');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_no_wider_than_the_page() {
        let text = "wörd ".repeat(60);
        let wrapped = wrap("    head: ", 6, &text);
        let lines: Vec<_> = wrapped.lines().collect();
        assert!(lines.len() > 3);
        assert!(lines.iter().all(|line| line.chars().count() <= WIDTH));
        assert!(lines[1].starts_with("      wörd"));
        assert_eq!(wrapped.split_whitespace().count(), 61);
        // A word that fits in no line keeps its own.
        let long = wrap("", 2, &format!("a {} b", "x".repeat(150)));
        assert_eq!(long.lines().count(), 3);
    }
}
