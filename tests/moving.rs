//! Moving obstacles among bodies: what they push, and what the records say of it.

mod common;

use common::{spec, world};
use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::shape::In;
use volary::simulation::Simulation;
use volary::trace::record::{Contact, Frame, Record, Summary};

fn run<const D: usize>(json: Value) -> (Vec<Contact>, Summary, Vec<Frame>)
where
    In<D>: Engine<D>,
{
    let (mut contacts, mut frames) = (Vec::new(), Vec::new());
    let mut simulation = Simulation::<D>::new(world(spec(json))).expect("a finite start");
    let summary = simulation.run(
        |record| {
            match record {
                Record::Contact(contact) => contacts.push(contact),
                Record::Frame(frame) => frames.push(frame),
                _ => {}
            }
            Ok::<_, ()>(())
        },
        |_| std::ops::ControlFlow::Continue(()),
    );
    (contacts, summary.expect("recording cannot fail"), frames)
}

/// Three disks at rest in front of a wall that comes at speed 2.
fn pushed(wall: Value) -> Value {
    json!({
        "dimension": 2, "time": { "end": 3 }, "record": { "every": 1 },
        "agents": [{
            "radius": 0.5, "mass": [1, 2, 5],
            "positions": { "explicit": [[2, -2], [2, 0], [2, 2]] }
        }],
        "obstacles": [wall]
    })
}

#[test]
fn a_wall_takes_resting_bodies_along() {
    let drift = json!({ "drift": { "velocity": [2, 0] } });
    let walls = [
        json!({ "shape": { "cuboid": { "half_extents": [0.1, 4] } }, "motion": drift }),
        json!({ "shape": { "segment": { "from": [0.1, -4], "to": [0.1, 4] } }, "motion": drift }),
        json!({ "shape": { "half_space": { "normal": [1, 0] } }, "position": [0.1, 0], "motion": drift }),
        json!({ "shape": { "polyline": {
            "points": [[0.1, -4], [0.1, 0], [0.1, 4]]
        } }, "motion": drift }),
    ];
    for wall in walls {
        let (contacts, summary, frames) = run::<2>(pushed(wall.clone()));
        let last = frames.last().expect("a frame");
        for (k, (position, velocity)) in last.positions.iter().zip(&last.velocities).enumerate() {
            assert!((velocity[0] - 2.0).abs() < 1e-6, "{wall}: {velocity:?}");
            // Where the wall's face is, and half a diameter.
            assert!((position[0] - 6.6).abs() < 0.03, "{wall}: {position:?}");
            assert!(
                (position[1] - (2.0 * k as f64 - 2.0)).abs() < 1e-6,
                "{wall}: {position:?}"
            );
        }
        assert_eq!(
            summary.obstacle_contacts.pushed,
            summary.obstacle_contacts.episodes
        );
        assert_eq!(
            summary.obstacle_contacts.pairs, 3,
            "one for each body, whatever the parts"
        );
        for mass in [1.0, 2.0, 5.0] {
            let agent = [1.0, 2.0, 5.0].iter().position(|m| *m == mass);
            let first = contacts
                .iter()
                .find(|it| Some(it.agent) == agent)
                .expect("touched");
            assert!((first.push_speed - 2.0).abs() < 1e-9, "{first:?}");
            assert!((first.approach_speed - 2.0).abs() < 1e-9, "{first:?}");
            // From rest to the wall's speed.
            assert!(
                (first.largest_impulse - 2.0 * mass).abs() < 0.05 * mass,
                "{wall} {first:?}"
            );
        }
    }
}

#[test]
fn a_fixed_wall_pushes_nothing() {
    let mut world = pushed(json!({ "shape": { "cuboid": { "half_extents": [0.1, 4] } } }));
    world["agents"][0]["velocities"] = json!({ "common": [-1, 0] });
    let (contacts, summary, frames) = run::<2>(world);
    assert_eq!(summary.obstacle_contacts.pushed, 0);
    assert!(contacts.len() >= 3 && contacts.iter().all(|it| it.push_speed == 0.0));
    assert!(frames.iter().all(|frame| frame.obstacles.is_none()));
}

