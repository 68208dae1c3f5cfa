//! `volary plot`.

use serde_json::{Value, json};

use crate::scene::Scene;

/// Two agents that track a target and come to touch.
fn world(seed: u64) -> Value {
    json!({
        "dimension": 2, "seed": seed, "time": { "end": 2 },
        "record": { "every": 0.05, "laws": true },
        "agents": [{
            "radius": 0.4, "positions": { "explicit": [[0, 0], [3, 0]] },
            "velocities": { "explicit": [[2, 0], [-2, 0]] }
        }],
        "laws": [{ "tracking": { "target": { "circle": { "center": [0, 0], "radius": 2, "angular_velocity": 1 } } } }]
    })
}

/// A folder with the traces of two runs.
fn scene() -> Scene {
    let scene = Scene::with(&world(1));
    scene.put("v.json", &world(2).to_string());
    scene.succeeds("run w.json --trace w.jsonl --quiet");
    scene.succeeds("run v.json --trace v.jsonl --quiet");
    scene
}

fn svg(scene: &Scene, arguments: &str) -> String {
    scene.succeeds(&format!("plot {arguments} -o plot.svg --force"));
    String::from_utf8(scene.bytes("plot.svg")).unwrap()
}

#[test]
fn plots_what_is_recorded_and_what_follows() {
    let scene = scene();
    let text = svg(&scene, "w.jsonl");
    for says in [
        "velocity diameter d_V",
        "agent gap",
        "contact",
        "contacts begin",
        "time",
        ">w<",
    ] {
        assert!(text.contains(says), "{says}");
    }
    let text = svg(
        &scene,
        "w.jsonl --metric target_error --metric laws[0].position_error --metric mean_speed \
         --together --level 1.5=limit --title both --from 0.5 --to 1.5",
    );
    for says in [
        "target error",
        "laws[0].position error",
        "mean speed",
        "limit",
        ">both<",
    ] {
        assert!(text.contains(says), "{says}");
    }
    assert!(!text.contains(">2<"), "nothing is shown beyond time 1.5");
    let text = svg(&scene, "w.jsonl --metric laws.total_energy");
    assert!(text.contains("J(0)"));
    let text = svg(&scene, "w.jsonl --metric d_V --log xy");
    assert!(text.contains(">1<"));
    scene.succeeds("plot w.jsonl --trajectories -o paths.png --theme dark --size 400x300");
    let png = scene.bytes("paths.png");
    assert_eq!(png[16..24], [0, 0, 1, 144, 0, 0, 1, 44]);
    let text = svg(&scene, "w.jsonl --trajectories");
    for says in [
        "(a) positions",
        "(b) velocities",
        "start",
        "end",
        "target",
        "agent 1",
    ] {
        assert!(text.contains(says), "{says}");
    }
    let text = svg(&scene, "w.jsonl --components velocities --agents 1");
    for says in ["v_x", "v_y", "target"] {
        assert!(text.contains(says), "{says}");
    }
    assert!(!text.contains("agent 0"));
}

#[test]
fn space_has_three_views() {
    let mut world = world(1);
    world["dimension"] = json!(3);
    for states in ["positions", "velocities"] {
        let list = world["agents"][0][states]["explicit"]
            .as_array_mut()
            .unwrap();
        list.iter_mut()
            .for_each(|it| it.as_array_mut().unwrap().push(json!(0.5)));
    }
    world["laws"] = json!([]);
    let scene = Scene::with(&world);
    scene.succeeds("run w.json --trace w.jsonl --quiet");
    let text = svg(&scene, "w.jsonl --trajectories");
    assert!(text.contains("(f) velocities") && text.contains("v_z"));
    let text = svg(&scene, "w.jsonl --components positions");
    assert!([">x<", ">y<", ">z<"].iter().all(|it| text.contains(it)));
    scene.put("flat.json", &self::world(1).to_string());
    scene.succeeds("run flat.json --trace flat.jsonl --quiet");
    let says = ["flat.jsonl has 2 dimensions, w.jsonl has 3"];
    scene.fails("plot w.jsonl flat.jsonl --trajectories -o a.svg", 2, &says);
}

#[test]
fn runs_are_told_apart() {
    let scene = scene();
    let text = svg(&scene, "w.jsonl v.jsonl --metric d_V");
    assert!(
        text.contains("w, seed 1") && text.contains("v, seed 2"),
        "{text}"
    );
    let text = svg(&scene, "w.jsonl w.jsonl --metric d_V");
    assert!(text.contains(">w.jsonl<"));
}

#[test]
fn lists_what_a_trace_records() {
    let scene = scene();
    let text = scene.succeeds("plot w.jsonl --list");
    for says in [
        "w.jsonl: 41 frames",
        "metrics.polarization ",
        "laws.laws[0].position_error ",
        "mean_speed ",
        "target_error ",
    ] {
        assert!(text.contains(says), "{says}: {text}");
    }
    let density = text.lines().find(|it| it.contains("metrics.density"));
    assert!(density.unwrap().ends_with("no value"), "{text}");
    // Every name listed can be plotted.
    let names = text
        .lines()
        .filter(|line| line.starts_with("  ") && !line.ends_with("no value"));
    let names: Vec<&str> = names
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(names.len() > 15, "{names:?}");
    for name in names.iter().step_by(5) {
        svg(&scene, &format!("w.jsonl --metric {name}"));
    }
}

