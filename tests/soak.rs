//! A million steps: memory stays flat, and the same run is the same to the last bit.

mod common;

use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::ControlFlow;
use std::thread;

use common::world;
use volary::simulation::Simulation;
use volary::world::spec::WorldSpec;

const STEPS: u64 = 1_000_000;

/// State and memory are looked at this often.
const LOOKS: u64 = 10;

/// A world with all there is, for a million steps.
fn restless() -> WorldSpec {
    let mut world = common::circus(2);
    world.time.end = STEPS as f64 * world.time.step;
    world.record.every = 10.0;
    for (group, count) in world.agents.iter_mut().zip([2, 2, 1]) {
        group.count = Some(count);
    }
    world
}

/// Runs to the end; returns the state's bits and the memory in use, at each look, and the
/// number of contacts.
fn run() -> (Vec<u64>, Vec<u64>, u64) {
    let mut simulation = Simulation::<2>::new(world(restless())).expect("a finite start");
    let (mut states, mut memory) = (Vec::new(), Vec::new());
    let summary = simulation.run(
        |_| Ok::<_, std::convert::Infallible>(()),
        |state| {
            if state.step.is_multiple_of(STEPS / LOOKS) {
                let mut hash = DefaultHasher::new();
                for vector in state.positions.iter().chain(state.velocities) {
                    vector.iter().for_each(|x| x.to_bits().hash(&mut hash));
                }
                states.push(hash.finish());
                memory.extend(resident_bytes());
            }
            ControlFlow::Continue(())
        },
    );
    let summary = summary.expect("recording cannot fail");
    assert_eq!(summary.steps, STEPS);
    let contacts = summary.agent_contacts.episodes + summary.obstacle_contacts.episodes;
    (states, memory, contacts)
}

/// Memory that this process holds, where the system tells.
fn resident_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: u64 = text.split_whitespace().nth(1)?.parse().ok()?;
    Some(pages * 4096)
}

#[test]
fn a_million_steps_leave_no_trace_in_memory_and_no_doubt() {
    let twin = thread::spawn(run);
    let (states, memory, contacts) = run();
    let (twin_states, _, twin_contacts) = twin.join().expect("the twin ran");
    assert_eq!(states.len() as u64, LOOKS);
    assert_eq!((states, contacts), (twin_states, twin_contacts));
    assert!(contacts > 1_000, "only {contacts}: nothing went on");
    if let (Some(&early), Some(&late)) = (memory.first(), memory.last()) {
        let grown = late.saturating_sub(early);
        println!("{contacts} contacts; {early} bytes resident, {grown} more at the end");
        assert!(grown < 1 << 20, "{early} grew to {late} bytes");
    }
}
