//! The claims themselves, for a terminal.

use super::words::{paper, reading, wrap};
use crate::claim::About;

/// A list of claims, by paper: name, reading, source and statement.
pub fn list(claims: &[&About]) -> String {
    let mut out = String::new();
    let mut last = None;
    let longest = claims
        .iter()
        .map(|about| paper(about.name).1.chars().count());
    let width = longest.max().unwrap_or(0);
    for about in claims {
        let (folder, name) = paper(about.name);
        if last.replace(folder) != Some(folder) {
            let gap = if out.is_empty() { "" } else { "\n" };
            out += &format!("{gap}{folder}\n");
        }
        let head = format!("  {name:width$}  {:<9}  ", reading(about.reading));
        out += &wrap(&head, 6, about.source);
        out += &wrap("      ", 6, about.statement);
    }
    out
}

/// All that there is to say of one claim.
pub fn describe(about: &About) -> String {
    let mut out = format!("{}\n", about.name);
    for (label, text) in [
        ("source", about.source),
        ("reading", reading(about.reading)),
        ("statement", about.statement),
        ("hypotheses", about.hypotheses),
        ("measured", about.measured),
        ("tolerance", about.tolerance),
    ] {
        out += &wrap(&format!("  {label:<10}  "), 14, text);
    }
    out
}
