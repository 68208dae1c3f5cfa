//! A report as one HTML page that needs nothing else.

mod claim;
mod world;

use super::markup::{element, escape, row, table};
use super::overview::{self, CONTACT_COLUMNS, CONTACT_LEGEND, ClaimRow};
use super::tally::Tally;
use super::words::{plural, reading};
use crate::validate::report::Report;

const STYLE: &str = include_str!("style.css");

const LEGEND: &str = "Margins say how far a verdict is from another: of a bound the least \
     distance from it, as a share; of a limit 1 less what is left in the end; negative where it \
     fails. \u{201c}Not met\u{201d} and \u{201c}undecided\u{201d} are no passes: there the claim says nothing of the run, or the \
     run is too short to tell.";

/// A report as one HTML page with the plots that show each verdict. It needs neither scripts
/// nor other files, follows the reader's choice of light or dark, and is well-formed XML.
pub fn html(report: &Report) -> String {
    let total = Tally::of(report);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>Validation</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <h1>Validation</h1>\n<p>{}, by {}.</p>\n{}\n<p><small>{LEGEND}</small></p>\n",
        plural(report.worlds.len(), "world"),
        escape(&report.program),
        verdict_on_all(total)
    );
    if report.worlds.len() > 1 {
        out += &overview(report);
        out += &worlds(report);
    }
    for (w, world) in report.worlds.iter().enumerate() {
        out += &world::section(world, &world_id(w));
    }
    out + "</body>\n</html>\n"
}

fn verdict_on_all(total: Tally) -> String {
    let class = if total.unexpected == 0 {
        "soft"
    } else {
        "unexpected"
    };
    format!("<p class=\"{class}\">{}.</p>", escape(&total.to_string()))
}

/// The anchor of a world.
fn world_id(world: usize) -> String {
    format!("w{world}")
}

/// The anchor of a claim in a world.
fn claim_id(world: &str, claim: usize) -> String {
    format!("{world}c{claim}")
}

fn link(id: &str, text: &str) -> String {
    format!("<a href=\"#{id}\">{}</a>", escape(text))
}

fn overview(report: &Report) -> String {
    let (claims, unmet) = overview::claims(report);
    let rows: String = claims.iter().map(overview_row).collect();
    let headings = ["claim", "reading", "as points", "as bodies", "violated in"];
    let caption = "In how many worlds each claim came to what";
    let mut out = element("h2", "Claims") + &table(caption, &headings, &rows);
    if let Some(unmet) = unmet {
        out += &element("p", &unmet);
    }
    let contacts = overview::contact_rows(report).into_iter();
    let rows: String = contacts
        .map(|(w, world, cells)| {
            let cells = cells.iter().map(|it| escape(it));
            let name = link(&world_id(w), &world.world);
            row(&[name].into_iter().chain(cells).collect::<Vec<_>>())
        })
        .collect();
    if !rows.is_empty() {
        let headings = [&["world"], CONTACT_COLUMNS.as_slice()].concat();
        out += &element("h2", "What bodies change");
        out += &table(CONTACT_LEGEND, &headings, &rows);
    }
    out
}

fn overview_row(claim: &ClaimRow) -> String {
    let at = |(w, c): (usize, usize)| claim_id(&world_id(w), c);
    let name = link(&at(claim.first), claim.claim);
    let tally = |tally: &Tally| match tally.violated {
        0 => escape(&tally.brief()),
        _ => format!("<span class=\"violated\">{}</span>", escape(&tally.brief())),
    };
    let places = claim.violated.iter();
    let places = places.map(|it| link(&at(it.at), it.world) + &escape(&it.suffix()));
    row(&[
        format!("{name}<br/><small>{}</small>", escape(claim.source)),
        reading(claim.reading).to_owned(),
        tally(&claim.tallies[0]),
        tally(&claim.tallies[1]),
        places.collect::<Vec<_>>().join(", "),
    ])
}

/// The worlds, as a way to each of them.
fn worlds(report: &Report) -> String {
    let mut out = element("h2", "Worlds") + "<ul>\n";
    for (w, world) in report.worlds.iter().enumerate() {
        let findings = world.claims.iter().flat_map(|it| &it.findings);
        let tally: Tally = findings.map(Tally::from).sum();
        let name = link(&world_id(w), &world.world);
        out += &format!("<li>{name}: {}</li>\n", escape(&tally.brief()));
    }
    out + "</ul>\n"
}
