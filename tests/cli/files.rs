//! The files of a run: what is kept, replaced and refused.

use std::fs;

use crate::scene::{Scene, crowd, json};

#[test]
fn existing_files_are_kept_unless_forced() {
    let scene = Scene::with(&crowd(2));
    for (option, name) in [("--trace", "t.jsonl"), ("--summary", "s.json")] {
        scene.put(name, "precious");
        let arguments = format!("run w.json --quiet --until 0.1 {option} {name}");
        scene.fails(&arguments, 2, &[name, "exists already", "--force"]);
        assert_eq!(scene.bytes(name), b"precious");
        scene.succeeds(&format!("{arguments} --force"));
        assert_ne!(scene.bytes(name), b"precious");
    }
    assert_eq!(scene.summary("t.jsonl").steps, 10);
    assert_eq!(json(&scene.path("s.json"))["steps"], 10);

    scene.put("s.json", "precious");
    scene.fails(
        "run w.json --trace new.jsonl --summary s.json",
        2,
        &["s.json"],
    );
    assert_eq!(scene.names(), ["s.json", "t.jsonl", "w.json"]);
}

#[test]
fn no_file_replaces_the_world_or_another() {
    let scene = Scene::with(&crowd(2));
    let world = scene.bytes("w.json");
    let mut aliases = vec!["w.json", "./w.json"];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("w.json", scene.path("soft.json")).unwrap();
        fs::hard_link(scene.path("w.json"), scene.path("hard.json")).unwrap();
        aliases.extend(["soft.json", "hard.json"]);
    }
    for alias in aliases {
        for (option, what) in [("--trace", "trace"), ("--summary", "summary")] {
            for force in ["", "--force"] {
                scene.fails(
                    &format!("run w.json {option} {alias} {force}"),
                    2,
                    &[alias, &format!("the {what} would overwrite the world")],
                );
                assert_eq!(scene.bytes("w.json"), world);
            }
        }
    }
    for force in ["", "--force"] {
        scene.fails(
            &format!("run w.json --trace one.json --summary ./one.json {force}"),
            2,
            &["one.json", "cannot share one file"],
        );
    }
    assert!(!scene.path("one.json").exists());
}

#[test]
fn unfit_names_are_refused_before_the_run() {
    let scene = Scene::with(&crowd(2));
    fs::create_dir(scene.path("folder.jsonl")).unwrap();
    for (arguments, says) in [
        ("--trace t.csv", ["t.csv", ".jsonl, .ndjson or .json"]),
        (
            "--trace no/t.jsonl",
            ["no/t.jsonl", "the folder no does not exist"],
        ),
        ("--trace folder.jsonl", ["folder.jsonl", "this is a folder"]),
        (
            "--trace w.json/t.jsonl",
            ["w.json/t.jsonl", "cannot create"],
        ),
        (
            "--summary no/s.json",
            ["no/s.json", "the folder no does not exist"],
        ),
        (
            "--summary folder.jsonl",
            ["folder.jsonl", "this is a folder"],
        ),
        (
            "--summary w.json/s.json",
            ["w.json/s.json", "cannot create"],
        ),
    ] {
        for force in ["", "--force"] {
            // The other file shows whether the run began.
            let other = match arguments.starts_with("--trace") {
                true => "--summary other.json",
                false => "--trace other.jsonl",
            };
            scene.fails(&format!("run w.json {arguments} {other} {force}"), 2, &says);
            assert_eq!(scene.names(), ["folder.jsonl", "w.json"], "{arguments}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    use std::fs::File;
    use std::process::Command;

    let scene = Scene::with(&crowd(2));
    std::os::unix::fs::symlink("/dev/full", scene.path("full.jsonl")).unwrap();
    for option in ["--trace", "--summary"] {
        let arguments = format!("run w.json --quiet --force {option} full.jsonl");
        scene.fails(&arguments, 1, &["cannot write full.jsonl", "No space left"]);
    }
    let run = |arguments: &[&str], out: bool| {
        let full = File::create("/dev/full").unwrap();
        let mut command = Command::new(crate::scene::VOLARY);
        match out {
            true => command.args(arguments).stdout(full).output(),
            false => command.args(arguments).stderr(full).output(),
        }
        .unwrap()
    };
    let schema = run(&["schema"], true);
    assert_eq!(schema.status.code(), Some(1));
    let said = String::from_utf8(schema.stderr).unwrap();
    assert!(
        said.starts_with("Error: cannot write to standard output"),
        "{said}"
    );
    assert_eq!(run(&["run", "nowhere"], false).status.code(), Some(2));
}
