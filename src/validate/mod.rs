//! Validation: worlds run as points and as bodies, and what the papers' claims come to.

mod contact;
mod course;
mod expectation;
pub mod form;
pub mod report;

pub use course::course;
use course::least_distance;
pub use expectation::problems;

use crate::claim::{Claim, Curve, Finding, Reading, Run, Verdict, claims};
use crate::dynamics::{Accuracy, Dynamics, Engine, Failure};
use crate::metric::Observation;
use crate::shape::In;
use crate::trace::record::Partner;
use crate::world::World;
use contact::contact_report;
use expectation::expected;
use report::{ClaimReport, ClosestReport, JudgedRun, Report, RunReport, WorldReport};

/// Points of a curve that a report keeps.
const KEPT: usize = 400;

/// Which runs to judge by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// As points, this exact.
    pub points: Option<Accuracy>,
    /// As bodies.
    pub bodies: bool,
}

/// Runs a world as wanted, and judges all claims that have something to say of it.
///
/// # Errors
/// Where a run cannot begin or go on.
pub fn validate<const D: usize>(world: &World<D>, wanted: Wanted) -> Result<WorldReport, Failure>
where
    In<D>: Engine<D>,
{
    let claims = claims::<D>();
    let run =
        |dynamics: Option<Dynamics>| dynamics.map(|it| judged(world, &claims, it)).transpose();
    let points = wanted.points.map(Dynamics::Points);
    let bodies = wanted.bodies.then_some(Dynamics::Bodies);
    let (points, bodies) = rayon::join(|| run(points), || run(bodies));
    let (points, bodies) = (points?, bodies?);
    let runs = || points.iter().chain(&bodies);
    let reports = claims.iter().filter_map(|claim| {
        let about = claim.about();
        let findings: Vec<_> = runs().filter_map(|run| judge(&**claim, run)).collect();
        (!findings.is_empty()).then(|| ClaimReport {
            claim: about.name.to_owned(),
            source: about.source.to_owned(),
            reading: about.reading,
            statement: about.statement.to_owned(),
            findings,
        })
    });
    let touching = bodies.as_ref().and_then(|bodies| bodies.contacts.first());
    let touching = touching.filter(|contact| contact.with == Partner::Agent);
    let apart = touching.zip(wanted.points).map(|(contact, accuracy)| {
        let pair = [contact.agent, contact.other];
        least_distance(world, accuracy, pair, contact.begin)
    });
    let apart = apart.transpose()?;
    Ok(WorldReport {
        world: world.name.clone(),
        description: world.spec.description.clone(),
        agents: world.agents.len(),
        dimension: D,
        end: world.steps() as f64 * world.spec.time.step,
        claims: reports.collect(),
        contact: bodies
            .as_ref()
            .map(|bodies| contact_report(&claims, bodies, points.as_ref(), apart)),
        runs: runs().map(run_report).collect(),
    })
}

/// The report of some worlds.
pub fn report(worlds: Vec<WorldReport>) -> Report {
    Report {
        format: report::FORMAT.to_owned(),
        version: report::VERSION,
        program: format!("volary {}", env!("CARGO_PKG_VERSION")),
        as_expected: worlds.iter().all(WorldReport::as_expected),
        worlds,
    }
}

impl WorldReport {
    /// Whether every finding is as expected, and no contact is seen that theory excludes.
    pub fn as_expected(&self) -> bool {
        let mut findings = self.claims.iter().flat_map(|claim| &claim.findings);
        let exclusions = self.contact.iter().flat_map(|contact| &contact.exclusions);
        let excluded =
            |it: &report::ExclusionReport| it.outcome != report::ContactOutcome::ExcludedYetSeen;
        findings.all(|it| it.as_expected) && exclusions.into_iter().all(excluded)
    }
}

/// A run of a world, with the runs of its variations that claims ask for.
fn judged<'w, const D: usize>(
    world: &'w World<D>,
    claims: &[Box<dyn Claim<D>>],
    dynamics: Dynamics,
) -> Result<Run<'w, D>, Failure>
where
    In<D>: Engine<D>,
{
    let mut run = course(world, dynamics)?;
    // Claims that ask for the same variation share its run.
    let mut known: Vec<(World<D>, Vec<Observation<D>>)> = Vec::new();
    for claim in claims {
        let mut companions = Vec::new();
        for variation in claim.companions(world) {
            let same = |it: &&(World<D>, _)| it.0.spec == variation.spec;
            let companion = match known.iter().find(same) {
                Some(companion) => companion.clone(),
                None => {
                    let observations = course(&variation, dynamics)?.observations;
                    known.push((variation.clone(), observations));
                    known[known.len() - 1].clone()
                }
            };
            companions.push(companion);
        }
        if !companions.is_empty() {
            run.companions.insert(claim.about().name, companions);
        }
    }
    Ok(run)
}

/// What a claim comes to on a run, and whether that is expected; nothing where it has nothing
/// to say.
fn judge<const D: usize>(claim: &dyn Claim<D>, run: &Run<'_, D>) -> Option<JudgedRun> {
    let mut finding = claim.judge(run)?;
    let at = finding.closest;
    for curve in &mut finding.curves {
        thin(curve, at);
    }
    let dynamics = run.moved_by.name();
    let expected = expected(&run.world.spec, claim.about().name, dynamics);
    Some(JudgedRun {
        dynamics,
        expected,
        as_expected: is_expected(&finding, expected, claim.about().reading),
        finding,
    })
}

/// Whether a finding is what a world expects; without more to go by, that nothing is violated
/// that is not known to be wrong.
fn is_expected(finding: &Finding, expected: Option<Verdict>, reading: Reading) -> bool {
    match expected {
        Some(expected) => finding.verdict == expected,
        None => finding.verdict != Verdict::Violated || reading == Reading::Misprinted,
    }
}

/// Leaves points out of a long curve, but not its ends nor the one at a time.
fn thin(curve: &mut Curve, at: Option<f64>) {
    let count = curve.times.len();
    if count <= KEPT {
        return;
    }
    let every = count.div_ceil(KEPT);
    let times = curve.times.clone();
    let keep = |k: usize| k.is_multiple_of(every) || k + 1 == count || Some(times[k]) == at;
    let mut kept = (0..count).map(keep);
    curve.times.retain(|_| kept.next() == Some(true));
    for list in [&mut curve.values, &mut curve.bounds] {
        let mut kept = (0..count).map(keep);
        list.retain(|_| kept.next() == Some(true));
    }
}

fn run_report<const D: usize>(run: &Run<'_, D>) -> RunReport {
    let contacts = |with: Partner| run.contacts.iter().filter(|it| it.with == with).count();
    RunReport {
        dynamics: run.moved_by.name(),
        method: run.method.clone(),
        observations: run.observations.len(),
        first_contact: run.first_contact,
        agent_contacts: contacts(Partner::Agent),
        obstacle_contacts: contacts(Partner::Obstacle),
        closest: run.closest.map(|it| ClosestReport {
            agents: it.pair,
            distance: it.distance,
            time: it.time,
        }),
    }
}
