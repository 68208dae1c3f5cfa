//! Laws that relax: followed exactly over each step, for any rate and step.

mod common;

use common::{Flow, order, world};
use volary::dynamics::Engine;
use volary::law::{Law, Link, Pull};
use volary::math::{Gain, Vector};
use volary::sense::Scene;
use volary::shape::In;
use volary::simulation::Simulation;
use volary::world::spec::WorldSpec;

/// Motsch–Tadmor alignment with influences 1/(1 + r²), as a law of one's own that relaxes.
#[derive(Clone)]
struct Alignment {
    gain: Gain,
}

impl<const D: usize> Law<D> for Alignment {
    fn name(&self) -> &str {
        "own_alignment"
    }

    fn range(&self) -> f64 {
        f64::INFINITY
    }

    fn relaxes(&self) -> bool {
        true
    }

    fn pull(&self, scene: &Scene<'_, D>, i: usize, links: &mut Vec<Link<D>>) -> Option<Pull> {
        let mut total = 1.0;
        scene.neighbours(i, f64::INFINITY, |neighbour| {
            let weight = 1.0 / (1.0 + neighbour.squared);
            total += weight;
            links.push(Link {
                index: neighbour.index,
                weight,
                velocity: neighbour.velocity,
            });
        });
        links.iter_mut().for_each(|link| link.weight /= total);
        Some(Pull {
            gain: self.gain,
            own: 1.0 / total,
        })
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (k, out) in out.iter_mut().enumerate() {
            let mut links = Vec::new();
            if let Some(pull) = self.pull(scene, first + k, &mut links) {
                let drive =
                    |link: &Link<D>| (link.velocity - scene.velocities[first + k]) * link.weight;
                *out += pull.gain.of(&links.iter().map(drive).sum());
            }
        }
    }
}

fn flock(dimension: usize, step: f64, end: f64, gravity: f64) -> WorldSpec {
    common::spec(serde_json::json!({
        "dimension": dimension,
        "time": { "step": step, "end": end },
        "record": { "every": end },
        "seed": 3,
        "physics": { "gravity": vec![gravity; dimension] },
        "agents": [{
            "count": 7, "radius": 0.01, "mass": 2,
            "positions": { "box": {
                "min": vec![0; dimension], "max": vec![8; dimension], "separation": 1.0
            } },
            "velocities": { "uniform": { "min": vec![0; dimension], "max": vec![3; dimension] } }
        }],
        "laws": [{ "alpha_interaction": { "spacing": 3, "range": 5, "damping": 0 } }]
    }))
}

fn simulation<const D: usize>(spec: WorldSpec, gain: Gain) -> Simulation<D>
where
    In<D>: Engine<D>,
{
    Simulation::with_laws(world(spec), vec![Box::new(Alignment { gain })]).expect("a finite start")
}

/// The same equations by the classical Runge–Kutta method, written as plain loops.
fn reference<const D: usize>(spec: &WorldSpec, gain: Gain, steps: usize) -> Flow<D>
where
    In<D>: Engine<D>,
{
    let world = world::<D>(spec.clone());
    let mut others = volary::law::Flock::of_world(&world, Vec::new());
    let h = spec.time.end / steps as f64;
    let mut slope = |(x, v): &Flow<D>| -> Flow<D> {
        let n = x.len();
        let mut a = vec![Vector::zeros(); n];
        let state = volary::law::State {
            time: 0.0,
            positions: x,
            velocities: v,
            headings: &common::headings(v),
            groups: &world.agents.group,
            masses: &world.agents.mass,
            rotations: &[],
            obstacles: &[],
        };
        others.accelerations(&state, &mut a);
        for i in 0..n {
            let (mut sum, mut total) = (Vector::zeros(), 0.0);
            for j in 0..n {
                let weight = 1.0 / (1.0 + (x[i] - x[j]).norm_squared());
                sum += v[j] * weight;
                total += weight;
            }
            let u = sum / total - v[i];
            a[i] += u * gain.at(u.norm()) + world.gravity;
        }
        (v.clone(), a)
    };
    let moved = |(x, v): &Flow<D>, (dx, dv): &Flow<D>, h: f64| -> Flow<D> {
        let add =
            |a: &[Vector<D>], b: &[Vector<D>]| a.iter().zip(b).map(|(a, b)| a + b * h).collect();
        (add(x, dx), add(v, dv))
    };
    let mut state = (
        world.agents.positions.clone(),
        world.agents.velocities.clone(),
    );
    for _ in 0..steps {
        let k1 = slope(&state);
        let k2 = slope(&moved(&state, &k1, h / 2.0));
        let k3 = slope(&moved(&state, &k2, h / 2.0));
        let k4 = slope(&moved(&state, &k3, h));
        for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            state = moved(&state, &k, h * weight / 6.0);
        }
    }
    state
}

