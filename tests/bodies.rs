//! Bodies of every shape: what they weigh, how they turn, what drives them and how they bounce.

mod common;

use std::f64::consts::PI;

use common::{flock_world, order, spec, world};
use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::{Vector, direction};
use volary::shape::In;
use volary::simulation::Simulation;
use volary::trace::record::Record;
use volary::world::check;
use volary::world::spec::{Rotation, WorldSpec};

fn simulation<const D: usize>(json: Value) -> Simulation<D>
where
    In<D>: Engine<D>,
{
    Simulation::new(world(spec(json))).expect("a finite start")
}

fn step<const D: usize>(simulation: &mut Simulation<D>) {
    simulation.step().expect("a finite state");
}

/// A rod of half length 1 and radius 0.2, with some more fields.
fn rod(more: Value) -> Value {
    let mut group = json!({
        "shape": { "capsule": { "half_length": 1, "radius": 0.2 } },
        "positions": { "explicit": [[0, 0]] }
    });
    for (field, value) in more.as_object().expect("fields") {
        group[field] = value.clone();
    }
    group
}

/// The moment of inertia of a flat capsule at density 1, and its area: a rectangle and two half
/// disks with centroids 4r/(3π) beyond its ends.
fn flat_capsule(half_length: f64, radius: f64) -> (f64, f64) {
    let (l, r) = (half_length, radius);
    let (bar, disk) = (4.0 * l * r, PI * r * r);
    let inertia =
        bar * (l * l + r * r) / 3.0 + disk * (0.5 * r * r + l * l + 2.0 * l * 4.0 * r / (3.0 * PI));
    (inertia, bar + disk)
}

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
    for k in 0..4 {
        assert!(
            (space.agents.mass[k] - 3.0 * volumes[k]).abs() < 1e-9,
            "{k}"
        );
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

/// A disk that hits a resting rod off its middle.
fn off_center(dimension: usize) -> Value {
    let place = |x: f64, y: f64| {
        let mut at = vec![0.0; dimension];
        (at[0], at[1]) = (x, y);
        at
    };
    json!({
        "dimension": dimension, "time": { "end": 6 },
        "physics": { "restitution": 1 },
        "agents": [
            rod(json!({ "heading": "free", "mass": 2, "positions": { "explicit": [place(0.0, 0.0)] } })),
            { "radius": 0.3, "mass": 1.5, "positions": { "explicit": [place(0.7, 2.0)] },
              "velocities": { "common": place(0.0, -1.0) } }
        ]
    })
}

#[test]
fn a_blow_off_the_middle_turns_a_rod_and_keeps_the_angular_momentum() {
    let mut run = simulation::<2>(off_center(2));
    let (inertia, area) = flat_capsule(1.0, 0.2);
    let moment = inertia / area * 2.0;
    let momentum = |run: &Simulation<2>| {
        let state = run.snapshot();
        let orbit = |i: usize, mass: f64| {
            let (x, v) = (state.positions[i], state.velocities[i]);
            mass * (x.x * v.y - x.y * v.x)
        };
        orbit(0, 2.0) + orbit(1, 1.5) + moment * state.spins.expect("a rod")[0].z
    };
    let before = momentum(&run);
    while run.ledger().agent_contacts().episodes == 0 {
        assert!(run.snapshot().time < 3.0, "they never touch");
        step(&mut run);
    }
    for _ in 0..20 {
        step(&mut run);
    }
    assert!((momentum(&run) - before).abs() < 0.01 * before.abs());
    let angle =
        |run: &Simulation<2>| match Rotation::of(&run.snapshot().rotations.expect("a rod")[0]) {
            Rotation::Angle(angle) => angle,
            Rotation::Vector(_) => panic!("an angle in the plane"),
        };
    let (spin, begin) = (run.snapshot().spins.expect("a rod")[0].z, angle(&run));
    assert!(spin.abs() > 0.3, "{spin}");
    // Free from now on: the spin stays, and the angle grows by arctan(ωh) in each of two
    // substeps.
    for k in 1..100 {
        step(&mut run);
        assert!((run.snapshot().spins.expect("a rod")[0].z - spin).abs() < 1e-14);
        let expected = begin + f64::from(k) * 2.0 * (spin * 0.005).atan();
        let apart = (angle(&run) - expected).rem_euclid(2.0 * PI);
        assert!(apart.min(2.0 * PI - apart) < 1e-12, "step {k}: {apart}");
        let heading = run.snapshot().headings[0];
        let along = Vector::<2>::new(angle(&run).cos(), angle(&run).sin());
        assert!((heading - along).norm() < 1e-12);
    }
}

#[test]
fn fixed_bodies_are_not_turned_by_blows() {
    for dimension in [2, 3] {
        let mut json = off_center(dimension);
        json["agents"][0]["heading"] = json!("fixed");
        json["agents"][0]["rotation"] = match dimension {
            2 => json!(0.3),
            _ => json!([0, 0, 0.3]),
        };
        let turned = match dimension {
            2 => rotations::<2>(json),
            _ => rotations::<3>(json),
        };
        for (before, after) in turned.0.iter().zip(&turned.1) {
            // The engine keeps rotations normal by rounding.
            assert!((before - after).abs() < 1e-14, "{turned:?}");
        }
    }
}

/// All entries of the rotations before and after a run in which something touches.
fn rotations<const D: usize>(json: Value) -> (Vec<f64>, Vec<f64>)
where
    In<D>: Engine<D>,
{
    let mut run = simulation::<D>(json);
    let all = |run: &Simulation<D>| -> Vec<f64> {
        let rotations = run.snapshot().rotations.expect("some are not round");
        rotations
            .iter()
            .flat_map(|it| it.as_slice().to_vec())
            .collect()
    };
    let before = all(&run);
    for _ in 0..run.world().steps() {
        step(&mut run);
    }
    assert!(run.ledger().agent_contacts().episodes > 0);
    (before, all(&run))
}

/// A rod that flies up while it heads to the right, at the end of a time.
fn swing(h: f64, time: f64, gain: f64, damping: f64) -> f64 {
    let mut run = simulation::<2>(json!({
        "dimension": 2, "time": { "step": h, "end": time }, "record": { "every": time },
        "agents": [rod(json!({
            "heading": { "torque": { "gain": gain, "damping": damping } },
            "rotation": 0, "velocities": { "common": [0, 1] }, "mass": 2
        }))]
    }));
    for _ in 0..run.world().steps() {
        step(&mut run);
    }
    let heading = run.snapshot().headings[0];
    heading.y.atan2(heading.x)
}

#[test]
fn a_steering_torque_swings_the_heading_in_as_its_equation_says() {
    let (gain, damping, time) = (9.0, 1.5, 1.6);
    // θ'' = g 2 sin((π/2 − θ)/2) − d θ', by the classical Runge–Kutta method.
    let slope = |[angle, spin]: [f64; 2]| {
        [
            spin,
            gain * 2.0 * ((PI / 2.0 - angle) / 2.0).sin() - damping * spin,
        ]
    };
    let moved = |x: [f64; 2], k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
    let (mut x, h) = ([0.0, 0.0], time / 4000.0);
    for _ in 0..4000 {
        let k1 = slope(x);
        let k2 = slope(moved(x, k1, h / 2.0));
        let k3 = slope(moved(x, k2, h / 2.0));
        let k4 = slope(moved(x, k3, h));
        for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            x = moved(x, k, h * weight / 6.0);
        }
    }
    assert!(x[0] > PI / 2.0, "underdamped, it overshoots");
    let steps = [0.02, 0.01, 0.005, 0.0025];
    let errors: Vec<f64> = steps
        .map(|h| (swing(h, time, gain, damping) - x[0]).abs())
        .to_vec();
    assert!(errors[1] < 0.03, "{errors:?}");
    let order = order(&steps, &errors);
    assert!(
        (0.85..1.3).contains(&order),
        "{errors:?} fall with order {order}"
    );
    // Damped critically, it settles.
    assert!((swing(0.01, 6.0, gain, 6.0) - PI / 2.0).abs() < 1e-4);
}

