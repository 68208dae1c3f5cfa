//! Friction at a blow: Coulomb's law with the impulse that the blow had.

use serde_json::json;
use volary::math::Vector;
use volary::shape::In;

use crate::run;

/// A ball that hits a floor obliquely, without gravity. Returns its velocity and angular velocity
/// (about the axis that it turns on) after the blow, in the plane of motion.
fn bounce<const D: usize>(
    angle: f64,
    friction: f64,
    restitution: f64,
    (step, phase): (f64, f64),
) -> (f64, f64, f64)
where
    In<D>: volary::dynamics::Engine<D>,
{
    let up = D - 1;
    let at = |x: f64, y: f64| -> Vec<f64> {
        (0..D)
            .map(|k| {
                if k == 0 {
                    x
                } else if k == up {
                    y
                } else {
                    0.0
                }
            })
            .collect()
    };
    let (sin, cos) = angle.to_radians().sin_cos();
    let world = json!({
        "dimension": D, "time": { "step": step, "end": 20.0 * step },
        "physics": { "restitution": restitution, "friction": friction },
        "agents": [{
            "radius": 0.5, "mass": 2,
            "positions": { "explicit": [at(0.0, 0.5 + cos * step * (3.0 + phase))] },
            "velocities": { "explicit": [at(sin, -cos)] }
        }],
        "obstacles": [{ "shape": { "half_space": { "normal": at(0.0, 1.0) } } }]
    });
    let run = run::<D>(world, 10);
    assert_eq!(run.blows().len(), 1, "{:?}", run.blows());
    let spin = match D {
        2 => run.spins.first().map_or(0.0, |spin| -spin.z),
        _ => run.spins.first().map_or(0.0, |spin| spin.y),
    };
    (run.velocities[0][0], run.velocities[0][up], spin)
}

fn check<const D: usize>()
where
    In<D>: volary::dynamics::Engine<D>,
{
    // Moment of inertia over m r².
    let inertia = if D == 2 { 0.5 } else { 0.4 };
    let (mass, radius) = (2.0, 0.5);
    for friction in [0.0, 0.1, 0.3, 1.0] {
        for restitution in [0.0, 0.5, 1.0] {
            for angle in [0.0, 20.0, 40.0, 60.0, 80.0] {
                for phase in [0.0, 0.13, 0.5, 0.87] {
                    let (sin, cos) = f64::to_radians(angle).sin_cos();
                    let normal = mass * (1.0 + restitution) * cos;
                    // What stops the sliding, and what Coulomb allows.
                    let stopping = mass * sin * inertia / (1.0 + inertia);
                    let rub = f64::min(friction * normal, stopping);
                    let expected = (
                        sin - rub / mass,
                        restitution * cos,
                        rub / (inertia * mass * radius),
                    );
                    for step in [0.01, 0.001] {
                        let (x, y, spin) = bounce::<D>(angle, friction, restitution, (step, phase));
                        let off = (x - expected.0)
                            .abs()
                            .max((y - expected.1).abs())
                            .max((spin - expected.2).abs());
                        assert!(
                            off < 1e-9,
                            "{D}: {friction} {restitution} {angle}° {phase} {step}: \
                             {x} {y} {spin} for {expected:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn balls_obey_coulomb_at_a_wall() {
    check::<2>();
    check::<3>();
}

#[test]
fn balls_obey_coulomb_at_each_other() {
    for friction in [0.1, 0.5] {
        for restitution in [0.0, 0.6, 1.0] {
            let world = json!({
                "dimension": 2, "time": { "end": 1 },
                "physics": { "restitution": restitution, "friction": friction },
                "agents": [
                    { "radius": 0.5, "mass": 1, "positions": { "explicit": [[-1.02, 0.31]] },
                      "velocities": { "explicit": [[3, 0]] } },
                    { "radius": 0.7, "mass": 4, "positions": { "explicit": [[0.4, 0]] },
                      "velocities": { "explicit": [[0, 1]] } }
                ]
            });
            let run = run::<2>(world, 20);
            let blows = run.blows();
            assert_eq!(blows.len(), 1);
            let (blow, normal) = (blows[0], blows[0].normal);
            let reduced = 0.8;
            let against = Vector::<2>::new(3.0, -1.0);
            let slip = against - normal * against.dot(&normal);
            // Disks: 1/m + r²/I is 3/m for each.
            let rub = f64::min(friction * blow.blow, slip.norm() * reduced / 3.0);
            assert!(
                (blow.friction - rub).abs() < 1e-12,
                "{} for {rub}",
                blow.friction
            );
            let impulse = normal * blow.blow + slip.normalize() * rub;
            let one = Vector::<2>::new(3.0, 0.0) - impulse;
            let other = Vector::<2>::new(0.0, 1.0) + impulse / 4.0;
            assert!((run.velocities[0] - one).norm() < 1e-12);
            assert!((run.velocities[1] - other).norm() < 1e-12);
        }
    }
}

#[test]
fn a_sliding_ball_comes_to_roll() {
    // Under gravity: it slides on with deceleration μg until it rolls at 2/3 of its speed (disks),
    // 5/7 (balls).
    let disk = json!({
        "dimension": 2, "time": { "end": 10 },
        "physics": { "friction": 0.2, "gravity": [0, -10] },
        "agents": [{ "radius": 0.5, "positions": { "explicit": [[0, 0.5]] },
                     "velocities": { "explicit": [[3, 0]] } }],
        "obstacles": [{ "shape": { "half_space": { "normal": [0, 1] } } }]
    });
    let rolling = run::<2>(disk, 200);
    assert!(
        (rolling.velocities[0].x - 2.0).abs() < 1e-3,
        "{:?}",
        rolling.velocities
    );
    assert!(
        (rolling.spins[0].z + 4.0).abs() < 2e-3,
        "{:?}",
        rolling.spins
    );
}
