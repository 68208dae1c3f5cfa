//! Noise and lost links: reproducible, independent, and of the right size.

use serde_json::json;
use volary::law::Flock;
use volary::math::Vector;
use volary::world::World;

use crate::common::{headings, state};
use crate::scene::{Dice, Told, Watch, who, world};

const RANGE: f64 = 3.0;

fn scene(agents: usize, seed: u64, sensing: serde_json::Value) -> World<2> {
    world(&[(agents, sensing)], json!({ "seed": seed }))
}

/// What is told in one step of a scene of 700 agents, or of the first of them.
fn told(agents: usize, seed: u64, time: f64, sensing: serde_json::Value) -> Vec<Told<2>> {
    let mut dice = Dice(11);
    let (mut at, mut v) = (
        dice.vectors::<2>(700, 0.0, 40.0),
        dice.vectors::<2>(700, -1.0, 1.0),
    );
    at.truncate(agents);
    v.truncate(agents);
    let world = scene(agents, seed, sensing);
    Watch::new(&world, RANGE).look(&state(&world, time, &at, &v, &headings(&v)))
}

#[test]
fn errors_have_their_size_and_leave_the_choice_alone() {
    let plain = told(700, 1, 0.0, json!({}));
    let noisy = told(
        700,
        1,
        0.0,
        json!({ "noise": { "position": 0.5, "velocity": 0.2 } }),
    );
    // Noise corrupts what is told of those who are seen, not who they are.
    assert_eq!(who(&plain), who(&noisy));
    let n = 2.0 * plain.len() as f64;
    assert!(n > 10_000.0);
    let errors = |of: fn(&Told<2>) -> Vector<2>| -> (f64, f64) {
        let errors: Vec<_> = plain
            .iter()
            .zip(&noisy)
            .map(|(a, b)| of(b) - of(a))
            .collect();
        let mean = errors.iter().map(|e| e.sum()).sum::<f64>() / n;
        let variance = errors.iter().map(|e| e.norm_squared()).sum::<f64>() / n;
        (mean, variance.sqrt())
    };
    // Five standard errors are 5σ/√n, and 5σ/√(2n) of the deviation.
    for (found, deviation) in [
        (errors(|told| told.2.offset), 0.5),
        (errors(|told| told.2.velocity), 0.2),
    ] {
        assert!(found.0.abs() < 0.05 * deviation, "{found:?}");
        assert!((found.1 - deviation).abs() < 0.036 * deviation, "{found:?}");
    }
    for (_, _, neighbour) in &noisy {
        assert_eq!(neighbour.squared, neighbour.offset.norm_squared());
        let along = neighbour.velocity.normalize();
        assert!((neighbour.heading - along).norm() < 1e-14);
    }
}

#[test]
fn errors_follow_seed_step_and_link_alone() {
    let sensing = json!({ "noise": { "position": 0.5, "velocity": 0.2 }, "dropout": 0.2 });
    let run = |agents, seed, time| told(agents, seed, time, sensing.clone());
    let first = run(700, 1, 0.3);
    assert_eq!(first, run(700, 1, 0.3));
    // The rest hear the same where some are gone.
    let fewer = run(650, 1, 0.3);
    let rest: Vec<_> = (first.iter())
        .filter(|(i, j, _)| *i < 650 && *j < 650)
        .map(|&(i, j, neighbour)| (i, j, neighbour.offset, neighbour.velocity))
        .collect();
    let fewer: Vec<_> = (fewer.iter())
        .map(|&(i, j, neighbour)| (i, j, neighbour.offset, neighbour.velocity))
        .collect();
    assert_eq!(rest, fewer);
    // Another seed and another step tell something else.
    assert_ne!(who(&first), who(&run(700, 2, 0.3)));
    assert_ne!(who(&first), who(&run(700, 1, 0.4)));
}

#[test]
fn links_drop_out_at_their_rate() {
    let all = told(700, 1, 0.0, json!({})).len() as f64;
    for rate in [0.25, 0.9] {
        let left = told(700, 1, 0.0, json!({ "dropout": rate })).len() as f64;
        let error = (left / all - (1.0 - rate)).abs();
        assert!(error < 5.0 * (rate * (1.0 - rate) / all).sqrt(), "{error}");
    }
    assert!(told(700, 1, 0.0, json!({ "dropout": 1 })).is_empty());
}

#[test]
fn senses_do_not_depend_on_threads() {
    let sensing = json!({
        "radius": 2.8, "field_of_view": { "angle": 2.5 },
        "cone": { "angle": 2.9, "smooth": true },
        "blocked_by": { "obstacles": true, "bodies": true },
        "noise": { "position": 0.1, "velocity": 0.1 }, "delay": 0.2, "dropout": 0.1
    });
    let more = json!({
        "obstacles": [{ "shape": { "ball": { "radius": 3 } }, "position": [20, 20] }],
        "laws": [
            { "alpha_interaction": { "spacing": 2, "range": 2.9 } },
            { "scope": { "agents": ["group 0"], "neighbours": ["group 1"], "laws": [
                { "heading_consensus": { "range": 2.5 } },
                { "navigation": { "steer": "mean", "velocity": [1, 0] } }
            ] } }
        ]
    });
    let world = world::<2>(&[(400, sensing.clone()), (300, sensing)], more);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads can be made").install(|| {
            let mut dice = Dice(5);
            let mut flock = Flock::of_world(&world, Vec::new());
            let mut all = Vec::new();
            for step in 0..6 {
                let at = dice.vectors::<2>(700, 0.0, 40.0);
                let v = dice.vectors::<2>(700, -1.0, 1.0);
                let mut out = vec![Vector::zeros(); 700];
                let time = f64::from(step) * 0.1;
                flock.accelerations(&state(&world, time, &at, &v, &headings(&v)), &mut out);
                all.extend(out);
            }
            all
        })
    };
    let one = run(1);
    assert!(one.iter().all(|a| a.norm().is_finite()) && one.iter().any(|a| a.norm() > 1.0));
    assert_eq!(one, run(4));
}
