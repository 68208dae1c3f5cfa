//! Walls in many pieces act as the wall that they form.

use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::Vector;
use volary::shape::{In, Pose};

use crate::{list, run};

/// Where a wall stands: turned about the origin, and whether it moves along itself.
struct Stand<const D: usize> {
    pose: Pose<D>,
    drifts: bool,
}

impl<const D: usize> Stand<D> {
    fn new(turn: [f64; 3], drifts: bool) -> Self {
        let pose = Pose::new(Vector::zeros(), turn);
        Self { pose, drifts }
    }

    fn turn(&self) -> Value {
        match D {
            2 => json!(self.pose.turn()[2]),
            _ => json!(self.pose.turn()),
        }
    }

    /// An obstacle whose shape is given in the wall's frame.
    fn obstacle(&self, shape: Value, at: Vector<D>) -> Value {
        let mut obstacle = json!({
            "shape": shape, "rotation": self.turn(),
            "position": list(&self.pose.point_to_world(&at))
        });
        if self.drifts {
            let along = point::<D>(0.7, 0.0, 0.0);
            let velocity = list(&self.pose.vector_to_world(&along));
            obstacle["motion"] = json!({ "drift": { "velocity": velocity } });
        }
        obstacle
    }
}

/// A place along the wall, across it (in space), and above it.
fn point<const D: usize>(along: f64, across: f64, above: f64) -> Vector<D> {
    Vector::from_fn(|k, _| match k {
        0 => along,
        _ if k == D - 1 => above,
        _ => across,
    })
}

/// The kinds of walls, and whether they have no thickness.
fn kinds(dimension: usize) -> &'static [(&'static str, bool)] {
    match dimension {
        2 => &[
            ("polyline", true),
            ("segments", true),
            ("boxes", false),
            ("compound", false),
            ("mesh", false),
            ("heightfield", true),
            ("corridor", true),
        ],
        _ => &[
            ("mesh", true),
            ("triangles", true),
            ("boxes", false),
            ("compound", false),
            ("heightfield", true),
        ],
    }
}

