//! `volary reduce`.

use serde_json::{Value, json};

use crate::scene::Scene;

fn world() -> Value {
    json!({
        "dimension": 2, "time": { "end": 1 }, "record": { "every": 0.25 },
        "agents": [{
            "radius": 0.1, "positions": { "explicit": [[0, 0], [1, 0], [0, 2]] },
            "velocities": { "explicit": [[1, 0], [0, 1], [0, 0]] }
        }],
        "laws": [
            { "alignment": {
                "normalisation": "motsch_tadmor", "epsilon": 0.01,
                "kernel": { "cucker_smale": { "strength": 1, "length": 1, "exponent": 0.5 } }
            } },
            { "steering": { "acceleration": [1, 0] } }
        ]
    })
}

#[test]
fn prints_the_model_for_people_and_for_programs() {
    let scene = Scene::with(&world());
    let text = scene.succeeds("reduce w.json");
    for says in [
        "v^f(0) ",
        "v^f(0) as printed",
        "(4.23)",
        "(4.25)",
        "weight of each agent",
    ] {
        assert!(text.contains(says), "{says}: {text}");
    }
    let object: Value = serde_json::from_str(&scene.succeeds("reduce w.json --json")).unwrap();
    let weights: Vec<f64> = serde_json::from_value(object["weights"].clone()).unwrap();
    assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    // The gain is constant, so both starts are Σπv.
    for start in ["start", "printed_start"] {
        let start: Vec<f64> = serde_json::from_value(object[start].clone()).unwrap();
        assert!((start[0] - weights[0]).abs() < 1e-9 && (start[1] - weights[1]).abs() < 1e-9);
    }
    for matrix in ["influences", "rates"] {
        let rows: Vec<Vec<f64>> = serde_json::from_value(object[matrix].clone()).unwrap();
        let sum = if matrix == "rates" { 0.0 } else { 1.0 };
        assert!(
            rows.iter()
                .all(|row| (row.iter().sum::<f64>() - sum).abs() < 1e-12)
        );
    }
    assert_eq!(scene.names(), ["w.json"]);
}

#[test]
fn writes_the_leading_order_and_overwrites_only_when_told_to() {
    let scene = Scene::with(&world());
    scene.succeeds("reduce w.json --out leading.jsonl");
    let text = String::from_utf8(scene.bytes("leading.jsonl")).unwrap();
    let lines: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let times: Vec<&Value> = lines.iter().map(|line| &line["time"]).collect();
    assert_eq!(json!(times), json!([0.0, 0.25, 0.5, 0.75, 1.0]));
    let (first, last) = (&lines[0], &lines[4]);
    let faster = last["velocity"][0].as_f64().unwrap() - first["velocity"][0].as_f64().unwrap();
    assert!((faster - 1.0).abs() < 1e-9);
    assert_eq!(
        first["positions"],
        json!([[0.0, 0.0], [1.0, 0.0], [0.0, 2.0]])
    );
    scene.fails(
        "reduce w.json --out leading.jsonl",
        2,
        &["leading.jsonl", "--force"],
    );
    scene.succeeds("reduce w.json --out leading.jsonl --force --set record.every=0.5");
    assert!(scene.bytes("leading.jsonl").len() < text.len());
    scene.fails(
        "reduce w.json --out w.json --force",
        2,
        &["overwrite the world"],
    );

    scene.succeeds("reduce w.json --out leading.csv");
    let table = String::from_utf8(scene.bytes("leading.csv")).unwrap();
    let mut rows = table.lines();
    assert_eq!(rows.next(), Some("time,vx,vy,x0,y0,x1,y1,x2,y2"));
    assert_eq!(rows.clone().count(), 5);
    let fields: Vec<Vec<f64>> = rows
        .map(|row| row.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert_eq!(json!(fields[4][1]), last["velocity"][0]);
    assert_eq!(json!(fields[4][5..7]), last["positions"][1]);
}

#[test]
fn refuses_what_has_no_reduced_model() {
    let mut bad = world();
    bad["laws"] = json!([{ "steering": { "acceleration": [1, 0] } }]);
    let scene = Scene::with(&bad);
    let says = ["w.json", "one alignment law", "has 0"];
    scene.fails("reduce w.json --out leading.csv", 2, &says);
    assert_eq!(scene.names(), ["w.json"]);
    scene.fails("reduce nowhere.json", 2, &["nowhere.json"]);
    let apart = Scene::with(&world());
    let set = "--set laws[0].alignment.range=0.5";
    apart.fails(&format!("reduce w.json {set}"), 2, &["no one flock"]);
}
