//! Masses and inertias.

use std::f64::consts::PI;

use serde_json::{Value, json};
use volary::math::Vector;
use volary::world::spec::WorldSpec;

use super::common::{spec, world};
use super::flat_capsule;

#[test]
fn density_gives_masses_and_inertias_of_the_shapes() {
    let masses = |dimension: usize, shapes: &[Value]| -> WorldSpec {
        let group = |(k, shape): (usize, &Value)| {
            let mut at = vec![0.0; dimension];
            at[0] = 10.0 * k as f64;
            json!({ "shape": shape, "density": 3, "positions": { "explicit": [at] } })
        };
        let groups: Vec<Value> = shapes.iter().enumerate().map(group).collect();
        spec(json!({ "dimension": dimension, "time": { "end": 0 }, "agents": groups }))
    };
    let ball = json!({ "ball": { "radius": 0.7 } });
    let rod = json!({ "capsule": { "half_length": 1.5, "radius": 0.4 } });
    let flat = [
        ball.clone(),
        rod.clone(),
        json!({ "cuboid": { "half_extents": [1, 2] } }),
        json!({ "convex": { "points": [[0, 0], [3, 0], [0, 2]] } }),
    ];
    let plane = world::<2>(masses(2, &flat));
    let (rod_inertia, rod_area) = flat_capsule(1.5, 0.4);
    let areas = [PI * 0.49, rod_area, 8.0, 3.0];
    // A triangle of base b, height h and right angle: bh(b² + h²)/36.
    let inertias = [
        PI * 0.49 * 0.245,
        rod_inertia,
        8.0 * 5.0 / 3.0,
        6.0 * 13.0 / 36.0,
    ];
    for k in 0..4 {
        assert!((plane.agents.mass[k] - 3.0 * areas[k]).abs() < 1e-9, "{k}");
        let inertia = plane.solids[k].inertia()[(2, 2)];
        assert!((inertia - inertias[k]).abs() < 1e-9, "{k}: {inertia}");
    }
    let solid = [
        ball,
        rod,
        json!({ "cuboid": { "half_extents": [1, 2, 0.5] } }),
        json!({ "convex": { "points": [[0, 0, 0], [3, 0, 0], [0, 2, 0], [0, 0, 5]] } }),
    ];
    let space = world::<3>(masses(3, &solid));
    let (bar, ends) = (PI * 0.16 * 3.0, 4.0 / 3.0 * PI * 0.064);
    let volumes = [4.0 / 3.0 * PI * 0.343, bar + ends, 8.0, 5.0];
    for (mass, volume) in space.agents.mass.iter().zip(volumes) {
        assert!((mass - 3.0 * volume).abs() < 1e-9, "{mass}");
    }
    let diagonal = |k: usize| space.solids[k].inertia().diagonal();
    let sphere = Vector::<3>::repeat(0.4 * volumes[0] * 0.49);
    assert!((diagonal(0) - sphere).norm() < 1e-9);
    let brick = Vector::<3>::new(4.25, 1.25, 5.0) * (8.0 / 3.0);
    assert!((diagonal(2) - brick).norm() < 1e-9);
    // About the axis of the rod: a cylinder and a sphere.
    let along = 0.5 * bar * 0.16 + 0.4 * ends * 0.16;
    assert!((diagonal(1).x - along).abs() < 1e-9);
    // Across it: half spheres have their centroids 3r/8 from their flat side.
    let across = bar * (0.16 / 4.0 + 9.0 / 12.0)
        + ends * (0.4 * 0.16 + 1.5 * 1.5 + 2.0 * 1.5 * 3.0 / 8.0 * 0.4);
    assert!((diagonal(1) - Vector::<3>::new(along, across, across)).norm() < 1e-9);
}