/// A flat wall from −10 to 10 (and in space from −3 to 3 across) whose surface goes through the
/// origin, as obstacles of some kind, in a number of pieces.
fn wall<const D: usize>(kind: &str, pieces: usize, stand: &Stand<D>) -> Value {
    let origin = Vector::<D>::zeros();
    let rows = if D == 3 && pieces >= 24 { 2 } else { 1 };
    let x = |k: usize, of: usize| -10.0 + 20.0 * k as f64 / of as f64;
    let y = |k: usize| -3.0 + 6.0 * k as f64 / rows as f64;
    let line = || -> Vec<_> {
        (0..=pieces)
            .map(|k| list(&point::<D>(x(k, pieces), 0.0, 0.0)))
            .collect()
    };
    // Corners of the triangles that a wall in space is made of.
    let columns = (pieces / 2 / rows).max(1);
    let corner = |i: usize, j: usize| list(&point::<D>(x(i, columns), y(j), 0.0));
    let halves = |i: usize, j: usize| {
        [
            [(i, j), (i + 1, j), (i + 1, j + 1)],
            [(i, j), (i + 1, j + 1), (i, j + 1)],
        ]
    };
    let cells = || (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j)));
    // Boxes side by side, one thick.
    let beams = (pieces / rows).max(1);
    let half = point::<D>(10.0 / beams as f64, 3.0 / rows as f64, 1.0);
    let boxes = || {
        (0..beams).flat_map(move |i| {
            (0..rows)
                .map(move |j| point::<D>(x(i, beams) + half[0], y(j) + 3.0 / rows as f64, -1.0))
        })
    };
    let cuboid = json!({ "cuboid": { "half_extents": list(&half) } });
    let one = |shape: Value| json!([stand.obstacle(shape, origin)]);
    match (kind, D) {
        ("polyline", _) => {
            // Turned by its points: joints are then straight to rounding only.
            let points: Vec<_> = (0..=pieces)
                .map(|k| {
                    list(
                        &stand
                            .pose
                            .point_to_world(&point::<D>(x(k, pieces), 0.0, 0.0)),
                    )
                })
                .collect();
            let mut obstacle = stand.obstacle(json!({ "polyline": { "points": points } }), origin);
            obstacle.as_object_mut().expect("fields").remove("rotation");
            json!([obstacle])
        }
        ("segments", _) => line()
            .windows(2)
            .map(|ends| {
                stand.obstacle(
                    json!({ "segment": { "from": ends[0], "to": ends[1] } }),
                    origin,
                )
            })
            .collect(),
        ("boxes", _) => boxes()
            .map(|at| stand.obstacle(cuboid.clone(), at))
            .collect(),
        ("compound", _) => {
            let parts: Vec<_> = boxes()
                .map(|at| json!({ "shape": cuboid, "position": list(&at) }))
                .collect();
            one(json!({ "compound": { "parts": parts } }))
        }
        ("corridor", _) => {
            let points: Vec<_> = (0..=pieces)
                .map(|k| list(&point::<D>(x(k, pieces), 0.0, 5.0)))
                .collect();
            one(json!({ "corridor": { "points": points, "width": 10 } }))
        }
        ("heightfield", 2) => {
            one(json!({ "heightfield": { "width": 20, "heights": vec![0.0; pieces + 1] } }))
        }
        ("heightfield", _) => {
            let heights = vec![vec![0.0; columns + 1]; rows + 1];
            one(json!({ "heightfield": { "width": 20, "depth": 6, "heights": heights } }))
        }
        ("mesh", 2) => {
            // A strip of triangles, one thick.
            let upper = line();
            let lower: Vec<_> = (0..=pieces)
                .map(|k| list(&point::<D>(x(k, pieces), 0.0, -1.0)))
                .collect();
            let vertices: Vec<_> = upper.into_iter().chain(lower).collect();
            let below = pieces + 1;
            let triangles: Vec<_> = (0..pieces)
                .flat_map(|k| [[k, below + k, k + 1], [k + 1, below + k, below + k + 1]])
                .collect();
            one(json!({ "mesh": { "vertices": vertices, "triangles": triangles } }))
        }
        ("mesh", _) => {
            let vertices: Vec<_> = (0..=columns)
                .flat_map(|i| (0..=rows).map(move |j| (i, j)))
                .map(|(i, j)| corner(i, j))
                .collect();
            let index = |(i, j): (usize, usize)| i * (rows + 1) + j;
            let triangles: Vec<_> = cells()
                .flat_map(|(i, j)| halves(i, j).map(|it| it.map(index)))
                .collect();
            one(json!({ "mesh": { "vertices": vertices, "triangles": triangles } }))
        }
        ("triangles", _) => cells()
            .flat_map(|(i, j)| halves(i, j))
            .map(|it| {
                let points = it.map(|(i, j)| corner(i, j));
                stand.obstacle(json!({ "triangle": { "points": points } }), origin)
            })
            .collect(),
        _ => unreachable!("{kind}"),
    }
}

/// How a body comes to a wall.
#[derive(Debug, Clone, Copy)]
struct Coming {
    gap: f64,
    /// Velocity along the wall and down to it, and the gravity that presses it.
    along: f64,
    down: f64,
    press: f64,
    restitution: f64,
    /// 1 from above, −1 from below.
    side: f64,
}

/// Where a body ends and how fast it is, in the wall's frame, and how often it was struck.
fn slide<const D: usize>(
    body: &Value,
    obstacles: Value,
    stand: &Stand<D>,
    coming: Coming,
) -> (Vector<D>, Vector<D>, usize)
where
    In<D>: Engine<D>,
{
    let Coming {
        gap,
        along,
        down,
        press,
        restitution,
        side,
    } = coming;
    let world = |v: Vector<D>| list(&stand.pose.vector_to_world(&v));
    let mut group = body.clone();
    group["positions"] = json!({ "explicit": [world(point(-4.0, 0.1, side * (0.5 + gap)))] });
    group["velocities"] = json!({ "explicit": [world(point(along, 0.3, -side * down))] });
    if group.get("shape").is_some() {
        group["rotation"] = stand.turn();
    }
    let ran = run::<D>(
        json!({
            "dimension": D, "time": { "end": 2 },
            "physics": { "restitution": restitution, "gravity": world(point(0.0, 0.0, -side * press)) },
            "agents": [group], "obstacles": obstacles
        }),
        150,
    );
    let back = |v: &Vector<D>| stand.pose.vector_to_local(v);
    // Obstacles that lie flush are each struck, at one time.
    let mut times: Vec<f64> = ran.blows().iter().map(|blow| blow.time).collect();
    times.dedup_by(|next, kept| (*next - *kept).abs() < 1e-9);
    (
        back(&ran.positions[0]),
        back(&ran.velocities[0]),
        times.len(),
    )
}

