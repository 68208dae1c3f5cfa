//! Several contacts at once: cradles, breaks, wedges, and many bounces in a row.

use serde_json::{Value, json};
use volary::math::Vector;

use crate::common::Dice;
use crate::{Run, list, run};

/// Disks of radius ½ and mass 1 at some places, with some velocities.
fn disks(places: &[[f64; 2]], velocities: &[[f64; 2]], restitution: f64) -> Value {
    json!({
        "dimension": 2, "time": { "end": 3 }, "physics": { "restitution": restitution },
        "agents": [{
            "radius": 0.5,
            "positions": { "explicit": places }, "velocities": { "explicit": velocities }
        }]
    })
}

fn energy<const D: usize>(run: &Run<D>) -> f64 {
    run.velocities.iter().map(|v| 0.5 * v.norm_squared()).sum()
}

#[test]
fn one_into_two_that_touch_keeps_energy_and_symmetry() {
    let far = -3.0f64.sqrt() / 2.0 - 1.0;
    let places = [[far, 0.0], [0.0, 0.5], [0.0, -0.5]];
    let run = run::<2>(disks(&places, &[[1.0, 0.0], [0.0; 2], [0.0; 2]], 1.0), 300);
    let aside = 0.2 * 3.0f64.sqrt();
    let expected = [[-0.2, 0.0], [0.6, aside], [0.6, -aside]];
    for (velocity, expected) in run.velocities.iter().zip(expected) {
        assert!(
            (velocity - Vector::<2>::from(expected)).norm() < 1e-12,
            "{velocity:?}"
        );
    }
    let [up, down] = [run.positions[1], run.positions[2]];
    assert_eq!((up.x, up.y), (down.x, -down.y));
}

#[test]
fn a_cradle_hands_the_blow_on_to_its_last_ball() {
    for count in 2..=20 {
        let places: Vec<[f64; 2]> = (0..count).map(|k| [f64::from(k), 0.0]).collect();
        let places: Vec<_> = [[-2.505, 0.0]].into_iter().chain(places).collect();
        let mut velocities = vec![[0.0; 2]; places.len()];
        velocities[0] = [1.0, 0.0];
        let run = run::<2>(disks(&places, &velocities, 1.0), 200);
        for (k, velocity) in run.velocities.iter().enumerate() {
            let expected = if k == places.len() - 1 { 1.0 } else { 0.0 };
            assert!(
                (velocity.x - expected).abs() < 1e-9,
                "{count}: {k} at {velocity:?}"
            );
        }
        assert!((energy(&run) - 0.5).abs() < 1e-9);
    }
}

#[test]
fn a_break_of_fifteen_keeps_energy_momentum_and_symmetry() {
    let mut places = vec![[-3.0, 0.0]];
    for row in 0..5 {
        let x = f64::from(row) * 0.75f64.sqrt();
        places.extend((0..=row).map(|k| [x, f64::from(k) - 0.5 * f64::from(row)]));
    }
    let mut velocities = vec![[0.0; 2]; places.len()];
    velocities[0] = [4.0, 0.0];
    let run = run::<2>(disks(&places, &velocities, 1.0), 150);
    assert!((energy(&run) - 8.0).abs() < 1e-7, "{}", energy(&run));
    let momentum: Vector<2> = run.velocities.iter().sum();
    assert!(
        (momentum - Vector::<2>::new(4.0, 0.0)).norm() < 1e-12,
        "{momentum:?}"
    );
    // Row by row, the first mirrors the last.
    let mut first = 1;
    for row in 0..5 {
        for k in 0..=row {
            let (one, other) = (run.velocities[first + k], run.velocities[first + row - k]);
            let mirrored = Vector::<2>::new(other.x, -other.y);
            assert!(
                (one - mirrored).norm() < 1e-6,
                "row {row}: {one:?} and {other:?}"
            );
        }
        first += row + 1;
    }
}