#[test]
fn a_steering_torque_keeps_its_limit_in_every_step() {
    let limit = 0.5;
    let mut run = simulation::<2>(json!({
        "dimension": 2, "time": { "end": 12 },
        "agents": [rod(json!({
            "heading": { "torque": { "gain": 30, "limit": limit } },
            "rotation": 3, "velocities": { "common": [1, 0] }, "mass": 2
        }))]
    }));
    let (inertia, area) = flat_capsule(1.0, 0.2);
    let moment = inertia / area * 2.0;
    let (mut spin, mut largest) = (0.0, 0.0_f64);
    for _ in 0..1200 {
        step(&mut run);
        let now = run.snapshot().spins.expect("a rod")[0].z;
        largest = largest.max((now - spin).abs() * moment / 0.01);
        spin = now;
    }
    assert!(largest <= limit * (1.0 + 1e-9), "{largest}");
    assert!(
        largest > 0.999 * limit,
        "{largest}: the limit was never needed"
    );
    let heading = run.snapshot().headings[0];
    assert!(heading.x > 0.9, "{heading}: it never turned round");
}

#[test]
fn headings_that_follow_the_velocity_do_so_at_their_rate() {
    for turn_rate in [None, Some(1.5)] {
        let mut run = simulation::<3>(json!({
            "dimension": 3, "time": { "end": 3 },
            "agents": [rod(json!({
                "heading": { "velocity": { "turn_rate": turn_rate } },
                "positions": { "explicit": [[0, 0, 0]] }, "velocities": { "common": [1, 0, 0] }
            }))],
            "laws": [{ "navigation": {
                "velocity": [-1, 1, 0.5], "feedback": "linear", "velocity_gain": 3
            } }]
        }));
        let mut lag = 0.0_f64;
        for _ in 0..300 {
            step(&mut run);
            let state = run.snapshot();
            let fastest = turn_rate.unwrap_or(f64::INFINITY);
            assert!(state.spins.expect("a rod")[0].norm() <= fastest * (1.0 + 1e-12));
            lag = lag.max((state.headings[0] - direction(&state.velocities[0])).norm());
        }
        match turn_rate {
            None => assert!(lag < 1e-3, "{lag}"),
            Some(_) => assert!(lag > 0.1, "{lag}: it could follow"),
        }
        let state = run.snapshot();
        assert!((state.headings[0] - direction(&state.velocities[0])).norm() < 1e-3);
    }
}