#[test]
fn an_elastic_wall_returns_twice_its_speed() {
    let mut world = pushed(json!({
        "shape": { "cuboid": { "half_extents": [0.1, 4] } },
        "restitution": 1, "motion": { "drift": { "velocity": [2, 0] } }
    }));
    let last = |world: Value| run::<2>(world).2.pop().expect("a frame").velocities;
    for velocity in last(world.clone()) {
        assert!((velocity[0] - 4.0).abs() < 1e-6, "{velocity:?}");
    }
    // The other way round: the obstacle's own value counts, not a mean.
    world["physics"] = json!({ "restitution": 1 });
    world["obstacles"][0]["restitution"] = json!(0);
    for velocity in last(world) {
        assert!((velocity[0] - 2.0).abs() < 1e-6, "{velocity:?}");
    }
}

#[test]
fn friction_of_the_obstacle_overrides() {
    let slide = |friction: Value| {
        let (.., frames) = run::<2>(json!({
            "dimension": 2, "time": { "end": 1 }, "record": { "every": 1 },
            "physics": { "gravity": [0, -10], "friction": 0.1 },
            "agents": [{
                "radius": 0.5, "positions": { "explicit": [[0, 0.5]] },
                "velocities": { "common": [1, 0] }
            }],
            "obstacles": [{
                "shape": { "half_space": { "normal": [0, 1] } }, "friction": friction
            }]
        }));
        frames.last().expect("a frame").velocities[0][0]
    };
    assert!((slide(json!(0)) - 1.0).abs() < 1e-9);
    let (own, given) = (slide(Value::Null), slide(json!(0.1)));
    assert!((own - given).abs() < 1e-12 && own < 0.99, "{own} {given}");
}

#[test]
fn a_turning_door_sweeps_disks() {
    let (contacts, summary, frames) = run::<2>(json!({
        "dimension": 2, "time": { "end": 2 }, "record": { "every": 0.1 },
        "agents": [{
            "radius": 0.2,
            "positions": { "explicit": [[1, 1], [2, 1.5], [3, 1], [-3, -1]] }
        }],
        "obstacles": [{
            "name": "door", "shape": { "cuboid": { "half_extents": [2, 0.05] } },
            "position": [2, 0], "motion": { "rotation": { "about": [0, 0], "rate": 1 } }
        }]
    }));
    let last = frames.last().expect("a frame");
    // The door turns by a radian a second about the origin; what it met is ahead of it for
    // as long as it has not slid off the tip.
    let door = [2.0f64.cos(), 2.0f64.sin()];
    for frame in &frames {
        let door = [frame.time.cos(), frame.time.sin()];
        for position in &frame.positions[..3] {
            let ahead = door[0] * position[1] - door[1] * position[0];
            let reached = position[0].hypot(position[1]) < 4.0;
            assert!(
                !reached || ahead > 0.2 + 0.05 - 0.02,
                "{position:?} at {}",
                frame.time
            );
        }
    }
    let moved = last.velocities[..3].iter().all(|v| v[0].hypot(v[1]) > 0.5);
    assert!(moved, "{:?}", last.velocities);
    assert_eq!(last.positions[3], [-3.0, -1.0], "out of its reach");
    assert!(summary.obstacle_contacts.pushed >= 3);
    for contact in contacts
        .iter()
        .filter(|it| it.with == volary::trace::record::Partner::Obstacle)
    {
        // The tip goes at 4; each point at its distance.
        assert!(
            contact.push_speed > 0.5 && contact.push_speed < 4.1,
            "{contact:?}"
        );
    }
    let pose = &last.obstacles.as_ref().expect("the door moves")[0];
    assert!((pose.position[0] - 2.0 * door[0]).abs() < 1e-12, "{pose:?}");
}

