//! Restitution and friction.

use serde_json::{Value, json};

use super::{simulation, step};

/// Speed of parting over speed of meeting of two bodies whose surfaces differ, head on.
fn bounce(shape: Value, first: f64, second: f64) -> f64 {
    // What steers its heading would turn round when its velocity does.
    let heading = match shape["ball"].is_null() {
        true => json!("free"),
        false => json!(null),
    };
    let body = |x: f64, speed: f64, restitution: f64| {
        json!({
            "heading": heading, "shape": shape, "restitution": restitution, "positions": { "explicit": [[x, 0]] },
            "velocities": { "common": [speed, 0] }
        })
    };
    let mut run = simulation::<2>(json!({
        "dimension": 2, "time": { "end": 4 }, "physics": { "restitution": 0.9 },
        "agents": [body(0.0, 1.0, first), body(5.0, -1.0, second)]
    }));
    for _ in 0..400 {
        step(&mut run);
    }
    let velocities = run.snapshot().velocities;
    (velocities[1].x - velocities[0].x) / 2.0
}

#[test]
fn a_contact_has_the_mean_restitution_of_its_surfaces() {
    for shape in [
        json!({ "ball": { "radius": 0.5 } }),
        json!({ "capsule": { "half_length": 0.5, "radius": 0.3 } }),
        json!({ "cuboid": { "half_extents": [0.5, 0.3] } }),
    ] {
        for (first, second) in [(1.0, 1.0), (1.0, 0.2), (0.0, 0.0), (0.0, 0.5)] {
            let found = bounce(shape.clone(), first, second);
            let mean = 0.5 * (first + second);
            // Flat sides meet at two points, which the engine bounces one after the other.
            let slack = match shape["cuboid"].is_null() {
                true => 0.02,
                false => 0.06,
            };
            assert!((found - mean).abs() < slack, "{shape}: {found} for {mean}");
        }
    }
}

#[test]
fn friction_makes_disks_and_spheres_roll() {
    // Down a slope of 0.2 radians, which is a level floor under tilted gravity. The floor
    // has no friction of its own: the contact has half of the body's.
    let (down, into) = (9.81 * 0.2_f64.sin(), -9.81 * 0.2_f64.cos());
    let rolled = |dimension: usize, friction: f64| -> f64 {
        let tilt = [down, into, 0.0];
        let json = json!({
            "dimension": dimension, "time": { "end": 2 },
            "physics": { "gravity": &tilt[..dimension] },
            "agents": [{ "radius": 0.5, "friction": friction, "mass": 3, "positions": {
                "explicit": [&[0.0, 0.5, 0.0][..dimension]]
            } }],
            "obstacles": [{ "shape": { "half_space": {
                "normal": &[0.0, 1.0, 0.0][..dimension]
            } } }]
        });
        let speed = |velocity: &[f64]| velocity[0];
        if dimension == 2 {
            let mut run = simulation::<2>(json);
            (0..200).for_each(|_| step(&mut run));
            speed(run.snapshot().velocities[0].as_slice())
        } else {
            let mut run = simulation::<3>(json);
            (0..200).for_each(|_| step(&mut run));
            speed(run.snapshot().velocities[0].as_slice())
        }
    };
    for (dimension, share) in [(2, 2.0 / 3.0), (3, 5.0 / 7.0)] {
        let rolling = rolled(dimension, 1.0) / (2.0 * down);
        assert!(
            (rolling / share - 1.0).abs() < 0.02,
            "{dimension}-D: {rolling} for {share}"
        );
        let sliding = rolled(dimension, 0.0) / (2.0 * down);
        assert!((sliding - 1.0).abs() < 0.02, "{dimension}-D: {sliding}");
    }
}