/// Speed of parting over speed of meeting of two bodies whose surfaces differ, head on.
fn bounce(shape: Value, first: f64, second: f64) -> f64 {
    // What steers its heading would turn round when its velocity does.
    let heading = match shape["ball"].is_null() {
        true => json!("free"),
        false => json!(null),
    };
    let body = |x: f64, speed: f64, restitution: f64| {
        json!({
            "heading": heading, "shape": shape, "restitution": restitution, "positions": { "explicit": [[x, 0]] },
            "velocities": { "common": [speed, 0] }
        })
    };
    let mut run = simulation::<2>(json!({
        "dimension": 2, "time": { "end": 4 }, "physics": { "restitution": 0.9 },
        "agents": [body(0.0, 1.0, first), body(5.0, -1.0, second)]
    }));
    for _ in 0..400 {
        step(&mut run);
    }
    let velocities = run.snapshot().velocities;
    (velocities[1].x - velocities[0].x) / 2.0
}

#[test]
fn a_contact_has_the_mean_restitution_of_its_surfaces() {
    for shape in [
        json!({ "ball": { "radius": 0.5 } }),
        json!({ "capsule": { "half_length": 0.5, "radius": 0.3 } }),
        json!({ "cuboid": { "half_extents": [0.5, 0.3] } }),
    ] {
        for (first, second) in [(1.0, 1.0), (1.0, 0.2), (0.0, 0.0), (0.0, 0.5)] {
            let found = bounce(shape.clone(), first, second);
            let mean = 0.5 * (first + second);
            // Flat sides meet at two points, which the engine bounces one after the other.
            let slack = match shape["cuboid"].is_null() {
                true => 0.02,
                false => 0.06,
            };
            assert!((found - mean).abs() < slack, "{shape}: {found} for {mean}");
        }
    }
}

