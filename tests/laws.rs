//! What every law must respect: symmetries, conservation, potentials, and the papers' formulas.

mod common;

use common::{flock_world, spec, world};
use proptest::prelude::*;
use serde_json::json;
use volary::math::Vector;
use volary::net::{Net, structural_energy};
use volary::shape::{Geometry, In, Pose};
use volary::world::World;
use volary::world::spec::{ObstacleSpec, Rotation, WorldSpec};

const PROTOCOLS: [&str; 4] = [
    "nonsmooth",
    "smooth",
    "smooth_weighted_damping",
    "approximate",
];

/// What a world's laws give in some state at time 0.
fn accelerations<const D: usize>(
    world: &World<D>,
    positions: &[Vector<D>],
    velocities: &[Vector<D>],
) -> Vec<Vector<D>> {
    common::accelerations(world, 0.0, positions, velocities)
}

fn alpha_only(dimension: usize, protocol: &str) -> WorldSpec {
    let mut spec = flock_world(dimension);
    spec.obstacles.clear();
    spec.laws = common::spec(json!({
        "dimension": dimension, "time": { "end": 1 },
        "agents": [{ "radius": 1, "positions": { "explicit": [vec![0; dimension]] } }],
        "laws": [{ "alpha_interaction": {
            "protocol": protocol, "spacing": 2.5, "range": 3.5, "damping": 0.6
        } }]
    }))
    .laws;
    spec
}

/// Moves a whole world: every position and direction in its file.
fn moved<const D: usize>(spec: &WorldSpec, pose: &Pose<D>) -> WorldSpec {
    let mut value = serde_json::to_value(spec).expect("a world can be written");
    let turn = |list: &mut serde_json::Value| {
        let numbers: Vec<f64> = serde_json::from_value(list.clone()).expect("a vector");
        let turned = pose.vector_to_world(&volary::world::vector(&numbers));
        *list = json!(turned.as_slice());
    };
    for law in value["laws"].as_array_mut().expect("laws") {
        if let Some(navigation) = law.get_mut("navigation") {
            turn(&mut navigation["velocity"]);
        }
    }
    let mut spec: WorldSpec = serde_json::from_value(value).expect("still a world");
    for ObstacleSpec {
        position, rotation, ..
    } in &mut spec.obstacles
    {
        let at = volary::world::vector_or_zero::<D>(position);
        *position = Some(pose.point_to_world(&at).as_slice().to_vec());
        *rotation = Some(match D {
            2 => Rotation::Angle(pose.turn()[2]),
            _ => Rotation::Vector(pose.turn().to_vec()),
        });
    }
    spec
}

/// Senses that treat all directions alike, and laws in a scope.
fn with_senses_and_scope(spec: &mut WorldSpec) {
    let group = &mut spec.agents[0];
    group.name = Some("flock".to_owned());
    group.radius = Some(0.3);
    group.sensing = common::from_json(json!({
        "radius": 3.2,
        "field_of_view": { "angle": 2.1 },
        "cone": { "angle": 2.8, "smooth": true },
        "blocked_by": { "obstacles": true, "bodies": true }
    }));
    spec.laws.push(common::from_json(json!({ "scope": {
        "agents": ["flock"], "neighbours": ["flock"],
        "laws": [{ "heading_consensus": { "gain": 2, "range": 5, "smooth": true } }]
    } })));
}

