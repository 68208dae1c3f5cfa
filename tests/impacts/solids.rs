//! Clouds of rods, boxes and hulls that meet turning, each meeting against one found by halving
//! and against the mechanics of rigid bodies.

use serde_json::{Value, json};
use volary::dynamics::{Bodies, Engine, Touched};
use volary::law::Flock;
use volary::math::{Matrix, Vector};
use volary::shape::{In, Pose};
use volary::world::World;

use crate::common::{Dice, spec, world};
use crate::list;

/// Times of a step at which gaps are looked at for a meeting.
const LOOKS: usize = 60;

/// Shapes about one unit long.
fn shape<const D: usize>(kind: usize, dice: &mut Dice) -> Value {
    let mut sizes =
        |low: f64, high: f64| -> Vec<f64> { (0..D).map(|_| dice.between(low, high)).collect() };
    match kind % 3 {
        0 => json!({ "capsule": { "half_length": 0.4, "radius": 0.1 } }),
        1 if kind.is_multiple_of(2) => json!({ "cuboid": { "half_extents": sizes(0.1, 0.5) } }),
        1 => json!({ "cuboid": { "half_extents": vec![0.4; D] } }),
        _ => {
            let points: Vec<_> = (0..8).map(|_| sizes(-0.6, 0.6)).collect();
            json!({ "convex": { "points": points } })
        }
    }
}

/// Bodies on a grid that fly inwards, at up to some speed.
fn cloud<const D: usize>(dice: &mut Dice, step: f64, speed: f64, restitution: f64) -> Value {
    let side: usize = if D == 2 { 6 } else { 3 };
    let groups: Vec<_> = (0..side.pow(D as u32))
        .map(|k| {
            let place = Vector::<D>::from_fn(|axis, _| {
                let along = k / side.pow(axis as u32) % side;
                3.0 * (along as f64 - 0.5 * (side - 1) as f64)
            });
            let place = place + dice.vector(-0.3, 0.3);
            let velocity = dice.direction::<D>() * speed - place * (0.1 * speed);
            let turn: Vec<f64> = (0..3).map(|_| dice.between(-3.0, 3.0)).collect();
            json!({
                "shape": shape::<D>(k, dice), "mass": dice.magnitude(0.3, 3.0), "heading": "free",
                "rotation": if D == 2 { json!(turn[0]) } else { json!(turn) },
                "positions": { "explicit": [list(&place)] },
                "velocities": { "explicit": [list(&velocity)] }
            })
        })
        .collect();
    json!({
        "dimension": D, "time": { "step": step, "end": 100.0 * step },
        "physics": { "restitution": restitution }, "agents": groups
    })
}

/// A body as it flies through a step.
#[derive(Clone)]
struct Body<const D: usize> {
    pose: Pose<D>,
    velocity: Vector<D>,
    spin: Vector<3>,
}

/// A vector of the plane or of space, in space.
fn embed<const D: usize>(v: &Vector<D>) -> Vector<3> {
    Vector::from_fn(|k, _| if k < D { v[k] } else { 0.0 })
}

fn project<const D: usize>(v: &Vector<3>) -> Vector<D> {
    Vector::from_fn(|k, _| v[k])
}

impl<const D: usize> Body<D> {
    fn pose_at(&self, time: f64) -> Pose<D> {
        let turn = Pose::<D>::new(Vector::zeros(), [0, 1, 2].map(|k| self.spin[k] * time));
        Pose::from_matrix(
            self.pose.translation + self.velocity * time,
            turn.rotation() * self.pose.rotation(),
        )
    }

    fn all(bodies: &Bodies<D>) -> Vec<Self>
    where
        In<D>: Engine<D>,
    {
        let now = bodies.snapshot();
        let rotations = now.rotations.expect("none is round");
        let spins = now.spins.expect("none is round");
        (0..now.positions.len())
            .map(|k| Self {
                pose: Pose::from_matrix(now.positions[k], rotations[k]),
                velocity: now.velocities[k],
                spin: spins[k],
            })
            .collect()
    }
}