#[test]
fn friction_makes_disks_and_spheres_roll() {
    // Down a slope of 0.2 radians, which is a level floor under tilted gravity. The floor
    // has no friction of its own: the contact has half of the body's.
    let (down, into) = (9.81 * 0.2_f64.sin(), -9.81 * 0.2_f64.cos());
    let rolled = |dimension: usize, friction: f64| -> f64 {
        let tilt = [down, into, 0.0];
        let json = json!({
            "dimension": dimension, "time": { "end": 2 },
            "physics": { "gravity": &tilt[..dimension] },
            "agents": [{ "radius": 0.5, "friction": friction, "mass": 3, "positions": {
                "explicit": [&[0.0, 0.5, 0.0][..dimension]]
            } }],
            "obstacles": [{ "shape": { "half_space": {
                "normal": &[0.0, 1.0, 0.0][..dimension]
            } } }]
        });
        let speed = |velocity: &[f64]| velocity[0];
        if dimension == 2 {
            let mut run = simulation::<2>(json);
            (0..200).for_each(|_| step(&mut run));
            speed(run.snapshot().velocities[0].as_slice())
        } else {
            let mut run = simulation::<3>(json);
            (0..200).for_each(|_| step(&mut run));
            speed(run.snapshot().velocities[0].as_slice())
        }
    };
    for (dimension, share) in [(2, 2.0 / 3.0), (3, 5.0 / 7.0)] {
        let rolling = rolled(dimension, 1.0) / (2.0 * down);
        assert!(
            (rolling / share - 1.0).abs() < 0.02,
            "{dimension}-D: {rolling} for {share}"
        );
        let sliding = rolled(dimension, 0.0) / (2.0 * down);
        assert!((sliding - 1.0).abs() < 0.02, "{dimension}-D: {sliding}");
    }
}

/// A driven flock whose bodies have these fields besides.
fn limited(dimension: usize, more: Value) -> Simulation<2> {
    let mut json = serde_json::to_value(flock_world(dimension)).expect("a world");
    for (field, value) in more.as_object().expect("fields") {
        json["agents"][0][field] = value.clone();
    }
    simulation::<2>(json)
}

#[test]
fn the_laws_take_no_body_beyond_its_top_speed() {
    for solver_iterations in [1, 3] {
        let mut json = serde_json::to_value(flock_world(2)).expect("a world");
        json["agents"][0]["top_speed"] = json!(1.2);
        json["physics"]["solver_iterations"] = json!(solver_iterations);
        let mut run = simulation::<2>(json);
        let mut fastest = 0.0_f64;
        for _ in 0..run.world().steps() {
            step(&mut run);
            for velocity in run.snapshot().velocities {
                fastest = fastest.max(velocity.norm());
            }
        }
        assert!(fastest <= 1.2 * (1.0 + 1e-12), "{fastest}");
        assert!(fastest > 1.1999, "{fastest}: nobody came near");
    }
}

#[test]
fn above_the_top_speed_laws_brake_as_they_ask_and_never_push() {
    let speeds = |top_speed: Option<f64>, wish: f64| -> Vec<f64> {
        let mut run = simulation::<2>(json!({
            "dimension": 2, "time": { "end": 1 }, "physics": { "gravity": [0, -1] },
            "agents": [{
                "radius": 0.1, "top_speed": top_speed,
                "positions": { "explicit": [[0, 0]] }, "velocities": { "common": [0, -5] }
            }],
            "laws": [{ "navigation": {
                "velocity": [0, -wish], "feedback": "linear", "velocity_gain": 2
            } }]
        }));
        (0..100)
            .map(|_| {
                step(&mut run);
                run.snapshot().velocities[0].norm()
            })
            .collect()
    };
    // Gravity alone makes it faster, by 1 in a unit of time.
    let pushed = speeds(Some(3.0), 20.0);
    assert!((pushed[99] - 6.0).abs() < 1e-9, "{}", pushed[99]);
    assert_eq!(speeds(Some(3.0), 4.0), speeds(None, 4.0));
}

