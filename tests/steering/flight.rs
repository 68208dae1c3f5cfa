//! What steering promises is flown, by bodies.

use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::{Moment, Trajectory, Vector};
use volary::metric::target_errors;
use volary::shape::In;
use volary::simulation::Simulation;
use volary::world::World;
use volary::world::spec::TrajectoriesSpec;

use crate::common::{accelerations, from_json, order, world};

const AGENTS: usize = 6;

/// Trajectories that no other law of the worlds below would keep to.
fn courses<const D: usize>() -> Vec<Trajectory<D>> {
    let spec: TrajectoriesSpec = from_json(courses_json::<D>());
    spec.trajectories(AGENTS)
}

fn courses_json<const D: usize>() -> Value {
    let mut ring = json!({
        "center": vec![1; D], "radius": [4, 4, 5, 4, 4, 5], "angular_velocity": 0.8
    });
    if D == 3 {
        ring["heights"] = json!([0, 1, 2, 0, 1, -2]);
        ring["axis"] = json!([1, 2, 2]);
    }
    json!({ "mill_ring": ring })
}

/// A crowd of unequal masses that start on the trajectories, but off by `off`, among laws that
/// pull it elsewhere: spacing, headings, a destination, an obstacle and gravity.
fn crowd<const D: usize>(flatness: Value, step: f64, off: f64) -> World<D>
where
    In<D>: Engine<D>,
{
    let vector = |x: f64, rest: f64| {
        let mut vector = vec![rest; D];
        vector[0] = x;
        vector
    };
    let start: Vec<Moment<D>> = courses().iter().map(|course| course.at(0.0)).collect();
    let aside = Vector::<D>::repeat(off);
    let places: Vec<_> = (start.iter())
        .map(|moment| (moment.position + aside).as_slice().to_vec())
        .collect();
    let velocities: Vec<_> = start.iter().map(|it| it.velocity.as_slice()).collect();
    world(from_json(json!({
        "dimension": D, "time": { "step": step, "end": 4 },
        "physics": { "gravity": vector(0.3, -1.0) },
        "agents": [{
            "name": "ring", "radius": 0.01, "mass": [1, 2, 0.5, 1, 3, 1],
            "positions": { "explicit": places }, "velocities": { "explicit": velocities }
        }],
        "obstacles": [{ "shape": { "ball": { "radius": 1 } }, "position": vector(9.0, 0.0) }],
        "laws": [
            { "alpha_interaction": { "spacing": 5, "range": 8, "damping": 0.5 } },
            { "scope": { "agents": ["ring"], "laws": [{ "flatness": flatness }] } },
            { "heading_consensus": { "range": 6, "gain": 0.3 } },
            { "navigation": { "steer": "mean", "destination": vector(30.0, 2.0) } },
            { "obstacle_avoidance": {
                "range": 5, "standoff": 4, "gain": 1, "damping": 0.2,
                "gamma": { "spacing": 1, "direction": vector(1.0, 0.0) }
            } }
        ]
    })))
}

/// The target errors at the end.
fn flown<const D: usize>(world: World<D>, courses: &[Trajectory<D>]) -> [f64; 2]
where
    In<D>: Engine<D>,
{
    let mut simulation = Simulation::new(world).expect("a finite start");
    for _ in 0..simulation.world().steps() {
        simulation.step().expect("a finite state");
    }
    let state = simulation.snapshot();
    let targets: Vec<_> = courses.iter().map(|it| it.at(state.time)).collect();
    target_errors(state.positions, state.velocities, &targets)
}

fn on_the_reference_all_laws_add_up_to_the_trajectory<const D: usize>()
where
    In<D>: Engine<D>,
{
    let world = crowd::<D>(json!({ "trajectories": courses_json::<D>() }), 0.01, 0.0);
    for time in [0.0, 1.3, 2.9] {
        let now: Vec<_> = courses::<D>().iter().map(|it| it.at(time)).collect();
        let positions: Vec<_> = now.iter().map(|it| it.position).collect();
        let velocities: Vec<_> = now.iter().map(|it| it.velocity).collect();
        let found = accelerations(&world, time, &positions, &velocities);
        for (found, moment) in found.iter().zip(&now) {
            let error = (found + world.gravity - moment.acceleration).norm();
            assert!(error < 1e-12, "at {time}: {error}");
        }
    }
}