/// The inverse of a body's inertia tensor, in the world.
fn inverse_inertia<const D: usize>(world: &World<D>, agent: usize, pose: &Pose<D>) -> Matrix<3> {
    let solid = &world.solids[agent];
    let own = solid.inertia() * (world.agents.mass[agent] / solid.volume());
    if D == 2 {
        let mut inverse = Matrix::zeros();
        inverse[(2, 2)] = 1.0 / own[(2, 2)];
        return inverse;
    }
    let turn = Matrix::<3>::from_fn(|row, column| pose.rotation()[(row, column)]);
    turn * own.try_inverse().expect("a body turns") * turn.transpose()
}

/// Whether a body turns on as it does: no gyroscopic forces act.
fn turns_evenly<const D: usize>(world: &World<D>, agent: usize, body: &Body<D>) -> bool {
    let inverse = inverse_inertia(world, agent, &body.pose);
    let change = body.spin.cross(&(inverse * body.spin));
    change.norm() <= 1e-14 * inverse.norm() * body.spin.norm_squared()
}

/// When the surfaces of two bodies meet first in a step.
fn meeting<const D: usize>(
    world: &World<D>,
    pair: [usize; 2],
    ways: [&Body<D>; 2],
    step: f64,
) -> Option<f64> {
    let [a, b] = pair.map(|agent| &world.solids[agent]);
    let gap = |time: f64| a.gap(&ways[0].pose_at(time), b, &ways[1].pose_at(time));
    let time = |k: usize| step * k as f64 / LOOKS as f64;
    // Those that touch already are another matter.
    if gap(0.0) < 1e-6 {
        return None;
    }
    let after = (1..=LOOKS).find(|&k| gap(time(k)) < 0.0)?;
    let (mut low, mut high) = (time(after - 1), time(after));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match gap(middle) < 0.0 {
            true => high = middle,
            false => low = middle,
        }
    }
    Some(high)
}

/// Whether two bodies that touch overlap within some time.
fn meets_again<const D: usize>(
    world: &World<D>,
    pair: [usize; 2],
    ways: [&Body<D>; 2],
    left: f64,
) -> bool {
    let [a, b] = pair.map(|agent| &world.solids[agent]);
    (1..=LOOKS).any(|k| {
        let time = left * k as f64 / LOOKS as f64;
        a.gap(&ways[0].pose_at(time), b, &ways[1].pose_at(time)) < 0.0
    })
}

#[derive(Default)]
struct Score {
    met: usize,
    told: usize,
    worst: [f64; 4],
}

impl Score {
    fn note(&mut self, which: usize, off: f64) {
        self.worst[which] = self.worst[which].max(off);
    }
}