/// Moving and relabelling the world moves and relabels the accelerations.
fn equivariant<const D: usize>(turn: [f64; 3], shift: [f64; 3], protocol: &str, senses: bool)
where
    In<D>: Geometry<D>,
{
    let pose = Pose::<D>::new(Vector::from_fn(|k, _| shift[k]), turn);
    let mut original = flock_world(D);
    original.laws[0] = alpha_only(D, protocol).laws[0].clone();
    if senses {
        with_senses_and_scope(&mut original);
    }
    // An obstacle without symmetry, amid the flock, at rest in its own frame.
    original.obstacles.push(
        serde_json::from_value(json!({
            "shape": { "cuboid": { "half_extents": vec![0.8; D] } }, "position": vec![-2.5; D]
        }))
        .expect("an obstacle"),
    );
    let here = world::<D>(original.clone());
    let mut there_spec = moved(&original, &pose);
    // The starts are drawn in the original world only.
    there_spec.agents[0].positions = serde_json::from_value(json!({
        "explicit": here.agents.positions.iter()
            .map(|q| pose.point_to_world(q).as_slice().to_vec()).collect::<Vec<_>>()
    }))
    .expect("positions");
    let there = world::<D>(there_spec);

    let order: Vec<usize> = (0..here.agents.len()).rev().collect();
    let positions: Vec<_> = order.iter().map(|&i| there.agents.positions[i]).collect();
    let velocities: Vec<_> = order
        .iter()
        .map(|&i| pose.vector_to_world(&here.agents.velocities[i]))
        .collect();
    let expected = accelerations(&here, &here.agents.positions, &here.agents.velocities);
    let found = accelerations(&there, &positions, &velocities);
    for (place, &i) in order.iter().enumerate() {
        let expected = pose.vector_to_world(&expected[i]);
        let error = (found[place] - expected).norm();
        assert!(error < 1e-9, "{protocol}, agent {i}: {error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn laws_do_not_depend_on_where_the_world_is_or_how_agents_are_numbered(
        turn in prop::array::uniform3(-2.0..2.0f64),
        shift in prop::array::uniform3(-30.0..30.0f64),
        protocol in prop::sample::select(&PROTOCOLS[..]),
        senses in any::<bool>(),
    ) {
        equivariant::<2>(turn, shift, protocol, senses);
        equivariant::<3>(turn, shift, protocol, senses);
    }
}

#[test]
fn alpha_forces_are_the_gradient_of_the_structural_potential() {
    // Protocols (34), within its range, and (35) without damping.
    for protocol in ["nonsmooth", "smooth"] {
        let mut spec = alpha_only(3, protocol);
        let volary::world::spec::LawSpec::AlphaInteraction(alpha) = &mut spec.laws[0] else {
            panic!("the world has this law");
        };
        alpha.damping = 0.0;
        let pair = alpha.pair();
        let world = world::<3>(spec);
        let positions = world.agents.positions.clone();
        let rest = vec![Vector::zeros(); positions.len()];
        let force = accelerations(&world, &positions, &rest);
        let energy = |positions: &[Vector<3>]| {
            structural_energy(positions, &rest, &Net::new(positions, pair.range), &pair)
        };
        for i in 0..positions.len() {
            for axis in 0..3 {
                let h = 1e-6;
                let shifted = |by: f64| {
                    let mut positions = positions.clone();
                    positions[i][axis] += by;
                    energy(&positions)
                };
                let numeric = -(shifted(h) - shifted(-h)) / (2.0 * h);
                assert!(
                    (numeric - force[i][axis]).abs() < 1e-6,
                    "{protocol}: agent {i}"
                );
            }
        }
    }
}

#[test]
fn alpha_protocols_keep_the_momentum_to_rounding() {
    for protocol in PROTOCOLS {
        let world = world::<3>(alpha_only(3, protocol));
        let agents = &world.agents;
        let all = accelerations(&world, &agents.positions, &agents.velocities);
        let sum: Vector<3> = all.iter().sum();
        let size: f64 = all.iter().map(|a| a.norm()).sum();
        assert!(size > 1.0, "{protocol}: nothing happens");
        assert!(
            sum.norm() < 1e-14 * size,
            "{protocol}: {}",
            sum.norm() / size
        );
    }
}

fn explicit(positions: serde_json::Value, laws: serde_json::Value) -> World<2> {
    world(spec(json!({
        "dimension": 2, "time": { "end": 1 },
        "agents": [{ "radius": 0.1, "positions": { "explicit": positions } }],
        "laws": laws
    })))
}

#[test]
fn two_agents_follow_equation_34() {
    let law = json!([{ "alpha_interaction": {
        "protocol": "nonsmooth", "spacing": 7, "range": 8.4, "damping": 2,
        "action": { "attraction": 1, "repulsion": 5 }
    } }]);
    let world = explicit(json!([[0, 0], [3, 4], [40, 0]]), law);
    let velocities = [[1.0, 0.0], [0.0, 1.0], [9.0, 9.0]].map(Vector::<2>::from);
    let found = accelerations(&world, &world.agents.positions, &velocities);
    // φ_α(−2) along (3, 4)/5, plus 2 (p_1 − p_0).
    let c = 4.0 / (2.0 * 5.0f64.sqrt());
    let s = -2.0 + c;
    let phi = 3.0 * s / (1.0 + s * s).sqrt() - 2.0;
    let expected = Vector::<2>::new(0.6, 0.8) * phi + Vector::<2>::new(-2.0, 2.0);
    assert!((found[0] - expected).norm() < 1e-14);
    assert!((found[1] + expected).norm() < 1e-14);
    assert_eq!(found[2], Vector::<2>::zeros());
}

#[test]
fn agents_at_the_same_point_give_no_nan() {
    let law = json!([{ "alpha_interaction": { "spacing": 7, "range": 8.4 } }]);
    let world = explicit(json!([[0, 0], [3, 4]]), law);
    let same = [Vector::<2>::zeros(); 2];
    let found = accelerations(&world, &same, &same);
    assert!(found.iter().all(|a| *a == Vector::<2>::zeros()));
}

#[test]
fn navigation_follows_its_equations() {
    let at = json!([[3, 0], [1, 0]]);
    let velocities = [[0.0, 2.0], [0.0, 0.0]].map(Vector::<2>::from);
    let run = |law: serde_json::Value| {
        let world = explicit(at.clone(), json!([{ "navigation": law }]));
        accelerations(&world, &world.agents.positions, &velocities)
    };
    // (66): by the mean, which is (0, 1), the same for all.
    let mean = run(json!({ "steer": "mean", "velocity": [0, 4], "velocity_gain": 5 }));
    let expected = Vector::<2>::new(0.0, 5.0 * 3.0 / 10.0f64.sqrt());
    assert!(mean.iter().all(|a| (a - expected).norm() < 1e-14));
    // (64): the mean position is (2, 0).
    let sink = run(json!({ "steer": "mean", "destination": [0, 0], "velocity_gain": 5 }));
    let expected = Vector::<2>::new(-2.0 / 5.0f64.sqrt(), -5.0 / 2.0f64.sqrt());
    assert!(sink.iter().all(|a| (a - expected).norm() < 1e-14));
    // (50), with gains.
    let linear = run(json!({
        "feedback": "linear", "destination": [0, 0], "position_gain": 0.5, "velocity_gain": 3
    }));
    assert_eq!(linear[0], Vector::<2>::new(-1.5, -6.0));
    assert_eq!(linear[1], Vector::<2>::new(-0.5, 0.0));
}

#[test]
fn obstacle_avoidance_follows_equation_54() {
    let world: World<2> = world(spec(json!({
        "dimension": 2, "time": { "end": 1 },
        "agents": [{ "radius": 0.1, "positions": { "explicit": [[-4, 3], [-20, 0]] } }],
        "obstacles": [{ "shape": { "ball": { "radius": 2 } } }],
        "laws": [{ "obstacle_avoidance": {
            "range": 4, "standoff": 3.5, "gain": 10, "damping": 0.5,
            "gamma": { "spacing": 1, "offset": 0.5, "direction": [1, 0] }
        } }]
    })));
    let velocities = [[1.0, 0.0], [1.0, 0.0]].map(Vector::<2>::from);
    let found = accelerations(&world, &world.agents.positions, &velocities);
    let phi = |z: f64| {
        let s = z + 4.0 / (2.0 * 5.0f64.sqrt());
        3.0 * s / (1.0 + s * s).sqrt() - 2.0
    };
    let (q, p) = (Vector::<2>::new(-4.0, 3.0), Vector::<2>::new(1.0, 0.0));
    // The ball's centre is 5 away, its surface 3; ρ(3/4) = 1.
    let toward = -q / 5.0;
    let gamma = Vector::<2>::new(1.0, 0.0) - q;
    let beta_velocity = (p - toward * toward.dot(&p)) * (2.0 / 5.0);
    let expected = (toward * phi(-0.5)
        + gamma / gamma.norm() * phi(gamma.norm() - 1.0)
        + (beta_velocity - p) * 0.5)
        * 10.0;
    assert!(
        (found[0] - expected).norm() < 1e-8,
        "{} {expected}",
        found[0]
    );
    assert_eq!(found[1], Vector::<2>::zeros());
}

#[test]
fn an_agent_inside_an_obstacle_is_pushed_out() {
    for (shape, at) in [
        (
            json!({ "ball": { "radius": 2 } }),
            Vector::<2>::new(0.5, 0.0),
        ),
        (
            json!({ "cuboid": { "half_extents": [2, 3] } }),
            Vector::<2>::new(1.5, 0.1),
        ),
        (
            json!({ "half_space": { "normal": [1, 0] } }),
            Vector::<2>::new(-0.5, 7.0),
        ),
    ] {
        let world: World<2> = world(spec(json!({
            "dimension": 2, "time": { "end": 1 },
            "agents": [{ "radius": 0.1, "positions": { "explicit": [[30, 0]] } }],
            "obstacles": [{ "shape": shape }],
            "laws": [{ "obstacle_avoidance": { "range": 4, "standoff": 2, "gain": 10 } }]
        })));
        let found = accelerations(&world, &[at], &[Vector::zeros()])[0];
        assert!(found[0] > 10.0 && found[1].abs() < 1e-9, "{shape}: {found}");
        // At the very centre there is no telling where, but out it is.
        let center = accelerations(&world, &[Vector::zeros()], &[Vector::zeros()])[0];
        assert!(center.norm() > 10.0 && center.norm().is_finite(), "{shape}");
    }
}
