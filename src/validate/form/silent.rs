//! Claims that say nothing of a world, gathered: most of other papers.

use super::words::paper;
use crate::claim::Verdict;
use crate::validate::report::ClaimReport;

/// Claims of one paper whose hypotheses are not met, for one reason.
#[derive(Debug, PartialEq)]
pub(super) struct Silent<'a> {
    pub(super) paper: &'a str,
    pub(super) reason: &'a str,
    /// Their names without the paper.
    pub(super) claims: Vec<&'a str>,
}

/// Whether no run meets the hypotheses of a claim, and the world expects nothing else.
pub(super) fn is_silent(claim: &ClaimReport) -> bool {
    claim.findings.iter().all(|run| {
        run.finding.verdict == Verdict::HypothesisNotMet
            && run.expected.is_none()
            && run.finding.reason == claim.findings[0].finding.reason
    })
}

/// The claims that say nothing, by paper and reason in the order in which these come.
pub(super) fn silent(claims: &[ClaimReport]) -> Vec<Silent<'_>> {
    let mut groups: Vec<Silent<'_>> = Vec::new();
    for claim in claims.iter().filter(|claim| is_silent(claim)) {
        let (of, name) = paper(&claim.claim);
        let reason = claim.findings[0].finding.reason.as_str();
        let known = groups
            .iter_mut()
            .find(|it| it.paper == of && it.reason == reason);
        match known {
            Some(group) => group.claims.push(name),
            None => groups.push(Silent {
                paper: of,
                reason,
                claims: vec![name],
            }),
        }
    }
    groups
}
