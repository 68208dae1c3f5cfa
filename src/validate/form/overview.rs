//! One row for each claim and for each world, over all worlds of a report.

use super::tally::Tally;
use super::words::{DYNAMICS, dynamics, number, number_or_dash};
use crate::claim::{Reading, Verdict, abouts};
use crate::validate::report::{ClaimReport, ContactReport, Report, WorldReport};
use crate::world::spec::DynamicsName;

/// What a claim came to in all worlds.
#[derive(Debug)]
pub(super) struct ClaimRow<'a> {
    pub(super) claim: &'a str,
    pub(super) source: &'a str,
    pub(super) reading: Reading,
    /// As points and as bodies, in this order.
    pub(super) tallies: [Tally; 2],
    /// Where it is violated.
    pub(super) violated: Vec<Place<'a>>,
    /// The first place where it is judged: numbers of the world, and of the claim in it.
    pub(super) first: (usize, usize),
}

/// A world in which a claim is violated.
#[derive(Debug)]
pub(super) struct Place<'a> {
    /// Numbers of the world, and of the claim in it.
    pub(super) at: (usize, usize),
    pub(super) world: &'a str,
    /// On what, where it is violated on one of two only.
    pub(super) only: Option<DynamicsName>,
}

impl Place<'_> {
    /// " (bodies)", where it is violated on these only.
    pub(super) fn suffix(&self) -> String {
        let only = self.only.map(dynamics);
        only.map_or_else(String::new, |only| format!(" ({only})"))
    }
}

/// What all claims came to that say something somewhere, in the order in which the program lists
/// them; and the names of the others, if any, as a sentence.
pub(super) fn claims(report: &Report) -> (Vec<ClaimRow<'_>>, Option<String>) {
    let silent = |row: &ClaimRow| row.tallies.iter().all(Tally::is_silent);
    let (silent, spoken): (Vec<_>, Vec<_>) = all(report).into_iter().partition(silent);
    let names: Vec<_> = silent.iter().map(|row| row.claim).collect();
    let sentence = (!names.is_empty()).then(|| format!("Met in no world: {}.", names.join(", ")));
    (spoken, sentence)
}

fn all(report: &Report) -> Vec<ClaimRow<'_>> {
    let mut rows: Vec<ClaimRow> = Vec::new();
    for (w, world) in report.worlds.iter().enumerate() {
        for (c, claim) in world.claims.iter().enumerate() {
            let index = match rows.iter().position(|row| row.claim == claim.claim) {
                Some(index) => index,
                None => {
                    rows.push(ClaimRow {
                        claim: &claim.claim,
                        source: &claim.source,
                        reading: claim.reading,
                        tallies: [Tally::default(); 2],
                        violated: Vec::new(),
                        first: (w, c),
                    });
                    rows.len() - 1
                }
            };
            add(&mut rows[index], (w, c), &world.world, claim);
        }
    }
    let names: Vec<_> = abouts().into_iter().map(|about| about.name).collect();
    // A claim that this program does not know comes last.
    rows.sort_by_key(|row| {
        let known = names.iter().position(|name| *name == row.claim);
        known.unwrap_or(names.len())
    });
    rows
}

fn add<'a>(row: &mut ClaimRow<'a>, at: (usize, usize), world: &'a str, claim: &'a ClaimReport) {
    let mut on = Vec::new();
    for run in &claim.findings {
        for (tally, dynamics) in row.tallies.iter_mut().zip(DYNAMICS) {
            if run.dynamics == dynamics {
                *tally = *tally + Tally::from(run);
            }
        }
        if run.finding.verdict == Verdict::Violated {
            on.push(run.dynamics);
        }
    }
    let only = match on.as_slice() {
        [] => return,
        [one] if claim.findings.len() > 1 => Some(*one),
        _ => None,
    };
    row.violated.push(Place { at, world, only });
}

/// What [`contact_rows`] are headed by, behind the world.
pub(super) const CONTACT_COLUMNS: [&str; 7] = [
    "radius", "theory", "points", "bodies", "contact", "before", "at end",
];

/// What the columns of [`contact_rows`] mean.
pub(super) const CONTACT_LEGEND: &str = "radius: that of the bodies; theory, points, bodies: the \
     largest radius without contact, as the sharpest claim has it, and as seen; contact: time of \
     the first; before, at end: how far bodies depart from points before it, and at the end.";

/// What bodies change in each world that was run with bodies, by columns.
pub(super) fn contact_rows(report: &Report) -> Vec<(usize, &WorldReport, [String; 7])> {
    let rows = report.worlds.iter().enumerate();
    rows.filter_map(|(w, world)| Some((w, world, contact_cells(world.contact.as_ref()?))))
        .collect()
}

fn contact_cells(contact: &ContactReport) -> [String; 7] {
    let excluded = contact.exclusions.iter().map(|it| it.radius);
    let departure = contact.departure.as_ref();
    [
        number(contact.radius),
        number_or_dash(excluded.max_by(f64::total_cmp)),
        number_or_dash(contact.points_radius),
        number_or_dash(contact.bodies_radius),
        (contact.first.as_ref()).map_or("none".to_owned(), |it| number(it.time)),
        number_or_dash(departure.map(|it| it.before_contact)),
        number_or_dash(departure.map(|it| it.at_end)),
    ]
}
