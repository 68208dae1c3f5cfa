//! Worlds and options, good and bad; what is printed about them.

use std::fs;

use serde_json::json;

use crate::scene::{Scene, crowd};

#[test]
fn help_shows_examples() {
    let scene = Scene::new();
    for arguments in ["--help", "run --help"] {
        let help = scene.succeeds(arguments);
        assert!(help.contains("Examples:\n  volary "), "{help}");
        assert!(
            help.lines().all(|line| line.chars().count() <= 100),
            "{help}"
        );
    }
    scene.fails("", 2, &["Usage: volary <COMMAND>"]);
    scene.fails("fly", 2, &["fly"]);
}

#[test]
fn runs_print_a_summary_unless_quiet() {
    let scene = Scene::with(&crowd(3));
    let out = scene.succeeds("run w.json --until 0.1 --seed 8");
    assert!(
        out.starts_with("w, seed 8: 30 agents to time 0.1 in 10 steps"),
        "{out}"
    );
    for row in [
        "polarization",
        "contacts agent-agent",
        "contacts agent-obstacle",
    ] {
        assert!(out.contains(row), "{out}");
    }
    assert_eq!(scene.succeeds("run w.json --until 0.1 --quiet"), "");
    assert_eq!(scene.names(), ["w.json"], "nothing is written unasked");
}

#[test]
fn unreadable_worlds_are_bad_input() {
    let scene = Scene::with(&crowd(2));
    fs::create_dir(scene.path("folder")).unwrap();
    fs::write(scene.path("latin.json"), b"{\"description\": \"caf\xe9\"}").unwrap();
    scene.put("empty.json", "");
    for (world, says) in [
        (
            "absent.json",
            "absent.json: neither a file nor a shipped world",
        ),
        (
            "six-obstacle",
            "did you mean olfati-saber-2003/six-obstacles?",
        ),
        ("folder", "folder: this is a folder"),
        ("latin.json", "latin.json: not a text file: it is not UTF-8"),
        ("empty.json", "empty.json:1:1: the file is empty"),
    ] {
        for command in ["run", "check"] {
            scene.fails(&format!("{command} {world}"), 2, &["Error: ", says]);
        }
    }
    #[cfg(target_os = "linux")]
    scene.fails(
        "run /proc/self/mem",
        2,
        &["/proc/self/mem: cannot be read: "],
    );
}

#[test]
fn bad_options_are_bad_input() {
    let scene = Scene::with(&crowd(2));
    for (options, says) in [
        (
            "--seed -1",
            "'--seed <SEED>': must be a whole number from 0",
        ),
        (
            "--seed 1.5",
            "'--seed <SEED>': must be a whole number from 0",
        ),
        (
            "--seed 18446744073709551616",
            "must be a whole number from 0",
        ),
        (
            "--until nan",
            "'--until <TIME>': must be a number, and finite",
        ),
        ("--until inf", "must be a number, and finite"),
        ("--until 1e999", "must be a number, and finite"),
        ("--until soon", "must be a number, and finite"),
        ("--until -1", "time.end=-1: must be at least 0"),
        ("--until 0.015", "must be a whole number of steps"),
        ("--step 0", "time.step=0: must be greater than 0"),
        ("--step -0.5", "time.step=-0.5: must be greater than 0"),
        ("--threads 0", "0 is not in 1..=1024"),
        ("--threads -2", "-2 is not in 1..=1024"),
        ("--set seed", "--set: `seed` lacks an equals sign"),
        ("--set =1", "lacks a path"),
        ("--set a..b=1", "the path `a..b` lacks a name"),
        ("--set sed=1", "did you mean `seed`?"),
        ("--set laws[7].navigation=1", "`laws` has no entry 7"),
        ("--set seed=x", "seed=x"),
    ] {
        scene.fails(&format!("run w.json --trace t.jsonl {options}"), 2, &[says]);
        assert_eq!(scene.names(), ["w.json"], "{options}");
    }
}

