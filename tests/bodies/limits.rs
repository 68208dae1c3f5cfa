//! The limits of actuators.

use serde_json::{Value, json};
use volary::math::Vector;
use volary::simulation::Simulation;

use super::common::flock_world;
use super::{simulation, step};

/// A driven flock whose bodies have these fields besides.
fn limited(dimension: usize, more: Value) -> Simulation<2> {
    let mut json = serde_json::to_value(flock_world(dimension)).expect("a world");
    for (field, value) in more.as_object().expect("fields") {
        json["agents"][0][field] = value.clone();
    }
    simulation::<2>(json)
}

#[test]
fn the_laws_take_no_body_beyond_its_top_speed() {
    for solver_iterations in [1, 3] {
        let mut json = serde_json::to_value(flock_world(2)).expect("a world");
        json["agents"][0]["top_speed"] = json!(1.2);
        json["physics"]["solver_iterations"] = json!(solver_iterations);
        let mut run = simulation::<2>(json);
        let mut fastest = 0.0_f64;
        for _ in 0..run.world().steps() {
            step(&mut run);
            for velocity in run.snapshot().velocities {
                fastest = fastest.max(velocity.norm());
            }
        }
        assert!(fastest <= 1.2 * (1.0 + 1e-12), "{fastest}");
        assert!(fastest > 1.1999, "{fastest}: nobody came near");
    }
}

#[test]
fn above_the_top_speed_laws_brake_as_they_ask_and_never_push() {
    let speeds = |top_speed: Option<f64>, wish: f64| -> Vec<f64> {
        let mut run = simulation::<2>(json!({
            "dimension": 2, "time": { "end": 1 }, "physics": { "gravity": [0, -1] },
            "agents": [{
                "radius": 0.1, "top_speed": top_speed,
                "positions": { "explicit": [[0, 0]] }, "velocities": { "common": [0, -5] }
            }],
            "laws": [{ "navigation": {
                "velocity": [0, -wish], "feedback": "linear", "velocity_gain": 2
            } }]
        }));
        (0..100)
            .map(|_| {
                step(&mut run);
                run.snapshot().velocities[0].norm()
            })
            .collect()
    };
    // Gravity alone makes it faster, by 1 in a unit of time.
    let pushed = speeds(Some(3.0), 20.0);
    assert!((pushed[99] - 6.0).abs() < 1e-9, "{}", pushed[99]);
    assert_eq!(speeds(Some(3.0), 4.0), speeds(None, 4.0));
}

#[test]
fn forces_keep_their_limit_and_their_rate_in_every_step() {
    let (limit, rate) = (0.8, 2.0);
    let mut run = limited(2, json!({ "force_limit": limit, "force_rate_limit": rate }));
    let mut before: Vec<Vector<2>> = run.pushes().to_vec();
    let mut largest = (0.0_f64, 0.0_f64);
    for _ in 0..run.world().steps() {
        step(&mut run);
        for (now, before) in run.pushes().iter().zip(&before) {
            largest.0 = largest.0.max(now.norm());
            largest.1 = largest.1.max((now - before).norm());
        }
        before = run.pushes().to_vec();
    }
    assert!(largest.0 <= limit * (1.0 + 1e-12), "{largest:?}");
    assert!(largest.1 <= rate * 0.01 * (1.0 + 1e-12), "{largest:?}");
    let summary = run.run(|_| Ok::<_, ()>(()), |_| std::ops::ControlFlow::Continue(()));
    let summary = summary.expect("recording cannot fail");
    assert!(
        summary.force_cuts > 0 && summary.rate_cuts > 0,
        "{summary:?}"
    );
    assert_eq!(summary.speed_cuts, 0);
}

#[test]
fn limits_that_never_cut_change_nothing() {
    let last = |more: Value| {
        let mut run = limited(2, more);
        (0..200).for_each(|_| step(&mut run));
        (
            run.snapshot().positions.to_vec(),
            run.snapshot().velocities.to_vec(),
        )
    };
    let far = json!({ "force_limit": 1e9, "force_rate_limit": 1e9, "top_speed": 1e9 });
    assert_eq!(last(far), last(json!({})));
}
