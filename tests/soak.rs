//! A million steps: memory stays flat, and the same run is the same to the last bit.

mod common;

use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::ControlFlow;
use std::thread;

use common::{spec, world};
use serde_json::json;
use volary::simulation::Simulation;
use volary::world::spec::WorldSpec;

const STEPS: u64 = 1_000_000;

/// State and memory are looked at this often.
const LOOKS: u64 = 10;

/// Disks that never come to rest in a closed room, with every law at work.
fn restless() -> WorldSpec {
    let wall = |normal: [i32; 2]| {
        json!({
            "shape": { "half_space": { "normal": normal } },
            "position": [-6 * normal[0], -6 * normal[1]]
        })
    };
    spec(json!({
        "dimension": 2,
        "time": { "step": 0.01, "end": STEPS as f64 * 0.01 },
        "physics": { "restitution": 1, "friction": 0.2 },
        "agents": [{
            "count": 4, "radius": 0.5,
            "positions": { "box": { "min": [-5, -5], "max": [5, 5] } },
            "velocities": { "uniform": { "min": [-3, -3], "max": [3, 3] } }
        }],
        "obstacles": [
            wall([1, 0]), wall([-1, 0]), wall([0, 1]), wall([0, -1]),
            { "shape": { "ball": { "radius": 1 } } }
        ],
        "laws": [
            { "alpha_interaction": { "spacing": 3, "range": 4, "damping": 0 } },
            { "obstacle_avoidance": { "range": 1, "standoff": 0.5, "gain": 1 } },
            { "navigation": {
                "destination": [0, 0], "feedback": "linear", "position_gain": 0.5, "velocity_gain": 0
            } }
        ],
        "record": { "every": 1 }
    }))
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
