//! Lines of sight against geometry of our own.

use serde_json::json;
use volary::law::State;
use volary::math::{Matrix, Vector, axis};
use volary::shape::{Geometry, In, Pose};
use volary::world::World;

use crate::common::{self, headings, least, state};
use crate::scene::{Dice, Watch, pairs, who, world};

/// A convex function that is negative inside an obstacle.
type Gap<const D: usize> = Box<dyn Fn(&Vector<D>) -> f64>;

/// Obstacles as a world file names them, and their gaps, without a line of parry's.
fn obstacles<const D: usize>(dice: &mut Dice) -> (serde_json::Value, Vec<Gap<D>>) {
    let mut list = Vec::new();
    let mut gaps: Vec<Gap<D>> = Vec::new();
    for kind in 0..5 {
        let position: Vector<D> = dice.vector(1.0, 9.0);
        let mut turn: [f64; 3] = std::array::from_fn(|_| dice.between(-1.5, 1.5));
        if kind == 3 {
            // The half-space faces the row in which the world places its agents.
            (turn[0], turn[1]) = (0.0, 0.0);
        }
        let pose = Pose::<D>::new(position, turn);
        let local = move |x: &Vector<D>| pose.point_to_local(x);
        let (shape, gap): (_, Gap<D>) = match kind {
            0 => (
                json!({ "ball": { "radius": 0.9 } }),
                Box::new(move |x| local(x).norm() - 0.9),
            ),
            1 => {
                let half: Vector<D> = dice.vector(0.2, 1.2);
                let gap = move |x: &Vector<D>| (local(x).abs() - half).max();
                (
                    json!({ "cuboid": { "half_extents": half.as_slice() } }),
                    Box::new(gap),
                )
            }
            2 => {
                let (a, b): (Vector<D>, Vector<D>) =
                    (dice.vector(-1.0, 1.0), dice.vector(-1.0, 1.0));
                let shape = json!({ "capsule": {
                    "from": a.as_slice(), "to": b.as_slice(), "radius": 0.5
                } });
                let gap = move |x: &Vector<D>| {
                    let x = local(x);
                    let t = (x - a).dot(&(b - a)) / (b - a).norm_squared();
                    (x - a - (b - a) * t.clamp(0.0, 1.0)).norm() - 0.5
                };
                (shape, Box::new(gap))
            }
            3 => {
                let normal = json!({ "half_space": { "normal": axis::<D>(0).as_slice() } });
                // Far enough out to leave most agents in the open.
                let gap = move |x: &Vector<D>| local(x)[0] + 4.0;
                (normal, Box::new(gap))
            }
            _ => {
                // The simplex between the origin's corner and the points 1.5 along the axes.
                let mut points = vec![vec![0.0; D]; D + 1];
                (0..D).for_each(|k| points[k + 1][k] = 1.5);
                let gap = move |x: &Vector<D>| {
                    let x = local(x);
                    (-x).max().max((x.sum() - 1.5) / (D as f64).sqrt())
                };
                (json!({ "convex": { "points": points } }), Box::new(gap))
            }
        };
        let position = match kind {
            3 => pose_back(&position, turn),
            _ => position,
        };
        let rotation = match D {
            2 => json!(turn[2]),
            _ => json!(turn),
        };
        list.push(json!({
            "shape": shape, "position": position.as_slice(), "rotation": rotation
        }));
        gaps.push(gap);
    }
    (json!(list), gaps)
}

/// Where a half-space stands whose plane lies 4 behind `position`.
fn pose_back<const D: usize>(position: &Vector<D>, turn: [f64; 3]) -> Vector<D> {
    Pose::<D>::new(*position, turn).point_to_world(&(axis::<D>(0) * -4.0))
}

