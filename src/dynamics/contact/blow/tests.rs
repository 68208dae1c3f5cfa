//! Rows of bodies that strike each other.

use super::*;

fn body(x: f64, inverse_mass: f64) -> Struck<2> {
    Struck {
        velocity: Vector::<2>::new(x, 0.0),
        spin: Vector::zeros(),
        inverse_mass,
        inverse_inertia: Matrix::zeros(),
    }
}

fn spot(one: usize, other: Option<usize>, restitution: f64) -> Spot<2> {
    Spot {
        one,
        other,
        arms: [Vector::zeros(); 2],
        normal: Vector::<2>::new(1.0, 0.0),
        surface: Vector::zeros(),
        restitution,
        friction: 0.0,
        slow: 0.0,
        pair: 0,
        normal_impulse: 0.0,
        friction_impulse: 0.0,
        approach: f64::NEG_INFINITY,
    }
}

fn row(velocities: &[f64], wall: bool, restitution: f64) -> Cluster<2> {
    let last = velocities.len() - 1;
    let between = (0..last).map(|k| spot(k, Some(k + 1), restitution));
    Cluster {
        bodies: velocities.iter().map(|&x| body(x, 1.0)).collect(),
        spots: between
            .chain(wall.then(|| spot(last, None, restitution)))
            .collect(),
        unordered: false,
        fastest: 0.0,
    }
}

fn speeds(cluster: &Cluster<2>) -> Vec<f64> {
    cluster.bodies.iter().map(|body| body.velocity.x).collect()
}

#[test]
fn a_blow_runs_through_a_row() {
    let mut cluster = row(&[1.0, 0.0, 0.0, 0.0], false, 1.0);
    cluster.bounce(|_, _| {});
    assert_eq!(speeds(&cluster), [0.0, 0.0, 0.0, 1.0]);
    // Against a wall it comes back.
    let mut cluster = row(&[1.0, 0.0, 0.0], true, 1.0);
    cluster.bounce(|_, _| {});
    assert_eq!(speeds(&cluster), [-1.0, 0.0, 0.0]);
}

#[test]
fn what_does_not_bounce_stops_at_a_wall_in_few_rounds() {
    let mut cluster = row(&[1.0, 0.0, 0.0], true, 0.0);
    let mut rounds = 0;
    cluster.bounce(|_, _| rounds += 1);
    assert!(speeds(&cluster).iter().all(|speed| speed.abs() < 1e-12));
    assert!(!cluster.unordered);
    let impulse: f64 = cluster.spots[2].normal_impulse;
    assert!((impulse - 1.0).abs() < 1e-12, "{impulse}");
}

#[test]
fn stopping_is_inelastic() {
    let mut cluster = row(&[3.0, 0.0], false, 1.0);
    cluster.stop();
    assert_eq!(speeds(&cluster), [1.5, 1.5]);
}
