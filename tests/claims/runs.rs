//! Runs for claims to be judged on, as they went or doctored.

#![allow(dead_code, reason = "the papers use what they need")]

use volary::claim::{Finding, MovedBy, Run, Verdict, claims};
use volary::dynamics::Engine;
use volary::law::Field;
use volary::math::{DormandPrince, Vector};
use volary::shape::In;
use volary::simulation::Simulation;
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

/// The frames of a world that is moved as points, integrated with an error below 1e-10.
pub fn point_states<const D: usize>(world: &World<D>) -> Vec<Seen<D>> {
    let mut field = Field::of_world(world);
    let agents = &world.agents;
    let half = agents.len() * D;
    let vectors = |numbers: &[f64]| -> Vec<Vector<D>> {
        numbers
            .chunks_exact(D)
            .map(Vector::from_column_slice)
            .collect()
    };
    let both = [&agents.positions, &agents.velocities];
    let state = both
        .into_iter()
        .flatten()
        .flat_map(|it| it.iter().copied())
        .collect();
    let slope = |time: f64, y: &[f64], out: &mut [f64]| {
        let (x, v) = (vectors(&y[..half]), vectors(&y[half..]));
        out[..half].copy_from_slice(&y[half..]);
        let accelerations = field.accelerations(time, &x, &v);
        for (out, a) in out[half..].chunks_exact_mut(D).zip(accelerations) {
            out.copy_from_slice((a + world.gravity).as_slice());
        }
    };
    let mut solution = DormandPrince::new(slope, 0.0, state, ACCURACY);
    let frames = (0..=world.steps()).step_by(world.frame_steps() as usize);
    frames
        .map(|step| {
            let time = step as f64 * world.spec.time.step;
            solution.advance_to(time).expect("it can be integrated");
            let y = solution.state();
            (time, vectors(&y[..half]), vectors(&y[half..]))
        })
        .collect()
}

/// A run of these states, as of points.
pub fn seen<const D: usize>(world: &World<D>, states: Vec<Seen<D>>) -> Run<'_, D> {
    let moved_by = MovedBy::Points { relative: ACCURACY };
    Run::of_states(world, moved_by, states)
}

/// A run as points.
pub fn points<const D: usize>(world: &World<D>) -> Run<'_, D> {
    seen(world, point_states(world))
}

/// A run as points, its states changed: `doctor` gets each frame's number and state.
pub fn doctored<'w, const D: usize>(
    world: &'w World<D>,
    mut doctor: impl FnMut(usize, &mut Seen<D>),
) -> Run<'w, D> {
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
    let mut simulation = Simulation::new(world.clone()).expect("the world can start");
    let mut states = Vec::new();
    loop {
        let state = simulation.snapshot();
        if state.step.is_multiple_of(world.frame_steps()) {
            states.push((
                state.time,
                state.positions.to_vec(),
                state.velocities.to_vec(),
            ));
        }
        if state.step == world.steps() {
            break;
        }
        simulation.step().expect("the world can go on");
    }
    assert_eq!(simulation.ledger().agent_contacts().episodes, 0);
    let step = world.spec.time.step;
    Run::of_states(world, MovedBy::Bodies { step }, states)
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
