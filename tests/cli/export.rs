//! `volary export`.

use std::fs;

use serde_json::{Value, json};
use volary::trace::Record;
use volary::trace::record::{Contact, Frame};

use crate::scene::{Scene, crowd};

/// A folder with a trace of a crowd in which everything is recorded, `t.jsonl`.
fn traced(dimension: usize) -> Scene {
    let mut world = crowd(dimension);
    world["agents"][0]["name"] = json!("a, \"b\"");
    world["record"] = json!({
        "every": 0.1, "accelerations": true, "beta_agents": true, "edges": true, "net": true,
        "links": true, "laws": true, "blocked": true
    });
    let scene = Scene::with(&world);
    scene.succeeds("run w.json --trace t.jsonl --quiet");
    scene
}

/// A table's names and rows. None of the tests' cells but the group's is quoted.
fn table(text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let text = text.replace("\"a, \"\"b\"\"\"", "GROUP");
    let mut lines = text
        .lines()
        .map(|line| -> Vec<String> { line.split(',').map(str::to_owned).collect() });
    let names = lines.next().unwrap();
    let rows: Vec<_> = lines.collect();
    assert!(rows.iter().all(|row| row.len() == names.len()));
    (names, rows)
}

fn bits<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Vec<u64> {
    numbers.into_iter().map(|number| number.to_bits()).collect()
}

/// The bits of the numbers in some cells.
fn read(cells: &[String]) -> Vec<u64> {
    let numbers = cells
        .iter()
        .map(|cell| cell.parse::<f64>().unwrap().to_bits());
    numbers.collect()
}

fn contacts(scene: &Scene) -> Vec<Contact> {
    let contact = |record| match record {
        Record::Contact(contact) => Some(contact),
        _ => None,
    };
    scene
        .records("t.jsonl")
        .into_iter()
        .filter_map(contact)
        .collect()
}

#[test]
fn agents_read_back_bit_for_bit() {
    for dimension in [2, 3] {
        let scene = traced(dimension);
        scene.succeeds("export t.jsonl -o t.csv");
        let (names, rows) = table(&String::from_utf8(scene.bytes("t.csv")).unwrap());
        let axes = &["x", "y", "z"][..dimension];
        let with = |before: &str| axes.iter().map(|axis| format!("{before}{axis}")).collect();
        let expected: Vec<Vec<String>> = vec![
            ["time", "step", "agent", "group"].map(str::to_owned).into(),
            with(""),
            with("v"),
            with("acceleration.alpha_interaction."),
            with("acceleration.obstacle_avoidance."),
            with("acceleration.navigation."),
        ];
        assert_eq!(names, expected.concat());
        let frames = scene.frames("t.jsonl");
        assert_eq!((frames.len(), rows.len()), (11, 11 * 30));
        for (frame, rows) in frames.iter().zip(rows.chunks(30)) {
            for (agent, row) in rows.iter().enumerate() {
                assert_eq!(read(&row[..1]), bits([&frame.time]));
                let who = [
                    frame.step.to_string(),
                    agent.to_string(),
                    "GROUP".to_owned(),
                ];
                assert_eq!(row[1..4], who);
                let laws = frame.accelerations.iter().flatten();
                let vectors = [&frame.positions[agent], &frame.velocities[agent]];
                let vectors = vectors
                    .into_iter()
                    .chain(laws.map(|law| &law.values[agent]));
                assert_eq!(read(&row[4..]), bits(vectors.flatten()));
            }
        }
    }
}

#[test]
fn rotations_and_moving_obstacles_are_columns_where_there_are_any() {
    let scene = Scene::new();
    let short = "--until 0.5 --set record.every=0.25 --trace t.jsonl --quiet --force";
    for (world, rotation, count) in [
        ("courses/rods", "angle", 0),
        ("courses/rotating-door", "", 1),
    ] {
        scene.succeeds(&format!("run {world} {short}"));
        let frames = scene.frames("t.jsonl");
        let (names, rows) = table(&scene.succeeds("export t.jsonl -o - --as csv"));
        assert_eq!(names[8..].concat(), rotation, "{world}");
        if !rotation.is_empty() {
            let angle = json!(frames[2].rotations.as_ref().unwrap()[39]);
            assert_eq!(json!(rows[119][8].parse::<f64>().unwrap()), angle);
        }
        let obstacles = "export t.jsonl -o - --as csv --table obstacles";
        if count == 0 {
            scene.fails(obstacles, 2, &["no obstacles that move"]);
            continue;
        }
        let (names, rows) = table(&scene.succeeds(obstacles));
        assert_eq!(names, ["time", "step", "obstacle", "x", "y", "angle"]);
        let poses = frames
            .iter()
            .flat_map(|frame| frame.obstacles.iter().flatten());
        let poses: Vec<_> = poses.collect();
        assert!(poses.len() >= 3 && poses.len() == rows.len());
        for (pose, row) in poses.iter().zip(&rows) {
            assert_eq!(row[2], pose.obstacle.to_string());
            assert_eq!(read(&row[3..5]), bits(&pose.position));
            assert_eq!(json!(row[5].parse::<f64>().unwrap()), json!(pose.rotation));
        }
    }
}

