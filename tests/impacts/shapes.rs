//! Bodies that are not round.

use serde_json::json;
use volary::math::Vector;

use crate::run;

#[test]
fn a_box_that_lands_flat_bounces_flat() {
    for (dimension_3, restitution) in [(false, 1.0), (false, 0.5), (true, 1.0), (true, 0.5)] {
        let what = format!("3-D: {dimension_3}, restitution {restitution}");
        if dimension_3 {
            let ran = run::<3>(
                json!({
                    "dimension": 3, "time": { "end": 1 }, "physics": { "restitution": restitution },
                    "agents": [{ "shape": { "cuboid": { "half_extents": [0.7, 0.4, 0.5] } },
                                 "heading": "free", "rotation": [0, 0, 0],
                                 "positions": { "explicit": [[0, 0, 0.907]] },
                                 "velocities": { "explicit": [[0.3, 0, -1]] } }],
                    "obstacles": [{ "shape": { "cuboid": { "half_extents": [5, 5, 1] } },
                                    "position": [0, 0, -1] }]
                }),
                60,
            );
            assert!(
                (ran.velocities[0] - Vector::<3>::new(0.3, 0.0, restitution)).norm() < 1e-9,
                "{what}: {:?}",
                ran.velocities
            );
            assert!(ran.spins[0].norm() < 1e-9, "{what}: {:?}", ran.spins);
        } else {
            let ran = run::<2>(
                json!({
                    "dimension": 2, "time": { "end": 1 }, "physics": { "restitution": restitution },
                    "agents": [{ "shape": { "cuboid": { "half_extents": [0.7, 0.4] } },
                                 "heading": "free", "rotation": 0,
                                 "positions": { "explicit": [[0, 0.707]] },
                                 "velocities": { "explicit": [[0.3, -1]] } }],
                    "obstacles": [{ "shape": { "half_space": { "normal": [0, 1] } } }]
                }),
                60,
            );
            assert!(
                (ran.velocities[0] - Vector::<2>::new(0.3, restitution)).norm() < 1e-9,
                "{what}: {:?}",
                ran.velocities
            );
            assert!(ran.spins[0].norm() < 1e-9, "{what}: {:?}", ran.spins);
        }
    }
}

#[test]
fn a_rod_struck_at_its_end_turns_as_on_paper() {
    // A ball meets the flat of a rod near its end, elastically: conservation of momentum, of
    // angular momentum and of energy.
    let world = json!({
        "dimension": 2, "time": { "end": 2 }, "physics": { "restitution": 1 },
        "agents": [
            { "shape": { "capsule": { "half_length": 2, "radius": 0.1 } }, "mass": 3,
              "heading": "free", "rotation": 0, "positions": { "explicit": [[0, 0]] } },
            { "radius": 0.3, "mass": 1, "positions": { "explicit": [[1.5, 1.4]] },
              "velocities": { "explicit": [[0, -2]] } }
        ]
    });
    let w = crate::world::<2>(crate::spec(world.clone()));
    let inertia = w.solids[0].inertia()[(2, 2)] * (3.0 / w.solids[0].volume());
    let ran = run::<2>(world, 60);
    let blow = ran.blows()[0].clone();
    assert!((blow.time - 0.5).abs() < 1e-9, "{blow:?}");
    let give = 1.0 / 3.0 + 1.0 + 1.5 * 1.5 / inertia;
    let impulse = 2.0 * 2.0 / give;
    assert!((blow.blow - impulse).abs() < 1e-9, "{blow:?} for {impulse}");
    assert!((ran.velocities[0].y + impulse / 3.0).abs() < 1e-9);
    assert!((ran.velocities[1].y - (impulse - 2.0)).abs() < 1e-9);
    assert!(
        (ran.spins[0].z + 1.5 * impulse / inertia).abs() < 1e-9,
        "{:?}",
        ran.spins
    );
}

#[test]
fn a_turning_bar_strikes_with_the_speed_that_it_has_there() {
    // A bar turning at 2 about the origin meets a disk at rest; the disk leaves with twice the
    // speed of the bar there.
    let world = json!({
        "dimension": 2, "time": { "end": 1 }, "physics": { "restitution": 1 },
        "agents": [{ "radius": 0.2, "positions": { "explicit": [[2, 1]] } }],
        "obstacles": [{
            "shape": { "segment": { "from": [0, 0], "to": [5, 0] } },
            "motion": { "rotation": { "rate": 2 } }
        }]
    });
    let ran = run::<2>(world, 60);
    let blow = ran.blows()[0].clone();
    let distance = 5.0f64.sqrt();
    // The bar touches when its line is 0.2 below the centre.
    let angle = 0.5f64.atan() - (0.2 / distance).asin();
    let along = (distance * distance - 0.04).sqrt();
    assert!(
        (blow.time - angle / 2.0).abs() < 1e-8,
        "{blow:?} for {}",
        angle / 2.0
    );
    let speed = ran.velocities[0].norm();
    assert!(
        (speed - 2.0 * 2.0 * along).abs() < 1e-6,
        "{speed} for {}",
        4.0 * along
    );
}