#[test]
fn on_the_reference_all_laws_add_up_to_the_trajectory_in_2d_and_3d() {
    on_the_reference_all_laws_add_up_to_the_trajectory::<2>();
    on_the_reference_all_laws_add_up_to_the_trajectory::<3>();
}

fn rings_are_flown_with_errors_of_second_order<const D: usize>()
where
    In<D>: Engine<D>,
{
    let steps = [0.02, 0.01, 0.005];
    let errors = steps.map(|step| {
        let flatness = json!({ "trajectories": courses_json::<D>(), "velocity_gain": 1 });
        flown(crowd::<D>(flatness, step, 0.0), &courses())
    });
    for k in 0..2 {
        let errors = errors.map(|error| error[k]);
        let order = order(&steps, &errors);
        assert!((1.8..2.3).contains(&order), "{order}: {errors:?}");
        assert!(errors[2] < 1e-3, "{errors:?}");
    }
}

#[test]
fn rings_are_flown_with_errors_of_second_order_in_2d_and_3d() {
    rings_are_flown_with_errors_of_second_order::<2>();
    rings_are_flown_with_errors_of_second_order::<3>();
}

#[test]
fn feedback_brings_agents_back_to_their_trajectories() {
    let gains = json!({
        "trajectories": courses_json::<2>(), "velocity_gain": 6, "position_gain": 9
    });
    let back = flown(crowd::<2>(gains, 0.01, 0.3), &courses());
    let without = json!({ "trajectories": courses_json::<2>() });
    let away = flown(crowd::<2>(without, 0.01, 0.3), &courses());
    assert!(back[0] < 0.02 && back[1] < 0.05, "{back:?}");
    assert!(away[0] > 0.1, "{away:?}");
}

/// One body after a target on a circle.
fn chase(feedforward: bool) -> [f64; 2] {
    let target = json!({ "circle": {
        "center": [1, 2], "radius": 3, "angular_velocity": 1, "phase": 0.5
    } });
    let world: World<2> = world(from_json(json!({
        "dimension": 2, "time": { "end": 30 },
        "agents": [{ "radius": 0.1, "positions": { "explicit": [[9, 9]] } }],
        "laws": [{ "tracking": {
            "target": target, "velocity_gain": 2, "position_gain": 2, "feedforward": feedforward
        } }]
    })));
    let course: volary::world::spec::TrajectorySpec = from_json(target);
    flown(world, &[course.trajectory()])
}

#[test]
fn targets_are_caught_with_feedforward_and_trailed_without() {
    let [off, slow] = chase(true);
    assert!(off < 1e-4 && slow < 1e-4, "{off}, {slow}");
    // The error's response to −ÿ, of size 3 and frequency 1: 3/|2 − 1 + 2i|.
    let [off, slow] = chase(false);
    let expected = 3.0 / 5f64.sqrt();
    assert!((off - expected).abs() < 1e-3, "{off}");
    assert!((slow - expected).abs() < 1e-3, "{slow}");
}

#[test]
fn steering_given_in_advance_is_integrated() {
    let world: World<2> = world(from_json(json!({
        "dimension": 2, "time": { "end": 3 },
        "agents": [{
            "radius": 0.1, "mass": 5, "positions": { "explicit": [[0, 0]] },
            "velocities": { "common": [1, 0] }
        }],
        "laws": [{ "steering": { "acceleration": [
            2, { "sine": { "amplitude": 1, "period": std::f64::consts::TAU } }
        ] } }]
    })));
    let expected = |t: f64| Moment {
        position: Vector::<2>::new(t + t * t, t - t.sin()),
        velocity: Vector::<2>::new(1.0 + 2.0 * t, 1.0 - t.cos()),
        acceleration: Vector::<2>::new(2.0, t.sin()),
    };
    let [off, slow] = flown(world, &[Trajectory::own(expected)]);
    assert!(off < 1e-4 && slow < 1e-4, "{off}, {slow}");
}
