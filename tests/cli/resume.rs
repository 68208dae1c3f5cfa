//! Runs that are killed or stopped, and go on from their checkpoints.

use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use std::{fs, path::Path};

use serde_json::{Value, json};
use volary::checkpoint::Checkpoint;
use volary::trace::{Record, TraceError, TraceReader};

use crate::scene::{Scene, VOLARY, crowd};

/// Agents that touch, and a frame at every step.
fn chatty() -> Value {
    let mut world = crowd(2);
    world["time"]["end"] = json!(4.0);
    world["record"] = json!({ "every": 0.01, "edges": true });
    world
}

/// A child that does not outlive its test.
struct Guarded(Child);

impl Drop for Guarded {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn spawn(scene: &Scene, arguments: &str) -> Guarded {
    let child = Command::new(VOLARY)
        .args(arguments.split_whitespace())
        .current_dir(scene.path(""))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn();
    Guarded(child.unwrap())
}

/// Starts a command and kills it: once a file is so long, and then after a while.
fn kill(scene: &Scene, arguments: &str, (file, length): (&str, u64), delay: Duration) {
    let mut run = spawn(scene, arguments);
    while length_of(&scene.path(file)) < length && run.0.try_wait().unwrap().is_none() {
        sleep(Duration::from_millis(1));
    }
    sleep(delay);
    run.0.kill().unwrap();
    run.0.wait().unwrap();
}

/// Length of a file, 0 where there is none.
fn length_of(path: &Path) -> u64 {
    path.metadata().map_or(0, |data| data.len())
}

/// Shares of 1, the same in every run of the test.
struct Shares(u64);

impl Iterator for Shares {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        // The generator of Lehmer, with the constants of MINSTD.
        self.0 = self.0 * 48_271 % 2_147_483_647;
        Some(self.0 as f64 / 2_147_483_647.0)
    }
}

/// The records of a trace that was cut anywhere; none where it has no header yet.
fn readable(path: &Path) -> Option<Vec<Record>> {
    match TraceReader::open(path) {
        Ok(reader) => Some(reader.map(Result::unwrap).collect()),
        Err(TraceError::NotATrace { .. } | TraceError::Io { .. }) => None,
        Err(error) => panic!("{error}"),
    }
}

/// Kills runs that write this trace at random moments, some of them more than once, and
/// goes on with them; whatever they leave must be sound, and the end the same.
fn killed_runs_go_on(trace: &str, kills: usize, seed: u64) {
    let scene = Scene::with(&chatty());
    let options = "--quiet --checkpoint c --every 0.1 --summary s.json --force";
    let run = format!("run w.json --trace {trace} {options}");
    let begin = Instant::now();
    scene.succeeds(&run);
    let takes = begin.elapsed();
    let (whole, summary) = (scene.bytes(trace), scene.bytes("s.json"));
    let records = scene.records(trace);
    let of_run = |name: &str| name == trace || name == "s.json" || name == "c";

    let mut shares = Shares(seed);
    let (mut killed, mut on_its_way) = (0, 0);
    while killed < kills {
        for name in scene.names().iter().filter(|name| *name != "w.json") {
            fs::remove_file(scene.path(name)).unwrap();
        }
        let mut command = run.clone();
        for again in 0..1 + killed % 3 {
            // Where the trace grows from nothing, its length tells the moment however busy
            // the machine is; later, time must.
            let mut share = |of: f64| of * shares.next().unwrap();
            let (length, delay) = match again {
                0 => (share(whole.len() as f64), share(0.01)),
                _ => (0.0, share(takes.as_secs_f64())),
            };
            let delay = Duration::from_secs_f64(delay);
            kill(&scene, &command, (trace, length as u64), delay);
            killed += 1;
            let found = readable(&scene.path(trace));
            if let Some(found) = &found {
                assert!(found[..] == records[..found.len()], "after kill {killed}");
            }
            if trace.ends_with(".jsonl") && scene.path(trace).exists() {
                let lines = scene.bytes(trace).iter().filter(|&&b| b == b'\n').count();
                assert_eq!(found.map_or(0, |found| found.len() + 1), lines);
            }
            for name in scene.names() {
                let part = name.starts_with("c.") || name.starts_with("s.json.");
                let part = part && name.ends_with(".part");
                assert!(name == "w.json" || of_run(&name) || part, "{name}");
            }
            if !scene.path("c").exists() {
                break;
            }
            // The checkpoint is whole, old or new.
            let checkpoint = Checkpoint::read(&scene.path("c")).unwrap();
            let complete = checkpoint.recording().unwrap().complete();
            on_its_way += usize::from(!complete && checkpoint.step() > 0);
            command = "resume c --quiet".to_owned();
        }
        if scene.path("c").exists() {
            scene.succeeds("resume c --quiet --threads 2");
            assert!(scene.bytes(trace) == whole, "{trace} after kill {killed}");
            assert!(scene.bytes("s.json") == summary, "after kill {killed}");
        }
    }
    assert!(
        3 * on_its_way >= killed,
        "of {killed} kills only {on_its_way} came between the first checkpoint and the end"
    );
}