#[test]
fn forces_keep_their_limit_and_their_rate_in_every_step() {
    let (limit, rate) = (0.8, 2.0);
    let mut run = limited(2, json!({ "force_limit": limit, "force_rate_limit": rate }));
    let mut before: Vec<Vector<2>> = run.pushes().to_vec();
    let mut largest = (0.0_f64, 0.0_f64);
    for _ in 0..run.world().steps() {
        step(&mut run);
        for (now, before) in run.pushes().iter().zip(&before) {
            largest.0 = largest.0.max(now.norm());
            largest.1 = largest.1.max((now - before).norm());
        }
        before = run.pushes().to_vec();
    }
    assert!(largest.0 <= limit * (1.0 + 1e-12), "{largest:?}");
    assert!(largest.1 <= rate * 0.01 * (1.0 + 1e-12), "{largest:?}");
    let summary = run.run(|_| Ok::<_, ()>(()), |_| std::ops::ControlFlow::Continue(()));
    let summary = summary.expect("recording cannot fail");
    assert!(
        summary.force_cuts > 0 && summary.rate_cuts > 0,
        "{summary:?}"
    );
    assert_eq!(summary.speed_cuts, 0);
}

#[test]
fn limits_that_never_cut_change_nothing() {
    let last = |more: Value| {
        let mut run = limited(2, more);
        (0..200).for_each(|_| step(&mut run));
        (
            run.snapshot().positions.to_vec(),
            run.snapshot().velocities.to_vec(),
        )
    };
    let far = json!({ "force_limit": 1e9, "force_rate_limit": 1e9, "top_speed": 1e9 });
    assert_eq!(last(far), last(json!({})));
}

/// Rods, boxes and hulls driven into each other and against a wall.
fn crowd(dimension: usize) -> Value {
    let vector = |x: f64, rest: f64| {
        let mut vector = vec![rest; dimension];
        vector[0] = x;
        vector
    };
    let hull = match dimension {
        2 => json!([[0.4, 0], [-0.2, 0.3], [-0.3, -0.2]]),
        _ => json!([[0.4, 0, 0], [-0.2, 0.3, 0], [-0.3, -0.2, 0.2], [0, 0, -0.3]]),
    };
    let group = |shape: Value, low: f64| {
        json!({
            "shape": shape, "count": 8, "density": 2,
            "positions": { "box": { "min": vector(low, -1.5), "max": vector(low + 3.0, 1.5) } },
            "velocities": { "uniform": { "min": vector(-1.0, -1.0), "max": vector(1.0, 1.0) } }
        })
    };
    let mut turning = group(json!({ "convex": { "points": hull } }), 6.5);
    turning["heading"] = json!({ "velocity": {} });
    json!({
        "dimension": dimension, "time": { "end": 4 }, "seed": 2,
        "physics": { "friction": 0.2, "restitution": 0.3 },
        "agents": [
            group(json!({ "capsule": { "half_length": 0.3, "radius": 0.1 } }), 0.0),
            group(json!({ "cuboid": { "half_extents": vector(0.3, 0.15) } }), 3.2),
            turning,
            { "radius": 0.2, "count": 4,
              "positions": { "box": { "min": vector(-3.0, -1.0), "max": vector(-1.0, 1.0) } } }
        ],
        "obstacles": [{ "shape": { "half_space": { "normal": vector(-1.0, 0.0) } },
                        "position": vector(10.5, 0.0) }],
        "laws": [{ "navigation": { "velocity": vector(3.0, 0.0), "feedback": "linear" } }]
    })
}

/// The smallest gaps at any time between bodies, and to the wall.
fn smallest_gaps<const D: usize>() -> (f64, f64)
where
    In<D>: Engine<D>,
{
    let mut run = simulation::<D>(crowd(D));
    let mut smallest = (f64::INFINITY, f64::INFINITY);
    for _ in 0..run.world().steps() {
        step(&mut run);
        let metrics = run.metrics();
        smallest.0 = smallest.0.min(metrics.agent_gap.expect("several agents"));
        smallest.1 = smallest.1.min(metrics.obstacle_gap.expect("a wall"));
    }
    assert!(run.ledger().agent_contacts().episodes > 5);
    assert!(run.ledger().obstacle_contacts().episodes > 5);
    smallest
}