fn second_order<const D: usize>(gain: Gain, iterations: usize)
where
    In<D>: Engine<D>,
{
    let mut spec = flock(D, 0.01, 1.6, 0.3);
    spec.physics.solver_iterations = iterations;
    let exact = reference::<D>(&spec, gain, 4000);
    let steps = [0.04, 0.02, 0.01, 0.005];
    let mut errors = [Vec::new(), Vec::new()];
    for step in steps {
        spec.time.step = step;
        let mut run = simulation::<D>(spec.clone(), gain);
        for _ in 0..run.world().steps() {
            run.step().expect("a finite state");
        }
        assert_eq!(run.ledger().agent_contacts().episodes, 0);
        let state = run.snapshot();
        let far = |a: &[Vector<D>], b: &[Vector<D>]| {
            a.iter()
                .zip(b)
                .map(|(a, b)| (a - b).norm())
                .fold(0.0, f64::max)
        };
        errors[0].push(far(state.positions, &exact.0));
        errors[1].push(far(state.velocities, &exact.1));
    }
    for errors in errors {
        let order = order(&steps, &errors);
        assert!(
            (1.8..2.6).contains(&order),
            "{D}-D, {iterations} iterations, {gain:?}: {errors:?} fall with order {order:.2}"
        );
    }
}

#[test]
fn relaxing_is_of_second_order_where_it_is_not_stiff() {
    let bounded = Gain::Bounded {
        bound: 3.0,
        scale: 0.5,
    };
    second_order::<2>(Gain::Constant(2.0), 1);
    second_order::<3>(bounded, 1);
    second_order::<2>(bounded, 3);
}

/// How far a point is outside the convex hull of others: the largest distance by which it
/// leads them in one of many directions.
fn outside<const D: usize>(point: &Vector<D>, hull: &[Vector<D>], directions: &[Vector<D>]) -> f64 {
    let lead = |along: &Vector<D>| {
        let farthest = hull
            .iter()
            .map(|v| v.dot(along))
            .fold(f64::NEG_INFINITY, f64::max);
        point.dot(along) - farthest
    };
    directions
        .iter()
        .map(lead)
        .fold(f64::NEG_INFINITY, f64::max)
}

fn directions<const D: usize>() -> Vec<Vector<D>> {
    let grid = |k: usize| (k as f64 * 0.754_877 + 0.3).fract() * 2.0 - 1.0;
    let all = (0..400).map(|k| Vector::from_fn(|axis, _| grid(k * (axis + 1) + 17 * axis)));
    all.map(|v: Vector<D>| v.normalize()).collect()
}

fn stays_in_the_hull<const D: usize>(gain: Gain, step: f64)
where
    In<D>: Engine<D>,
{
    let mut spec = flock(D, step, 200.0 * step, 0.0);
    spec.laws.clear();
    spec.agents[0].radius = Some(1e-6);
    let mut run = simulation::<D>(spec, gain);
    let directions = directions();
    let mut before = run.snapshot().velocities.to_vec();
    for _ in 0..200 {
        let places = run.snapshot().positions.to_vec();
        run.step().expect("a finite state");
        let state = run.snapshot();
        let far = state.positions.iter().map(Vector::amax).fold(0.0, f64::max);
        let slack = 1e-12 + 1e-15 * far / step;
        // The velocities that the bodies moved with, and then those at the end of the step.
        let ways = state.positions.iter().zip(&places);
        let moved: Vec<_> = ways.map(|(to, from)| (to - from) / step).collect();
        for (moved_with, velocity) in moved.iter().zip(state.velocities) {
            let far = outside(moved_with, &before, &directions);
            assert!(far < slack, "{gain:?}, steps of {step}: {far}");
            assert!(outside(velocity, &moved, &directions) < slack);
        }
        before = moved;
    }
    assert!(gain.at(1.0) * step < 10.0 || volary::metric::diameter(&before) < 1e-3);
}

#[test]
fn velocities_stay_in_the_convex_hull_for_any_rate_and_step() {
    for rate in [0.5, 1.0, 3e3, 1e7, 1e30] {
        for step in [1e-3, 0.01, 1.0, 50.0] {
            let bounded = Gain::Bounded {
                bound: rate,
                scale: 0.3,
            };
            stays_in_the_hull::<2>(Gain::Constant(rate), step);
            stays_in_the_hull::<3>(bounded, step);
        }
    }
}

