//! What alignment promises: symmetries, bounds, conservation, scopes, senses.

use proptest::prelude::*;
use serde_json::json;
use volary::law::{Flock, Law, build};
use volary::math::Vector;
use volary::shape::{Geometry, In, Pose};

use crate::common::{headings, state};
use crate::scene::{Dice, accelerations, law, probe, world};

const MASSES: [f64; 8] = [1.0, 0.5, 2.0, 1.5, 3.0, 0.7, 1.0, 0.9];

/// Moving, turning, reflecting and relabelling the world does so with the accelerations.
fn equivariant<const D: usize>(seed: u64, turn: [f64; 3], shift: [f64; 3], reflect: bool)
where
    In<D>: Geometry<D>,
{
    let full = json!({
        "kernel": { "cucker_smale": { "exponent": 0.4 } }, "normalisation": "motsch_tadmor",
        "gain": { "bounded": { "bound": 2, "scale": 0.5 } }, "acts_as": "force",
        "masking": { "radius": 0.4 }, "line_of_sight": { "agents": 0.5 },
        "orientation": { "angle": 1.2, "speed": 0.5, "length": 0.2 }
    });
    let mut dice = Dice(seed);
    let n = MASSES.len();
    let (x, v) = (
        dice.vectors::<D>(n, -3.0, 3.0),
        dice.vectors::<D>(n, -2.0, 2.0),
    );
    let expected = accelerations(&world::<D>(&MASSES, full.clone(), json!({})), 0.0, &x, &v);
    let pose = Pose::<D>::new(Vector::from_fn(|k, _| shift[k]), turn);
    let mirror = |mut x: Vector<D>| {
        x[1] *= if reflect { -1.0 } else { 1.0 };
        x
    };
    let order: Vec<usize> = (0..n).map(|k| (k * 3 + 2) % n).collect();
    let masses: Vec<f64> = order.iter().map(|&i| MASSES[i]).collect();
    let at: Vec<_> = order
        .iter()
        .map(|&i| pose.point_to_world(&mirror(x[i])))
        .collect();
    let velocities: Vec<_> = order
        .iter()
        .map(|&i| pose.vector_to_world(&mirror(v[i])))
        .collect();
    let found = accelerations(&world::<D>(&masses, full, json!({})), 0.0, &at, &velocities);
    for (found, &i) in found.iter().zip(&order) {
        let error = (found - pose.vector_to_world(&mirror(expected[i]))).norm();
        assert!(error < 1e-9, "agent {i}: {error}");
    }
}

/// Numbers of any size: up to 1e±150, so that squares are numbers too.
fn any_size() -> impl Strategy<Value = f64> {
    (-1.0..1.0f64, -150..=150i32).prop_map(|(x, power)| x * 10f64.powi(power))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn alignment_does_not_depend_on_place_direction_or_number(
        seed in any::<u64>(),
        turn in prop::array::uniform3(-2.0..2.0f64),
        shift in prop::array::uniform3(-30.0..30.0f64),
        reflect in any::<bool>(),
    ) {
        equivariant::<2>(seed, turn, shift, reflect);
        equivariant::<3>(seed, turn, shift, reflect);
    }

    #[test]
    fn a_bounded_gain_bounds_the_acceleration_in_any_state(
        numbers in prop::collection::vec(any_size(), 32),
        ordinary in any::<bool>(),
        epsilon in 1e-6..10.0f64,
        bounds in prop::collection::vec(1e-3..1e3f64, 8),
        scale in 1e-3..1e3f64,
        normalisation in prop::sample::select(&["none", "mean_field", "motsch_tadmor"][..]),
    ) {
        let law = json!({
            "kernel": { "cucker_smale": { "strength": 5, "exponent": 0.2 } },
            "normalisation": normalisation, "epsilon": epsilon, "self_influence": false,
            "gain": { "bounded": { "bound": bounds, "scale": scale } }
        });
        let world = world::<2>(&MASSES, law, json!({}));
        let vector = |k: usize| Vector::<2>::new(numbers[2 * k], numbers[2 * k + 1]);
        let mut x: Vec<_> = (0..8).map(vector).collect();
        if ordinary {
            x = Dice(1).vectors(8, -3.0, 3.0);
        }
        let v: Vec<_> = (8..16).map(vector).collect();
        for (agent, a) in accelerations(&world, 0.0, &x, &v).iter().enumerate() {
            // To the last bit, not to rounding; and a number in any case.
            prop_assert!(a.norm() <= bounds[agent] / epsilon, "{agent}: {}", a.norm());
        }
    }
}

#[test]
fn momentum_is_kept_where_influence_is_mutual() {
    let mut dice = Dice(3);
    let n = MASSES.len();
    for (normalisation, more) in [
        ("none", json!({})),
        ("mean_field", json!({})),
        (
            "none",
            json!({ "masking": { "radius": 0.3 }, "line_of_sight": { "agents": 0.25 } }),
        ),
    ] {
        let mut law = json!({
            "kernel": { "exponential": { "length": 4 } }, "normalisation": normalisation,
            "gain": 1.3, "acts_as": "force"
        });
        for (name, value) in more.as_object().expect("an object") {
            law[name] = value.clone();
        }
        let world = world::<3>(&MASSES, law, json!({}));
        let (x, v) = (
            dice.vectors::<3>(n, -2.0, 2.0),
            dice.vectors::<3>(n, -2.0, 2.0),
        );
        let forces: Vec<_> = (accelerations(&world, 0.0, &x, &v).iter().zip(MASSES))
            .map(|(a, mass)| a * mass)
            .collect();
        let size: f64 = forces.iter().map(|force| force.norm()).sum();
        let sum: Vector<3> = forces.iter().sum();
        assert!(
            size > 1.0 && sum.norm() < 1e-14 * size,
            "{}",
            sum.norm() / size
        );
    }
}

