//! β-velocities of moving obstacles, against central differences in time.

use proptest::prelude::*;
use serde_json::{Value, json};
use volary::shape::{Geometry, In};

use crate::{along, obstacle};

/// One obstacle of each kind.
fn shapes(dimension: usize) -> Vec<Value> {
    let cut = |numbers: [f64; 3]| numbers[..dimension].to_vec();
    let points = [[-1.0, 0.3, 0.2], [0.8, 1.0, -0.6], [1.4, -0.9, 0.5]].map(cut);
    let corners = [
        [1.0, 0.2, 0.1],
        [-1.2, 0.4, -0.3],
        [0.3, 1.5, 0.2],
        [0.1, -1.0, 1.5],
    ]
    .map(cut);
    let heights = match dimension {
        2 => json!([0.2, 1.0, -0.4, 0.3]),
        _ => json!([[0.1, 0.9, -0.2], [0.4, -0.7, 0.0]]),
    };
    let mut field = json!({ "width": 3, "heights": heights });
    if dimension == 3 {
        field["depth"] = json!(2);
    }
    vec![
        json!({ "ball": { "radius": 0.9 } }),
        json!({ "cuboid": { "half_extents": cut([1.0, 0.6, 0.8]) } }),
        json!({ "capsule": { "from": points[0], "to": points[1], "radius": 0.3 } }),
        json!({ "half_space": { "normal": cut([0.6, 0.8, 0.3]) } }),
        json!({ "convex": { "points": corners } }),
        json!({ "segment": { "from": points[0], "to": points[1] } }),
        json!({ "triangle": { "points": points } }),
        json!({ "polyline": { "points": points, "closed": true } }),
        json!({ "mesh": { "vertices": points, "triangles": [[0, 1, 2]] } }),
        json!({ "heightfield": field }),
        json!({ "compound": { "parts": [
            { "shape": { "ball": { "radius": 0.5 } }, "position": cut([1.0, 0.2, 0.3]) },
            { "shape": { "segment": { "from": points[0], "to": points[2] } } }
        ] } }),
        json!({ "room": { "half_extents": cut([2.0, 3.0, 2.5]) } }),
        json!({ "corridor": { "points": points, "width": 0.4 } }),
    ]
}

fn motions(dimension: usize) -> Vec<Value> {
    let cut = |numbers: [f64; 3]| numbers[..dimension].to_vec();
    let rate = match dimension {
        2 => json!(0.7),
        _ => json!([0.7, -0.4, 0.9]),
    };
    vec![
        json!({ "oscillation": { "amplitude": cut([0.5, -0.3, 0.8]), "period": 2.3, "phase": 0.4 } }),
        json!({ "rotation": { "rate": rate } }),
        json!({ "rotation": { "about": cut([1.0, -2.0, 0.5]), "rate": rate } }),
        json!({ "waypoints": {
            "points": [cut([0.0, 0.0, 0.0]), cut([1.0, 2.0, 0.5])], "period": 5, "easing": "smooth"
        } }),
        json!({ "drift": { "velocity": cut([0.4, 0.1, -0.6]) } }),
    ]
}

/// Compares p̂ with the movement of the closest point while agent and obstacle both move;
/// returns how many could be compared, and of how many.
fn check<const D: usize>(at: [f64; 3], velocity: [f64; 3], time: f64) -> (usize, usize)
where
    In<D>: Geometry<D>,
{
    let (q, p) = (along::<D>(at), along::<D>(velocity));
    let (mut compared, mut all) = (0, 0);
    for shape in shapes(D) {
        for motion in motions(D) {
            let unbounded = shape.get("room").or(shape.get("half_space")).is_some();
            if unbounded && motion.get("rotation").is_some() {
                continue;
            }
            let mut spec = json!({ "shape": shape, "motion": motion });
            if motion.get("waypoints").is_none() {
                spec["position"] = json!(vec![0.3; D]);
            }
            spec["rotation"] = if D == 2 {
                json!(0.4)
            } else {
                json!([0.4, 0.1, -0.3])
            };
            let mut it = obstacle::<D>(&spec);
            all += 1;
            let mut point = |s: f64| {
                it.move_to(time + s);
                it.project(&(q + p * s)).point
            };
            let h = 1e-5;
            let (ahead, here, behind) = (point(h), point(0.0), point(-h));
            let central = (ahead - behind) / (2.0 * h);
            let one_sided = (ahead - here) / h;
            if (central - one_sided).norm() > 1e-2 {
                continue; // The feature changes right here.
            }
            compared += 1;
            it.move_to(time);
            let exact = it.project(&q).velocity(&p);
            let error = (exact - central).norm();
            assert!(error < 1e-4, "{shape} {motion}: {exact} is not {central}");
        }
    }
    (compared, all)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn velocity_is_the_derivative_while_both_move(
        at in prop::array::uniform3(-2.5..2.5f64),
        velocity in prop::array::uniform3(-2.0..2.0f64),
        time in 0.0..20.0f64,
    ) {
        for (compared, all) in [check::<2>(at, velocity, time), check::<3>(at, velocity, time)] {
            prop_assert!(all > 40 && 10 * compared > 8 * all, "{compared} of {all}");
        }
    }
}

#[test]
fn on_the_surface_the_point_goes_with_it() {
    let spec = json!({
        "shape": { "cuboid": { "half_extents": [1, 2] } }, "position": [8, 0],
        "motion": { "rotation": { "rate": 0.5 } }
    });
    let wall = obstacle::<2>(&spec);
    // At rest on the middle of the left face, which moves down at 0.5.
    let beta = wall.project(&[7.0, 0.0].into());
    let exact = volary::math::Vector::<2>::new(0.0, -0.5);
    assert!((beta.surface_velocity() - exact).norm() < 1e-12);
    // The closest point of an agent at rest stays, but for the normal, which stands still.
    assert!(beta.velocity(&[0.0, 0.0].into()).norm() < 1e-12);
    assert!((beta.velocity(&exact) - exact).norm() < 1e-12);
}
