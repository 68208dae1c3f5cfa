//! Bodies follow the equations of motion to second order in the step, while nothing touches,
//! and keep what the equations keep.

mod common;

use common::{Flow, flock_world, headings, order, world};
use volary::dynamics::Engine;
use volary::law::{Flock, State, build};
use volary::math::Vector;
use volary::shape::In;
use volary::simulation::Simulation;
use volary::world::World;
use volary::world::spec::{LawSpec, WorldSpec};

/// The equations of motion integrated by the classical Runge–Kutta method: another
/// integrator than the engine, with the same laws.
fn reference<const D: usize>(world: &World<D>, steps: usize) -> Flow<D> {
    let mut flock = Flock::new(build(world));
    let h = world.spec.time.end / steps as f64;
    let mut state = (
        world.agents.positions.clone(),
        world.agents.velocities.clone(),
    );
    let mut slope = |time: f64, state: &Flow<D>| -> Flow<D> {
        let mut acceleration = vec![Vector::zeros(); state.0.len()];
        let seen = State {
            time,
            positions: &state.0,
            velocities: &state.1,
            headings: &headings(&state.1),
            groups: &world.agents.group,
            masses: &world.agents.mass,
            rotations: &world.agents.rotations,
            obstacles: &world.obstacles,
        };
        flock.accelerations(&seen, &mut acceleration);
        for value in &mut acceleration {
            *value += world.gravity;
        }
        (state.1.clone(), acceleration)
    };
    let moved = |state: &Flow<D>, slope: &Flow<D>, h: f64| -> Flow<D> {
        let add = |a: &[Vector<D>], b: &[Vector<D>]| {
            a.iter().zip(b).map(|(a, b)| a + b * h).collect::<Vec<_>>()
        };
        (add(&state.0, &slope.0), add(&state.1, &slope.1))
    };
    for step in 0..steps {
        let time = step as f64 * h;
        let k1 = slope(time, &state);
        let k2 = slope(time + h / 2.0, &moved(&state, &k1, h / 2.0));
        let k3 = slope(time + h / 2.0, &moved(&state, &k2, h / 2.0));
        let k4 = slope(time + h, &moved(&state, &k3, h));
        for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            state = moved(&state, &k, h * weight / 6.0);
        }
    }
    state
}

fn error<const D: usize>(a: &[Vector<D>], b: &[Vector<D>]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).norm())
        .fold(0.0, f64::max)
}

fn errors<const D: usize>(spec: &WorldSpec, steps: &[f64], exact: &Flow<D>) -> Vec<(f64, f64)>
where
    In<D>: Engine<D>,
{
    let run = |step: &f64| {
        let mut spec = spec.clone();
        spec.time.step = *step;
        let mut simulation = Simulation::<D>::new(world(spec)).expect("a finite start");
        for _ in 0..simulation.world().steps() {
            simulation.step().expect("a finite state");
        }
        assert_eq!(
            simulation.ledger().agent_contacts().episodes,
            0,
            "nothing may touch"
        );
        let state = simulation.snapshot();
        (
            error(state.positions, &exact.0),
            error(state.velocities, &exact.1),
        )
    };
    steps.iter().map(run).collect()
}

fn converges<const D: usize>(spec: WorldSpec, substeps: usize)
where
    In<D>: Engine<D>,
{
    let mut spec = spec;
    spec.physics.solver_iterations = substeps;
    spec.physics.gravity = Some((0..D).map(|k| 0.1 * k as f64).collect());
    let exact = reference(&world::<D>(spec.clone()), 4000);
    let steps = [0.04, 0.02, 0.01, 0.005];
    let errors = errors(&spec, &steps, &exact);
    let positions: Vec<f64> = errors.iter().map(|error| error.0).collect();
    let velocities: Vec<f64> = errors.iter().map(|error| error.1).collect();
    for (name, errors) in [("position", positions), ("velocity", velocities)] {
        let order = order(&steps, &errors);
        assert!(
            (1.8..2.4).contains(&order),
            "{D}-D, {substeps} substeps: {name} errors {errors:?} fall with order {order:.2}"
        );
    }
}

#[test]
fn second_order_in_the_plane() {
    converges::<2>(flock_world(2), 1);
}

#[test]
fn second_order_in_space() {
    converges::<3>(flock_world(3), 1);
}

#[test]
fn second_order_with_substeps() {
    converges::<2>(flock_world(2), 4);
    converges::<3>(flock_world(3), 3);
}

/// The same flock of rods, which a torque turns along their velocities.
fn rods(dimension: usize) -> WorldSpec {
    let mut spec = flock_world(dimension);
    let shape = serde_json::json!({ "capsule": { "half_length": 0.03, "radius": 0.01 } });
    spec.agents[0].radius = None;
    spec.agents[0].shape = serde_json::from_value(shape).expect("a shape");
    spec
}

#[test]
fn second_order_whatever_the_shape() {
    converges::<2>(rods(2), 1);
    converges::<3>(rods(3), 2);
}

#[test]
fn bodies_keep_the_momentum_under_the_alpha_protocols() {
    for protocol in [
        "nonsmooth",
        "smooth",
        "smooth_weighted_damping",
        "approximate",
    ] {
        let mut spec = flock_world(2);
        spec.obstacles.clear();
        spec.laws.truncate(1);
        let LawSpec::AlphaInteraction(alpha) = &mut spec.laws[0] else {
            panic!("the world has this law");
        };
        alpha.protocol = serde_json::from_value(protocol.into()).expect("a protocol");
        let mut simulation = Simulation::<2>::new(world(spec)).expect("a finite start");
        let momentum = |velocities: &[Vector<2>]| velocities.iter().sum::<Vector<2>>();
        let before = momentum(simulation.snapshot().velocities);
        let start = simulation.snapshot().velocities.to_vec();
        for _ in 0..200 {
            simulation.step().expect("a finite state");
        }
        let state = simulation.snapshot();
        assert!(
            error(state.velocities, &start) > 0.1,
            "{protocol}: nothing happened"
        );
        let drift = (momentum(state.velocities) - before).norm();
        assert!(drift < 1e-12, "{protocol}: the momentum drifts by {drift}");
    }
}
