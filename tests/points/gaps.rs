//! The smallest gaps of points, between steps and between frames.

use std::ops::ControlFlow;

use serde_json::{Value, json};
use volary::dynamics::{Accuracy, Dynamics, Engine};
use volary::shape::In;
use volary::simulation::Simulation;
use volary::trace::record::{Frame, Record, Summary};

use crate::common::{spec, world};

fn run<const D: usize>(json: Value) -> (Summary, Vec<Frame>)
where
    In<D>: Engine<D>,
{
    let dynamics = Dynamics::Points(Accuracy::default());
    let mut simulation = Simulation::<D>::with_dynamics(world(spec(json)), Vec::new(), dynamics)
        .expect("a finite start");
    let mut frames = Vec::new();
    let summary = simulation.run(
        |record| {
            if let Record::Frame(frame) = record {
                frames.push(frame);
            }
            Ok::<_, ()>(())
        },
        |_| ControlFlow::Continue(()),
    );
    (summary.expect("recording cannot fail"), frames)
}

/// Three that fall; the last two pass each other, 0.03 apart at time 0.254, while frames and
/// steps see them far from each other.
#[test]
fn who_passes_between_two_steps_is_seen() {
    for step in [0.02, 0.1] {
        let (summary, frames) = run::<2>(json!({
            "dimension": 2, "time": { "step": step, "end": 1 }, "record": { "every": 0.5 },
            "physics": { "gravity": [0, -9.81] },
            "agents": [{
                "radius": 0.1,
                "positions": { "explicit": [[50, 50], [-2.54, 0], [2.54, 0.23]] },
                "velocities": { "explicit": [[0, 0], [10, 0], [-10, 0]] }
            }]
        }));
        let gap = summary.smallest_agent_gap.expect("there are three");
        assert!((gap - 0.03).abs() < 1e-12, "{gap}");
        let who = summary.closest_agents.expect("they are known");
        assert_eq!((who.agent, who.other), (1, 2));
        assert!((who.time - 0.254).abs() < 1e-9, "{who:?}");
        assert_eq!(summary.smallest_obstacle_gap, None);
        assert_eq!(summary.closest_obstacle, None);
        // Frames tell the present gap, and the smallest so far.
        let metrics: Vec<_> = frames.iter().filter_map(|it| it.metrics.as_ref()).collect();
        assert_eq!(metrics.len(), 3);
        assert!(metrics.iter().all(|it| it.agent_gap > Some(4.0)));
        assert_eq!(metrics[0].smallest_agent_gap, metrics[0].agent_gap);
        assert_eq!(metrics[1].smallest_agent_gap, Some(gap));
        assert_eq!(metrics[2].smallest_agent_gap, Some(gap));
    }
}

#[test]
fn obstacles_are_passed_between_two_steps_too() {
    let (summary, frames) = run::<3>(json!({
        "dimension": 3, "time": { "step": 0.1, "end": 1 }, "record": { "every": 0.5 },
        "agents": [{
            "radius": 0.1,
            "positions": { "explicit": [[-2.54, 0, 0], [-2.54, 9, 0]] },
            "velocities": { "common": [10, 0, 0] }
        }],
        "obstacles": [
            { "shape": { "ball": { "radius": 0.5 } }, "position": [0, 0, 0.75] },
            { "shape": { "half_space": { "normal": [0, 0, 1] } }, "position": [0, 0, -4] }
        ]
    }));
    let gap = summary.smallest_obstacle_gap.expect("there are two");
    assert!((gap - 0.15).abs() < 1e-12, "{gap}");
    let who = summary.closest_obstacle.expect("they are known");
    assert_eq!((who.agent, who.other), (0, 0));
    assert!((who.time - 0.254).abs() < 1e-6, "{who:?}");
    // No two agents come nearer to each other than they are.
    assert_eq!(summary.smallest_agent_gap, Some(9.0 - 0.2));
    let last = frames.last().and_then(|it| it.metrics.as_ref());
    let last = last.expect("metrics are recorded");
    assert!(last.obstacle_gap > Some(3.0));
    assert_eq!(last.smallest_obstacle_gap, Some(gap));
}
