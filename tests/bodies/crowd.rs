//! Bodies among each other: gaps, determinism, records, refusals.

use std::f64::consts::PI;

use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::Vector;
use volary::shape::In;
use volary::trace::record::Record;
use volary::world::check;
use volary::world::spec::{Rotation, WorldSpec};

use super::common::spec;
use super::{off_center, simulation, step};

/// Rods, boxes and hulls driven into each other and against a wall.
fn crowd(dimension: usize) -> Value {
    let vector = |x: f64, rest: f64| {
        let mut vector = vec![rest; dimension];
        vector[0] = x;
        vector
    };
    let hull = match dimension {
        2 => json!([[0.4, 0], [-0.2, 0.3], [-0.3, -0.2]]),
        _ => json!([[0.4, 0, 0], [-0.2, 0.3, 0], [-0.3, -0.2, 0.2], [0, 0, -0.3]]),
    };
    let group = |shape: Value, low: f64| {
        json!({
            "shape": shape, "count": 8, "density": 2,
            "positions": { "box": { "min": vector(low, -1.5), "max": vector(low + 3.0, 1.5) } },
            "velocities": { "uniform": { "min": vector(-1.0, -1.0), "max": vector(1.0, 1.0) } }
        })
    };
    let mut turning = group(json!({ "convex": { "points": hull } }), 6.5);
    turning["heading"] = json!({ "velocity": {} });
    json!({
        "dimension": dimension, "time": { "end": 4 }, "seed": 2,
        "physics": { "friction": 0.2, "restitution": 0.3 },
        "agents": [
            group(json!({ "capsule": { "half_length": 0.3, "radius": 0.1 } }), 0.0),
            group(json!({ "cuboid": { "half_extents": vector(0.3, 0.15) } }), 3.2),
            turning,
            { "radius": 0.2, "count": 4,
              "positions": { "box": { "min": vector(-3.0, -1.0), "max": vector(-1.0, 1.0) } } }
        ],
        "obstacles": [{ "shape": { "half_space": { "normal": vector(-1.0, 0.0) } },
                        "position": vector(10.5, 0.0) }],
        "laws": [{ "navigation": { "velocity": vector(3.0, 0.0), "feedback": "linear" } }]
    })
}

/// The smallest gaps at any time between bodies, and to the wall.
fn smallest_gaps<const D: usize>() -> (f64, f64)
where
    In<D>: Engine<D>,
{
    let mut run = simulation::<D>(crowd(D));
    let mut smallest = (f64::INFINITY, f64::INFINITY);
    for _ in 0..run.world().steps() {
        step(&mut run);
        let metrics = run.metrics();
        smallest.0 = smallest.0.min(metrics.agent_gap.expect("several agents"));
        smallest.1 = smallest.1.min(metrics.obstacle_gap.expect("a wall"));
    }
    assert!(run.ledger().agent_contacts().episodes > 5);
    assert!(run.ledger().obstacle_contacts().episodes > 5);
    smallest
}

#[test]
fn bodies_pressed_against_a_wall_and_each_other_stay_out() {
    // The thinnest body is 0.2 thick; those that meet do so at up to 0.06 in a step.
    for (bodies, wall) in [smallest_gaps::<2>(), smallest_gaps::<3>()] {
        assert!(bodies > -0.08, "{bodies} between bodies");
        assert!(wall > -0.001, "{wall} to the wall");
        assert!(wall < 0.01, "{wall}: they never came to the wall");
    }
}

fn bits<const D: usize>(threads: usize) -> Vec<u64>
where
    In<D>: Engine<D>,
{
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads can be made").install(|| {
        let mut run = simulation::<D>(crowd(D));
        (0..300).for_each(|_| step(&mut run));
        let state = run.snapshot();
        let rotations = state.rotations.expect("some are not round").iter();
        let vectors = state.positions.iter().chain(state.velocities);
        vectors
            .flat_map(|vector| vector.as_slice())
            .chain(rotations.flat_map(|rotation| rotation.as_slice()))
            .map(|x| x.to_bits())
            .collect()
    })
}

#[test]
fn runs_are_the_same_on_any_number_of_threads() {
    assert_eq!(bits::<2>(1), bits::<2>(3));
    assert_eq!(bits::<3>(1), bits::<3>(3));
}

#[test]
fn rotations_are_recorded_where_some_body_is_not_round() {
    let recorded = |json: Value| {
        let mut frames = Vec::new();
        let mut run = simulation::<2>(json);
        let end = run.run(
            |record| {
                if let Record::Frame(frame) = record {
                    frames.push(frame.rotations);
                }
                Ok::<_, ()>(())
            },
            |_| std::ops::ControlFlow::Continue(()),
        );
        end.expect("recording cannot fail");
        frames
    };
    let mut json = off_center(2);
    json["agents"][0]["rotation"] = json!(0.25);
    let frames = recorded(json.clone());
    let start = frames[0].as_ref().expect("a rod");
    assert_eq!(start.len(), 2);
    assert!(matches!(start[0], Rotation::Angle(x) if (x - 0.25).abs() < 1e-15));
    assert!(matches!(start[1], Rotation::Angle(0.0)));
    json["agents"].as_array_mut().expect("a list").remove(0);
    assert!(recorded(json).iter().all(Option::is_none));
}

#[test]
fn bodies_start_along_their_velocities_unless_told_otherwise() {
    let mut json = off_center(2);
    json["agents"][0]["velocities"] = json!({ "common": [-3, -4] });
    let start = |json: &Value| simulation::<2>(json.clone()).snapshot().headings[0];
    assert!((start(&json) - Vector::<2>::new(-0.6, -0.8)).norm() < 1e-12);
    json["agents"][0]["rotation"] = json!(PI / 2.0);
    assert!((start(&json) - Vector::<2>::new(0.0, 1.0)).norm() < 1e-12);
    json["agents"][0]["velocities"] = json!("rest");
    json["agents"][0]
        .as_object_mut()
        .expect("fields")
        .remove("rotation");
    assert_eq!(start(&json), Vector::<2>::new(1.0, 0.0));
}

#[test]
fn what_is_not_a_sound_number_is_refused() {
    type Field = fn(&mut WorldSpec) -> &mut Option<f64>;
    let right = spec(off_center(2));
    assert_eq!(check::problems(&right), []);
    let fields: [(&str, Field); 6] = [
        ("density", |world| &mut world.agents[0].density),
        ("restitution", |world| &mut world.agents[0].restitution),
        ("friction", |world| &mut world.agents[0].friction),
        ("force_rate_limit", |world| {
            &mut world.agents[0].force_rate_limit
        }),
        ("top_speed", |world| &mut world.agents[0].top_speed),
        ("radius", |world| &mut world.agents[1].radius),
    ];
    for (name, field) in fields {
        for wrong in [f64::NAN, f64::INFINITY, -1.0] {
            let mut world = right.clone();
            world.agents[0].mass = None;
            *field(&mut world) = Some(wrong);
            let paths: Vec<_> = check::problems(&world)
                .into_iter()
                .map(|it| it.path)
                .collect();
            let group = usize::from(name == "radius");
            assert_eq!(paths, [format!("agents[{group}].{name}")], "{wrong}");
        }
    }
}