fn sight_equals_geometry<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let mut dice = Dice(D as u64);
    let (mut seen, mut hidden) = ([0, 0], [0, 0]);
    for round in 0..12 {
        let by_obstacles = round % 3 != 0;
        let by_bodies = round % 3 != 1;
        let (list, gaps) = obstacles::<D>(&mut dice);
        let sensing = json!({
            "blocked_by": { "obstacles": by_obstacles, "bodies": by_bodies }
        });
        let world = world::<D>(
            &[(14, sensing.clone()), (8, sensing)],
            json!({ "obstacles": list }),
        );
        let n = world.agents.len();
        let (range, at) = (6.0, dice.vectors::<D>(n, 0.0, 10.0));
        let v = dice.vectors::<D>(n, -1.0, 1.0);
        let told = Watch::new(&world, range).look(&state(&world, 0.0, &at, &v, &headings(&v)));
        let mut doubtful = Vec::new();
        let mut clearance = |i: usize, j: usize| {
            let mut least_of_all = f64::INFINITY;
            if by_obstacles {
                for gap in &gaps {
                    least_of_all = least_of_all.min(least(&at[i], &at[j], gap));
                }
            }
            if by_bodies {
                for k in (0..n).filter(|&k| k != i && k != j) {
                    let gap = |x: &Vector<D>| (x - at[k]).norm() - world.agents.radius[k];
                    least_of_all = least_of_all.min(least(&at[i], &at[j], gap));
                }
            }
            if least_of_all.abs() < 1e-6 {
                doubtful.push([i, j]);
            }
            least_of_all
        };
        let mut expected = Vec::new();
        for [i, j] in pairs(n, |i, j| (at[i] - at[j]).norm() <= range) {
            let kind = usize::from(by_bodies);
            if clearance(i, j) > 0.0 {
                seen[kind] += 1;
                expected.push([i, j]);
            } else {
                hidden[kind] += 1;
            }
        }
        let mut found = who(&told);
        expected.retain(|pair| !doubtful.contains(pair));
        found.retain(|pair| !doubtful.contains(pair));
        assert_eq!(found, expected, "round {round}");
        assert!(doubtful.len() < 3);
    }
    // The scenes hide some and show some, by obstacles alone and with bodies.
    assert!(
        seen.iter().chain(&hidden).all(|&count| count > 40),
        "{seen:?} {hidden:?}"
    );
}

#[test]
fn what_stands_between_hides() {
    sight_equals_geometry::<2>();
    sight_equals_geometry::<3>();
}

/// Rods, boxes and balls as bodies in the way, now or, seen late, as they were and stood a step ago.
fn bodies_of_any_shape_hide<const D: usize>(delay: bool)
where
    In<D>: Geometry<D>,
{
    let mut dice = Dice(7 + D as u64);
    let sensing = json!({
        "blocked_by": { "bodies": true }, "delay": if delay { 0.1 } else { 0.0 }
    });
    let half: Vector<D> = Vector::from_fn(|k, _| [1.1, 0.3, 0.5][k]);
    let row = |first: usize, count: usize| -> Vec<Vec<f64>> {
        let place = |k: usize| (axis::<D>(0) * (10.0 * k as f64)).as_slice().to_vec();
        (first..first + count).map(place).collect()
    };
    let group = |shape: serde_json::Value, first: usize| {
        json!({
            "shape": shape, "sensing": sensing, "positions": { "explicit": row(first, 8) }
        })
    };
    let world: World<D> = common::world(common::spec(json!({
        "dimension": D, "time": { "step": 0.1, "end": 10 },
        "agents": [
            group(json!({ "ball": { "radius": 0.3 } }), 0),
            group(json!({ "capsule": { "half_length": 1.2, "radius": 0.2 } }), 8),
            group(json!({ "cuboid": { "half_extents": half.as_slice() } }), 16),
        ]
    })));
    let n = world.agents.len();
    let (mut seen, mut hidden, mut spared) = (0, 0, 0);
    for _ in 0..6 {
        let (at, v) = (
            dice.vectors::<D>(n, 0.0, 9.0),
            dice.vectors::<D>(n, -1.0, 1.0),
        );
        let turned = |dice: &mut Dice| -> Vec<Matrix<D>> {
            let turn = |_| std::array::from_fn(|_| dice.between(-2.0, 2.0));
            let turns: Vec<[f64; 3]> = (0..n).map(turn).collect();
            let rotation = |turn| *Pose::<D>::new(Vector::zeros(), turn).rotation();
            turns.into_iter().map(rotation).collect()
        };
        let (rotations, later) = (turned(&mut dice), turned(&mut dice));
        let mut watch = Watch::new(&world, 6.0);
        let headings = headings(&v);
        let first = State {
            rotations: &rotations,
            ..state(&world, 0.0, &at, &v, &headings)
        };
        let mut told = watch.look(&first);
        if delay {
            // All stand still but turn; who sees late sees them as they stood.
            told = watch.look(&State {
                time: 0.1,
                rotations: &later,
                ..first
            });
        }
        let gap = |k: usize, x: &Vector<D>| {
            let local = rotations[k].tr_mul(&(x - at[k]));
            match world.agents.group[k] {
                0 => local.norm() - 0.3,
                1 => {
                    let along = axis::<D>(0) * local[0].clamp(-1.2, 1.2);
                    (local - along).norm() - 0.2
                }
                _ => (local.abs() - half).max(),
            }
        };
        let mut doubtful = Vec::new();
        let mut expected = Vec::new();
        for [i, j] in pairs(n, |i, j| (at[i] - at[j]).norm() <= 6.0) {
            let others = || (0..n).filter(|&k| k != i && k != j);
            let clear = |k: usize| least(&at[i], &at[j], |x| gap(k, x));
            let clearance = others().map(clear).fold(f64::INFINITY, f64::min);
            let ball = |k: usize| {
                least(&at[i], &at[j], |x| {
                    (x - at[k]).norm() - world.agents.radius[k]
                })
            };
            if clearance.abs() < 1e-6 {
                doubtful.push([i, j]);
            } else if clearance > 0.0 {
                seen += 1;
                // Hidden, if bodies were the balls that hold them.
                spared += usize::from(others().any(|k| ball(k) < 0.0));
                expected.push([i, j]);
            } else {
                hidden += 1;
            }
        }
        let mut found = who(&told);
        found.retain(|pair| !doubtful.contains(pair));
        assert_eq!(found, expected);
    }
    assert!(
        seen > 100 && hidden > 100 && spared > 50,
        "{seen} {hidden} {spared}"
    );
}

