//! Accelerations, against plain loops written from the paper.

use std::f64::consts::TAU;

use serde_json::{Value, json};
use volary::math::Vector;
use volary::shape::{Geometry, In};
use volary::world::World;

use crate::common::{accelerations, from_json, world};

/// Six agents of two groups and unequal masses, under some laws.
fn six<const D: usize>(laws: Value) -> World<D>
where
    In<D>: Geometry<D>,
{
    let place = |i: usize| -> Vec<f64> {
        (0..D)
            .map(|k| ((3 * i + k) as f64 * 1.7).sin() * 5.0 + i as f64)
            .collect()
    };
    let group = |name: &str, from: usize, count: usize| {
        let places: Vec<_> = (from..from + count).map(place).collect();
        let masses: Vec<f64> = (0..count).map(|i| 0.5 + i as f64).collect();
        let velocities: Vec<_> = (from..from + count).map(|i| place(i + 9)).collect();
        json!({
            "name": name, "radius": 0.01, "mass": masses,
            "positions": { "explicit": places }, "velocities": { "explicit": velocities }
        })
    };
    world(from_json(json!({
        "dimension": D, "time": { "end": 1 },
        "agents": [group("a", 0, 2), group("b", 2, 4)],
        "laws": laws
    })))
}

fn vector<const D: usize>(numbers: [f64; 3]) -> Vector<D> {
    Vector::from_fn(|k, _| numbers[k])
}

fn assert_close<const D: usize>(found: &[Vector<D>], expected: &[Vector<D>]) {
    assert_eq!(found.len(), expected.len());
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let error = (found - expected).norm();
        assert!(
            error < 1e-12 * (1.0 + expected.norm()),
            "agent {i}: {error}"
        );
    }
}

fn tracking_is_a_damped_spring_to_the_target<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let numbers = |x: [f64; 3]| json!(x[..D]);
    for feedforward in [false, true] {
        let world = six::<D>(json!([{ "tracking": {
            "target": { "ellipse": {
                "center": numbers([1.0, 2.0, 3.0]), "first": numbers([2.0, 0.0, 1.0]),
                "second": numbers([0.5, 3.0, 0.0]), "angular_velocity": -0.7, "phase": 0.3
            } },
            "velocity_gain": 2, "position_gain": 0.1, "feedforward": feedforward
        } }]));
        let agents = &world.agents;
        for time in [0.0, 0.77, 31.0] {
            let (sin, cos) = (-0.7 * time + 0.3_f64).sin_cos();
            let (a, b) = (vector::<D>([2.0, 0.0, 1.0]), vector::<D>([0.5, 3.0, 0.0]));
            let y = vector::<D>([1.0, 2.0, 3.0]) + a * cos + b * sin;
            let dy = (a * -sin + b * cos) * -0.7;
            let ddy = (a * cos + b * sin) * -0.49;
            let mut expected = Vec::new();
            for i in 0..6 {
                let mut sum = (dy - agents.velocities[i]) * 2.0 + (y - agents.positions[i]) * 0.1;
                if feedforward {
                    sum += ddy;
                }
                expected.push(sum);
            }
            let found = accelerations(&world, time, &agents.positions, &agents.velocities);
            assert_close(&found, &expected);
        }
    }
}

#[test]
fn tracking_is_a_damped_spring_to_the_target_in_2d_and_3d() {
    tracking_is_a_damped_spring_to_the_target::<2>();
    tracking_is_a_damped_spring_to_the_target::<3>();
}

#[test]
fn a_mill_ring_is_the_one_printed() {
    // (2.10), with what a list gives each agent of group b, which come third to sixth.
    let (radii, rates) = ([1.0, 2.0, 3.0, 4.0], [0.3, -0.4, 0.5, 0.0]);
    let (phases, heights) = ([0.0, 1.0, -2.0, 9.0], [5.0, 6.0, 7.0, 8.0]);
    let ring = json!({ "mill_ring": {
        "center": [1, 2, 3], "radius": radii, "angular_velocity": rates,
        "phases": phases, "heights": heights
    } });
    let world = six::<3>(
        json!([{ "scope": { "agents": ["b"], "laws": [{ "tracking": {
        "targets": ring, "velocity_gain": 1.5, "position_gain": 0.7
    } }] } }]),
    );
    let agents = &world.agents;
    let time = 2.3_f64;
    let mut expected = vec![Vector::<3>::zeros(); 2];
    for i in 0..4 {
        let angle: f64 = rates[i] * time + phases[i];
        let x = Vector::<3>::new(
            1.0 + radii[i] * angle.cos(),
            2.0 + radii[i] * angle.sin(),
            3.0 + heights[i],
        );
        let v = Vector::<3>::new(-angle.sin(), angle.cos(), 0.0) * (radii[i] * rates[i]);
        let k = i + 2;
        expected.push((v - agents.velocities[k]) * 1.5 + (x - agents.positions[k]) * 0.7);
    }
    let found = accelerations(&world, time, &agents.positions, &agents.velocities);
    assert_close(&found, &expected);
}

#[test]
fn rings_are_evenly_spread_and_lie_across_their_axis() {
    let axis = Vector::<3>::new(1.0, -2.0, 0.5);
    let world = six::<3>(json!([{ "tracking": {
        "targets": { "mill_ring": {
            "center": [1, 2, 3], "radius": 2, "angular_velocity": 0.5, "heights": 1.5,
            "axis": axis.as_slice()
        } },
        "velocity_gain": 0, "position_gain": 1
    } }]));
    let zeros = vec![Vector::<3>::zeros(); 6];
    // From the origin, at rest, the acceleration is the target itself.
    let targets = accelerations(&world, 0.0, &zeros, &zeros);
    let later = accelerations(&world, 1e-4, &zeros, &zeros);
    let unit = axis.normalize();
    let center = Vector::<3>::new(1.0, 2.0, 3.0) + unit * 1.5;
    for i in 0..6 {
        let arm = targets[i] - center;
        assert!((arm.norm() - 2.0).abs() < 1e-12 && arm.dot(&unit).abs() < 1e-12);
        let next = targets[(i + 1) % 6] - center;
        assert!((arm.dot(&next) / 4.0 - (TAU / 6.0).cos()).abs() < 1e-12);
        // Counter-clockwise, seen from the axis's tip, one after the other and in time.
        assert!((arm.cross(&next).dot(&unit) / 4.0 - (TAU / 6.0).sin()).abs() < 1e-12);
        assert!(arm.cross(&(later[i] - center)).dot(&unit) > 0.0);
    }
}

#[test]
fn steering_is_what_is_given_for_each_axis_and_agent() {
    let each = json!([
        [1, { "sine": { "amplitude": 2, "period": 3 } }],
        [{ "table": { "times": [0, 2], "values": [0, 4] } }, 0]
    ]);
    let world = six::<2>(json!([
        { "scope": { "agents": ["a"], "laws": [{ "steering": { "accelerations": each } }] } },
        { "steering": { "acceleration": [0.25, { "square": { "high": 7, "period": 2 } }] } }
    ]));
    let agents = &world.agents;
    for time in [0.0_f64, 0.5, 1.7, 2.2] {
        let square = if time % 2.0 < 1.0 { 7.0 } else { 0.0 };
        let shared = Vector::<2>::new(0.25, square);
        let mut expected = vec![shared; 6];
        expected[0] += Vector::<2>::new(1.0, 2.0 * (TAU * time / 3.0).sin());
        expected[1] += Vector::<2>::new((2.0 * time).min(4.0), 0.0);
        let found = accelerations(&world, time, &agents.positions, &agents.velocities);
        assert_close(&found, &expected);
    }
}
