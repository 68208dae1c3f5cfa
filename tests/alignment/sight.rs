//! Lines of sight against geometry of our own.

use serde_json::json;
use volary::law::{Flock, State};
use volary::math::{Matrix, Vector, axis};
use volary::shape::{Geometry, In, Pose};
use volary::world::World;

use crate::common::{headings, least, state};
use crate::scene::{Dice, law, probe, world};

/// Balls, rods and boxes, a ball and a box as obstacles, under one law.
fn crowd<const D: usize>(law: serde_json::Value, half: &Vector<D>) -> World<D>
where
    In<D>: Geometry<D>,
{
    let row = |first: usize, count: usize| -> Vec<Vec<f64>> {
        let place = |k: usize| {
            (axis::<D>(0) * (100.0 + 10.0 * k as f64))
                .as_slice()
                .to_vec()
        };
        (first..first + count).map(place).collect()
    };
    let group = |shape: serde_json::Value, first: usize| json!({ "shape": shape, "positions": { "explicit": row(first, 7) } });
    let more = json!({
        "agents": [
            group(json!({ "ball": { "radius": 0.3 } }), 0),
            group(json!({ "capsule": { "half_length": 1.2, "radius": 0.2 } }), 7),
            group(json!({ "cuboid": { "half_extents": half.as_slice() } }), 14),
        ],
        "obstacles": [
            { "shape": { "ball": { "radius": 1.1 } }, "position": (axis::<D>(0) * 3.0).as_slice() },
            {
                "shape": { "cuboid": { "half_extents": vec![0.8; D] } },
                "position": (axis::<D>(1) * 5.0).as_slice()
            }
        ]
    });
    world(&[1.0], law, more)
}

fn what_stands_between_counts<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let half: Vector<D> = Vector::from_fn(|k, _| [1.1, 0.3, 0.5][k]);
    let mut dice = Dice(11 + D as u64);
    let (mut clear, mut several, mut spared) = (0, 0, 0);
    for round in 0..4 {
        let (bodies, obstacles) = [(0.5, 0.25), (0.5, 1.0), (1.0, 0.25), (0.0, 0.25)][round];
        let law_of_file = json!({ "line_of_sight": { "agents": bodies, "obstacles": obstacles } });
        let world = crowd(law_of_file, &half);
        let n = world.agents.len();
        let (x, v) = (
            dice.vectors::<D>(n, 0.0, 7.0),
            dice.vectors::<D>(n, -1.0, 1.0),
        );
        let turn = |_| std::array::from_fn(|_| dice.between(-2.0, 2.0));
        let turns: Vec<[f64; 3]> = (0..n).map(turn).collect();
        let rotation = |turn| *Pose::<D>::new(Vector::zeros(), turn).rotation();
        let rotations: Vec<Matrix<D>> = turns.into_iter().map(rotation).collect();
        let headings = headings(&v);
        let state = State {
            rotations: &rotations,
            ..state(&world, 0.0, &x, &v, &headings)
        };
        let body = |k: usize, at: &Vector<D>| {
            let local = rotations[k].tr_mul(&(at - x[k]));
            match world.agents.group[k] {
                0 => local.norm() - 0.3,
                1 => (local - axis::<D>(0) * local[0].clamp(-1.2, 1.2)).norm() - 0.2,
                _ => (local.abs() - half).max(),
            }
        };
        let obstacle = |k: usize, at: &Vector<D>| match k {
            0 => (at - axis::<D>(0) * 3.0).norm() - 1.1,
            _ => (at - axis::<D>(1) * 5.0).abs().max() - 0.8,
        };
        let (_, rows) = probe(law(&world), &state);
        let mut blocked = Vec::new();
        for i in 0..n {
            for j in (0..n).filter(|&j| j != i) {
                let third = (0..n).filter(|&k| k != i && k != j);
                let gaps: Vec<f64> = third
                    .map(|k| least(&x[i], &x[j], |at| body(k, at)))
                    .filter(|_| bodies < 1.0)
                    .collect();
                let walls: Vec<f64> = (0..2)
                    .map(|k| least(&x[i], &x[j], |at| obstacle(k, at)))
                    .filter(|_| obstacles < 1.0)
                    .collect();
                let in_doubt = |gap: &f64| gap.abs() < 1e-6;
                assert!(
                    !gaps.iter().chain(&walls).any(in_doubt),
                    "choose another seed"
                );
                let count = |gaps: &[f64]| gaps.iter().filter(|&&gap| gap < 0.0).count() as i32;
                let (by_bodies, by_walls) = (count(&gaps), count(&walls));
                let expected = f64::powi(bodies, by_bodies) * f64::powi(obstacles, by_walls);
                let (row, _) = rows[i].as_ref().expect("it acts on all");
                assert_eq!(row[j], expected, "round {round}: {i} {j}");
                if by_bodies + by_walls > 0 {
                    blocked.push([i, j]);
                }
                clear += usize::from(by_bodies + by_walls == 0);
                several += usize::from(by_bodies > 1);
                // Hit the ball about a body, but not the body.
                let balls = (0..n).filter(|&k| k != i && k != j).filter(|&k| {
                    let gap = |at: &Vector<D>| (at - x[k]).norm() - world.agents.radius[k];
                    least(&x[i], &x[j], gap) < 0.0
                });
                spared += usize::from(bodies < 1.0 && balls.count() as i32 > by_bodies);
            }
        }
        assert_eq!(Flock::of_world(&world, Vec::new()).blocked(&state), blocked);
    }
    assert!(
        clear > 100 && several > 20 && spared > 50,
        "{clear} {several} {spared}"
    );
}

#[test]
fn bodies_and_obstacles_between_two_agents_count_by_their_shapes() {
    what_stands_between_counts::<2>();
    what_stands_between_counts::<3>();
}

#[test]
fn only_laws_that_look_have_blocked_lines() {
    let x: Vec<Vector<2>> = (0..4)
        .map(|k| Vector::<2>::new(f64::from(k), 0.0))
        .collect();
    let v = vec![Vector::<2>::zeros(); 4];
    let blocked = |file: serde_json::Value| {
        let world = world::<2>(&[1.0; 4], file, json!({}));
        let headings = headings(&v);
        Flock::of_world(&world, Vec::new()).blocked(&state(&world, 0.0, &x, &v, &headings))
    };
    assert_eq!(blocked(json!({})), Vec::<[usize; 2]>::new());
    let sight = json!({ "agents": 0.5 });
    let all = [[0, 2], [0, 3], [1, 3], [2, 0], [3, 0], [3, 1]];
    assert_eq!(blocked(json!({ "line_of_sight": sight })), all);
    // Lines along which there is no influence to block are not looked along.
    let near = json!({ "line_of_sight": sight, "range": 2.5 });
    assert_eq!(blocked(near), [[0, 2], [1, 3], [2, 0], [3, 1]]);
    let matrix = json!({ "matrix": [[0, 0, 1, 0], [0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]] });
    assert_eq!(
        blocked(json!({ "line_of_sight": sight, "graph": matrix })),
        [[0, 2]]
    );
    let obstacles_only = json!({ "line_of_sight": { "obstacles": 0 } });
    assert_eq!(blocked(obstacles_only), Vec::<[usize; 2]>::new());
}
