//! Nothing passes through anything: 10,000 random shots at walls and at each other.
//!
//! Shots are flown fifty at a time, in lanes too far apart to meet, at relative speeds from
//! 5 to 50 or to 150 diameters a second and a step of 0.01 s. A ball has passed a wall when
//! the path of its centre, seen from the wall, crosses it: the segments and triangles that
//! the wall is made of, the middle plane of a thin cuboid, the edges of solid triangles.
//! Balls that pass by the rim cross nothing. A pair has passed when the straight way from
//! step to step brings the centres nearer than half the distance at which surfaces touch.
//! Nothing may even overlap by more than 0.3 diameters, which balls do where the engine
//! foresees nothing.

mod common;

use common::{Dice, spec};
use serde_json::{Value, json};
use volary::dynamics::{Bodies, Engine};
use volary::law::{Flock, build};
use volary::math::{Vector, axis, direction};
use volary::shape::{In, Obstacle, Pose, Shape};
use volary::world::World;

const LANES: usize = 50;
const APART: f64 = 1_000.0;
const RADIUS: f64 = 0.5;
const STEP: f64 = 0.01;

fn list<const D: usize>(vector: &Vector<D>) -> Value {
    json!(vector.as_slice())
}

/// A thin wall of some kind, a few diameters wide, about the origin.
fn wall<const D: usize>(kind: usize, dice: &mut Dice) -> Value {
    let mut jagged =
        |count: usize| -> Vec<f64> { (0..count).map(|_| dice.between(-0.8, 0.8)).collect() };
    let flat = |x: f64, y: f64| -> Vec<f64> {
        let mut at = vec![0.0; D];
        (at[0], at[D - 1]) = (x, y);
        at
    };
    match kind {
        0 if D == 2 => json!({ "segment": { "from": [-1.5, 0.0], "to": [1.5, 0.2] } }),
        0 => json!({ "triangle": { "points": [[-2, -1, 0], [2, -1, 0.3], [0, 2, -0.2]] } }),
        1 => {
            let heights = jagged(5);
            let points: Vec<_> = heights
                .iter()
                .enumerate()
                .map(|(k, y)| flat(1.2 * k as f64 - 2.4, *y))
                .collect();
            match D {
                2 => json!({ "polyline": { "points": points } }),
                _ => {
                    // A folded screen.
                    let corner = |k: usize, y: f64| json!([points[k][0], y, points[k][2]]);
                    let vertices: Vec<_> = (0..10)
                        .map(|i| corner(i / 2, if i % 2 == 0 { -1.5 } else { 1.5 }))
                        .collect();
                    let triangles: Vec<_> = (0..8).map(|i| json!([i, i + 1, i + 2])).collect();
                    json!({ "mesh": { "vertices": vertices, "triangles": triangles } })
                }
            }
        }
        2 if D == 2 => json!({ "mesh": {
            "vertices": [[-2, 0], [-1, 0.8], [0, 0], [1, 0.8], [2, 0]],
            "triangles": [[0, 1, 2], [2, 3, 4]]
        } }),
        2 => json!({ "heightfield": {
            "width": 4, "depth": 4, "heights": [jagged(4), jagged(4), jagged(4), jagged(4)]
        } }),
        3 if D == 2 => json!({ "heightfield": { "width": 5, "heights": jagged(6) } }),
        4 => {
            let mut half = vec![2.0; D];
            half[D - 1] = 0.02;
            json!({ "cuboid": { "half_extents": half } })
        }
        5 => json!({ "corridor": {
            "points": [flat(-4.0, 0.0), flat(0.0, 0.6), flat(4.0, 0.0)], "width": 2.0
        } }),
        _ => json!({ "compound": { "parts": [
            { "shape": { "cuboid": { "half_extents": vec![0.3; D] } }, "position": flat(-1.5, 0.0) },
            { "shape": { "segment": { "from": flat(-1.5, 0.0), "to": flat(1.5, 0.0) } } },
            { "shape": { "ball": { "radius": 0.3 } }, "position": flat(1.5, 0.0) }
        ] } }),
    }
}