#[test]
fn the_other_tables_hold_what_the_records_hold() {
    let scene = traced(2);
    let frames = scene.frames("t.jsonl");
    let export = |name: &str| {
        table(&scene.succeeds(&format!("export t.jsonl -o - --as csv --table {name}")))
    };

    let (names, rows) = export("metrics");
    assert_eq!(rows.len(), frames.len());
    let at = |name: &str| {
        let place = names.iter().position(|known| known == name);
        rows[3][place.unwrap_or_else(|| panic!("{name}: {names:?}"))].clone()
    };
    let frame = json!(frames[3]);
    for name in [
        "metrics.density",
        "metrics.edges",
        "net.rigid",
        "net.defect",
        "laws.energy",
    ] {
        let (group, field) = name.split_once('.').unwrap();
        assert_eq!(at(name), frame[group][field].to_string(), "{name}");
    }
    assert_eq!(
        at("laws.mean_position.y"),
        frame["laws"]["mean_position"][1].to_string()
    );
    assert_eq!(at("laws.navigation.residual"), "");
    for group in ["metrics", "net"] {
        let recorded = frame[group].as_object().unwrap().len();
        let columns = names
            .iter()
            .filter(|name| name.starts_with(&format!("{group}.")));
        assert_eq!(columns.count(), recorded, "{group}");
    }

    let (names, rows) = export("contacts");
    let contacts = contacts(&scene);
    assert!(contacts.len() > 5, "{}", contacts.len());
    assert_eq!(rows.len(), contacts.len());
    for (row, contact) in rows.iter().zip(&contacts) {
        let contact = json!(contact);
        for (name, cell) in names.iter().zip(row) {
            let value = match name.as_str() {
                "x" => &contact["position"][0],
                "y" => &contact["position"][1],
                field => &contact[field],
            };
            // What is unknown is an empty cell.
            let expected = match value {
                Value::Null => String::new(),
                value => value.to_string().replace('"', ""),
            };
            assert_eq!(*cell, expected, "{name}");
        }
    }

    type Pairs = fn(&Frame) -> &Option<Vec<[usize; 2]>>;
    let tables: [(&str, Pairs); 2] = [
        ("edges", |frame| &frame.edges),
        ("links", |frame| &frame.links),
    ];
    for (name, pairs) in tables {
        let (names, rows) = export(name);
        assert_eq!(names, ["time", "step", "agent", "other"]);
        let expected = frames.iter().flat_map(|frame| {
            let pairs = pairs(frame).iter().flatten();
            pairs.map(|[a, b]| [frame.step.to_string(), a.to_string(), b.to_string()])
        });
        let expected: Vec<_> = expected.collect();
        assert!(!expected.is_empty());
        let found: Vec<_> = rows.iter().map(|row| &row[1..]).collect();
        assert_eq!(found, expected, "{name}");
    }

    let (names, rows) = export("beta-agents");
    assert_eq!(names.len(), 10);
    let betas = frames
        .iter()
        .flat_map(|frame| frame.beta_agents.iter().flatten());
    let distances: Vec<u64> = betas.map(|beta| beta.distance.to_bits()).collect();
    assert!(!distances.is_empty());
    let found: Vec<u64> = rows.iter().flat_map(|row| read(&row[9..])).collect();
    assert_eq!(found, distances);
}