#[test]
fn killed_runs_go_on_with_lines() {
    killed_runs_go_on("t.jsonl", 14, 1);
}

#[test]
fn killed_runs_go_on_with_a_document() {
    killed_runs_go_on("t.json", 12, 2);
}

#[test]
fn killed_runs_go_on_with_gzip() {
    killed_runs_go_on("t.jsonl.gz", 12, 3);
}

#[test]
fn killed_runs_go_on_with_zstd() {
    killed_runs_go_on("t.json.zst", 12, 4);
}

#[test]
fn checkpoints_leave_no_mark_on_the_run() {
    let scene = Scene::with(&chatty());
    scene.succeeds("run w.json --quiet --trace a.jsonl --summary a.json");
    for every in ["0.01", "0.7", "100"] {
        for trace in ["b.jsonl", "b.jsonl.zst", "b.json.gz"] {
            scene.succeeds(&format!(
                "run w.json --quiet --trace {trace} --summary b.json --checkpoint c --every {every} \
                 --force"
            ));
            assert_eq!(scene.records(trace), scene.records("a.jsonl"));
            assert_eq!(scene.bytes("b.json"), scene.bytes("a.json"));
        }
        assert!(
            scene.bytes("b.jsonl") == scene.bytes("a.jsonl"),
            "every {every}"
        );
        let kept = format!("{every}.zst");
        fs::rename(scene.path("b.jsonl.zst"), scene.path(&kept)).unwrap();
        assert!(
            scene.bytes(&kept) == scene.bytes("0.01.zst"),
            "every {every}"
        );
    }
}

#[test]
fn a_completed_run_is_left_alone() {
    let scene = Scene::with(&crowd(3));
    scene.succeeds("run w.json --quiet --trace t.jsonl --checkpoint c --every 0.3");
    let before = scene.bytes("t.jsonl");
    let out = scene.succeeds("resume c");
    assert_eq!(
        out,
        "w ran to its end at time 1 already; there is nothing left to do.\n"
    );
    assert_eq!(scene.succeeds("resume c --quiet"), "");
    assert!(scene.bytes("t.jsonl") == before);
}