/// A motion whose fastest point goes at about `speed`.
fn motion<const D: usize>(kind: usize, speed: f64, at: &Vector<D>, dice: &mut Dice) -> Value {
    let along = dice.direction::<D>();
    match kind {
        0 => json!({ "drift": { "velocity": list(&(along * speed)) } }),
        1 => {
            let period = dice.between(0.2, 1.0);
            let amplitude = along * (speed * period / std::f64::consts::TAU);
            json!({ "oscillation": {
                "amplitude": list(&amplitude), "period": period, "phase": dice.between(0.0, 6.0)
            } })
        }
        2 => {
            // Walls reach about 3 from their middle.
            let rate = speed / 3.0;
            match D {
                2 => json!({ "rotation": { "rate": rate } }),
                _ => json!({ "rotation": { "rate": list(&(along * rate)) } }),
            }
        }
        _ => {
            let points = [list(at), list(&(at + along * (0.2 * speed)))];
            json!({ "waypoints": { "points": points, "period": 0.4 } })
        }
    }
}

/// The pieces that a wall must not be crossed through, by their corners.
fn pieces<const D: usize>(obstacle: &Obstacle<D>) -> Vec<Vec<Vector<D>>> {
    let mut pieces = Vec::new();
    for part in obstacle.parts() {
        let own = Pose::new(Vector::zeros(), [0.0; 3]);
        let pose = part.pose.clone().unwrap_or(own);
        let mut add = |corners: &[Vector<D>]| {
            pieces.push(corners.iter().map(|it| pose.point_to_world(it)).collect());
        };
        match &part.shape {
            Shape::Segment { from, to } if D == 2 => add(&[*from, *to]),
            Shape::Triangle { points } if D == 3 => add(points),
            Shape::Triangle { points: [a, b, c] } => {
                [[*a, *b], [*b, *c], [*c, *a]]
                    .iter()
                    .for_each(|edge| add(edge));
            }
            Shape::Cuboid { half_extents: half } => {
                let corner = |x: f64, y: f64| {
                    let mut at = Vector::<D>::zeros();
                    at[1] = y * half[1];
                    at[D - 1] = 0.0;
                    at[0] = x * half[0];
                    at
                };
                if D == 2 {
                    add(&[corner(-1.0, 0.0), corner(1.0, 0.0)]);
                } else {
                    add(&[corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0)]);
                    add(&[corner(-1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]);
                }
            }
            // A rod in space can be passed on either side, and balls are thick.
            _ => {}
        }
    }
    pieces
}

/// Whether the way between two points crosses a segment (in the plane) or a triangle.
fn crosses<const D: usize>(from: &Vector<D>, to: &Vector<D>, corners: &[Vector<D>]) -> bool {
    // Solve from + s (to − from) = c₀ + Σ uₖ (cₖ − c₀).
    let columns: Vec<Vector<D>> = std::iter::once(from - to)
        .chain(corners[1..].iter().map(|corner| corner - corners[0]))
        .collect();
    let matrix = nalgebra::DMatrix::from_fn(D, D, |row, column| columns[column][row]);
    let right = nalgebra::DVector::from_fn(D, |row, _| (from - corners[0])[row]);
    let Some(found) = matrix.lu().solve(&right) else {
        return false;
    };
    let shares = &found.as_slice()[1..];
    (0.0..=1.0).contains(&found[0])
        && shares.iter().all(|&u| u >= 0.0)
        && shares.iter().sum::<f64>() <= 1.0
}

struct Score {
    shots: usize,
    hits: usize,
    passed: Vec<String>,
    /// Deepest overlap at the end of a step.
    deepest: f64,
}