fn check<const D: usize>(body: Value)
where
    In<D>: Engine<D>,
{
    let cases = [
        // Along the wall, hovering, pressed, and obliquely down to it.
        (0.0, 5.0, 0.0, 0.0, 0.0),
        (0.01, 5.0, 0.0, 0.0, 0.0),
        (0.1, 5.0, 0.0, 0.0, 0.0),
        (0.0, 5.0, 0.0, 10.0, 0.0),
        (0.3, 3.0, 1.0, 0.0, 1.0),
        (0.5, 4.0, 1.0, 5.0, 0.5),
    ];
    let stands = [
        ([0.0; 3], false),
        ([0.3, -0.2, 0.3], false),
        ([0.7, 1.1, 2.9], true),
    ];
    for (turn, drifts) in stands {
        let stand = Stand::<D>::new(turn, drifts);
        for (gap, along, down, press, restitution) in cases {
            let from = |side: f64| Coming {
                gap,
                along,
                down,
                press,
                restitution,
                side,
            };
            let whole = slide(&body, wall("boxes", 1, &stand), &stand, from(1.0));
            for (kind, thin) in kinds(D) {
                for pieces in [2, 24, 480] {
                    // Many pieces take their time: of one stand they must do.
                    if pieces == 480 && (drifts || turn == [0.0; 3]) {
                        continue;
                    }
                    // From below walls without thickness are the same.
                    let below = *thin && pieces == 24 && *kind != "corridor";
                    let sides: &[f64] = if below { &[1.0, -1.0] } else { &[1.0] };
                    for &side in sides {
                        let obstacles = wall(kind, pieces, &stand);
                        let coming = from(side);
                        let mut found = slide(&body, obstacles, &stand, coming);
                        found.0[D - 1] *= side;
                        found.1[D - 1] *= side;
                        let off = (found.0 - whole.0).norm().max((found.1 - whole.1).norm());
                        let what =
                            format!("{D}-D, {body} at {kind} in {pieces}, {turn:?}, {coming:?}");
                        assert!(off < 1e-9, "{what}: off by {off}, {found:?} for {whole:?}");
                        assert_eq!(found.2, whole.2, "{what}: blows");
                    }
                }
            }
        }
    }
}

#[test]
fn balls_do_not_feel_joints() {
    check::<2>(json!({ "radius": 0.5 }));
    check::<3>(json!({ "radius": 0.5 }));
}

#[test]
fn boxes_do_not_feel_joints() {
    check::<2>(
        json!({ "shape": { "cuboid": { "half_extents": [0.5, 0.5] } }, "heading": "fixed" }),
    );
    check::<3>(json!({
        "shape": { "cuboid": { "half_extents": [0.6, 0.4, 0.5] } }, "heading": "fixed"
    }));
}

#[test]
fn rods_do_not_feel_joints() {
    let rod =
        json!({ "shape": { "capsule": { "half_length": 1, "radius": 0.5 } }, "heading": "fixed" });
    check::<2>(rod.clone());
    check::<3>(rod);
}

#[test]
fn true_corners_do_push() {
    // A step of 0.25 up, met by a disk that slides along the floor.
    let world = json!({
        "dimension": 2, "time": { "end": 1 }, "physics": { "restitution": 1 },
        "agents": [{ "radius": 0.5, "positions": { "explicit": [[-2, 0.5]] },
                     "velocities": { "explicit": [[5, 0]] } }],
        "obstacles": [{ "shape": { "polyline": {
            "points": [[-10, 0], [0, 0], [0, 0.25], [10, 0.25]]
        } } }]
    });
    let ran = run::<2>(world, 60);
    // At the corner the normal is at 30° above the floor: the centre is 0.25 above the corner.
    let blow = ran.blows()[0].clone();
    assert!(
        (blow.normal - Vector::<2>::new(0.75f64.sqrt(), -0.5)).norm() < 1e-9,
        "{blow:?}"
    );
    assert!(
        (blow.time - (2.0 - 0.5 * 0.75f64.sqrt()) / 5.0).abs() < 1e-9,
        "{blow:?}"
    );
}