/// A run that was stopped on its way goes on like one that was not.
#[cfg(unix)]
#[test]
fn stopped_runs_go_on() {
    for (signal, trace) in [("INT", "t.jsonl"), ("TERM", "t.jsonl.zst")] {
        let scene = stopped(signal, trace);
        let (summary, cut) = (scene.bytes("s.json"), scene.bytes(trace));
        // Elsewhere, the trace under another name.
        fs::create_dir(scene.path("moved")).unwrap();
        for (from, to) in [("c", "moved/c"), (trace, "moved/trace")] {
            fs::copy(scene.path(from), scene.path(to)).unwrap();
        }
        let table = scene.succeeds("resume c");
        assert!(
            table.starts_with("w, seed 1: 30 agents to time 8 in 800 steps ("),
            "{table}"
        );
        scene.succeeds(&format!("run w.json --quiet --trace whole.{trace} --checkpoint d --every 50 --summary whole.json"));
        assert!(
            scene.bytes(trace) == scene.bytes(&format!("whole.{trace}")),
            "{trace}"
        );
        assert_eq!(scene.bytes("s.json"), scene.bytes("whole.json"));
        assert!(summary != scene.bytes("s.json") && cut != scene.bytes(trace));
        scene.succeeds("resume moved/c --quiet --trace moved/trace --summary moved/s.json");
        assert!(scene.bytes("moved/trace") == scene.bytes(trace));
        assert_eq!(scene.bytes("moved/s.json"), scene.bytes("whole.json"));
    }
}

/// A scene with a run that `signal` stopped on its way.
#[cfg(unix)]
fn stopped(signal: &str, trace: &str) -> Scene {
    let mut world = chatty();
    world["time"]["end"] = json!(8.0);
    // On a busy machine a run may be over before it is stopped.
    for _ in 0..10 {
        let scene = Scene::with(&world);
        if let Some(said) = stop(&scene, signal, trace) {
            assert!(said.starts_with("Stopped at time "), "{said}");
            assert!(said.ends_with(". `volary resume c` goes on.\n"), "{said}");
            let checkpoint = Checkpoint::read(&scene.path("c")).unwrap();
            assert_eq!(scene.summary(trace).steps, checkpoint.step());
            return scene;
        }
    }
    panic!("no run could be stopped");
}

/// Runs the scene's world until `signal` stops it; returns what it says, or nothing where it
/// was over before.
#[cfg(unix)]
fn stop(scene: &Scene, signal: &str, trace: &str) -> Option<String> {
    use std::io::Read;

    let options = format!("--trace {trace} --summary s.json --checkpoint c --every 3");
    let mut run = spawn(scene, &format!("run w.json {options}"));
    let deadline = Instant::now() + Duration::from_secs(60);
    while length_of(&scene.path(trace)) < 20_000 {
        assert!(Instant::now() < deadline, "no frames come");
        sleep(Duration::from_millis(1));
    }
    let id = run.0.id().to_string();
    let kill = Command::new("kill")
        .args([format!("-{signal}"), id])
        .status();
    kill.unwrap();
    if run.0.wait().unwrap().success() {
        return None;
    }
    let mut said = String::new();
    let mut err = run.0.stderr.take().unwrap();
    err.read_to_string(&mut said).unwrap();
    Some(said)
}

#[cfg(unix)]
#[test]
fn traces_that_are_not_what_they_were_are_refused() {
    let scene = stopped("INT", "t.jsonl");
    let (trace, checkpoint) = (scene.bytes("t.jsonl"), scene.bytes("c"));
    let refuses = |arguments: &str, says: &[&str]| {
        scene.fails(&format!("resume c {arguments}"), 2, says);
        assert_eq!(scene.bytes("c"), checkpoint);
    };
    fs::rename(scene.path("t.jsonl"), scene.path("u.jsonl")).unwrap();
    refuses(
        "",
        &["cannot open ", "t.jsonl", "; --trace says where it is now"],
    );
    refuses(
        "--trace w.json",
        &["w.json is not the trace", "bytes, and had"],
    );
    refuses("--trace c", &["c is not the trace that was being written"]);
    refuses("--trace .", &[".: this is a folder"]);
    refuses(
        "--trace none/t.jsonl",
        &["none/t.jsonl: the folder none does not exist"],
    );
    refuses("--trace /dev/null", &["/dev/null", "no regular file"]);
    refuses(
        "--trace u.jsonl --summary u.jsonl",
        &["trace and summary cannot share one file"],
    );
    refuses(
        "--trace u.jsonl --summary c",
        &["checkpoint and summary cannot share one file"],
    );
    refuses(
        "--trace u.jsonl --summary w.json",
        &["w.json exists already; --force"],
    );
    let mut changed = trace.clone();
    changed[100] ^= 1;
    fs::write(scene.path("t.jsonl"), &changed).unwrap();
    refuses(
        "",
        &[
            "t.jsonl is not the trace that was being written",
            "bytes have changed",
        ],
    );
    assert!(
        scene.bytes("t.jsonl") == changed,
        "what is refused is left alone"
    );
    fs::write(scene.path("t.jsonl"), &trace[..1000]).unwrap();
    refuses("", &["it has 1000 bytes, and had "]);
    assert!(
        scene.bytes("u.jsonl") == trace,
        "what is refused is left alone"
    );
}

