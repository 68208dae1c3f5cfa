//! Bodies touch, and the ledger tells the truth about it.

mod common;
#[path = "contacts/episodes.rs"]
mod episodes;

use common::{spec, world};
use serde_json::{Value, json};
use volary::simulation::Simulation;
use volary::trace::record::{Contact, Partner, Record, Summary};

fn run<const D: usize>(json: Value) -> (Vec<Contact>, Summary, Vec<Vec<f64>>)
where
    volary::shape::In<D>: volary::dynamics::Engine<D>,
{
    let mut contacts = Vec::new();
    let mut last = Vec::new();
    let mut simulation = Simulation::<D>::new(world(spec(json))).expect("a finite start");
    let summary = simulation.run(
        |record| {
            match record {
                Record::Contact(contact) => contacts.push(contact),
                Record::Frame(frame) => last = frame.positions,
                _ => {}
            }
            Ok::<_, ()>(())
        },
        |_| std::ops::ControlFlow::Continue(()),
    );
    (contacts, summary.expect("recording cannot fail"), last)
}

/// Two disks of mass 2 that meet head-on at relative speed 2, at time 4.
fn head_on(restitution: f64) -> Value {
    json!({
        "dimension": 2, "time": { "end": 6 }, "record": { "every": 3 },
        "physics": { "restitution": restitution },
        "agents": [{
            "radius": 0.5, "mass": 2,
            "positions": { "explicit": [[0, 0], [9, 0]] },
            "velocities": { "explicit": [[1, 0], [-1, 0]] }
        }]
    })
}

#[test]
fn a_collision_between_frames_is_one_episode_with_its_impulse() {
    let (contacts, summary, _) = run::<2>(head_on(1.0));
    assert_eq!(contacts.len(), 1, "{contacts:?}");
    let contact = &contacts[0];
    assert_eq!(
        (contact.agent, contact.with, contact.other),
        (0, Partner::Agent, 1)
    );
    assert!((contact.begin - 4.0).abs() < 0.02, "{contact:?}");
    assert!((contact.approach_speed - 2.0).abs() < 1e-9);
    // Elastic: each disk turns round, momentum 2 → −2.
    assert!((contact.largest_impulse - 4.0).abs() < 0.05, "{contact:?}");
    assert_eq!(summary.agent_contacts.episodes, 1);
    assert_eq!(summary.obstacle_contacts.episodes, 0);
}

#[test]
fn an_inelastic_collision_stops_both() {
    let (contacts, _, last) = run::<2>(head_on(0.0));
    assert!(!contacts.is_empty());
    assert!(
        (contacts[0].largest_impulse - 2.0).abs() < 0.05,
        "{:?}",
        contacts[0]
    );
    assert!((last[1][0] - last[0][0] - 1.0).abs() < 0.02, "{last:?}");
}

#[test]
fn passing_by_within_the_engine_s_margin_is_no_contact() {
    let mut near_miss = head_on(0.0);
    // Surfaces pass 0.01 apart: the engine speaks of contact below 0.02.
    near_miss["agents"][0]["positions"]["explicit"] = json!([[0, 0], [9, 1.01]]);
    let (contacts, summary, last) = run::<2>(near_miss);
    assert!(contacts.is_empty(), "{contacts:?}");
    assert!((last[0][0] - 6.0).abs() < 1e-9, "it was held up: {last:?}");
    assert_eq!(summary.agent_contacts.episodes, 0);
}

#[test]
fn contacts_with_obstacles_are_counted_apart() {
    let (contacts, summary, last) = run::<3>(json!({
        "dimension": 3, "time": { "end": 3 }, "record": { "every": 3 },
        "agents": [{
            "radius": 0.5,
            "positions": { "explicit": [[0, 0, 2]] },
            "velocities": { "common": [0, 0, -1] }
        }],
        "obstacles": [{ "name": "floor", "shape": { "half_space": { "normal": [0, 0, 1] } } }]
    }));
    assert_eq!(summary.obstacle_contacts.pairs, 1);
    assert_eq!(summary.agent_contacts.episodes, 0);
    assert_eq!(
        (contacts[0].with, contacts[0].other),
        (Partner::Obstacle, 0)
    );
    assert!((contacts[0].begin - 1.5).abs() < 0.03, "{contacts:?}");
    assert!((last[0][2] - 0.5).abs() < 0.02, "{last:?}");
}

#[test]
fn a_body_at_rest_on_the_floor_touches_to_the_end() {
    let (contacts, summary, _) = run::<2>(json!({
        "dimension": 2, "time": { "end": 5 },
        "physics": { "gravity": [0, -9.81] },
        "agents": [{ "radius": 0.5, "mass": 3, "positions": { "explicit": [[0, 0.6]] } }],
        "obstacles": [{ "shape": { "half_space": { "normal": [0, 1] } } }]
    }));
    let last = contacts.last().expect("it landed");
    assert!(last.open, "{last:?}");
    assert!(summary.obstacle_contacts.deepest_penetration < 0.02);
    // Its weight for one step.
    assert!(last.largest_impulse >= 0.99 * 3.0 * 9.81 * 0.01, "{last:?}");
}

#[test]
fn the_actuator_limit_cuts_forces_and_is_counted() {
    let mut world = head_on(0.0);
    world["agents"][0]["velocities"] = json!("rest");
    world["agents"][0]["force_limit"] = json!(0.5);
    world["laws"] = json!([{ "navigation": {
        "velocity": [0, 10], "feedback": "linear", "velocity_gain": 1
    } }]);
    let (_, summary, last) = run::<2>(world);
    // Force 0.5 on mass 2 for 6 time units.
    assert!((last[0][1] - 0.5 * 0.25 * 36.0).abs() < 1e-9, "{last:?}");
    assert_eq!(summary.force_cuts, 2 * 600);
}

/// A fast disk shot at a target; returns how far it got along x.
fn shot(speed: f64, target: Value, obstacle: bool) -> f64 {
    let mut json = json!({
        "dimension": 2, "time": { "end": 0.5 }, "record": { "every": 0.5 },
        "agents": [{
            "radius": 0.5,
            "positions": { "explicit": [[0, 0]] },
            "velocities": { "explicit": [[speed, 0]] }
        }]
    });
    if obstacle {
        json["obstacles"] = json!([target]);
    } else {
        json["agents"].as_array_mut().expect("a list").push(target);
    }
    let (contacts, _, last) = run::<2>(json);
    assert!(!contacts.is_empty(), "no contact at {speed}");
    match obstacle {
        true => last[0][0],
        // How far it is behind what it hit.
        false => last[0][0] - last[1][0],
    }
}

#[test]
fn fast_bodies_pass_through_neither_walls_nor_each_other() {
    for k in 0..40 {
        let (speed, at) = (20.0 + 2.0 * f64::from(k), 3.0 + 0.037 * f64::from(k));
        let wall = json!({
            "shape": { "cuboid": { "half_extents": [0.02, 5] } }, "position": [at, 0]
        });
        assert!(shot(speed, wall, true) < at, "through the wall at {speed}");
        let meeting = json!({
            "radius": 0.5,
            "positions": { "explicit": [[at + 4.0, 0]] },
            "velocities": { "explicit": [[-speed, 0]] }
        });
        assert!(
            shot(speed, meeting, false) < 0.0,
            "through the other at {speed}"
        );
    }
}
