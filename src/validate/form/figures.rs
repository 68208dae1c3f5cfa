//! Which plots show a verdict.

use super::plot::{Line, Plot};
use super::words::{DYNAMICS, on};
use crate::claim::{Curve, Side};
use crate::validate::report::{ClaimReport, Departure, JudgedRun, WorldReport};
use crate::world::spec::DynamicsName;

/// The plots of a claim: one for each quantity that was measured along its runs.
pub(super) fn of_claim<'a>(
    world: &'a WorldReport,
    claim: &'a ClaimReport,
    id: &str,
) -> Vec<Plot<'a>> {
    let runs: Vec<&JudgedRun> = DYNAMICS
        .iter()
        .filter_map(|name| on(claim, *name))
        .collect();
    let mut keys: Vec<(&str, usize)> = Vec::new();
    for (key, _) in runs.iter().flat_map(|run| numbered(run)) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let plots = keys.into_iter().enumerate().map(|(k, key)| {
        let name = key.0;
        let curves = runs
            .iter()
            .flat_map(|run| numbered(run).map(move |it| (*run, it)));
        let lines: Vec<Line> = curves
            .filter(|(_, (own, _))| *own == key)
            .map(|(run, (_, curve))| line(run, curve))
            .collect();
        let level = world.contact.as_ref().filter(|contact| {
            contact.radius > 0.0
                && lines.iter().any(|line| line.side == Side::Above)
                && is_distance(world, claim, name)
        });
        Plot {
            id: format!("{id}f{k}"),
            name,
            level: level.map(|it| (2.0 * it.radius, "body diameter")),
            moment: first_contact(world, &lines),
            logarithmic: false,
            lines,
        }
    });
    plots.collect()
}

/// The plot of how far bodies depart from points.
pub(super) fn of_departure<'a>(
    world: &'a WorldReport,
    departure: &'a Departure,
    id: &str,
) -> Plot<'a> {
    let lines = vec![Line {
        dynamics: DynamicsName::Bodies,
        times: &departure.times,
        values: departure.distances.iter().map(|it| Some(*it)).collect(),
        bounds: &[],
        side: Side::Below,
        closest: None,
    }];
    Plot {
        id: format!("{id}d"),
        name: "largest distance between an agent as body and as point",
        level: None,
        moment: first_contact(world, &lines),
        logarithmic: true,
        lines,
    }
}

/// The curves of a run by name, and number among those of this name.
fn numbered(run: &JudgedRun) -> impl Iterator<Item = ((&str, usize), &Curve)> {
    let curves = &run.finding.curves;
    curves.iter().enumerate().map(|(k, curve)| {
        let before = curves[..k].iter();
        let number = before.filter(|it| it.name == curve.name).count();
        ((curve.name.as_str(), number), curve)
    })
}

fn line<'a>(run: &'a JudgedRun, curve: &'a Curve) -> Line<'a> {
    // The closest approach is that of the quantity that decided, which the reason names.
    let finding = &run.finding;
    let decided = !curve.bounds.is_empty() && finding.reason.contains(&curve.name);
    let seen = |time: &f64| curve.times.contains(time);
    Line {
        dynamics: run.dynamics,
        times: &curve.times,
        values: curve.values.clone(),
        bounds: &curve.bounds,
        side: curve.side,
        closest: finding.closest.filter(|time| decided && seen(time)),
    }
}

/// Whether a quantity is a distance between agents: one by which a claim keeps them apart, or
/// one that its formula says is the least distance.
fn is_distance(world: &WorldReport, claim: &ClaimReport, name: &str) -> bool {
    let contact = world.contact.iter();
    let mut exclusions = contact.flat_map(|it| &it.exclusions);
    exclusions.any(|it| it.claim == claim.claim) || name.starts_with("min") && name.contains("|x")
}

/// The first contact, where bodies are among the lines and the time is on the plot.
fn first_contact(world: &WorldReport, lines: &[Line]) -> Option<(f64, &'static str)> {
    let bodies = |line: &Line| line.dynamics == DynamicsName::Bodies;
    if !lines.iter().any(bodies) {
        return None;
    }
    let run = world
        .runs
        .iter()
        .find(|it| it.dynamics == DynamicsName::Bodies)?;
    let time = run.first_contact?;
    let last = lines.iter().filter_map(|line| line.times.last());
    let last = last.copied().fold(f64::NEG_INFINITY, f64::max);
    (time <= last).then_some((time, "first contact"))
}