#[test]
fn a_cut_trace_is_drawn_up_to_the_cut() {
    let scene = scene();
    let whole = String::from_utf8(scene.bytes("w.jsonl")).unwrap();
    let lines: Vec<&str> = whole.lines().collect();
    let half = &lines[12][..lines[12].len() / 2];
    scene.put("cut.jsonl", &format!("{}\n{half}", lines[..12].join("\n")));
    let done = scene.volary("plot cut.jsonl -o cut.svg");
    assert_eq!(done.code, Some(0), "{done:?}");
    assert_eq!(
        done.err,
        "Note: cut.jsonl: the trace ends at t = 0.5, without its summary\n"
    );
    assert!(scene.names().contains(&"cut.svg".to_owned()));
    assert!(
        scene
            .succeeds("plot cut.jsonl --list")
            .contains("11 frames, cut")
    );
}

#[test]
fn refuses_what_cannot_be_drawn_and_writes_nothing() {
    let scene = scene();
    scene.put("none.jsonl", "{\"record\": \"frame\"}\n");
    let header = String::from_utf8(scene.bytes("w.jsonl")).unwrap();
    let header = header.lines().next().unwrap();
    scene.put("empty.jsonl", header);
    scene.put(
        "old.jsonl",
        &header.replacen("\"version\":1", "\"version\":9", 1),
    );
    scene.put("there.svg", "old");
    let before = scene.names();
    for (arguments, says) in [
        ("none.jsonl -o a.svg", "none.jsonl is not a trace"),
        ("nowhere.jsonl -o a.svg", "cannot open nowhere.jsonl"),
        ("w.json -o a.svg", "w.json is not a trace"),
        ("old.jsonl -o a.svg", "has version 9 of the trace format"),
        ("empty.jsonl -o a.svg", "empty.jsonl: no frame at all"),
        (
            "w.jsonl -o a.svg --from 7",
            "w.jsonl: no frame from time 7 on",
        ),
        (
            "w.jsonl -o a.svg --from 2 --to 1",
            "--from 2 is not before --to 1",
        ),
        (
            "w.jsonl -o a.svg --metric polarisation",
            "w.jsonl does not record polarisation; did you mean metrics.polarization? `--list` names all",
        ),
        (
            "w.jsonl -o a.svg --metric density",
            "density has no value in any frame",
        ),
        (
            "w.jsonl -o a.svg --metric agent_gap --metric laws.potential --log y",
            "laws.potential has no value above 0",
        ),
        ("w.jsonl -o a.pdf", "ends in .svg or .png"),
        (
            "w.jsonl -o a.gif",
            "a.gif: the name of a still ends in .svg or .png",
        ),
        ("w.jsonl -o in/a.svg", "the folder in does not exist"),
        (
            "w.jsonl -o there.svg",
            "there.svg exists already; --force overwrites it",
        ),
        ("w.jsonl -o w.jsonl --force", "cannot share one file"),
        (
            "w.jsonl -o a.svg --trajectories --agents 0,2",
            "w.jsonl has no agent 2; its agents are 0 to 1",
        ),
        (
            "w.jsonl -o a.svg --agents 0",
            "--agents is for --trajectories and --components",
        ),
        (
            "w.jsonl -o a.svg --trajectories --log y",
            "--log is for metrics",
        ),
        (
            "w.jsonl -o a.svg --agents 3-1",
            "must be indices and ranges",
        ),
        (
            "w.jsonl -o a.svg --size 5x5",
            "must be width x height in pixels",
        ),
        (
            "w.jsonl -o a.svg --level inf",
            "must be a number, and finite",
        ),
        ("w.jsonl -o a.svg --metric=", "a metric needs a name"),
        (
            "w.jsonl -o a.svg --metric d_V --log y --level 0",
            "a level of 0 has no place on a logarithmic axis",
        ),
        (
            "w.jsonl -o a.svg --size 120x120",
            "--size leaves no room for the plots between axes and words on 120 x 120 pixels",
        ),
        ("w.jsonl", "--out"),
    ] {
        scene.fails(&format!("plot {arguments}"), 2, &[says]);
    }
    assert_eq!(scene.names(), before);
    assert_eq!(scene.bytes("there.svg"), b"old");
}