/// One world of shots. `fastest` is the highest relative speed in diameters a second.
fn fly<const D: usize>(seed: u64, fastest: f64, score: &mut Score)
where
    In<D>: Engine<D>,
{
    let mut dice = Dice(seed);
    let restitution = (seed % 2) as f64;
    let iterations = [1, 2, 4, 8][(seed / 2 % 4) as usize];
    let physics = json!({ "restitution": restitution, "solver_iterations": iterations });
    let place = |lane: usize| axis::<D>(1) * (APART * lane as f64);

    // Lanes by kind: pairs of balls, fixed walls, moving walls.
    let kinds: Vec<usize> = (0..LANES)
        .map(|_| (dice.between(0.0, 1.0) * 8.0) as usize)
        .collect();
    let mut obstacles = Vec::new();
    let mut wall_of = vec![None; LANES];
    // The share of the relative speed that is the wall's.
    let mut share_of = vec![0.0; LANES];
    for (lane, &kind) in kinds.iter().enumerate() {
        if kind == 7 {
            continue;
        }
        wall_of[lane] = Some(obstacles.len());
        let at = place(lane);
        let mut wall = json!({ "shape": wall::<D>(kind, &mut dice), "position": list(&at) });
        let turn = dice.direction::<3>() * dice.between(0.0, 3.0);
        wall["rotation"] = if D == 2 { json!(turn[2]) } else { list(&turn) };
        if dice.between(0.0, 1.0) < 0.5 {
            share_of[lane] = dice.between(0.05, 0.95);
            let speed = share_of[lane] * fastest;
            let which = (dice.between(0.0, 1.0) * 4.0) as usize;
            wall["motion"] = motion(which, speed, &at, &mut dice);
            if which == 3 {
                wall.as_object_mut().expect("an object").remove("position");
            }
        }
        obstacles.push(wall);
    }
    let far =
        json!([{ "radius": 0.1, "positions": { "explicit": [list(&(axis::<D>(0) * -1e6))] } }]);
    let base = json!({
        "dimension": D, "time": { "step": STEP, "end": 0.4 }, "physics": physics,
        "obstacles": obstacles, "agents": far
    });
    let walls = World::<D>::new("walls", spec(base.clone()))
        .expect("sound")
        .obstacles;

    let (mut positions, mut velocities) = (Vec::new(), Vec::new());
    let mut balls = Vec::new();
    for (lane, wall) in wall_of.iter().enumerate() {
        let from = dice.direction::<D>();
        let first = positions.len();
        match *wall {
            None => {
                // Half of the relative speed each, off centre by up to a whole miss.
                let speed = dice.between(0.1, 1.0) * fastest;
                let mut aside = dice.direction::<D>();
                aside -= from * from.dot(&aside);
                let aside = direction(&aside) * dice.between(0.0, 2.0 * RADIUS);
                let way = from * dice.between(1.0, 2.0);
                positions.extend([place(lane) + way + aside, place(lane) - way]);
                velocities.extend([from * (-0.5 * speed), from * (0.5 * speed)]);
                balls.push((first, Some(first + 1)));
            }
            Some(wall) => {
                let speed = dice.between(0.1, 1.0) * (1.0 - share_of[lane]) * fastest;
                // Aimed at some point of the wall, corners and joints among them.
                let pieces = pieces(&walls[wall]);
                let piece =
                    &pieces[(dice.between(0.0, 1.0) * pieces.len() as f64) as usize % pieces.len()];
                let mut weights: Vec<f64> = piece
                    .iter()
                    .map(|_| dice.between(0.0, 1.0).powi(3))
                    .collect();
                let total: f64 = weights.iter().sum();
                weights.iter_mut().for_each(|weight| *weight /= total);
                let target: Vector<D> = piece.iter().zip(&weights).map(|(at, w)| at * *w).sum();
                let target = walls[wall].pose.point_to_world(&target);
                let start = (0..1000).find_map(|_| {
                    let from = dice.direction::<D>();
                    let start = target + from * dice.between(0.7, 3.0);
                    let clear = walls[wall].project(&start).distance > RADIUS + 0.01;
                    clear.then_some((start, from))
                });
                let (start, from) = start.expect("there is room around a wall");
                positions.push(start);
                velocities.push(from * -speed);
                balls.push((first, None));
            }
        }
    }
    let mut world = base;
    world["agents"] = json!([{
        "radius": RADIUS,
        "positions": { "explicit": positions.iter().map(list).collect::<Vec<_>>() },
        "velocities": { "explicit": velocities.iter().map(list).collect::<Vec<_>>() }
    }]);
    let world = World::<D>::new("shots", spec(world)).expect("sound");
    let mut flock = Flock::new(build(&world));
    let mut bodies = Bodies::new(&world, &mut flock).expect("finite");
    let (mut touched, mut passed) = (vec![false; LANES], vec![false; LANES]);
    for _ in 0..40 {
        let before = bodies.snapshot().positions.to_vec();
        let poses: Vec<_> = bodies
            .snapshot()
            .obstacles
            .iter()
            .map(|it| it.pose.clone())
            .collect();
        bodies.step(&mut flock).expect("finite");
        let now = bodies.snapshot();
        for touch in bodies.touches() {
            let lane = (touch.position[1] / APART).round() as usize;
            touched[lane.min(LANES - 1)] = true;
        }
        for lane in 0..LANES {
            let (ball, other) = balls[lane];
            let here = &now.positions[ball];
            let gap = match (other, wall_of[lane]) {
                (Some(other), _) => (now.positions[other] - here).norm() - 2.0 * RADIUS,
                (None, Some(wall)) => now.obstacles[wall].project(here).distance - RADIUS,
                (None, None) => unreachable!("every lane has a target"),
            };
            score.deepest = score.deepest.max(-gap);
            passed[lane] |= match (other, wall_of[lane]) {
                (Some(other), _) => {
                    let (a, b) = (
                        before[other] - before[ball],
                        now.positions[other] - now.positions[ball],
                    );
                    let way = b - a;
                    let t = (-a.dot(&way) / way.norm_squared().max(1e-300)).clamp(0.0, 1.0);
                    (a + way * t).norm() < RADIUS
                }
                (None, Some(wall)) => {
                    let from = poses[wall].point_to_local(&before[ball]);
                    let to = now.obstacles[wall]
                        .pose
                        .point_to_local(&now.positions[ball]);
                    pieces(&now.obstacles[wall])
                        .iter()
                        .any(|piece| crosses(&from, &to, piece))
                }
                (None, None) => unreachable!("every lane has a target"),
            };
        }
    }
    score.shots += LANES;
    score.hits += touched.iter().filter(|&&it| it).count();
    for lane in (0..LANES).filter(|&lane| passed[lane]) {
        let wall = wall_of[lane].map(|wall| &world.spec.obstacles[wall]);
        let moves = wall.and_then(|wall| wall.motion.as_ref());
        score.passed.push(format!(
            "{D}-D, seed {seed}, lane {lane}, kind {}, restitution {restitution}, {iterations} iterations, {moves:?}",
            kinds[lane]
        ));
    }
}

fn shoot(worlds: u64, fastest: f64) -> Score {
    let mut score = Score {
        shots: 0,
        hits: 0,
        passed: Vec::new(),
        deepest: 0.0,
    };
    for seed in 0..worlds / 2 {
        fly::<2>(seed, fastest, &mut score);
        fly::<3>(seed, fastest, &mut score);
    }
    score
}

#[test]
fn ten_thousand_shots_pass_nothing() {
    // Beyond, walls would turn faster than a world may ask for.
    for fastest in [50.0, 150.0] {
        let score = shoot(200, fastest);
        assert_eq!(score.shots, 10_000);
        // Most are aimed well; the rest pass by a rim that moves away.
        assert!(score.hits > 7_000, "only {} hit", score.hits);
        // Nothing even gets far in. Without foresight, balls do by up to a radius.
        assert!(score.deepest < 0.6 * RADIUS, "{} deep", score.deepest);
        assert!(
            score.passed.is_empty(),
            "{fastest}: {}: {:#?}",
            score.passed.len(),
            &score.passed[..score.passed.len().min(30)]
        );
    }
}