#[test]
fn traces_come_back_in_the_bytes_of_the_run() {
    let scene = traced(3);
    for name in ["r.json", "r.jsonl.gz", "r.json.zst"] {
        let run = "run w.json --quiet --trace";
        scene.succeeds(&format!("{run} {name}"));
        scene.succeeds(&format!("export t.jsonl -o e{name}"));
        assert_eq!(
            scene.bytes(name),
            scene.bytes(&format!("e{name}")),
            "{name}"
        );
        scene.succeeds(&format!("export {name} -o back.ndjson --force"));
        assert_eq!(scene.bytes("back.ndjson"), scene.bytes("t.jsonl"), "{name}");
    }
    let document: Value = serde_json::from_slice(&scene.bytes("er.json")).unwrap();
    assert_eq!(
        document.as_array().unwrap().len(),
        1 + scene.records("t.jsonl").len()
    );
}

#[test]
fn tables_may_be_compressed() {
    let scene = traced(2);
    let plain = scene.succeeds("export t.jsonl -o - --as csv");
    scene.succeeds("export t.jsonl -o t.csv.gz");
    scene.succeeds("export t.jsonl -o t.csv.zst");
    let mut text = String::new();
    let file = fs::File::open(scene.path("t.csv.gz")).unwrap();
    std::io::Read::read_to_string(&mut flate2::read::GzDecoder::new(file), &mut text).unwrap();
    assert_eq!(text, plain);
    let zstd = zstd::decode_all(&scene.bytes("t.csv.zst")[..]).unwrap();
    assert_eq!(String::from_utf8(zstd).unwrap(), plain);
}

#[test]
fn frames_are_extended_xyz() {
    for dimension in [2, 3] {
        let scene = traced(dimension);
        let text = scene.succeeds("export t.jsonl -o - --as xyz --every 5");
        let frames = scene.frames("t.jsonl");
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 3 * 32);
        for (lines, frame) in lines.chunks(32).zip(frames.iter().step_by(5)) {
            assert_eq!(lines[0], "30");
            let head = format!(
                "Properties=species:S:1:pos:R:3:velo:R:3:id:I:1:radius:R:1:mass:R:1 Time={:?} \
                 Step={} pbc=\"F F F\"",
                frame.time, frame.step
            );
            assert_eq!(lines[1], head);
            for (agent, line) in lines[2..].iter().enumerate() {
                let words: Vec<&str> = line.split(' ').collect();
                assert_eq!((words[0], words.len()), ("a___b_", 10));
                let numbers: Vec<f64> = words[1..]
                    .iter()
                    .map(|word| word.parse().unwrap())
                    .collect();
                for axis in 0..3 {
                    let of =
                        |vectors: &[Vec<f64>]| vectors[agent].get(axis).copied().unwrap_or(0.0);
                    assert_eq!(numbers[axis].to_bits(), of(&frame.positions).to_bits());
                    assert_eq!(numbers[3 + axis].to_bits(), of(&frame.velocities).to_bits());
                }
                assert_eq!(numbers[6..], [agent as f64, 0.3, 1.0]);
            }
        }
    }
}

#[test]
fn a_selection_leaves_out_frames_and_contacts() {
    let scene = traced(2);
    scene.succeeds("export t.jsonl -o some.jsonl --from 0.3 --to 0.7 --every 2");
    let steps: Vec<u64> = scene
        .frames("some.jsonl")
        .iter()
        .map(|frame| frame.step)
        .collect();
    assert_eq!(steps, [30, 50, 70]);
    assert_eq!(scene.summary("some.jsonl"), scene.summary("t.jsonl"));
    let (_, rows) =
        table(&scene.succeeds("export t.jsonl -o - --as csv --table contacts --to 0.5"));
    let all = contacts(&scene);
    let early = all
        .iter()
        .filter(|contact| contact.begin <= 0.5 + 1e-9)
        .count();
    assert_eq!(rows.len(), early);
    assert!(early < all.len());

    let none = scene.volary("export t.jsonl -o none.csv --from 7");
    assert_eq!(none.code, Some(0), "{none:?}");
    assert!(none.err.contains("t.jsonl has no frame"), "{none:?}");
    assert_eq!(
        scene.bytes("none.csv"),
        b"time,step,agent,group,x,y,vx,vy\n"
    );
}

