//! A report as a Markdown document.

use super::contact;
use super::overview::{self, CONTACT_COLUMNS, CONTACT_LEGEND, ClaimRow};
use super::reasons::{reasons, standing};
use super::silent::{is_silent, silent};
use super::tally::Tally;
use super::words::{DYNAMICS, closest, contacts, dynamics, number, on, plural, reading, verdict};
use crate::claim::Verdict;
use crate::math::digits;
use crate::validate::report::{ClaimReport, JudgedRun, Report, WorldReport};

/// A report as a Markdown document: the overview over all worlds, then each world with what
/// every claim came to and why, and with what bodies change.
pub fn markdown(report: &Report) -> String {
    let mut out = format!(
        "# Validation\n\n{}, by {}. {}.\n",
        plural(report.worlds.len(), "world"),
        escape(&report.program),
        Tally::of(report)
    );
    if report.worlds.len() > 1 {
        out += &overview(report);
    }
    for world in &report.worlds {
        out += &of_world(world);
    }
    out
}

fn overview(report: &Report) -> String {
    let mut out = "\n## Claims\n\n".to_owned();
    out += &row([
        "claim",
        "source",
        "reading",
        "as points",
        "as bodies",
        "violated in",
    ]);
    out += &rule(6);
    let (claims, unmet) = overview::claims(report);
    for claim in claims {
        out += &overview_row(&claim);
    }
    if let Some(unmet) = unmet {
        out += &format!("\n{}\n", escape(&unmet));
    }
    let contacts = overview::contact_rows(report);
    if !contacts.is_empty() {
        out += "\n## What bodies change\n\n";
        let heading = [&["world"], CONTACT_COLUMNS.as_slice()].concat();
        out += &row(heading);
        out += &rule(8);
        for (_, world, cells) in contacts {
            let cells = cells.iter().map(String::as_str);
            out += &row([code(&world.world).as_str()].into_iter().chain(cells));
        }
        out += &format!("\n{CONTACT_LEGEND}\n");
    }
    out
}

fn overview_row(claim: &ClaimRow) -> String {
    let places = claim.violated.iter();
    let places: Vec<_> = places
        .map(|it| format!("{}{}", code(it.world), it.suffix()))
        .collect();
    let [points, bodies] = claim.tallies.map(|tally| match tally.violated {
        0 => tally.brief(),
        _ => format!("**{}**", tally.brief()),
    });
    row([
        code(claim.claim).as_str(),
        &escape(claim.source),
        reading(claim.reading),
        &points,
        &bodies,
        &places.join(", "),
    ])
}

fn of_world(world: &WorldReport) -> String {
    let mut out = format!("\n## {}\n\n", escape(&world.world));
    if !world.description.is_empty() {
        out += &format!("{}\n\n", escape(&world.description));
    }
    let agents = plural(world.agents, "agent");
    let end = number(world.end);
    out += &format!("{agents} in {}-D to time {end}.\n\n", world.dimension);
    for run in &world.runs {
        let method = escape(&run.method);
        let states = plural(run.observations, "state");
        let closest = run
            .closest
            .as_ref()
            .map(|it| format!("; closest {}", closest(it)));
        out += &format!(
            "- **{}** {method}; {states}; {}{}\n",
            dynamics(run.dynamics),
            contacts(run),
            closest.unwrap_or_default()
        );
    }
    if world.claims.is_empty() {
        out += "\nNo claim has anything to say of this world.\n";
    } else if !world.claims.iter().all(is_silent) {
        out.push('\n');
        out += &row(["claim", "reading", "points", "bodies", "why"]);
        out += &rule(5);
    }
    for claim in world.claims.iter().filter(|it| !is_silent(it)) {
        out += &claim_row(claim);
    }
    let silent = silent(&world.claims);
    if !silent.is_empty() {
        out.push('\n');
    }
    for group in silent {
        let names: Vec<_> = group.claims.iter().map(|it| code(it)).collect();
        let reason = escape(group.reason);
        out += &format!(
            "- {}: {reason}: {}\n",
            escape(group.paper),
            names.join(", ")
        );
    }
    if let Some(contact) = &world.contact {
        out += "\n### Bodies against points\n\n";
        for (about, text) in contact::lines(contact) {
            out += &format!("- {about}: {}\n", escape(&text));
        }
    }
    out
}

fn claim_row(claim: &ClaimReport) -> String {
    let cells = DYNAMICS.map(|name| on(claim, name).map_or("–".to_owned(), cell));
    let why = reasons(claim).into_iter();
    let why: Vec<_> = why
        .map(|it| format!("{}: {}", it.about, escape(it.text)))
        .collect();
    row([
        code(&claim.claim).as_str(),
        reading(claim.reading),
        &cells[0],
        &cells[1],
        &why.join("<br>"),
    ])
}

/// Verdict and margin; bold where it is violated, or not as expected.
fn cell(run: &JudgedRun) -> String {
    let margin = run.finding.margin.map(|it| format!(" {}", digits(it, 3)));
    let word = verdict(run.finding.verdict);
    let word = match run.finding.verdict == Verdict::Violated || !run.as_expected {
        true => format!("**{word}**"),
        false => word.to_owned(),
    };
    let standing = if run.as_expected {
        String::new()
    } else {
        standing(run)
    };
    format!("{word}{}{standing}", margin.unwrap_or_default())
}

fn row<'a>(cells: impl IntoIterator<Item = &'a str>) -> String {
    let cells: Vec<_> = cells.into_iter().collect();
    format!("| {} |\n", cells.join(" | "))
}

fn rule(columns: usize) -> String {
    format!("|{}\n", "---|".repeat(columns))
}

/// Text in which nothing is taken for a mark.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::new();
    for c in text
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
        .chars()
    {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '#' | '~' | '$' => out.extend(['\\', c]),
            _ => out.push(c),
        }
    }
    out
}

/// A name in the letters of code, where it has no letters that these cannot hold.
fn code(name: &str) -> String {
    match name.contains(['`', '|', '\n', '\r']) {
        true => escape(name),
        false => format!("`{name}`"),
    }
}