#[test]
fn other_files_are_no_checkpoints() {
    let scene = Scene::with(&crowd(2));
    scene.succeeds("run w.json --quiet --trace t.jsonl.gz --checkpoint c --every 0.5");
    scene.put("empty", "");
    for name in ["w.json", "t.jsonl.gz", "empty"] {
        let says = format!("Error: {name} is not a checkpoint\n");
        scene.fails(&format!("resume {name}"), 2, &[&says]);
    }
    let mut bytes = scene.bytes("c");
    let half = bytes.len() / 2;
    fs::write(scene.path("short"), &bytes[..half]).unwrap();
    scene.fails("resume short", 2, &["short is damaged: it ends too early"]);
    bytes[half] ^= 4;
    fs::write(scene.path("flipped"), &bytes).unwrap();
    scene.fails(
        "resume flipped",
        2,
        &["flipped is damaged: its checksum is wrong"],
    );
    scene.fails("resume .", 2, &[".: this is a folder"]);
    scene.fails("resume none", 2, &["cannot open none"]);
    scene.fails(
        "resume none/c",
        2,
        &["none/c: the folder none does not exist"],
    );
}

#[test]
fn checkpoints_are_asked_for_in_full_and_kept() {
    let scene = Scene::with(&crowd(2));
    scene.fails("run w.json --checkpoint c", 2, &["--every <TIME>"]);
    scene.fails("run w.json --every 1", 2, &["--checkpoint <FILE>"]);
    for (every, says) in [
        (
            "0.015",
            "--every 0.015: must be a whole number of steps of 0.01; 0.01 or 0.02 would fit",
        ),
        ("0", "--every 0: must be a whole number of steps of 0.01"),
        ("-1", "--every -1: must be a whole number of steps of 0.01"),
        ("soon", "--every <TIME>"),
    ] {
        let run = format!("run w.json --checkpoint c --every {every} --trace t.jsonl");
        scene.fails(&run, 2, &[says]);
    }
    for (files, says) in [
        (
            "--checkpoint w.json",
            "w.json: the checkpoint would overwrite the world",
        ),
        (
            "--checkpoint t.jsonl --trace t.jsonl",
            "trace and checkpoint cannot share one file",
        ),
        (
            "--checkpoint s.json --summary ./s.json",
            "summary and checkpoint cannot share one file",
        ),
        (
            "--checkpoint none/c",
            "none/c: the folder none does not exist",
        ),
        ("--checkpoint .", ".: this is a folder"),
    ] {
        scene.fails(&format!("run w.json --every 1 {files} --force"), 2, &[says]);
    }
    #[cfg(target_os = "linux")]
    scene.fails(
        "run w.json --every 1 --checkpoint c --trace /dev/null --force",
        2,
        &["/dev/null", ".jsonl"],
    );
    assert_eq!(scene.names(), ["w.json"]);

    scene.put("c", "precious");
    let run = "run w.json --quiet --checkpoint c --every 1";
    scene.fails(run, 2, &["c exists already; --force overwrites it"]);
    assert_eq!(scene.bytes("c"), b"precious");
    scene.succeeds(&format!("{run} --force"));
    assert!(Checkpoint::read(&scene.path("c")).is_ok());
}