#[test]
fn coinciding_and_resting_agents_and_lone_ones_give_numbers() {
    for normalisation in ["none", "mean_field", "motsch_tadmor"] {
        let law = json!({
            "kernel": { "bump": { "range": 2 } }, "normalisation": normalisation,
            "self_influence": false, "masking": { "radius": 0.1 },
            "line_of_sight": { "agents": 0, "obstacles": 0 },
            "orientation": { "angle": 1, "speed": 0.1, "length": 0.1 }
        });
        let world = world::<2>(&[1.0; 5], law, json!({}));
        let x = [[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [90.0, 0.0]].map(Vector::from);
        let v = [[1.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 1.0], [3.0, 3.0]].map(Vector::from);
        let found = accelerations(&world, 0.0, &x, &v);
        assert!(found.iter().all(|a| a.norm().is_finite()), "{found:?}");
        assert_eq!(found[4], Vector::<2>::zeros());
    }
}

#[test]
fn scopes_choose_who_is_pulled_by_whom_and_how_many_count() {
    let agents = json!([
        { "name": "sheep", "radius": 0.1, "positions": { "explicit": [[0, 0], [9, 0]] } },
        { "name": "dogs", "radius": 0.1, "positions": { "explicit": [[0, 9], [9, 9], [5, 5]] } }
    ]);
    let laws = json!([{ "scope": { "agents": ["sheep"], "neighbours": ["dogs"], "laws": [
        { "alignment": {
            "normalisation": "mean_field", "gain": [1, 2], "relaxation": "always"
        } }
    ] } }]);
    let world = world::<2>(&[1.0], json!({}), json!({ "agents": agents, "laws": laws }));
    let mut dice = Dice(2);
    let (x, v) = (
        dice.vectors::<2>(5, 0.0, 9.0),
        dice.vectors::<2>(5, -1.0, 1.0),
    );
    let (found, rows) = probe(law(&world), &state(&world, 0.0, &x, &v, &headings(&v)));
    let mean = (v[2] + v[3] + v[4]) / 3.0;
    assert!((found[0] - (mean - v[0])).norm() < 1e-14);
    assert!((found[1] - (mean - v[1]) * 2.0).norm() < 1e-14);
    assert!(rows[2..].iter().all(Option::is_none) && rows[..2].iter().all(Option::is_some));
    assert!(build(&world)[0].relaxes());
}

#[test]
fn smooth_senses_weigh_before_the_normalisation() {
    let agents = json!([{
        "radius": 0.1, "positions": { "explicit": [[0, 0], [9, 0], [0, 9]] },
        "sensing": { "cone": { "angle": 2, "smooth": true, "bump_start": 0.1 } }
    }]);
    let law = json!({ "normalisation": "motsch_tadmor" });
    let world = world::<2>(&[1.0], law, json!({ "agents": agents }));
    let x = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Vector::<2>::from);
    let v = [[1.0, 0.0], [0.6, 0.8], [0.0, 1.0]].map(Vector::<2>::from);
    let found = accelerations(&world, 0.0, &x, &v)[0];
    let rho = |angle: f64| {
        let z = (angle / 2.0 - 0.1) / 0.9;
        (1.0 + (std::f64::consts::PI * z).cos()) / 2.0
    };
    let [a, b] = [rho(0.8f64.asin()), rho(std::f64::consts::FRAC_PI_2)];
    let expected = ((v[1] - v[0]) * a + (v[2] - v[0]) * b) / (1.0 + a + b);
    assert!((found - expected).norm() < 1e-12 && found.norm() > 0.1);
}

#[test]
fn stiff_laws_relax_and_slow_ones_do_not() {
    let relaxes = |file: serde_json::Value| {
        let boxed: Box<dyn Law<2>> = law(&world::<2>(&MASSES, file, json!({})));
        Flock::new(vec![boxed]).relaxes()
    };
    // The step is 0.01, so a rate of 25 is the limit; the lightest mass is a half.
    let tadmor = |gain: f64| json!({ "normalisation": "motsch_tadmor", "gain": gain });
    assert!(!relaxes(tadmor(24.9)) && relaxes(tadmor(25.1)));
    let force =
        |gain: f64| json!({ "normalisation": "motsch_tadmor", "gain": gain, "acts_as": "force" });
    assert!(!relaxes(force(12.4)) && relaxes(force(12.6)));
    // Eight agents: seven others, each with the kernel at its largest.
    let plain = |gain: f64| json!({ "kernel": { "constant": { "strength": 2 } }, "gain": gain });
    assert!(!relaxes(plain(1.78)) && relaxes(plain(1.79)));
    let ring = |gain: f64| json!({ "graph": { "ring": { "weight": 0.5 } }, "gain": gain });
    assert!(!relaxes(ring(49.0)) && relaxes(ring(51.0)));
    let bounded = |epsilon: f64| {
        json!({
            "normalisation": "motsch_tadmor", "epsilon": epsilon,
            "gain": { "bounded": { "bound": 10, "scale": 1 } }
        })
    };
    assert!(!relaxes(bounded(0.41)) && relaxes(bounded(0.39)));
    let open = json!({
        "normalisation": "mean_field",
        "gain": { "open_loop": { "sine": { "mean": 20, "amplitude": 10, "period": 1 } } }
    });
    assert!(relaxes(open.clone()));
    let mut never = open;
    never["relaxation"] = json!("never");
    assert!(!relaxes(never));
}
