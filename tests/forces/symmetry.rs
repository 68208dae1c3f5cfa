//! Where the world is, how it is turned or mirrored, and how its agents are numbered changes
//! nothing but that.

use proptest::prelude::*;
use serde_json::{Value, json};
use volary::math::{Matrix, Vector};
use volary::shape::{Geometry, In, Pose};

use crate::pairs::potentials;
use crate::{Crowd, assert_same};

/// Every law of this folder, with the line along `line`.
fn laws(line: &[f64]) -> Vec<Value> {
    let mut laws: Vec<Value> = potentials()
        .into_iter()
        .flat_map(|potential| {
            let pair = json!({ "potential": potential, "acts_as": "force", "range": 4 });
            let flow = json!({ "potential": potential, "rate": 2, "share": "mean" });
            [
                json!({ "pair_potential": pair }),
                json!({ "first_order_flow": flow }),
            ]
        })
        .collect();
    laws.extend([
        json!({ "cucker_dong": { "squared_distance": 0.05, "exponent": 1.5 } }),
        json!({ "park_bonding": { "velocity_gain": 1, "position_gain": 2, "radius": 0.7 } }),
        json!({ "line_pattern": { "direction": line } }),
        json!({ "line_pattern": { "direction": line, "normalised": true } }),
        json!({ "ball_pattern": { "radius": 2 } }),
        json!({ "friction": { "coefficient": 0.3, "exponent": 1.5, "acts_as": "force" } }),
        json!({ "friction_compensation": { "coefficient": 0.3 } }),
        json!({ "self_propulsion": { "propulsion": 1, "drag": 0.3 } }),
    ]);
    laws
}

fn equivariant<const D: usize>(turn: [f64; 3], shift: [f64; 3], seed: u64, mirrored: bool)
where
    In<D>: Geometry<D>,
{
    let pose = Pose::<D>::new(Vector::zeros(), turn);
    let mut mirror = Matrix::<D>::identity();
    if mirrored {
        mirror[(0, 0)] = -1.0;
    }
    let map = |x: &Vector<D>| pose.vector_to_world(&(mirror * x));
    let shift = Vector::<D>::from_fn(|k, _| shift[k]);
    let here = Crowd::<D>::new(9, seed);
    let there = Crowd {
        at: here.at.iter().rev().map(|x| map(x) + shift).collect(),
        v: here.v.iter().rev().map(map).collect(),
        mass: here.mass.iter().rev().copied().collect(),
    };
    let line = Vector::<D>::from_fn(|k, _| 1.0 + k as f64);
    let turned = map(&line);
    for (law, moved) in laws(line.as_slice())
        .into_iter()
        .zip(laws(turned.as_slice()))
    {
        let expected: Vec<_> = here.under(json!([&law])).iter().rev().map(map).collect();
        assert_same(&there.under(json!([moved])), &expected, &law.to_string());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn laws_do_not_depend_on_where_the_world_is_or_how_agents_are_numbered(
        turn in prop::array::uniform3(-2.0..2.0f64),
        shift in prop::array::uniform3(-1.0..1.0f64),
        seed in any::<u64>(),
        mirrored in any::<bool>(),
    ) {
        equivariant::<2>(turn, shift, seed, mirrored);
        equivariant::<3>(turn, shift, seed, mirrored);
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    // Enough agents for the parallel path.
    let mut crowd = Crowd::<3>::new(40, 6);
    while crowd.len() < 700 {
        let (i, by) = (crowd.len(), Vector::<3>::repeat(crowd.len() as f64 * 0.01));
        crowd.at.push(crowd.at[i - 40] + by);
        crowd.v.push(crowd.v[i - 40].yxz());
        crowd.mass.push(crowd.mass[i - 40]);
    }
    let all = Value::Array(laws(&[1.0, 2.0, 3.0]));
    let world = crowd.world(&[crowd.len()], all);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| {
            let flock = volary::law::Flock::of_world(&world, Vec::new());
            crowd.accelerations(flock, &world.agents.group)
        })
    };
    let (one, three) = (run(1), run(3));
    assert!(one == three && one.iter().all(|a| a.iter().all(|x| x.is_finite())));
}