#[test]
fn an_oscillating_wall_s_beta_agents_have_its_velocity() {
    let (_, _, frames) = run::<2>(json!({
        "dimension": 2, "time": { "end": 2 },
        "record": { "every": 0.25, "beta_agents": true },
        "agents": [{ "radius": 0.1, "positions": { "explicit": [[0, 3]] } }],
        "obstacles": [{
            "shape": { "cuboid": { "half_extents": [5, 1] } },
            "motion": { "oscillation": { "amplitude": [0, 0.5], "period": 2 } }
        }],
        "laws": [{ "obstacle_avoidance": {
            "range": 4, "standoff": 0.1, "gain": 1e-9
        } }]
    }));
    for frame in &frames {
        let beta = &frame.beta_agents.as_ref().expect("recorded")[0];
        let phase = std::f64::consts::PI * frame.time;
        let speed = 0.5 * std::f64::consts::PI * phase.cos();
        assert!(
            (beta.velocity[1] - speed).abs() < 1e-6,
            "{}: {beta:?}",
            frame.time
        );
        assert!(
            (beta.position[1] - 1.0 - 0.5 * phase.sin()).abs() < 1e-9,
            "{beta:?}"
        );
        assert_eq!(beta.part, None);
    }
    assert!(frames.len() == 9);
}

#[test]
fn gamma_agents_go_with_their_obstacle() {
    // A ball that carries its γ-agent past a resting agent, against one that stands where
    // the other is at that time: the laws must say the same of both at that moment.
    let at = |position: Value, motion: Value, end: f64| {
        let (.., frames) = run::<2>(json!({
            "dimension": 2, "time": { "end": end, "step": 0.01 },
            "record": { "every": 0.01, "accelerations": true },
            "agents": [{ "radius": 0.1, "mass": 1, "positions": { "explicit": [[0, 3]] } }],
            "obstacles": [{
                "shape": { "ball": { "radius": 1 } }, "position": position, "motion": motion
            }],
            "laws": [{ "obstacle_avoidance": {
                "range": 9, "standoff": 2, "gain": 1e-12,
                "gamma": { "spacing": 0.5, "offset": 0.5, "direction": [1, 0] }
            } }]
        }));
        frames
            .last()
            .expect("a frame")
            .accelerations
            .clone()
            .expect("recorded")
    };
    let moved = at(
        json!([-2, 0]),
        json!({ "drift": { "velocity": [1, 0] } }),
        1.0,
    );
    let fixed = at(json!([-1, 0]), Value::Null, 0.0);
    for (a, b) in moved[0].values[0].iter().zip(&fixed[0].values[0]) {
        assert!((a - b).abs() < 1e-9 * 1e-12 + 1e-20, "{a} {b}");
    }
}

#[test]
fn rooms_hold_and_may_move() {
    for motion in [
        Value::Null,
        json!({ "oscillation": { "amplitude": [0.5, 0.2, 0], "period": 1 } }),
    ] {
        let world = json!({
            "dimension": 3, "time": { "end": 5 }, "record": { "every": 0.1 },
            "physics": { "restitution": 1 },
            "agents": [{
                "count": 30, "radius": 0.2,
                "positions": { "box": { "min": [-1.5, -1.5, -1.5], "max": [1.5, 1.5, 1.5] } },
                "velocities": { "uniform": { "min": [-9, -9, -9], "max": [9, 9, 9] } }
            }],
            "obstacles": [{ "shape": { "room": { "half_extents": [2, 2, 2] } }, "motion": motion }]
        });
        let (_, summary, frames) = run::<3>(world);
        assert!(summary.obstacle_contacts.episodes > 100);
        for frame in &frames {
            let middle = match &frame.obstacles {
                Some(obstacles) => obstacles[0].position.clone(),
                None => vec![0.0; 3],
            };
            for position in &frame.positions {
                let out = (0..3)
                    .map(|k| (position[k] - middle[k]).abs())
                    .fold(0.0, f64::max);
                assert!(out < 2.0, "outside: {position:?} at {}", frame.time);
            }
        }
        assert!(
            summary.obstacle_contacts.deepest_penetration < 0.15,
            "{summary:?}"
        );
        assert_eq!(summary.obstacle_contacts.pushed > 0, !motion.is_null());
    }
}