fn check<const D: usize>(seed: u64, step: f64, score: &mut Score)
where
    In<D>: Engine<D>,
{
    let mut dice = Dice(seed);
    let restitution = [0.5, 1.0][(seed % 2) as usize];
    // Lengths of a body in a step.
    let travel = dice.magnitude(0.01, 2.0);
    let speed = travel / step;
    let world = world::<D>(spec(cloud::<D>(&mut dice, step, speed, restitution)));
    let mut flock = Flock::of_world(&world, Vec::new());
    let mut bodies = Bodies::new(&world, &mut flock).expect("a finite start");
    let steps = (10.0 / travel).clamp(5.0, 100.0) as usize;
    for taken in 0..steps {
        let before = Body::<D>::all(&bodies);
        let begin = bodies.snapshot().time;
        bodies.step(&mut flock).expect("a finite step");
        let after = Body::<D>::all(&bodies);
        let mut touched = vec![0; before.len()];
        for touch in bodies.touches() {
            touched[touch.agent] += 1;
            let Touched::Agent(other) = touch.touched else {
                panic!("there are no obstacles");
            };
            touched[other] += 1;
        }
        let what = format!("{D}-D, seed {seed}, travel {travel}, step {taken}");
        let even: Vec<bool> = (0..before.len())
            .map(|it| turns_evenly(&world, it, &before[it]))
            .collect();
        // Who was struck by nobody went on as it was, and so through nobody.
        for a in 0..before.len() {
            if touched[a] > 0 {
                continue;
            }
            assert!(
                (after[a].velocity - before[a].velocity).norm() < 1e-12 * speed,
                "{what}"
            );
            for b in 0..a {
                let near = before[a].pose.translation - before[b].pose.translation;
                let way = (before[a].velocity - before[b].velocity).norm() * step;
                let unlike = touched[b] > 0 || !even[a] || !even[b];
                if unlike || near.norm() > 2.2 + way {
                    continue;
                }
                let time = meeting(&world, [a, b], [&before[a], &before[b]], step);
                assert!(time.is_none(), "{what}: {a} and {b} meet at {time:?}");
            }
        }
        for touch in bodies.touches() {
            let Touched::Agent(other) = touch.touched else {
                continue;
            };
            let pair = [touch.agent, other];
            score.told += 1;
            if pair.iter().any(|&it| touched[it] > 1 || !even[it]) || touch.press > 0.0 {
                continue;
            }
            let ways = pair.map(|it| &before[it]);
            let Some(time) = meeting(&world, pair, ways, step) else {
                // Between two looks, or touching from the start: as near as can be told.
                let at = touch.time - begin;
                let [a, b] = [0, 1].map(|k| ways[k].pose_at(at));
                let gap = world.solids[pair[0]].gap(&a, &world.solids[pair[1]], &b);
                assert!(
                    at == 0.0 || gap.abs() < 1e-9,
                    "{what}: told at {at}, gap {gap}"
                );
                continue;
            };
            score.met += 1;
            let [a, b] = [0, 1].map(|k| ways[k].pose_at(time));
            let found = world.solids[pair[0]].separation(&a, &world.solids[pair[1]], &b);
            let normal = embed(&found.normal);
            let point = (found.points[0] + found.points[1]) * 0.5;
            let arms = [
                embed(&(point - a.translation)),
                embed(&(point - b.translation)),
            ];
            let surface = |k: usize| ways[k].velocity + project(&ways[k].spin.cross(&arms[k]));
            let approach = (surface(0) - surface(1)).dot(&found.normal);
            let inverse = [
                inverse_inertia(&world, pair[0], &a),
                inverse_inertia(&world, pair[1], &b),
            ];
            let masses = pair.map(|it| world.agents.mass[it]);
            let yields: f64 = (0..2)
                .map(|k| {
                    let turning = (inverse[k] * arms[k].cross(&normal)).cross(&arms[k]);
                    1.0 / masses[k] + turning.dot(&normal)
                })
                .sum();
            let impulse = (1.0 + restitution) * approach / yields;
            // Slow grazes are found as sharply as their square root can be.
            let grazing = (speed / approach).max(1.0);
            score.note(0, (touch.time - begin - time).abs() / step / grazing);
            score.note(1, (touch.approach_speed - approach).abs() / speed);
            let struck = [0, 1].map(|k| {
                let push = found.normal * (impulse * if k == 0 { -1.0 } else { 1.0 });
                Body {
                    pose: if k == 0 { a.clone() } else { b.clone() },
                    velocity: ways[k].velocity + push / masses[k],
                    spin: ways[k].spin + inverse[k] * arms[k].cross(&embed(&push)),
                }
            });
            if meets_again(&world, pair, [&struck[0], &struck[1]], step - time) {
                continue;
            }
            score.note(2, (touch.blow - impulse).abs() / speed);
            for (agent, struck) in pair.into_iter().zip(&struck) {
                score.note(3, (after[agent].velocity - struck.velocity).norm() / speed);
                score.note(3, (after[agent].spin - struck.spin).norm() / speed);
            }
            let off = score.worst;
            assert!(
                off.iter().all(|&it| it < 1e-8),
                "{what}: {pair:?} off by {off:?}, at {time} with {approach}, {touch:?}"
            );
        }
    }
}

#[test]
fn turning_bodies_meet_exactly_where_their_surfaces_do() {
    let mut score = Score::default();
    for seed in 0..6 {
        for step in [0.01, 0.001] {
            check::<2>(seed, step, &mut score);
            check::<3>(seed, step, &mut score);
        }
    }
    assert!(score.met > 300, "{} of {} told", score.met, score.told);
}
