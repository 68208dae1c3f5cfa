//! Signals end every command, wherever it is, and it leaves nothing half-written.

use std::fs;
use std::io::Write;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::scene::{Done, Scene, VOLARY, crowd};

/// How long a command may take to end. It takes a fifth of a second where the machine is not
/// busy with other tests; what is tried here would go on for minutes.
const SOON: Duration = Duration::from_secs(5);

/// Until a command is in the midst of what it does.
const MEANWHILE: Duration = Duration::from_millis(600);

/// Starts a command, stops it in the midst of it, and gives what it said.
fn stopped(scene: &Scene, signal: &str, arguments: &str, input: &[u8]) -> Done {
    let child = Command::new(VOLARY)
        .args(arguments.split_whitespace())
        .current_dir(scene.path(""))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = child.unwrap();
    // Held open, so that whoever reads it waits for more.
    let mut held = child.stdin.take().unwrap();
    held.write_all(input).unwrap();
    held.flush().unwrap();
    sleep(MEANWHILE);
    assert_eq!(child.try_wait().unwrap(), None, "{arguments} ends too soon");
    let kill = Command::new("kill")
        .args([format!("-{signal}"), child.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
    let begin = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begin.elapsed() > SOON {
            end(&mut child);
            panic!("{arguments} does not heed {signal}");
        }
        sleep(Duration::from_millis(5));
    }
    println!(
        "{:4} ms, {signal}: {arguments}",
        begin.elapsed().as_millis()
    );
    let done = Done::from(child.wait_with_output().unwrap());
    assert_eq!(done.code, Some(1), "{arguments}: {done:?}");
    let said = done.err.lines().last().unwrap_or_default();
    assert!(said.starts_with("Stopped"), "{arguments}: {done:?}");
    for name in scene.names() {
        assert!(!name.ends_with(".part"), "{arguments} leaves {name}");
    }
    done
}

fn end(child: &mut Child) {
    let _ = child.kill();
    let _ = child.wait();
}

/// A world with one group of agents in the plane, and these laws.
fn world(group: Value, laws: Value) -> Value {
    json!({ "dimension": 2, "time": { "end": 50000 }, "agents": [group], "laws": laws })
}

fn lattice(count: usize) -> Value {
    json!({
        "count": count, "radius": 0.1,
        "positions": { "hexagonal": { "center": [0, 0], "spacing": 1 } }
    })
}

#[test]
fn reading_heeds_signals() {
    let scene = Scene::new();
    for (signal, arguments) in [
        ("INT", "check /dev/stdin"),
        ("TERM", "run /dev/stdin"),
        ("INT", "validate /dev/stdin"),
        ("TERM", "reduce /dev/stdin"),
        ("INT", "plot /dev/stdin -o p.svg"),
        ("TERM", "export /dev/stdin -o e.csv"),
    ] {
        stopped(&scene, signal, arguments, b"{");
    }
    assert!(scene.names().is_empty());
}

#[test]
fn preparing_heeds_signals() {
    let large = json!({
        "count": 10_000_000, "radius": 0.4,
        "positions": { "box": { "min": [0, 0], "max": [7000, 7000] } }
    });
    let scene = Scene::with(&world(large, json!([])));
    for (signal, arguments) in [
        ("INT", "check w.json"),
        ("TERM", "run w.json --trace t.jsonl"),
    ] {
        stopped(&scene, signal, arguments, b"");
    }
    assert_eq!(scene.names(), ["w.json"]);
    // Nearly all arcs, drawn one by one.
    let graph = json!([{ "alignment": {
        "kernel": { "constant": { "strength": 1 } }, "graph": { "random": { "arcs": 998_000 } }
    } }]);
    let scene = Scene::with(&world(lattice(1000), graph));
    stopped(&scene, "INT", "check w.json", b"");
}

#[test]
fn running_heeds_signals() {
    let long = crowd(2);
    let all_pairs = json!([{ "alignment": {
        "kernel": { "cucker_smale": { "strength": 1, "exponent": 0.3 } }, "summation": "direct"
    } }]);
    let net = json!([{ "alpha_interaction": { "spacing": 1, "range": 1.2 } }]);
    let mut recorded = world(lattice(1000), net);
    recorded["record"] = json!({ "net": true });
    for (signal, world, options) in [
        ("INT", &long, "--trace t.jsonl"),
        ("TERM", &long, "--trace t.jsonl.gz --dynamics points"),
        (
            "INT",
            &world(lattice(60_000), all_pairs),
            "--trace t.jsonl.zst",
        ),
        ("TERM", &recorded, "--trace t.json"),
    ] {
        let scene = Scene::with(world);
        stopped(
            &scene,
            signal,
            &format!("run w.json --until 50000 {options}"),
            b"",
        );
        let trace = options.split_whitespace().nth(1).unwrap();
        if scene.names().contains(&trace.to_owned()) && !scene.bytes(trace).is_empty() {
            // Readable as far as it goes, whatever was cut.
            scene.records(trace);
        }
    }
}

#[test]
fn writing_heeds_signals() {
    let scene = Scene::with(&crowd(2));
    let pipe = Command::new("mkfifo").arg(scene.path("t.jsonl")).status();
    assert!(pipe.unwrap().success());
    // Nobody reads it.
    stopped(
        &scene,
        "INT",
        "run w.json --until 50000 --force --trace t.jsonl",
        b"",
    );
}

#[test]
fn validating_and_figures_heed_signals() {
    let scene = Scene::with(&crowd(2));
    let arguments = "validate w.json --set time.end=50000 --report r.html";
    stopped(&scene, "TERM", arguments, b"");
    assert_eq!(scene.names(), ["w.json"]);
    stopped(&scene, "INT", "figures out", b"");
}

#[test]
fn drawing_and_exporting_heed_signals() {
    let scene = Scene::with(&crowd(2));
    scene.succeeds("run w.json --quiet --until 20 --trace t.jsonl");
    let arguments = "render t.jsonl -o f.gif --size 4000x3000 --every 0.1 --fps 50";
    stopped(&scene, "TERM", arguments, b"");
    assert_eq!(scene.names(), ["t.jsonl", "w.json"]);
    let trace = fs::read(scene.path("t.jsonl")).unwrap();
    // The end of the trace does not come.
    for (signal, arguments) in [
        ("INT", "export /dev/stdin -o e.csv"),
        ("TERM", "export /dev/stdin -o e.jsonl.gz"),
        ("TERM", "plot /dev/stdin -o p.svg"),
    ] {
        let part = &trace[..60_000.min(trace.len())];
        stopped(&scene, signal, arguments, part);
    }
    assert_eq!(scene.names(), ["t.jsonl", "w.json"]);
}

#[test]
fn resuming_heeds_signals() {
    let scene = Scene::with(&crowd(2));
    let arguments = "run w.json --until 50000 --trace t.jsonl --checkpoint c.ckpt --every 1";
    stopped(&scene, "INT", arguments, b"");
    for signal in ["TERM", "INT"] {
        stopped(&scene, signal, "resume c.ckpt", b"");
    }
    assert_eq!(scene.names(), ["c.ckpt", "t.jsonl", "w.json"]);
}