#[test]
fn check_reports_on_all_worlds() {
    let scene = Scene::with(&crowd(3));
    scene.put(
        "typo.json",
        &crowd(2).to_string().replace("\"laws\"", "\"lows\""),
    );
    scene.put("comma.json", "{,}");
    let sound = "w.json: sound; 3-D, 30 agents, 2 obstacles, 3 laws, 100 steps\n";
    assert_eq!(scene.succeeds("check w.json"), sound);
    let done = scene.volary("check typo.json absent w.json comma.json w.json");
    assert_eq!(done.code, Some(2));
    assert_eq!(done.out, sound.repeat(2));
    for says in ["typo.json", "`laws`", "absent", "comma.json"] {
        assert!(done.err.contains(says), "{says}: {done:?}");
    }
    assert!(!done.err.contains("w.json"), "{done:?}");
    scene.fails("check", 2, &["<WORLD>"]);
}

#[test]
fn check_tells_which_step_contacts_need() {
    let scene = Scene::new();
    let world = |speed: f64, top: f64, steered: f64| {
        json!({
            "dimension": 2, "time": { "step": 0.01, "end": 1 },
            "agents": [
                { "radius": 0.1, "positions": { "explicit": [[0, 0]] },
                  "velocities": { "common": [speed, 0] }, "top_speed": top },
                { "radius": 3, "positions": { "explicit": [[9, 9]] }, "top_speed": 4 }
            ],
            "laws": [{ "navigation": { "velocity": [0, steered] } }]
        })
    };
    for (speed, top, steered, says) in [
        (9.0, 10.0, 8.0, ""),
        (
            30.0,
            25.0,
            8.0,
            "a body at the start goes 3.000 of the smallest radius, 0.1, in a step; --step 0.005",
        ),
        (
            9.0,
            21.0,
            8.0,
            "a body at top speed goes 2.100 of the smallest radius",
        ),
        // No faster than it may.
        (
            9.0,
            25.0,
            40.0,
            "a body under navigation goes 2.500 of the smallest radius",
        ),
    ] {
        scene.put("w.json", &world(speed, top, steered).to_string());
        let out = scene.succeeds("check w.json");
        assert!(out.contains(says), "{says}: {out}");
        assert_eq!(out.contains("note"), !says.is_empty(), "{out}");
        // The step that it names is one that the world can take, and raises no note.
        if let Some((_, rest)) = out.split_once("--step ") {
            let step = rest.split(' ').next().unwrap();
            scene.succeeds(&format!("run w.json --quiet --step {step}"));
            let mut spec = world(speed, top, steered);
            spec["time"]["step"] = json!(step.parse::<f64>().unwrap());
            scene.put("finer.json", &spec.to_string());
            let out = scene.succeeds("check finer.json");
            assert!(!out.contains("note"), "{out}");
        }
    }
}

#[test]
fn shipped_worlds_are_listed_and_start_new_ones() {
    let scene = Scene::new();
    let list = scene.succeeds("worlds");
    let names: Vec<_> = list.lines().filter(|line| !line.starts_with(' ')).collect();
    assert!(names.contains(&"olfati-saber-2003/six-obstacles"), "{list}");
    for name in names {
        scene.put("mine.json", &scene.succeeds(&format!("worlds {name}")));
        let mine = scene.succeeds("check mine.json");
        let theirs = scene.succeeds(&format!("check {name}"));
        assert_eq!(mine.replace("mine.json", name), theirs);
    }
    scene.fails(
        "worlds six-obstacles",
        2,
        &["did you mean olfati-saber-2003/six-obstacles?"],
    );
    scene.fails(
        "worlds qqq",
        2,
        &["qqq: no shipped world", "`volary worlds` lists them"],
    );
}

#[test]
fn schemas_are_printed() {
    let scene = Scene::new();
    for (name, title) in [
        ("world", "Volary world"),
        ("trace", "Volary trace record"),
        ("summary", "Volary summary"),
    ] {
        let schema = scene.succeeds(&format!("schema {name}"));
        let schema: serde_json::Value = serde_json::from_str(&schema).unwrap();
        assert_eq!(schema["title"], json!(title));
    }
    assert_eq!(scene.succeeds("schema"), scene.succeeds("schema world"));
    scene.fails("schema pictures", 2, &["world, trace, summary"]);
}