/// The lines of a trace, some of them changed.
fn changed(scene: &Scene, change: impl Fn(usize, &mut Value)) -> String {
    let whole = String::from_utf8(scene.bytes("w.jsonl")).unwrap();
    let lines = whole.lines().enumerate().map(|(k, line)| {
        let mut record: Value = serde_json::from_str(line).unwrap();
        change(k, &mut record);
        record.to_string()
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn refuses_traces_of_other_dimensions() {
    let scene = scene();
    for dimension in [0, 1, 5] {
        let text = changed(&scene, |k, record| {
            if k == 0 {
                record["world"]["dimension"] = json!(dimension);
            }
        });
        scene.put("odd.jsonl", &text);
        let says = format!("odd.jsonl has a world of {dimension} dimensions; only 2 or 3");
        for what in [
            "-o a.svg",
            "-o a.svg --trajectories",
            "-o a.svg --components positions",
            "--list",
        ] {
            scene.fails(&format!("plot odd.jsonl {what}"), 2, &[&says]);
        }
    }
    assert!(!scene.names().contains(&"a.svg".to_owned()));
}

#[test]
fn refuses_frames_that_are_not_of_the_world() {
    let scene = scene();
    for (field, value, says) in [
        (
            "positions",
            json!([[0, 0]]),
            "does not have a position for each agent, but 1 for 2",
        ),
        (
            "velocities",
            json!([[0, 0], [1, 0], [2, 0]]),
            "does not have a velocity for each agent, but 3 for 2",
        ),
        (
            "positions",
            json!([[0, 0], [1, 0, 2]]),
            "has a position of agent 1 with 3 components, in 2 dimensions",
        ),
        (
            "time",
            json!(0),
            "has time 0, which is not after 0.15, that of the frame before",
        ),
    ] {
        let text = changed(&scene, |k, record| {
            if record["step"] == json!(20) && k > 0 {
                record[field] = value.clone();
            }
        });
        scene.put("odd.jsonl", &text);
        let says = format!("odd.jsonl: the frame of step 20 {says}");
        for what in ["-o a.svg", "-o a.svg --trajectories --to 0.1", "--list"] {
            scene.fails(&format!("plot odd.jsonl {what}"), 2, &[&says]);
        }
    }
    assert!(!scene.names().contains(&"a.svg".to_owned()));
}

#[test]
fn defaults_without_a_value_are_left_out() {
    let mut rods = world(1);
    rods["record"]["metrics"] = json!(false);
    rods["agents"][0]["shape"] = json!({ "capsule": { "half_length": 0.5, "radius": 0.1 } });
    rods["agents"][0].as_object_mut().unwrap().remove("radius");
    let scene = Scene::with(&rods);
    scene.succeeds("run w.json --trace w.jsonl --quiet");
    let text = svg(&scene, "w.jsonl");
    assert!(text.contains("d_X") && text.contains("d_V"));
    assert!(!text.contains("agent gap"));
    scene.fails(
        "plot w.jsonl -o a.svg --metric d_V --metric agent_gap",
        2,
        &["w.jsonl: agent_gap has no value in any frame"],
    );
}

#[test]
fn a_time_in_decimals_is_met() {
    let scene = scene();
    // A sum of steps is not 0.3 to the last bit.
    let text = changed(&scene, |_, record| {
        if record["step"] == json!(30) {
            record["time"] = json!(0.300_000_000_000_000_04);
        }
    });
    scene.put("near.jsonl", &text);
    svg(&scene, "near.jsonl --metric d_V --from 0.29 --to 0.3");
    let says = ["no frame from time 0.29 to 0.2999"];
    let arguments = "plot near.jsonl -o a.svg --metric d_V --from 0.29 --to 0.2999";
    scene.fails(arguments, 2, &says);
}

#[test]
fn levels_without_a_place_are_not_told() {
    let scene = scene();
    let linear = svg(&scene, "w.jsonl --metric agent_gap --log none");
    assert!(linear.contains("contact<"));
    // Up to the time at which the agents touch all gaps are above 0.
    let text = svg(&scene, "w.jsonl --metric agent_gap --log y --to 0.3");
    assert!(!text.contains("contact<"));
    let text = svg(
        &scene,
        "w.jsonl --metric agent_gap --log y --to 0.3 --level 0.5=half",
    );
    assert!(text.contains("half<"));
}

#[test]
fn quantities_of_one_label_have_their_full_names() {
    let scene = scene();
    let arguments = "w.jsonl --metric d_X --metric metrics.position_diameter --together";
    let text = svg(&scene, arguments);
    assert!(text.contains(">d_X<") && text.contains(">metrics.position_diameter<"));
}

#[test]
fn runs_of_one_colour_have_other_dashes() {
    let scene = scene();
    let dashes = |count: usize| {
        let traces = vec!["w.jsonl"; count].join(" ");
        let text = svg(&scene, &format!("{traces} --components positions"));
        text.matches("stroke-dasharray").count()
    };
    // The targets alone are dashed; then the lines of runs are, too.
    assert!(dashes(8) > dashes(7));
}

#[test]
fn quiet_says_nothing() {
    let scene = scene();
    let whole = String::from_utf8(scene.bytes("w.jsonl")).unwrap();
    let lines: Vec<&str> = whole.lines().take(12).collect();
    scene.put("cut.jsonl", &lines.join("\n"));
    let done = scene.volary("plot cut.jsonl -o cut.svg --quiet");
    assert_eq!((done.code, done.err.as_str()), (Some(0), ""));
}
