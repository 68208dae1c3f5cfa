//! A world and the same world times a power of two move alike, to the last bit.

use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::math::Vector;
use volary::shape::In;

use crate::common::Dice;
use crate::{list, run};

/// Fields that are lengths, or lengths over powers of time.
const LENGTHS: [&str; 15] = [
    "radius",
    "half_length",
    "half_extents",
    "points",
    "position",
    "explicit",
    "common",
    "gravity",
    "from",
    "to",
    "vertices",
    "heights",
    "width",
    "depth",
    "velocity",
];

/// A world with all its lengths times a number.
fn scaled(value: &Value, by: f64, is_length: bool) -> Value {
    match value {
        Value::Object(fields) => fields
            .iter()
            .map(|(name, field)| {
                let is_length = is_length || LENGTHS.contains(&name.as_str());
                (
                    name.clone(),
                    scaled(field, by, is_length && name != "triangles"),
                )
            })
            .collect(),
        Value::Array(items) => items.iter().map(|it| scaled(it, by, is_length)).collect(),
        Value::Number(number) if is_length => json!(number.as_f64().expect("finite") * by),
        other => other.clone(),
    }
}

/// Bodies that fall on each other, among walls.
fn pile<const D: usize>(shape: &Value, restitution: f64, steered: bool) -> Value {
    let mut dice = Dice(11);
    let up = D - 1;
    let mut down = vec![0.0; D];
    down[up] = -10.0;
    let places: Vec<_> = (0..12)
        .map(|k| {
            let mut at = dice.vector::<D>(-0.1, 0.1);
            at[0] += 1.5 * (f64::from(k % 4) - 1.5);
            at[up] += 1.2 + 1.5 * f64::from(k / 4);
            list(&at)
        })
        .collect();
    let velocities: Vec<_> = (0..12)
        .map(|_| list(&dice.vector::<D>(-3.0, 3.0)))
        .collect();
    let walls = match D {
        2 => json!([
            { "shape": { "polyline": { "points": [[-4, 6], [-3.5, 0], [0, 0.3], [3.5, 0], [4, 6]] } } },
            { "shape": { "convex": { "points": [[0, 0], [1, 0.2], [0.4, 0.9]] } }, "position": [-0.4, 0.4] }
        ]),
        _ => json!([
            { "shape": { "half_space": { "normal": [0.1, 0, 1] } } },
            { "shape": { "mesh": {
                "vertices": [[-3, -3, 0.2], [3, -3, 0.1], [3, 3, 0.3], [-3, 3, 0.1]],
                "triangles": [[0, 1, 2], [0, 2, 3]]
            } } },
            { "shape": { "cuboid": { "half_extents": [0.3, 4, 4] } }, "position": [3.4, 0, 4] }
        ]),
    };
    let mut group = json!({
        "mass": 1.5,
        "positions": { "explicit": places }, "velocities": { "explicit": velocities }
    });
    for (name, value) in shape.as_object().expect("fields of a group") {
        group[name] = value.clone();
    }
    if group.get("shape").is_some() {
        group["heading"] = json!("free");
    }
    let mut along = vec![0.0; D];
    along[0] = 2.0;
    json!({
        "dimension": D, "time": { "end": 1 },
        "physics": { "restitution": restitution, "friction": 0.3, "gravity": down },
        "agents": [group], "obstacles": walls,
        "laws": if steered { json!([{ "navigation": { "velocity": along, "velocity_gain": 1, "feedback": "linear" } }]) } else { json!([]) }
    })
}

fn check<const D: usize>(shapes: &[Value])
where
    In<D>: Engine<D>,
{
    for shape in shapes {
        for (restitution, steered) in [(0.0, false), (0.7, true)] {
            let base = pile::<D>(shape, restitution, steered);
            let whole = run::<D>(base.clone(), 100);
            assert!(whole.touches.len() > 20, "{shape}: {}", whole.touches.len());
            for power in [-40, -1, 30] {
                let by = f64::from(power).exp2();
                let ran = run::<D>(scaled(&base, by, false), 100);
                let what = format!("{D}-D, {shape}, restitution {restitution}, times 2^{power}");
                let same =
                    |a: &[Vector<D>], b: &[Vector<D>]| a.iter().zip(b).all(|(a, b)| a * by == *b);
                assert!(same(&whole.positions, &ran.positions), "{what}: positions");
                assert!(
                    same(&whole.velocities, &ran.velocities),
                    "{what}: velocities"
                );
                assert_eq!(whole.spins, ran.spins, "{what}");
                assert_eq!(whole.touches.len(), ran.touches.len(), "{what}");
                for (one, other) in whole.touches.iter().zip(&ran.touches) {
                    assert_eq!(
                        (one.agent, one.touched),
                        (other.agent, other.touched),
                        "{what}"
                    );
                    assert_eq!(one.time, other.time, "{what}");
                    let [a, b] = [one, other].map(|it| [it.gap, it.blow, it.press, it.friction]);
                    assert_eq!(a.map(|it| it * by), b, "{what}");
                }
            }
        }
    }
}

#[test]
fn in_the_plane() {
    check::<2>(&[
        json!({ "radius": 0.4 }),
        json!({ "shape": { "capsule": { "half_length": 0.4, "radius": 0.2 } } }),
        json!({ "shape": { "cuboid": { "half_extents": [0.5, 0.3] } } }),
        json!({ "shape": { "convex": { "points": [[-0.5, -0.4], [0.6, -0.3], [0.1, 0.5], [-0.3, 0.4]] } } }),
    ]);
}

#[test]
fn in_space() {
    check::<3>(&[
        json!({ "radius": 0.4 }),
        json!({ "shape": { "capsule": { "half_length": 0.4, "radius": 0.2 } } }),
        json!({ "shape": { "cuboid": { "half_extents": [0.5, 0.3, 0.2] } } }),
        json!({ "shape": { "convex": { "points": [
            [-0.5, -0.4, 0], [0.6, -0.3, 0.1], [0.1, 0.5, 0], [-0.3, 0.4, 0.3], [0, 0, -0.4]
        ] } } }),
    ]);
}
