//! A report as text for a terminal.

use super::contact;
use super::grid::aligned;
use super::overview::{self, CONTACT_COLUMNS, CONTACT_LEGEND, ClaimRow};
use super::reasons::reasons;
use super::silent::{is_silent, silent};
use super::tally::Tally;
use super::words::{
    DYNAMICS, WIDTH, closest, contacts, dynamics, number, on, paper, plural, reading, verdict, wrap,
};
use crate::math::digits;
use crate::validate::report::{ClaimReport, ContactReport, Report, WorldReport};
use crate::world::spec::DynamicsName;

/// A report as text for a terminal, in lines of 100 characters: world by world what each claim
/// came to on points and on bodies, with margins, and the reason wherever it does not just
/// hold; then what bodies change. Findings that are not as expected are marked with "!". Of
/// several worlds there is an overview in the end; the last line counts the findings.
pub fn table(report: &Report) -> String {
    let mut out = String::new();
    for world in &report.worlds {
        out += &of_world(world);
        out.push('\n');
    }
    if report.worlds.len() > 1 {
        out += &overview(report);
        out.push('\n');
    }
    let total = Tally::of(report);
    out += &wrap("", 0, &total.to_string());
    out
}

fn of_world(world: &WorldReport) -> String {
    let agents = plural(world.agents, "agent");
    let mut out = format!(
        "{}: {agents} in {}-D to time {}\n",
        world.world,
        world.dimension,
        number(world.end)
    );
    for run in &world.runs {
        let mut text = format!(
            "{}; {}; {}",
            run.method,
            plural(run.observations, "state"),
            contacts(run)
        );
        if let Some(seen) = &run.closest {
            text += &format!("; closest {}", closest(seen));
        }
        out += &wrap(&format!("  {}  ", dynamics(run.dynamics)), 10, &text);
    }
    out.push('\n');
    if world.claims.is_empty() {
        out += "  no claim has anything to say of this world\n";
    }
    out += &claims(&world.claims);
    if let Some(contact) = &world.contact {
        out.push('\n');
        out += &bodies_against_points(contact);
    }
    out
}

/// One row for each claim, below a heading for each paper.
fn claims(claims: &[ClaimReport]) -> String {
    let row = |claim: &ClaimReport| {
        let mut row = vec![
            format!("    {}", paper(&claim.claim).1),
            reading(claim.reading).to_owned(),
        ];
        row.extend(DYNAMICS.map(|name| cell(claim, name)));
        row
    };
    let spoken: Vec<_> = claims.iter().filter(|it| !is_silent(it)).collect();
    let mut rows = Vec::new();
    if !spoken.is_empty() {
        rows.push(
            ["  claim", "reading", "points", "bodies"]
                .map(str::to_owned)
                .to_vec(),
        );
    }
    rows.extend(spoken.iter().copied().map(row));
    let mut lines = aligned(&rows).into_iter();
    let mut out = lines.next().unwrap_or_default();
    let mut last = None;
    for (claim, line) in spoken.into_iter().zip(lines) {
        out += &paper_heading(&claim.claim, &mut last);
        out += &line;
        for reason in reasons(claim) {
            out += &wrap(&format!("        {}: ", reason.about), 10, reason.text);
        }
    }
    for group in silent(claims) {
        let names = group.claims.join(", ");
        let text = format!("{}: {}: {names}", group.paper, group.reason);
        out += &wrap("  ", 6, &text);
    }
    out
}

/// A line with the paper of a claim, where it is another one than before.
fn paper_heading<'a>(claim: &'a str, last: &mut Option<&'a str>) -> String {
    let paper = paper(claim).0;
    match last.replace(paper) {
        Some(before) if before == paper => String::new(),
        _ => format!("  {paper}\n"),
    }
}

/// Verdict, margin, and a mark where it is not as expected.
fn cell(claim: &ClaimReport, name: DynamicsName) -> String {
    let Some(run) = on(claim, name) else {
        return "–".to_owned();
    };
    let margin = run.finding.margin.map_or(String::new(), |it| digits(it, 3));
    let mark = if run.as_expected { ' ' } else { '!' };
    format!("{:<9} {margin:>8} {mark}", verdict(run.finding.verdict))
}

fn bodies_against_points(contact: &ContactReport) -> String {
    let mut out = "  bodies against points\n".to_owned();
    let mut last = String::new();
    for (about, text) in contact::lines(contact) {
        let label = if about == last { "" } else { about.as_str() };
        out += &wrap(&format!("    {label:<26}  "), 32, &text);
        last = about;
    }
    out
}

fn overview(report: &Report) -> String {
    let mut out = format!(
        "{}\n{}\n",
        plural(report.worlds.len(), "world"),
        "─".repeat(WIDTH)
    );
    let (rows, unmet) = overview::claims(report);
    let heading = |cells: [&str; 4]| cells.map(str::to_owned).to_vec();
    let counts = "holds viol. unmet undec.";
    let mut cells = vec![
        heading(["", "", "points", "bodies"]),
        heading(["  claim", "reading", counts, counts]),
    ];
    cells.extend(rows.iter().map(overview_row));
    let mut lines = aligned(&cells).into_iter();
    out.extend(lines.by_ref().take(2));
    let mut last = None;
    for (row, line) in rows.iter().zip(lines) {
        out += &paper_heading(row.claim, &mut last);
        out += &line;
        if !row.violated.is_empty() {
            let names = row
                .violated
                .iter()
                .map(|it| format!("{}{}", it.world, it.suffix()));
            let names: Vec<_> = names.collect();
            out += &wrap("        violated in ", 10, &names.join(", "));
        }
    }
    if let Some(unmet) = unmet {
        out += &wrap("  ", 4, &unmet);
    }
    let contacts = overview::contact_rows(report);
    if !contacts.is_empty() {
        out += "\n  what bodies change\n";
        let heading = CONTACT_COLUMNS.map(|it| format!("{it:>8}"));
        let mut cells = vec![[vec!["  world".to_owned()], heading.to_vec()].concat()];
        cells.extend(contacts.iter().map(|(_, world, columns)| {
            let columns = columns.each_ref().map(|it| format!("{it:>8}"));
            [vec![format!("    {}", world.world)], columns.to_vec()].concat()
        }));
        out += &aligned(&cells).concat();
        out += &wrap("    ", 4, CONTACT_LEGEND);
    }
    out
}

fn overview_row(row: &ClaimRow) -> Vec<String> {
    let count = |count: usize| match count {
        0 => "·".to_owned(),
        _ => count.to_string(),
    };
    let tally = |tally: &Tally| {
        let [holds, violated] = [tally.holds, tally.violated].map(count);
        let [unmet, undecided] = [tally.unmet, tally.undecided].map(count);
        format!("{holds:>5} {violated:>5} {unmet:>5} {undecided:>6}")
    };
    let mut cells = vec![
        format!("    {}", paper(row.claim).1),
        reading(row.reading).to_owned(),
    ];
    cells.extend(row.tallies.iter().map(tally));
    cells
}
