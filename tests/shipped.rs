//! Every shipped world runs, with everything recorded that can be.

use std::ops::ControlFlow;
use std::path::Path;

use volary::dynamics::Engine;
use volary::shape::In;
use volary::simulation::Simulation;
use volary::trace::record::{Outcome, Record, Summary};
use volary::trace::{Format, TraceWriter};
use volary::world::{AnyWorld, Document, Override, World, shipped};

/// Steps of each run: enough to meet what is wrong from the start, and no more.
const STEPS: u64 = 60;

/// Runs a world for a while and writes its trace, which refuses numbers that are not finite;
/// tells how it went and how many frames there are.
fn run<const D: usize>(world: World<D>) -> (Summary, usize)
where
    In<D>: Engine<D>,
{
    let name = world.name.clone();
    let mut simulation = Simulation::new(world).expect("a finite start");
    let format = Format::of(Path::new("trace.jsonl")).expect("a known ending");
    let mut writer = TraceWriter::new(std::io::sink(), format);
    let mut frames = 0;
    let summary = simulation
        .run(
            |record| {
                frames += usize::from(matches!(record, Record::Frame(_)));
                writer.write(&record)
            },
            |state| match state.step < STEPS {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            },
        )
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    writer.finish().expect("nothing holds it up");
    (summary, frames)
}

#[test]
fn every_world_runs_and_every_number_is_finite() {
    let sets = [
        "accelerations",
        "laws",
        "net",
        "links",
        "blocked",
        "edges",
        "beta_agents",
    ];
    for name in shipped::names() {
        let text = shipped::get(&name).expect("it is shipped");
        let all = sets.map(|what| format!("record.{what}=true"));
        let often = [String::from("record.active_at=0.05")];
        let sets = all
            .iter()
            .chain(&often)
            .map(|set| set.parse::<Override>().expect("a path"));
        let world = Document::new(&name, text).with(sets).world(&name);
        let (summary, frames) = match world.unwrap_or_else(|report| panic!("{report}")) {
            AnyWorld::Plane(world) => run(world),
            AnyWorld::Space(world) => run(world),
        };
        assert!(
            matches!(summary.outcome, Outcome::Completed | Outcome::Interrupted),
            "{name}: {:?}",
            summary.error
        );
        assert!(frames >= 2, "{name}");
    }
}
