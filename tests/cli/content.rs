//! What traces and summaries hold.

use std::fs;

use serde_json::{Value, json};
use volary::trace::record::{Contact, Frame, Outcome};
use volary::trace::{Record, TraceReader};

use crate::common;
use crate::scene::{Scene, crowd, json};

fn steps(frames: &[Frame]) -> Vec<u64> {
    frames.iter().map(|frame| frame.step).collect()
}

#[test]
fn the_header_repeats_the_run() {
    let scene = Scene::with(&crowd(3));
    let options = "--seed 9 --until 0.3 --set physics.friction=0.25";
    scene.succeeds(&format!("run w.json --quiet --trace t.jsonl {options}"));
    let text = String::from_utf8(scene.bytes("t.jsonl")).unwrap();
    let header: Value = serde_json::from_str(text.lines().next().unwrap()).unwrap();
    assert_eq!(header["record"], "header");
    assert_eq!(header["name"], "w");
    let world = &header["world"];
    for (pointer, value) in [
        ("/seed", json!(9)),
        ("/time/end", json!(0.3)),
        ("/time/step", json!(0.01)),
        ("/physics/friction", json!(0.25)),
        ("/physics/solver_iterations", json!(1)),
        ("/agents/0/mass", json!(1.0)),
        (
            "/laws/0/alpha_interaction/protocol",
            json!("smooth_weighted_damping"),
        ),
        ("/laws/0/alpha_interaction/action/repulsion", json!(5.0)),
        ("/record/every", json!(0.1)),
        ("/record/edges", json!(false)),
    ] {
        assert_eq!(world.pointer(pointer), Some(&value), "{pointer}");
    }
    assert_eq!(header["bodies"]["radius"], json!(vec![0.3; 30]));

    // Its world is a world file, and runs to the same end.
    scene.put("again.json", &world.to_string());
    scene.succeeds("run again.json --quiet --trace again.jsonl");
    assert_eq!(scene.frames("again.jsonl"), scene.frames("t.jsonl"));
}

#[test]
fn frames_come_as_sampled() {
    let scene = Scene::with(&crowd(2));
    scene.succeeds("run w.json --quiet --trace a.jsonl --until 0.25");
    let frames = scene.frames("a.jsonl");
    assert_eq!(steps(&frames), [0, 10, 20, 25]);
    for frame in &frames {
        assert!((frame.time - frame.step as f64 * 0.01).abs() < 1e-12);
        assert!(frame.metrics.is_some() && frame.edges.is_none());
        assert!(frame.accelerations.is_none() && frame.beta_agents.is_none());
    }
    scene.succeeds("run w.json --quiet --trace b.jsonl --until 0.2 --set record.every=0.05");
    assert_eq!(steps(&scene.frames("b.jsonl")), [0, 5, 10, 15, 20]);

    scene.succeeds("run w.json --quiet --trace c.jsonl --until 0 --summary c.json");
    assert_eq!(steps(&scene.frames("c.jsonl")), [0]);
    assert_eq!(scene.summary("c.jsonl").outcome, Outcome::Completed);
    assert_eq!(json(&scene.path("c.json"))["steps"], 0);
}

#[test]
fn contacts_stand_where_they_end_and_the_summary_counts_them() {
    let scene = Scene::with(&crowd(2));
    scene.succeeds("run w.json --quiet --trace t.jsonl --summary s.json");
    let mut records = scene.records("t.jsonl");
    let Some(Record::Summary(summary)) = records.pop() else {
        panic!("no summary at the end");
    };
    assert_eq!(
        json(&scene.path("s.json")),
        serde_json::to_value(&summary).unwrap()
    );
    let (mut before, mut among) = (None, 0);
    let mut contacts: Vec<Contact> = Vec::new();
    for record in records {
        match record {
            Record::Frame(frame) => {
                let late = contacts.iter().find(|contact| contact.end > frame.time);
                assert_eq!(late, None, "before the frame at {}", frame.time);
                among = contacts.len();
                before = Some(frame.time);
            }
            Record::Contact(contact) => {
                // An episode is known to be over one step after its end.
                assert!(contact.end >= before.unwrap() - 0.01 - 1e-9, "{contact:?}");
                assert!(contact.begin <= contact.end);
                contacts.push(contact);
            }
            Record::Header(_) | Record::Summary(_) => panic!("in the middle"),
        }
    }
    assert!(among > 0, "some contacts end between frames");
    let (ended, rest) = contacts.split_at(among);
    assert!(ended.iter().all(|contact| !contact.open), "{ended:?}");
    assert!(rest.iter().any(|contact| contact.open), "{rest:?}");
    for contact in rest {
        // Who was struck in the last step touched within it.
        let since = summary.time - contact.end;
        assert!((-1e-9..0.01 + 1e-9).contains(&since), "{contact:?}");
    }
    let counted = summary.agent_contacts.episodes + summary.obstacle_contacts.episodes;
    assert_eq!(contacts.len() as u64, counted);
    let largest = contacts
        .iter()
        .map(|c| c.largest_impulse)
        .fold(0.0, f64::max);
    let counts = [&summary.agent_contacts, &summary.obstacle_contacts];
    assert_eq!(
        largest,
        counts
            .map(|c| c.largest_impulse)
            .into_iter()
            .fold(0.0, f64::max)
    );
    assert!(largest > 0.0);
}