#[test]
fn a_cut_trace_is_exported_up_to_the_cut() {
    let scene = traced(2);
    let whole = scene.bytes("t.jsonl");
    fs::write(scene.path("cut.jsonl"), &whole[..whole.len() / 2]).unwrap();
    let frames = scene.frames("cut.jsonl").len();
    assert!((1..11).contains(&frames));
    for out in ["cut.csv", "cut.json", "cut.xyz.gz"] {
        let done = scene.volary(&format!("export cut.jsonl -o {out}"));
        assert_eq!((done.code, done.out.as_str()), (Some(0), ""), "{done:?}");
        for says in ["Note: cut.jsonl", "without its summary"] {
            assert!(done.err.contains(says), "{done:?}");
        }
    }
    let (_, rows) = table(&String::from_utf8(scene.bytes("cut.csv")).unwrap());
    assert_eq!(rows.len(), 30 * frames);
    // What comes out is JSON that any reader takes, and still says that it is cut.
    let document: Value = serde_json::from_slice(&scene.bytes("cut.json")).unwrap();
    let last = document.as_array().unwrap().last().unwrap();
    assert_ne!(last["record"], "summary");
    assert_eq!(scene.frames("cut.json").len(), frames);
}

#[test]
fn what_cannot_be_exported_leaves_everything_as_it_was() {
    let scene = traced(2);
    scene.succeeds("export t.jsonl -o there.csv");
    scene.put(
        "other.jsonl",
        "{\"record\":\"header\",\"format\":\"volary-trace\",\"version\":9}\n",
    );
    let text = String::from_utf8(scene.bytes("t.jsonl")).unwrap();
    let ragged = text.replacen("\"velocities\":[[", "\"velocities\":[[0.5],[", 1);
    scene.put("ragged.jsonl", &ragged);
    let mut bad: Vec<&str> = text.lines().collect();
    bad[2] = "{\"record\":\"frame\"}";
    scene.put("bad.jsonl", &bad.join("\n"));
    scene.succeeds("run w.json --quiet --trace bare.jsonl --set record.edges=false --set record.beta_agents=false");
    let before = (
        scene.names(),
        scene.bytes("there.csv"),
        scene.bytes("t.jsonl"),
    );
    for (arguments, says) in [
        (
            "t.jsonl -o there.csv",
            &["there.csv exists already", "--force"][..],
        ),
        (
            "t.jsonl -o t.jsonl --force",
            &["t.jsonl", "trace", "export", "one file"],
        ),
        ("t.jsonl -o ./t.jsonl --force", &["one file"]),
        ("t.jsonl -o t.txt", &["t.txt", ".csv, .xyz, .jsonl"]),
        ("t.jsonl -o t", &["t: ", ".csv, .xyz, .jsonl"]),
        ("t.jsonl -o -", &["--as csv"]),
        ("t.jsonl -o - --as txt", &[".txt", ".csv"]),
        (
            "t.jsonl -o no/t.csv",
            &["no/t.csv", "the folder no does not exist"],
        ),
        ("t.jsonl -o . --as csv", &["folder"]),
        ("none.jsonl -o a.csv", &["none.jsonl"]),
        ("w.json -o a.csv", &["w.json is not a trace"]),
        ("other.jsonl -o a.csv", &["other.jsonl has version 9"]),
        ("bad.jsonl -o a.csv", &["bad.jsonl, line 3"]),
        ("bad.jsonl -o a.jsonl.gz", &["bad.jsonl, line 3"]),
        (
            "ragged.jsonl -o a.csv",
            &["ragged.jsonl: the frame at step 0"],
        ),
        (
            "ragged.jsonl -o a.xyz",
            &["ragged.jsonl: the frame at step 0"],
        ),
        (
            "bare.jsonl -o a.csv --table edges",
            &["bare.jsonl records no edges", "record.edges=true"],
        ),
        (
            "bare.jsonl -o a.csv --table beta-agents",
            &["bare.jsonl records no β-agents"],
        ),
        ("t.jsonl -o a.xyz --table edges", &["--table is for .csv"]),
        ("t.jsonl -o a.csv --table egdes", &["egdes", "edges"]),
        ("t.jsonl -o a.csv --from 2 --to 1", &["--from 2", "--to 1"]),
        ("t.jsonl -o a.csv --from nan", &["nan"]),
        ("t.jsonl -o a.csv --every 0", &["--every", "1"]),
        ("t.jsonl", &["--out"]),
    ] {
        scene.fails(&format!("export {arguments}"), 2, says);
        let after = (
            scene.names(),
            scene.bytes("there.csv"),
            scene.bytes("t.jsonl"),
        );
        assert_eq!(before, after, "{arguments}");
    }
    scene.succeeds("export t.jsonl -o there.csv --force --every 2");
    assert!(scene.bytes("there.csv").len() < before.1.len());
}
