//! Walls in many pieces act as the wall that they form.

use serde_json::{Value, json};
use volary::math::Vector;

use crate::run;

/// A straight wall along the first axis from −10 to 10, turned about the origin, as obstacles of
/// some kind, in a number of pieces.
fn wall(kind: &str, pieces: usize, angle: f64) -> Value {
    let (sin, cos) = angle.sin_cos();
    let turned = |x: f64, y: f64| json!([cos * x - sin * y, sin * x + cos * y]);
    let at = |k: usize| -10.0 + 20.0 * k as f64 / pieces as f64;
    match kind {
        "polyline" => {
            let points: Vec<_> = (0..=pieces).map(|k| turned(at(k), 0.0)).collect();
            json!([{ "shape": { "polyline": { "points": points } } }])
        }
        "segments" => {
            let each = (0..pieces).map(|k| {
                json!({ "shape": { "segment": {
                "from": turned(at(k), 0.0), "to": turned(at(k + 1), 0.0)
            } } })
            });
            Value::Array(each.collect())
        }
        "boxes" => {
            let half = 10.0 / pieces as f64;
            let each = (0..pieces).map(|k| {
                json!({
                    "shape": { "cuboid": { "half_extents": [half, 1] } },
                    "position": turned(at(k) + half, -1.0), "rotation": angle
                })
            });
            Value::Array(each.collect())
        }
        _ => unreachable!(),
    }
}

/// A body above the wall, with some velocity along it and down to it, pressed with a gravity.
fn slide(
    body: &Value,
    obstacles: Value,
    angle: f64,
    (gap, along, down, press): (f64, f64, f64, f64),
    restitution: f64,
) -> (Vector<2>, Vector<2>, usize) {
    let (sin, cos) = angle.sin_cos();
    let turned = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
    let height = 0.5 + gap;
    let mut group = body.clone();
    group["positions"] = json!({ "explicit": [turned(-4.0, height)] });
    group["velocities"] = json!({ "explicit": [turned(along, -down)] });
    if group.get("shape").is_some() {
        group["rotation"] = json!(angle);
    }
    let ran = run::<2>(
        json!({
            "dimension": 2, "time": { "end": 2 },
            "physics": { "restitution": restitution, "gravity": turned(0.0, -press) },
            "agents": [group], "obstacles": obstacles
        }),
        150,
    );
    let back = |v: &Vector<2>| Vector::<2>::new(cos * v.x + sin * v.y, cos * v.y - sin * v.x);
    // Obstacles that lie flush are each struck, at one time.
    let mut times: Vec<f64> = ran.blows().iter().map(|blow| blow.time).collect();
    times.dedup_by(|next, kept| (*next - *kept).abs() < 1e-9);
    let blows = times.len();
    (back(&ran.positions[0]), back(&ran.velocities[0]), blows)
}

fn check(body: Value) {
    let cases = [
        // Along the wall, hovering, pressed, and obliquely down to it.
        ((0.0, 5.0, 0.0, 0.0), 0.0),
        ((0.01, 5.0, 0.0, 0.0), 0.0),
        ((0.1, 5.0, 0.0, 0.0), 0.0),
        ((0.0, 5.0, 0.0, 10.0), 0.0),
        ((0.3, 3.0, 1.0, 0.0), 1.0),
        ((0.5, 4.0, 1.0, 5.0), 0.5),
    ];
    for angle in [0.0, 0.3, 2.9] {
        for (how, restitution) in cases {
            let whole = slide(&body, wall("polyline", 1, angle), angle, how, restitution);
            for kind in ["polyline", "segments", "boxes"] {
                for pieces in [2, 24, 480] {
                    if pieces == 480 && kind != "polyline" {
                        continue;
                    }
                    let obstacles = wall(kind, pieces, angle);
                    let found = slide(&body, obstacles, angle, how, restitution);
                    let off = (found.0 - whole.0).norm().max((found.1 - whole.1).norm());
                    let what = format!("{body} at {kind} in {pieces}, turned {angle}, {how:?}");
                    assert!(off < 1e-9, "{what}: off by {off}, {found:?} for {whole:?}");
                    assert_eq!(found.2, whole.2, "{what}: blows");
                }
            }
        }
    }
}

#[test]
fn disks_do_not_feel_joints() {
    check(json!({ "radius": 0.5 }));
}

#[test]
fn boxes_do_not_feel_joints() {
    check(json!({ "shape": { "cuboid": { "half_extents": [0.5, 0.5] } }, "heading": "fixed" }));
}

#[test]
fn rods_do_not_feel_joints() {
    check(
        json!({ "shape": { "capsule": { "half_length": 1, "radius": 0.5 } }, "heading": "fixed" }),
    );
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