#[test]
fn accelerations_edges_and_beta_agents_are_those_of_the_run() {
    for dimension in [2, 3] {
        let world = serde_json::to_value(common::flock_world(dimension)).unwrap();
        let scene = Scene::with(&world);
        let wants =
            ["accelerations", "beta_agents", "edges"].map(|it| format!("--set record.{it}=true"));
        let wants = wants.join(" ");
        scene.succeeds(&format!(
            "run w.json --quiet --trace t.jsonl --set record.every=0.01 {wants}"
        ));
        let frames = scene.frames("t.jsonl");
        let (mut betas, mut linked) = (0, 0);
        for three in frames.windows(3) {
            let [before, now, after] = three else {
                unreachable!()
            };
            follows_the_laws(before, now, after);
            betas += beta_agents_are_projections(now, &world);
            linked += edges_join_neighbours(now);
        }
        assert!(betas > 0 && linked > 0, "{betas} β-agents, {linked} edges");
    }
}

/// Without contacts the second difference of the positions is the laws' sum.
fn follows_the_laws(before: &Frame, now: &Frame, after: &Frame) {
    let laws = now.accelerations.as_ref().unwrap();
    let names: Vec<_> = laws.iter().map(|of| of.law.as_str()).collect();
    assert_eq!(
        names,
        ["alpha_interaction", "obstacle_avoidance", "navigation"]
    );
    for i in 0..now.positions.len() {
        for k in 0..now.positions[i].len() {
            let sum: f64 = laws.iter().map(|of| of.values[i][k]).sum();
            let [a, b, c] = [before, now, after].map(|frame| frame.positions[i][k]);
            let moved = (a - 2.0 * b + c) / 1e-4;
            assert!(
                (sum - moved).abs() < 1e-8,
                "agent {i} at {}: {sum}, {moved}",
                now.time
            );
        }
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).powi(2))
        .sum::<f64>()
        .sqrt()
}

/// Every agent near the ball, and no other, has its β-agent; returns how many there are.
fn beta_agents_are_projections(frame: &Frame, world: &Value) -> usize {
    let center: Vec<f64> =
        serde_json::from_value(world["obstacles"][0]["position"].clone()).unwrap();
    let gap = |i: usize| distance(&frame.positions[i], &center) - 1.5;
    let near: Vec<_> = (0..frame.positions.len())
        .filter(|&i| gap(i) <= 4.0)
        .collect();
    let found = frame.beta_agents.as_ref().unwrap();
    assert_eq!(
        found.iter().map(|beta| beta.agent).collect::<Vec<_>>(),
        near
    );
    for beta in found {
        assert!((beta.distance - gap(beta.agent)).abs() < 1e-9);
        assert!((distance(&beta.position, &center) - 1.5).abs() < 1e-9);
    }
    found.len()
}

/// Agents are joined where they are in range, and only there; returns how many pairs are.
fn edges_join_neighbours(frame: &Frame) -> usize {
    let count = frame.positions.len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
    let near = |[i, j]: &[usize; 2]| distance(&frame.positions[*i], &frame.positions[*j]) <= 3.5;
    let mut found = frame.edges.clone().unwrap();
    found.sort_unstable();
    assert_eq!(found, pairs.filter(near).collect::<Vec<_>>());
    found.len()
}

#[test]
fn all_formats_hold_the_same() {
    let scene = Scene::with(&crowd(2));
    let (gzip, zstd) = ([0x1f, 0x8b], [0x28, 0xb5]);
    let mut all: Vec<(Value, Vec<Record>)> = Vec::new();
    for (name, magic) in [
        ("a.jsonl", *b"{\""),
        ("a.ndjson", *b"{\""),
        ("a.json", *b"[\n"),
        ("a.jsonl.gz", gzip),
        ("a.json.gz", gzip),
        ("a.jsonl.zst", zstd),
        ("a.json.zst", zstd),
    ] {
        scene.succeeds(&format!("run w.json --quiet --trace {name}"));
        assert_eq!(scene.bytes(name)[..2], magic, "{name}");
        let header = TraceReader::open(&scene.path(name))
            .unwrap()
            .header()
            .clone();
        all.push((serde_json::to_value(header).unwrap(), scene.records(name)));
    }
    assert!(all[0].1.len() > 11);
    assert!(all.iter().all(|other| other == &all[0]));
    let array = json(&scene.path("a.json"));
    let lines = fs::read_to_string(scene.path("a.jsonl")).unwrap();
    let lines = lines
        .lines()
        .map(|line| serde_json::from_str(line).unwrap());
    assert_eq!(array, Value::Array(lines.collect()));
}

#[test]
fn files_keep_to_their_schemas() {
    let scene = Scene::with(&crowd(3));
    let wants =
        "--set record.accelerations=true --set record.beta_agents=true --set record.edges=true";
    scene.succeeds(&format!(
        "run w.json --quiet --trace t.json --summary s.json {wants}"
    ));
    let validator = |name: &str| {
        let schema = scene.succeeds(&format!("schema {name}"));
        jsonschema::validator_for(&serde_json::from_str(&schema).unwrap()).unwrap()
    };
    let (trace, records) = (validator("trace"), json(&scene.path("t.json")));
    for record in records.as_array().unwrap() {
        let flaw = trace
            .validate(record)
            .err()
            .map(|e| format!("{}: {e}", e.instance_path()));
        assert_eq!(flaw, None);
        let mut broken = record.clone();
        broken["record"] = json!("nonsense");
        assert!(!trace.is_valid(&broken));
    }
    let (summary, mut written) = (validator("summary"), json(&scene.path("s.json")));
    assert!(summary.is_valid(&written));
    written["outcome"] = json!("splendid");
    assert!(!summary.is_valid(&written));
    assert!(validator("world").is_valid(&records[0]["world"]));
}