#[test]
fn bodies_hide_by_their_shapes() {
    bodies_of_any_shape_hide::<2>(false);
    bodies_of_any_shape_hide::<3>(false);
}

#[test]
fn bodies_seen_late_hide_as_they_stood() {
    bodies_of_any_shape_hide::<2>(true);
    bodies_of_any_shape_hide::<3>(true);
}

#[test]
fn a_body_that_just_touches_the_line_hides_and_ends_do_not() {
    let sensing = json!({ "blocked_by": { "bodies": true } });
    let world = world::<2>(&[(3, sensing)], json!({}));
    let rest = vec![Vector::<2>::new(0.0, 0.0); 3];
    let look = |height: f64| {
        // Bodies of radius 0.4; those at the ends overlap nothing but their own line.
        let at = [[0.0, 0.0], [2.0, 0.0], [1.0, height]].map(Vector::<2>::from);
        let told = Watch::new(&world, 9.0).look(&state(&world, 0.0, &at, &rest, &headings(&rest)));
        who(&told).contains(&[0, 1])
    };
    assert!(!look(0.4));
    assert!(look(0.4 + 1e-9));
}

#[test]
fn an_agent_inside_an_obstacle_neither_sees_nor_is_seen() {
    let sensing = json!({ "blocked_by": { "obstacles": true } });
    for shape in [
        json!({ "ball": { "radius": 2 } }),
        json!({ "cuboid": { "half_extents": [2, 2] } }),
        json!({ "capsule": { "from": [-1, 0], "to": [1, 0], "radius": 2 } }),
        json!({ "half_space": { "normal": [1, 0] } }),
        json!({ "convex": { "points": [[-2, -2], [2, -2], [0, 3]] } }),
    ] {
        let obstacles = json!({ "obstacles": [{ "shape": shape }] });
        let world = world::<2>(&[(4, sensing.clone())], obstacles);
        let at = [[-0.5, 0.3], [-0.2, 0.1], [5.0, 0.0], [5.0, 1.0]].map(Vector::<2>::from);
        let rest = vec![Vector::<2>::zeros(); 4];
        let told = Watch::new(&world, 9.0).look(&state(&world, 0.0, &at, &rest, &headings(&rest)));
        assert_eq!(who(&told), [[2, 3], [3, 2]], "{shape}");
    }
}