#[test]
fn a_fast_wall_passes_through_nothing() {
    // A ball, a rod and a box broadside on, at rest, and walls at up to 50 widths a second.
    let wall = |speed: f64, x: f64| {
        json!({
            "shape": { "segment": { "from": [0, -5], "to": [0, 5] } },
            "position": [x, 0], "motion": { "drift": { "velocity": [speed, 0] } }
        })
    };
    let shapes = [
        json!({ "ball": { "radius": 0.2 } }),
        json!({ "capsule": { "half_length": 0.3, "radius": 0.1 } }),
        json!({ "cuboid": { "half_extents": [0.4, 0.1] } }),
    ];
    for (kind, shape) in shapes.iter().enumerate() {
        for share in 0..10 {
            for speed in [5.0, 20.0, 40.0] {
                let start = -1.0 - 0.037 * f64::from(share);
                let mut group = json!({
                    "shape": shape, "positions": { "explicit": [[0, 0]] }
                });
                if kind > 0 {
                    group["heading"] = json!("free");
                    group["rotation"] = json!(std::f64::consts::FRAC_PI_2);
                }
                let (contacts, summary, frames) = run::<2>(json!({
                    "dimension": 2, "time": { "end": 0.5 }, "record": { "every": 0.01 },
                    "agents": [group], "obstacles": [wall(speed, start)]
                }));
                let what = format!("{shape} at {speed} from {start}");
                for frame in &frames {
                    let ahead = frame.positions[0][0] - (start + speed * frame.time);
                    assert!(ahead > 0.0, "{what}: passed at {}", frame.time);
                }
                assert!(
                    !contacts.is_empty() && contacts[0].push_speed > 0.0,
                    "{what}"
                );
                let least = summary.smallest_obstacle_gap.expect("there is a wall");
                assert!(least > -0.05, "{what}: overlap {least}");
            }
        }
    }
}

#[test]
fn an_arm_pushes_with_the_speed_that_it_has_where_it_touches() {
    // The rod's right end is hit by the arm, 1.4 from its pivot; the rod's middle is beyond.
    let (contacts, summary, _) = run::<2>(json!({
        "dimension": 2, "time": { "end": 0.5 }, "record": { "every": 0.1 },
        "agents": [{
            "shape": { "capsule": { "half_length": 2, "radius": 0.1 } },
            "heading": "free", "rotation": 0,
            "positions": { "explicit": [[-0.6, 0.25]] }
        }],
        "obstacles": [{
            "shape": { "cuboid": { "half_extents": [6, 0.1] } },
            "motion": { "rotation": { "rate": 1 } }
        }]
    }));
    assert_eq!(summary.obstacle_contacts.pushed, 1);
    assert!((0.9..2.0).contains(&contacts[0].push_speed), "{contacts:?}");
}

#[test]
fn friction_of_an_obstacle_alone_makes_balls_roll() {
    let (_, _, frames) = run::<2>(json!({
        "dimension": 2, "time": { "end": 4 }, "record": { "every": 1 },
        "physics": { "gravity": [0, -9.81] },
        "agents": [{
            "radius": 0.5, "positions": { "explicit": [[0, 0.5]] }, "velocities": { "common": [5, 0] }
        }],
        "obstacles": [{ "shape": { "half_space": { "normal": [0, 1] } }, "friction": 0.3 }]
    }));
    // Sliding turns into rolling at two thirds of the speed, for a disk.
    let speed = frames.last().expect("a frame").velocities[0][0];
    assert!((speed - 10.0 / 3.0).abs() < 0.02, "{speed}");
}
