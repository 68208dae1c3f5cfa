//! Runs that someone stops, and readers that go away.

use std::io::Write;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::json;
use volary::trace::record::Outcome;
use volary::trace::{Record, TraceReader};

use crate::scene::{Done, Scene, VOLARY, crowd, json};

/// A child that does not outlive its test.
struct Guarded(Option<Child>);

impl Drop for Guarded {
    fn drop(&mut self) {
        if let Some(child) = &mut self.0 {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// Asks again and again, for a minute at most.
fn wait_for<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let deadline = Instant::now() + Duration::from_secs(60);
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(Instant::now() < deadline, "waited too long for {what}");
        sleep(Duration::from_millis(10));
    }
}

fn spawn(scene: &Scene, arguments: &str) -> Guarded {
    let child = Command::new(VOLARY)
        .args(arguments.split_whitespace())
        .current_dir(scene.path(""))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    Guarded(Some(child.unwrap()))
}

#[test]
fn a_signal_ends_a_run_in_good_order() {
    for (signal, trace) in [
        ("INT", "t.jsonl"),
        ("TERM", "t.json"),
        ("INT", "t.jsonl.zst"),
    ] {
        let scene = Scene::with(&crowd(2));
        let options = format!("--until 50000 --set record.every=0.5 --trace {trace}");
        let mut run = spawn(&scene, &format!("run w.json {options} --summary s.json"));
        let child = run.0.as_mut().unwrap();
        wait_for("frames", || {
            let records = TraceReader::open(&scene.path(trace)).ok()?;
            let frames = records.filter(|record| matches!(record, Ok(Record::Frame(_))));
            (frames.count() >= 3).then_some(())
        });
        let kill = Command::new("kill")
            .args([format!("-{signal}"), child.id().to_string()])
            .status();
        assert!(kill.unwrap().success());
        wait_for("the end", || child.try_wait().unwrap());
        let done = Done::from(run.0.take().unwrap().wait_with_output().unwrap());

        assert_eq!(done.code, Some(1), "{done:?}");
        assert!(done.err.starts_with("Stopped at time "), "{done:?}");
        assert_eq!(done.err.lines().count(), 1, "{done:?}");
        let summary = scene.summary(trace);
        assert_eq!(summary.outcome, Outcome::Interrupted);
        assert!(summary.time < 50000.0);
        let last = scene.frames(trace).pop().unwrap();
        assert_eq!((last.step, last.time), (summary.steps, summary.time));
        let written = serde_json::to_value(&summary).unwrap();
        assert_eq!(json(&scene.path("s.json")), written);
        assert_eq!(scene.names(), ["s.json", trace, "w.json"]);
    }
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let scene = Scene::new();
    let mut check = spawn(&scene, "check /dev/stdin");
    let child = check.0.as_mut().unwrap();
    drop(child.stdout.take());
    // The command prints only once it has read the whole world.
    let mut world = child.stdin.take().unwrap();
    world.write_all(crowd(3).to_string().as_bytes()).unwrap();
    drop(world);
    let done = Done::from(check.0.take().unwrap().wait_with_output().unwrap());
    assert_eq!((done.code, done.err.as_str()), (Some(0), ""));
}

#[test]
fn a_world_that_goes_out_of_bounds_fails_with_a_whole_trace() {
    let wild = |law: usize, name: &str, gains: &[(&str, f64)]| {
        let mut world = crowd(2);
        for (gain, value) in gains {
            world["laws"][law][name][gain] = json!(value);
        }
        world["time"] = json!({ "step": 0.1, "end": 10.0 });
        world["record"] = json!({ "every": 0.1 });
        world
    };
    let damping = wild(
        0,
        "alpha_interaction",
        &[("damping", 1e6), ("range", 1e100)],
    );
    let mut flight = wild(2, "navigation", &[("velocity_gain", 0.0)]);
    flight["agents"][0]["velocities"] = json!({ "common": [9e99, 0] });
    flight["obstacles"] = json!([]);
    // The first shakes itself apart, the second flies off.
    for (world, says) in [(damping, "a smaller step"), (flight, "too large")] {
        let scene = Scene::with(&world);
        scene.fails(
            "run w.json --quiet --trace t.jsonl --summary s.json",
            1,
            &["Error: w.json cannot go on: ", says],
        );
        let summary = scene.summary("t.jsonl");
        assert_eq!(summary.outcome, Outcome::Failed);
        assert!(summary.error.unwrap().contains(says));
        assert_eq!(json(&scene.path("s.json"))["outcome"], "failed");
        let steps: Vec<u64> = scene.frames("t.jsonl").iter().map(|f| f.step).collect();
        assert!(
            !steps.is_empty() && steps.windows(2).all(|pair| pair[0] < pair[1]),
            "{steps:?}"
        );
    }
    let mut heavy = wild(2, "navigation", &[("velocity_gain", 1e100)]);
    heavy["agents"][0]["mass"] = json!(1e100);
    let scene = Scene::with(&heavy);
    let arguments = "run w.json --trace t.jsonl --summary s.json";
    scene.fails(arguments, 1, &["Error: w.json cannot start: ", "agent 0"]);
    assert_eq!(
        scene.names(),
        ["w.json"],
        "a run that never starts writes nothing"
    );
}
