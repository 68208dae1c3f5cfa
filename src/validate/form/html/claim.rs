//! One claim in one world.

use super::super::figures;
use super::super::markup::{element, escape, row, table};
use super::super::reasons::standing;
use super::super::words::{self, DYNAMICS, dynamics, number, on, reading};
use super::world::figure;
use crate::claim::{Finding, Hypothesis, Verdict};
use crate::math::digits;
use crate::validate::report::{ClaimReport, JudgedRun, WorldReport};

/// A verdict with its margin, and a word where it is not as expected.
pub(super) fn verdict(run: &JudgedRun) -> String {
    let (class, sign) = match run.finding.verdict {
        Verdict::Holds => ("holds", "✓"),
        Verdict::Violated => ("violated", "✗"),
        Verdict::HypothesisNotMet => ("unmet", "∅"),
        Verdict::Undecided => ("undecided", "?"),
    };
    let word = words::verdict(run.finding.verdict);
    let margin = run.finding.margin.map(|it| format!(" {}", digits(it, 3)));
    let unexpected = match run.as_expected {
        true => String::new(),
        false => format!(
            "<span class=\"unexpected\">{}</span>",
            escape(&standing(run))
        ),
    };
    format!(
        "<span class=\"verdict {class}\">{sign} {word}</span>{}{unexpected}",
        margin.unwrap_or_default()
    )
}

/// A claim with everything that was found: open where it is violated or not as expected.
pub(super) fn details(world: &WorldReport, claim: &ClaimReport, id: &str) -> String {
    let striking = |run: &JudgedRun| !run.as_expected || run.finding.verdict == Verdict::Violated;
    let open = match claim.findings.iter().any(striking) {
        true => " open=\"open\"",
        false => "",
    };
    let runs: Vec<&JudgedRun> = DYNAMICS
        .iter()
        .filter_map(|name| on(claim, *name))
        .collect();
    let verdicts = runs.iter().map(|run| {
        format!(
            " <span class=\"soft\">{}</span> {}",
            dynamics(run.dynamics),
            verdict(run)
        )
    });
    let mut out = format!(
        "<details id=\"{id}\"{open}>\n<summary>{}, {}:{}</summary>\n{}\n{}\n",
        element("b", &claim.claim),
        reading(claim.reading),
        verdicts.collect::<Vec<_>>().join(","),
        element("p", &claim.statement),
        element("p", &claim.source).replacen("<p>", "<p class=\"soft\">", 1)
    );
    out += "<dl>\n";
    for run in &runs {
        out += &finding(run);
    }
    out += "</dl>\n";
    out += &hypotheses(&runs);
    out += &quantities(&runs);
    for plot in figures::of_claim(world, claim, id) {
        out += &figure(&plot).unwrap_or_default();
    }
    out + "</details>\n"
}

/// Reason, margin and the closest approach.
fn finding(run: &JudgedRun) -> String {
    let Finding {
        margin,
        closest,
        reason,
        ..
    } = &run.finding;
    let mut text = format!("{}.", reason.trim_end_matches('.'));
    if let Some(margin) = margin {
        text += &format!(" Margin {}.", number(*margin));
    }
    if let Some(time) = closest {
        text += &format!(" Closest to failing at time {}.", number(*time));
    }
    let about = format!("{}{}", dynamics(run.dynamics), standing(run));
    format!("{}{}\n", element("dt", &about), element("dd", &text))
}

fn hypotheses(runs: &[&JudgedRun]) -> String {
    let met = |it: &Hypothesis| {
        let margin = it.margin.map(|margin| format!(" {}", digits(margin, 3)));
        let (class, word) = match it.met {
            true => ("holds", "✓ met"),
            false => ("unmet", "∅ not met"),
        };
        let margin = margin.unwrap_or_default();
        format!("<span class=\"verdict {class}\">{word}</span>{margin}")
    };
    by_name("Hypotheses, with margins", runs, |finding| {
        let all = finding.hypotheses.iter();
        all.map(|it| (it.statement.as_str(), met(it))).collect()
    })
}

fn quantities(runs: &[&JudgedRun]) -> String {
    let value = |value: Option<f64>| value.map_or("infinite".to_owned(), number);
    by_name("Quantities", runs, |finding| {
        let all = finding.quantities.iter();
        all.map(|it| (it.name.as_str(), value(it.value))).collect()
    })
}

/// A table of what findings hold by name: one row for each name, one column for each run.
/// Nothing where they hold nothing.
fn by_name<'a>(
    caption: &str,
    runs: &[&'a JudgedRun],
    cells: impl Fn(&'a Finding) -> Vec<(&'a str, String)>,
) -> String {
    let of_runs: Vec<_> = runs.iter().map(|run| cells(&run.finding)).collect();
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in of_runs.iter().flatten() {
        if !names.contains(name) {
            names.push(name);
        }
    }
    let rows = names.iter().map(|name| {
        let cell = |of_run: &Vec<(&str, String)>| {
            let found = of_run.iter().find(|(own, _)| own == name);
            found.map_or("–".to_owned(), |(_, cell)| cell.clone())
        };
        let cells = of_runs.iter().map(cell);
        row(&[escape(name)].into_iter().chain(cells).collect::<Vec<_>>())
    });
    let headings = runs.iter().map(|run| dynamics(run.dynamics));
    let headings: Vec<_> = [""].into_iter().chain(headings).collect();
    match names.is_empty() {
        true => String::new(),
        false => table(caption, &headings, &rows.collect::<String>()),
    }
}
