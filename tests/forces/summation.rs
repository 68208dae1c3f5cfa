//! Worlds whose sums over all pairs are taken fast against the same summed directly.

use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::Vector;
use volary::shape::In;
use volary::simulation::Simulation;

use crate::common::{self, Dice, from_json};

/// Positions and velocities, one after the other, after some steps of a world with a law
/// whose sums are taken in this way.
fn after<const D: usize>(name: &str, law: &Value, summation: Value) -> Vec<Vector<D>>
where
    In<D>: Engine<D>,
{
    const COUNT: usize = 400;
    let mut dice = Dice(5);
    let mut rows = |low: f64, high: f64| -> Vec<Vec<f64>> {
        let vectors = dice.vectors::<D>(COUNT, low, high);
        vectors.iter().map(|it| it.as_slice().to_vec()).collect()
    };
    let [places, velocities] = [rows(-20.0, 20.0), rows(-0.5, 0.5)];
    let mut law = law.clone();
    law["summation"] = summation;
    let mut laws = json!([{}]);
    laws[0][name] = law;
    let world = common::world::<D>(from_json(json!({
        "dimension": D,
        "time": { "end": 1 },
        "agents": [{
            "radius": 1e-3,
            "positions": { "explicit": places }, "velocities": { "explicit": velocities }
        }],
        "laws": laws
    })));
    let mut simulation = Simulation::new(world).expect("a world that runs");
    for _ in 0..5 {
        simulation.step().expect("a finite state");
    }
    let snapshot = simulation.snapshot();
    [snapshot.positions, snapshot.velocities].concat()
}

fn compare<const D: usize>(name: &str, law: &Value)
where
    In<D>: Engine<D>,
{
    let direct = after::<D>(name, law, json!("direct"));
    let fast = after::<D>(name, law, json!({ "fast": { "relative_error": 1e-6 } }));
    let away = |(one, other): (&Vector<D>, &Vector<D>)| (one - other).norm();
    let error = direct.iter().zip(&fast).map(away).fold(0.0, f64::max);
    // All that laws did is less than 1 in all, and errors are relative to it.
    assert!(error <= 1e-6, "{D}-D, {law}: {error:e}");
    // Sums in another order: the fast way was taken.
    assert!(direct != fast, "{D}-D, {law}: the same to the bit");
}

#[test]
fn fast_sums_move_agents_as_direct_ones_do() {
    let alignment = json!({
        "kernel": { "cucker_smale": { "strength": 1, "length": 1, "exponent": 0.5 } },
        "normalisation": "mean_field"
    });
    let gazi_passino = json!({
        "potential": {
            "gazi_passino": { "attraction": 0.5, "repulsion": 3, "squared_length": 1.3 }
        },
        "share": "mean"
    });
    compare::<2>("alignment", &alignment);
    compare::<3>("alignment", &alignment);
    compare::<2>("pair_potential", &gazi_passino);
    compare::<3>("pair_potential", &gazi_passino);
}
