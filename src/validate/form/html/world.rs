//! The section of one world.

use super::super::contact;
use super::super::figures;
use super::super::markup::{element, escape, row, table};
use super::super::plot;
use super::super::silent::is_silent;
use super::super::words::{DYNAMICS, closest, contacts, dynamics, number, on, plural, reading};
use super::claim::{details, verdict};
use super::{claim_id, link};
use crate::validate::report::{ClaimReport, ContactReport, WorldReport};

/// A world: its runs, its claims, what bodies change, and each claim with all that was found.
pub(super) fn section(world: &WorldReport, id: &str) -> String {
    let agents = plural(world.agents, "agent");
    let end = number(world.end);
    let mut out = format!(
        "<section id=\"{id}\">\n{}\n{}\n{}\n",
        element("h2", &world.world),
        element("p", &world.description),
        element(
            "p",
            &format!("{agents} in {}-D to time {end}.", world.dimension)
        )
    );
    out += &runs(world);
    out += &claims(world, id);
    if let Some(contact) = &world.contact {
        out += &bodies_against_points(world, contact, id);
    }
    let claims = world.claims.iter().enumerate();
    let (silent, spoken): (Vec<_>, Vec<_>) = claims.partition(|(_, claim)| is_silent(claim));
    let each = |claims: Vec<(usize, &ClaimReport)>| -> String {
        let claims = claims.into_iter();
        claims
            .map(|(c, claim)| details(world, claim, &claim_id(id, c)))
            .collect()
    };
    if !spoken.is_empty() {
        out += &element("h3", "Each claim");
    }
    out += &each(spoken);
    if !silent.is_empty() {
        let summary = format!("Claims that say nothing of this world: {}", silent.len());
        out += &format!(
            "<details>\n{}\n{}</details>\n",
            element("summary", &summary),
            each(silent)
        );
    }
    out + "</section>\n"
}

fn runs(world: &WorldReport) -> String {
    let rows = world.runs.iter().map(|run| {
        row(&[
            dynamics(run.dynamics).to_owned(),
            escape(&run.method),
            run.observations.to_string(),
            escape(&contacts(run)),
            run.closest.as_ref().map_or_else(String::new, closest),
        ])
    });
    let headings = ["run", "method", "states", "contacts", "closest agents"];
    table("The runs", &headings, &rows.collect::<String>())
}

fn claims(world: &WorldReport, id: &str) -> String {
    if world.claims.is_empty() {
        return element("p", "No claim has anything to say of this world.");
    }
    if world.claims.iter().all(is_silent) {
        return String::new();
    }
    let spoken = world.claims.iter().enumerate();
    let spoken = spoken.filter(|(_, claim)| !is_silent(claim));
    let rows = spoken.map(|(c, claim)| {
        let mut cells = vec![
            link(&claim_id(id, c), &claim.claim),
            reading(claim.reading).to_owned(),
        ];
        cells.extend(DYNAMICS.map(|name| on(claim, name).map_or("–".to_owned(), verdict)));
        row(&cells)
    });
    let headings = ["claim", "reading", "points", "bodies"];
    table(
        "The claims, with margins",
        &headings,
        &rows.collect::<String>(),
    )
}

fn bodies_against_points(world: &WorldReport, contact: &ContactReport, id: &str) -> String {
    let mut out = element("h3", "Bodies against points") + "<dl>\n";
    for (about, text) in contact::lines(contact) {
        out += &format!("{}{}\n", element("dt", &about), element("dd", &text));
    }
    out += "</dl>\n";
    if let Some(departure) = &contact.departure {
        let plot = figures::of_departure(world, departure, id);
        out += &figure(&plot).unwrap_or_default();
    }
    out
}

/// A plot with its caption; nothing where there is nothing to show.
pub(super) fn figure(plot: &plot::Plot) -> Option<String> {
    let drawn = plot::svg(plot)?;
    let caption = element("figcaption", &format!("{} over time", plot.name));
    Some(format!("<figure>\n{drawn}{caption}\n</figure>\n"))
}
