//! Attitude alignment against its closed form and its invariant.

use serde_json::json;
use volary::math::Vector;
use volary::shape::{Geometry, In};
use volary::simulation::Simulation;
use volary::world::World;

use crate::common::{self, headings, state};
use crate::scene::{Dice, world};

fn rates(world: &World<2>, at: &[Vector<2>], v: &[Vector<2>]) -> Vec<f64> {
    let mut out = vec![Vector::zeros(); at.len()];
    let u = headings(v);
    volary::law::Flock::of_world(world, Vec::new())
        .accelerations(&state(world, 0.0, at, v, &u), &mut out);
    // The turning rate: the acceleration to the left over the speed.
    (0..at.len())
        .map(|i| (u[i][0] * out[i][1] - u[i][1] * out[i][0]) / v[i].norm())
        .collect()
}

#[test]
fn two_headings_meet_in_the_middle_at_twice_the_gain() {
    let (a, b, gain) = (0.4f64, 2.6f64, 0.5);
    let speeds = [1.0, 3.0];
    let spec = common::spec(json!({
        "dimension": 2, "time": { "step": 0.002, "end": 3 },
        "agents": [{
            "radius": 0.1, "positions": { "explicit": [[0, 0], [5, 0]] },
            "velocities": { "explicit": [
                [a.cos(), a.sin()], [3.0 * b.cos(), 3.0 * b.sin()]
            ] }
        }],
        "laws": [{ "heading_consensus": { "gain": gain, "range": 100 } }]
    }));
    let mut simulation = Simulation::<2>::new(common::world(spec)).expect("it starts");
    for _ in 0..1500 {
        simulation.step().expect("it goes on");
    }
    let state = simulation.snapshot();
    let angles: Vec<f64> = state.velocities.iter().map(|v| v[1].atan2(v[0])).collect();
    // δ̇ = −2kδ, and the mean stays.
    let difference = (b - a) * (-2.0 * gain * state.time).exp();
    assert!(
        (angles[1] - angles[0] - difference).abs() < 2e-6,
        "{angles:?}"
    );
    assert!((angles[0] + angles[1] - a - b).abs() < 2e-6, "{angles:?}");
    for (v, speed) in state.velocities.iter().zip(speeds) {
        assert!((v.norm() - speed).abs() < 1e-5, "{}", v.norm());
    }
}

#[test]
fn an_undirected_net_keeps_the_mean_heading_and_a_directed_one_does_not() {
    let law =
        json!({ "laws": [{ "heading_consensus": { "gain": 2, "range": 4, "smooth": true } }] });
    let mut dice = Dice(31);
    let at = dice.vectors::<2>(40, 0.0, 9.0);
    let v = dice.vectors::<2>(40, -2.0, 2.0);
    let sum = |sensing: serde_json::Value| {
        let all = rates(&world::<2>(&[(40, sensing)], law.clone()), &at, &v);
        let size: f64 = all.iter().map(|rate| rate.abs()).sum();
        assert!(size > 10.0);
        (all.iter().sum::<f64>() / size).abs()
    };
    // (5) and (18) are symmetric, a field of view is not.
    assert!(sum(json!({})) < 1e-14);
    assert!(sum(json!({ "cone": { "angle": 2, "smooth": true } })) < 1e-14);
    assert!(sum(json!({ "field_of_view": { "angle": 1.5 } })) > 1e-3);
}

#[test]
fn rates_are_the_sum_of_wrapped_differences() {
    let laws = json!({ "laws": [{ "heading_consensus": { "gain": 2, "range": 4 } }] });
    let world = world::<2>(&[(30, serde_json::Value::Null)], laws);
    let mut dice = Dice(32);
    let at = dice.vectors::<2>(30, 0.0, 9.0);
    let v = dice.vectors::<2>(30, -2.0, 2.0);
    for (i, rate) in rates(&world, &at, &v).into_iter().enumerate() {
        let mut expected = 0.0;
        for j in (0..30).filter(|&j| j != i && (at[j] - at[i]).norm() <= 4.0) {
            let by = v[j][1].atan2(v[j][0]) - v[i][1].atan2(v[i][0]);
            expected += 2.0 * by.sin().atan2(by.cos());
        }
        assert!((rate - expected).abs() < 1e-12, "{rate} {expected}");
    }
}

/// The accelerations of two agents with these velocities.
fn of_two<const D: usize>(v: [Vector<D>; 2], before: [Vector<D>; 2]) -> [Vector<D>; 2]
where
    In<D>: Geometry<D>,
{
    let laws = json!({ "laws": [{ "heading_consensus": { "gain": 1, "range": 9 } }] });
    let world = world::<D>(&[(2, serde_json::Value::Null)], laws);
    let at = [Vector::zeros(), Vector::repeat(1.0)];
    let mut out = [Vector::zeros(); 2];
    volary::law::Flock::of_world(&world, Vec::new())
        .accelerations(&state(&world, 0.0, &at, &v, &before), &mut out);
    out
}

#[test]
fn rest_and_opposite_headings_are_defined() {
    let (x, y) = (
        Vector::<3>::new(1.0, 0.0, 0.0),
        Vector::<3>::new(0.0, 1.0, 0.0),
    );
    let right_angle = std::f64::consts::FRAC_PI_2;
    // One at rest stays there, and is followed where it last pointed.
    let [mover, rester] = of_two([x * 2.0, Vector::zeros()], [x, y]);
    assert_eq!(rester, Vector::<3>::zeros());
    assert!((mover - y * (2.0 * right_angle)).norm() < 1e-15);
    // Opposite headings have no shortest way.
    let odd = Vector::<3>::new(0.1, -0.7, 0.3).normalize();
    assert_eq!(of_two([odd, -odd], [odd, -odd]), [Vector::<3>::zeros(); 2]);
    // In space they turn in the plane of the two.
    let tilted = (x + y * 2.0).normalize();
    let [a, b] = of_two([x, tilted * 3.0], [x, tilted]);
    assert!((a - y * 2f64.atan()).norm() < 1e-15);
    assert!((b.norm() - 3.0 * 2f64.atan()).abs() < 1e-14 && b.dot(&tilted).abs() < 1e-14);
}