#[test]
fn bodies_pressed_against_a_wall_and_each_other_stay_out() {
    // The thinnest body is 0.2 thick; those that meet do so at up to 0.06 in a step.
    for (bodies, wall) in [smallest_gaps::<2>(), smallest_gaps::<3>()] {
        assert!(bodies > -0.08, "{bodies} between bodies");
        assert!(wall > -0.005, "{wall} to the wall");
        assert!(wall < 0.01, "{wall}: they never came to the wall");
    }
}

fn bits<const D: usize>(threads: usize) -> Vec<u64>
where
    In<D>: Engine<D>,
{
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads can be made").install(|| {
        let mut run = simulation::<D>(crowd(D));
        (0..300).for_each(|_| step(&mut run));
        let state = run.snapshot();
        let rotations = state.rotations.expect("some are not round").iter();
        let vectors = state.positions.iter().chain(state.velocities);
        vectors
            .flat_map(|vector| vector.as_slice())
            .chain(rotations.flat_map(|rotation| rotation.as_slice()))
            .map(|x| x.to_bits())
            .collect()
    })
}

#[test]
fn runs_are_the_same_on_any_number_of_threads() {
    assert_eq!(bits::<2>(1), bits::<2>(3));
    assert_eq!(bits::<3>(1), bits::<3>(3));
}

#[test]
fn rotations_are_recorded_where_some_body_is_not_round() {
    let recorded = |json: Value| {
        let mut frames = Vec::new();
        let mut run = simulation::<2>(json);
        let end = run.run(
            |record| {
                if let Record::Frame(frame) = record {
                    frames.push(frame.rotations);
                }
                Ok::<_, ()>(())
            },
            |_| std::ops::ControlFlow::Continue(()),
        );
        end.expect("recording cannot fail");
        frames
    };
    let mut json = off_center(2);
    json["agents"][0]["rotation"] = json!(0.25);
    let frames = recorded(json.clone());
    let start = frames[0].as_ref().expect("a rod");
    assert_eq!(start.len(), 2);
    assert!(matches!(start[0], Rotation::Angle(x) if (x - 0.25).abs() < 1e-15));
    assert!(matches!(start[1], Rotation::Angle(0.0)));
    json["agents"].as_array_mut().expect("a list").remove(0);
    assert!(recorded(json).iter().all(Option::is_none));
}

#[test]
fn bodies_start_along_their_velocities_unless_told_otherwise() {
    let mut json = off_center(2);
    json["agents"][0]["velocities"] = json!({ "common": [-3, -4] });
    let start = |json: &Value| simulation::<2>(json.clone()).snapshot().headings[0];
    assert!((start(&json) - Vector::<2>::new(-0.6, -0.8)).norm() < 1e-12);
    json["agents"][0]["rotation"] = json!(PI / 2.0);
    assert!((start(&json) - Vector::<2>::new(0.0, 1.0)).norm() < 1e-12);
    json["agents"][0]["velocities"] = json!("rest");
    json["agents"][0]
        .as_object_mut()
        .expect("fields")
        .remove("rotation");
    assert_eq!(start(&json), Vector::<2>::new(1.0, 0.0));
}

#[test]
fn what_is_not_a_sound_number_is_refused() {
    let right = spec(off_center(2));
    assert_eq!(check::problems(&right), []);
    let fields: [(&str, fn(&mut WorldSpec) -> &mut Option<f64>); 6] = [
        ("density", |world| &mut world.agents[0].density),
        ("restitution", |world| &mut world.agents[0].restitution),
        ("friction", |world| &mut world.agents[0].friction),
        ("force_rate_limit", |world| {
            &mut world.agents[0].force_rate_limit
        }),
        ("top_speed", |world| &mut world.agents[0].top_speed),
        ("radius", |world| &mut world.agents[1].radius),
    ];
    for (name, field) in fields {
        for wrong in [f64::NAN, f64::INFINITY, -1.0] {
            let mut world = right.clone();
            world.agents[0].mass = None;
            *field(&mut world) = Some(wrong);
            let paths: Vec<_> = check::problems(&world)
                .into_iter()
                .map(|it| it.path)
                .collect();
            let group = usize::from(name == "radius");
            assert_eq!(paths, [format!("agents[{group}].{name}")], "{wrong}");
        }
    }
}