/// A world under alignment that changes with time and with where the agents look.
fn changing(iterations: usize, step: f64) -> WorldSpec {
    common::spec(serde_json::json!({
        "dimension": 2,
        "time": { "step": step, "end": 1.6 },
        "record": { "every": 1.6 },
        "physics": { "solver_iterations": iterations },
        "agents": [{
            "radius": 0.01,
            "positions": { "explicit": [[0, 0], [3, 0], [0, 4], [5, 5]] },
            "velocities": { "explicit": [[1, 0], [0, 1], [-1, 0.5], [2, -1]] }
        }],
        "laws": [
            { "alignment": {
                "kernel": { "cucker_smale": { "exponent": 0.5 } },
                "normalisation": "motsch_tadmor", "relaxation": "always",
                "gain": { "open_loop": { "sine": { "mean": 2, "amplitude": 2, "period": 3 } } },
                "orientation": { "angle": 1.5, "softness": 0.8, "speed": 0.5, "length": 1 }
            } },
            { "steering": { "accelerations": [[0.5, 0], [0, 0.3], [-0.2, 0.1], [0, 0]] } }
        ]
    }))
}

#[test]
fn gains_that_change_with_time_and_heading_are_of_second_order_with_substeps() {
    for iterations in [1, 2, 4] {
        let end = |step: f64| -> Vec<Vector<2>> {
            let mut run = Simulation::<2>::new(world(changing(iterations, step))).expect("finite");
            for _ in 0..run.world().steps() {
                run.step().expect("a finite state");
            }
            let state = run.snapshot();
            state
                .positions
                .iter()
                .chain(state.velocities)
                .copied()
                .collect()
        };
        let exact = end(0.0005);
        let steps = [0.08, 0.04, 0.02];
        let errors = steps.map(|step| {
            let far = end(step)
                .into_iter()
                .zip(&exact)
                .map(|(a, b)| (a - b).norm());
            far.fold(0.0, f64::max)
        });
        let order = order(&steps, &errors);
        assert!(
            (1.7..2.6).contains(&order),
            "{iterations} iterations: {errors:?}, {order:.2}"
        );
    }
}

#[test]
fn the_top_speed_holds_while_velocities_relax() {
    for push in [3.0, 4.0, 30.0] {
        let spec = common::spec(serde_json::json!({
            "dimension": 2,
            "time": { "step": 0.1, "end": 3 },
            "record": { "every": 3 },
            "agents": [{
                "radius": 0.1, "top_speed": 1,
                "positions": { "explicit": [[0, 0], [0, 5]] },
                "velocities": { "explicit": [[0, 0.5], [0, -0.5]] }
            }],
            "laws": [
                { "alignment": { "gain": 20, "relaxation": "always" } },
                { "steering": { "acceleration": [push, 0] } }
            ]
        }));
        let mut run = Simulation::<2>::new(world(spec)).expect("a finite start");
        let mut fastest = 0.0;
        for _ in 0..run.world().steps() {
            run.step().expect("a finite state");
            for velocity in run.snapshot().velocities {
                assert!(velocity.norm() < 1.0 + 1e-12, "{push}: {}", velocity.norm());
                fastest = f64::max(fastest, velocity.norm());
            }
        }
        assert!(fastest > 0.99, "{push}: {fastest}");
    }
}

#[test]
fn laws_that_are_stiff_together_relax() {
    let law = serde_json::json!({ "alignment": { "normalisation": "motsch_tadmor", "gain": 24 } });
    let mut spec = flock(2, 0.01, 5.0, 0.0);
    spec.laws = common::from_json(serde_json::json!(vec![law; 8]));
    let mut run = Simulation::<2>::new(world(spec)).expect("a finite start");
    for _ in 0..run.world().steps() {
        run.step().expect("a finite state");
    }
    assert!(volary::metric::diameter(run.snapshot().velocities) < 1e-9);
}

/// Two that are pulled together collide head on: the contact stops them, and the flock goes on.
#[test]
fn bodies_touch_while_they_relax() {
    let spec = common::spec(serde_json::json!({
        "dimension": 2,
        "time": { "step": 0.01, "end": 3 },
        "record": { "every": 3 },
        "physics": { "restitution": 0.5 },
        "agents": [{
            "radius": 0.5,
            "positions": { "explicit": [[0, 0], [4, 0], [2, 9]] },
            "velocities": { "explicit": [[4, 0], [-4, 0], [0, 0]] }
        }],
        "laws": [{ "alignment": { "gain": 0.2, "relaxation": "always" } }]
    }));
    let mut run = Simulation::<2>::new(world(spec)).expect("a finite start");
    let mut total = 0.0f64;
    for _ in 0..run.world().steps() {
        run.step().expect("a finite state");
        total = total.max(run.snapshot().velocities.iter().sum::<Vector<2>>().norm());
    }
    let contacts = run.ledger().agent_contacts();
    assert!(
        contacts.episodes >= 1 && contacts.deepest_penetration < 0.05,
        "{contacts:?}"
    );
    assert!(total < 1e-9, "momentum appears: {total}");
    // They bounced back, and then slowed down towards the mean, which is rest.
    let state = run.snapshot();
    assert!(state.velocities[0][0] < 0.0 && state.velocities[1][0] > 0.0);
}
