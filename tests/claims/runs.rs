//! Runs for claims to be judged on, as they went or doctored.

#![allow(dead_code, reason = "the papers use what they need")]

use volary::claim::{Finding, MovedBy, Run, Verdict, claims};
use volary::dynamics::{Accuracy, Dynamics, Engine};
use volary::math::Vector;
use volary::shape::In;
use volary::validate::course;
use volary::world::{AnyWorld, Document, World, shipped};

/// The relative accuracy of the point runs here.
const ACCURACY: f64 = 1e-10;

/// A state of a run: time, positions, velocities.
pub type Seen<const D: usize> = (f64, Vec<Vector<D>>, Vec<Vector<D>>);

/// A shipped world, with some fields set otherwise.
pub fn shipped(name: &str, set: &[&str]) -> AnyWorld {
    let text = shipped::get(name).expect("the world is shipped");
    let set = set.iter().map(|it| it.parse().expect("it can be set"));
    let document = Document::new(name, text).with(set);
    document.world(name).expect("the world is sound")
}

/// The same, in the plane.
pub fn plane(name: &str, set: &[&str]) -> World<2> {
    match shipped(name, set) {
        AnyWorld::Plane(world) => world,
        AnyWorld::Space(_) => panic!("{name} is not flat"),
    }
}

/// The frames of a world that is moved as points.
pub fn point_states<const D: usize>(world: &World<D>) -> Vec<Seen<D>>
where
    In<D>: Engine<D>,
{
    let run = points(world);
    let states = run.observations.into_iter();
    states
        .map(|it| (it.time, it.positions, it.velocities))
        .collect()
}

/// A run of these states, as of points.
pub fn seen<const D: usize>(world: &World<D>, states: Vec<Seen<D>>) -> Run<'_, D> {
    let moved_by = MovedBy::Points { relative: ACCURACY };
    Run::of_states(world, moved_by, states)
}

/// A run as points.
pub fn points<const D: usize>(world: &World<D>) -> Run<'_, D>
where
    In<D>: Engine<D>,
{
    let accuracy = Accuracy { relative: ACCURACY };
    course(world, Dynamics::Points(accuracy)).expect("it can be integrated")
}

/// A run as points, its states changed: `doctor` gets each frame's number and state.
pub fn doctored<'w, const D: usize>(
    world: &'w World<D>,
    mut doctor: impl FnMut(usize, &mut Seen<D>),
) -> Run<'w, D>
where
    In<D>: Engine<D>,
{
    let mut states = point_states(world);
    for (k, state) in states.iter_mut().enumerate() {
        doctor(k, state);
    }
    seen(world, states)
}

/// A run as bodies, which must not touch.
pub fn bodies<const D: usize>(world: &World<D>) -> Run<'_, D>
where
    In<D>: Engine<D>,
{
    let run = course(world, Dynamics::Bodies).expect("it can run");
    assert_eq!(run.first_contact, None);
    run
}

/// What a claim comes to on a run.
pub fn finding<const D: usize>(name: &str, run: &Run<'_, D>) -> Finding {
    let claims = claims::<D>();
    let claim = claims.iter().find(|claim| claim.about().name == name);
    let claim = claim.unwrap_or_else(|| panic!("there is no claim {name}"));
    let finding = claim.judge(run);
    finding.unwrap_or_else(|| panic!("{name} has nothing to say of {}", run.world.name))
}

fn expect<const D: usize>(name: &str, run: &Run<'_, D>, verdict: Verdict) -> Finding {
    let finding = finding(name, run);
    assert_eq!(finding.verdict, verdict, "{name}: {}", finding.reason);
    finding
}

/// A claim must hold on a run.
pub fn holds<const D: usize>(name: &str, run: &Run<'_, D>) -> Finding {
    expect(name, run, Verdict::Holds)
}

/// A claim must be violated on a run.
pub fn violated<const D: usize>(name: &str, run: &Run<'_, D>) -> Finding {
    expect(name, run, Verdict::Violated)
}

/// The hypotheses of a claim must not be met on a run.
pub fn unmet<const D: usize>(name: &str, run: &Run<'_, D>) -> Finding {
    expect(name, run, Verdict::HypothesisNotMet)
}
