//! Delays against hand-kept histories.

use std::ops::ControlFlow;

use serde_json::json;
use volary::math::Vector;
use volary::simulation::Simulation;
use volary::trace::record::Record;

use crate::common::{headings, state};
use crate::scene::{Dice, Watch, pairs, who, world};

#[test]
fn others_are_seen_as_they_were() {
    let world = world::<3>(
        &[
            (12, json!({ "delay": 0.3 })),
            (12, serde_json::Value::Null),
            (12, json!({ "delay": 0.7, "radius": 4 })),
        ],
        json!({}),
    );
    let (n, range) = (world.agents.len(), 5.0);
    let delay = |i: usize| [3, 0, 7][i / 12];
    let mut dice = Dice(3);
    let mut watch = Watch::new(&world, range);
    let mut past = Vec::new();
    for step in 0..25usize {
        let at = dice.vectors::<3>(n, 0.0, 8.0);
        let v = dice.vectors::<3>(n, -1.0, 1.0);
        past.push((at.clone(), v.clone(), headings(&v)));
        let (at, v, u) = &past[step];
        let now = state(&world, step as f64 * 0.1, at, v, u);
        let seen_by = |i: usize| &past[step.saturating_sub(delay(i))];
        let reach = |i: usize| if i < 24 { range } else { 4.0 };
        let expected = pairs(n, |i, j| (seen_by(i).0[j] - at[i]).norm() <= reach(i));
        // Looking without going on, and looking twice, change nothing.
        if step > 0 {
            let before = watch.flock.history().clone();
            assert_eq!(watch.flock.by_law(&now)[0].0, "spy");
            assert_eq!(*watch.flock.history(), before);
            assert_eq!(watch.flock.links(&now), expected);
            let _ = watch.look(&now);
        }
        let told = watch.look(&now);
        assert_eq!(who(&told), expected, "step {step}");
        for (i, j, neighbour) in told {
            let (then, v, u) = seen_by(i);
            assert_eq!(neighbour.offset, then[j] - at[i]);
            assert_eq!((neighbour.velocity, neighbour.heading), (v[j], u[j]));
        }
    }
    // Another flock that takes up the history goes on alike.
    let mut again = Watch::new(&world, range);
    let moments: Vec<_> = watch.flock.history().moments().cloned().collect();
    assert_eq!(moments.len(), 8);
    again.flock.history_mut().restore(moments);
    let (at, v, u) = &past[0];
    let next = state(&world, 2.5, at, v, u);
    assert_eq!(again.look(&next), watch.look(&next));
}

#[test]
fn frames_record_who_perceives_whom() {
    let spec = crate::common::spec(json!({
        "dimension": 2, "time": { "step": 0.05, "end": 2 }, "seed": 4,
        "agents": [{
            "count": 12, "radius": 0.1, "sensing": { "delay": 0.2, "radius": 2.5 },
            "positions": { "box": { "min": [0, 0], "max": [8, 8] } },
            "velocities": { "uniform": { "min": [-2, -2], "max": [2, 2] } }
        }],
        "laws": [{ "alpha_interaction": { "spacing": 2, "range": 3 } }],
        "record": { "every": 0.05, "links": true, "accelerations": true }
    }));
    let run = |spec| {
        let mut frames = Vec::new();
        let mut simulation = Simulation::<2>::new(crate::common::world(spec)).expect("it starts");
        let keep = |record| {
            if let Record::Frame(frame) = record {
                frames.push(frame);
            }
            Ok::<_, std::convert::Infallible>(())
        };
        simulation
            .run(keep, |_| ControlFlow::Continue(()))
            .expect("nothing is refused");
        frames
    };
    let frames = run(spec.clone());
    let mut directed = 0;
    for (step, frame) in frames.iter().enumerate() {
        let place =
            |step: usize, i: usize| Vector::<2>::from_column_slice(&frames[step].positions[i]);
        let then = step.saturating_sub(4);
        let links = pairs(12, |i, j| (place(then, j) - place(step, i)).norm() <= 2.5);
        assert_eq!(frame.links.as_ref(), Some(&links), "frame {step}");
        directed += links
            .iter()
            .filter(|&&[i, j]| !links.contains(&[j, i]))
            .count();
    }
    assert!(frames.len() == 41 && directed > 5, "{directed}");
    // Recording does not touch the run.
    let mut quiet = spec;
    quiet.record.links = false;
    quiet.record.accelerations = false;
    let last = run(quiet).pop().expect("there are frames");
    assert_eq!(last.positions, frames[40].positions);
    assert_eq!(last.links, None);
}