#[test]
fn bounces_never_add_energy() {
    for seed in 0..40 {
        let mut dice = Dice(seed);
        let restitutions = [dice.between(0.0, 1.0), dice.between(0.0, 1.0)];
        let group = |restitution: f64, mass: f64, places: &[[f64; 2]], dice: &mut Dice| {
            let velocities: Vec<_> = places
                .iter()
                .map(|_| list(&(dice.direction::<2>() * 3.0)))
                .collect();
            json!({
                "radius": 0.5, "mass": mass, "restitution": restitution,
                "positions": { "explicit": places }, "velocities": { "explicit": velocities }
            })
        };
        let one = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.5, 0.75f64.sqrt()]];
        let other = [[1.5, 0.75f64.sqrt()], [1.0, 3.0f64.sqrt()], [1.0, -1.0]];
        let world = json!({
            "dimension": 2, "time": { "end": 3 },
            "agents": [
                group(restitutions[0], 1.0, &one, &mut dice),
                group(restitutions[1], dice.magnitude(0.1, 10.0), &other, &mut dice)
            ]
        });
        let world = crate::world::<2>(crate::spec(world));
        let mut flock = volary::law::Flock::of_world(&world, Vec::new());
        let mut bodies = volary::dynamics::Bodies::new(&world, &mut flock).expect("it starts");
        let now = |bodies: &volary::dynamics::Bodies<2>| -> f64 {
            let velocities = bodies.snapshot().velocities.iter();
            let each = velocities.zip(&world.agents.mass);
            each.map(|(v, mass)| 0.5 * mass * v.norm_squared()).sum()
        };
        let mut before = now(&bodies);
        for _ in 0..100 {
            bodies.step(&mut flock).expect("a finite step");
            let after = now(&bodies);
            assert!(
                after <= before * (1.0 + 1e-9),
                "seed {seed}: {before} to {after}"
            );
            before = after;
        }
    }
}

#[test]
fn a_wedge_returns_what_it_gets() {
    // Two planes at 60°, a disk that comes straight down into the corner.
    let side = |sign: f64| {
        json!({ "shape": { "half_space": {
        "normal": [sign * (30.0f64).to_radians().cos(), (30.0f64).to_radians().sin()]
    } } })
    };
    let mut world = disks(&[[0.0, 3.0]], &[[0.0, -1.0]], 1.0);
    world["obstacles"] = json!([side(1.0), side(-1.0)]);
    let run = run::<2>(world, 300);
    assert!((energy(&run) - 0.5).abs() < 1e-9, "{:?}", run.velocities);
    assert!(run.velocities[0].x.abs() < 1e-9 && run.velocities[0].y > 0.9);
}

#[test]
fn a_ball_between_two_walls_bounces_on() {
    let wall = |x: f64, sign: f64| {
        json!({
            "shape": { "half_space": { "normal": [sign, 0] } }, "position": [x, 0]
        })
    };
    let mut world = disks(&[[0.0, 0.0]], &[[150.0, 0.0]], 1.0);
    world["time"] = json!({ "step": 0.01, "end": 100 });
    world["obstacles"] = json!([wall(-0.6, 1.0), wall(0.6, -1.0)]);
    // Room for the centre: 0.2. So 1.5 a step make 7.5 bounces, 10,000 steps 75,000.
    let run = run::<2>(world, 10_000);
    assert!(
        (run.velocities[0].x.abs() - 150.0).abs() < 1e-9,
        "{:?}",
        run.velocities
    );
    assert!(run.positions[0].x.abs() <= 0.1 + 1e-9);
    let impulse: f64 = run.touches.iter().map(|touch| touch.blow).sum();
    assert!(
        (impulse / 300.0 - 75_000.0).abs() < 2.0,
        "{}",
        impulse / 300.0
    );
}

#[test]
fn an_elastic_ball_keeps_its_height_for_a_hundred_bounces() {
    for step in [0.01, 0.001] {
        let world = json!({
            "dimension": 2, "time": { "step": step, "end": 140 },
            "physics": { "restitution": 1, "gravity": [0, -9.81] },
            "agents": [{ "radius": 0.1, "positions": { "explicit": [[0, 2.1]] } }],
            "obstacles": [{ "shape": { "half_space": { "normal": [0, 1] } } }]
        });
        let run = run::<2>(world, (128.0 / step) as usize);
        assert!(run.blows().len() >= 99, "{}", run.blows().len());
        let height = run.positions[0].y - 0.1 + 0.5 * run.velocities[0].y.powi(2) / 9.81;
        assert!((height - 2.0).abs() < 1e-8, "{step}: {height}");
    }
}
