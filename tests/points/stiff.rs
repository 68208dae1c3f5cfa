//! Stiff relaxation, whose solution is known.

use serde_json::json;
use volary::world::World;

use crate::common::{spec, world};
use crate::reference::{points, run_to};

/// Three agents that align by the mean, ε small: v_i − v̄ falls as exp(−t/ε).
fn three(epsilon: f64) -> World<3> {
    world(spec(json!({
        "dimension": 3,
        "time": { "step": 0.5, "end": 4.0 },
        "record": { "every": 2.0 },
        "agents": [{
            "radius": 1e-3,
            "positions": { "explicit": [[0, 0, 0], [1, 0, 2], [0, 3, 1]] },
            "velocities": { "explicit": [[1, 0, -0.5], [0, 0.25, 0.5], [0.5, -1, 0]] }
        }],
        "laws": [{ "alignment": { "normalisation": "mean_field", "epsilon": epsilon } }]
    })))
}

#[test]
fn velocities_relax_as_the_exponential_and_positions_by_its_integral() {
    for (epsilon, solver) in [
        (1.0, "Dormand"),
        (1e-2, "Radau"),
        (1e-4, "Radau"),
        (1e-6, "Radau"),
    ] {
        let start = three(epsilon);
        let (x, v) = (
            start.agents.positions.clone(),
            start.agents.velocities.clone(),
        );
        let mean = v.iter().sum::<volary::math::Vector<3>>() / 3.0;
        let mut simulation = points(start, 1e-11);
        let method = simulation.solver().expect("points have a solver").method;
        assert!(method.starts_with(solver), "{epsilon}: {method}");
        for time in [0.5, 4.0] {
            run_to(&mut simulation, time);
            let state = simulation.snapshot();
            let left = (-time / epsilon).exp();
            for i in 0..3 {
                let velocity = mean + (v[i] - mean) * left;
                let position = x[i] + mean * time + (v[i] - mean) * (epsilon * (1.0 - left));
                let error = f64::max(
                    (state.velocities[i] - velocity).norm(),
                    (state.positions[i] - position).norm(),
                );
                assert!(error < 3e-10, "{epsilon} at {time}: {error:e}");
            }
        }
    }
}

/// A finer accuracy gives a finer result, by either method.
#[test]
fn what_is_asked_for_is_what_comes() {
    for epsilon in [0.5, 1e-3] {
        let errors = [1e-4, 1e-7, 1e-10].map(|relative| {
            let start = three(epsilon);
            let (x, v) = (start.agents.positions[0], start.agents.velocities.clone());
            let mean = v.iter().sum::<volary::math::Vector<3>>() / 3.0;
            let mut simulation = points(start, relative);
            run_to(&mut simulation, 4.0);
            let left = (-4.0 / epsilon).exp();
            let wanted = x + mean * 4.0 + (v[0] - mean) * (epsilon * (1.0 - left));
            (simulation.snapshot().positions[0] - wanted).norm()
        });
        for (error, relative) in errors.iter().zip([1e-4, 1e-7, 1e-10]) {
            assert!(
                *error < 30.0 * relative,
                "{epsilon}, {relative:e}: {error:e}"
            );
        }
    }
}
