//! Runs of points from the command line.

use volary::trace::record::Header;

use crate::scene::{Scene, crowd};

#[test]
fn the_trace_names_what_moved_the_agents_and_how() {
    let scene = Scene::with(&crowd(2));
    let out =
        scene.succeeds("run w.json --dynamics points --accuracy 1e-7 --until 0.5 --trace t.jsonl");
    assert!(
        out.contains("points, by Dormand-Prince 8(5,3) of order 8, to 1e-7"),
        "{out}"
    );
    assert!(!out.contains("contacts agent"), "{out}");
    let trace = String::from_utf8(scene.bytes("t.jsonl")).unwrap();
    let header: Header = serde_json::from_str(trace.lines().next().unwrap()).unwrap();
    assert_eq!(header.dynamics, "points");
    let solver = header.solver.expect("a solver");
    assert_eq!((solver.order, solver.relative), (8, 1e-7));
    // Bodies name none.
    scene.succeeds("run w.json --until 0.1 --quiet --trace bodies.jsonl");
    assert!(
        !String::from_utf8(scene.bytes("bodies.jsonl"))
            .unwrap()
            .contains("\"solver\"")
    );
}

#[test]
fn what_makes_no_sense_for_points_is_bad_input() {
    let scene = Scene::with(&crowd(2));
    for (arguments, message) in [
        (
            "run w.json --dynamics points --accuracy 2",
            "from 1e-13 to 1e-3",
        ),
        (
            "run w.json --dynamics points --accuracy nan",
            "from 1e-13 to 1e-3",
        ),
        (
            "run w.json --accuracy 1e-9",
            "--accuracy is for --dynamics points",
        ),
        ("run w.json --dynamics point", "bodies, points"),
        (
            "run w.json --dynamics points --set agents[0].sensing.delay=0.1",
            "agents[0].sensing.delay: points remember no past",
        ),
    ] {
        let done = scene.volary(arguments);
        assert_eq!(done.code, Some(2), "{arguments}: {done:?}");
        assert!(done.err.contains(message), "{arguments}: {}", done.err);
    }
}

#[test]
fn runs_of_points_go_on_from_checkpoints() {
    let scene = Scene::with(&crowd(2));
    let points = "run w.json --quiet --dynamics points --accuracy 1e-6 --until 0.6";
    scene.succeeds(&format!("{points} --trace whole.jsonl"));
    scene.succeeds(&format!(
        "{points} --trace t.jsonl --checkpoint c --every 0.2"
    ));
    assert!(scene.bytes("whole.jsonl") == scene.bytes("t.jsonl"));
    let out = scene.succeeds("resume c");
    assert!(out.contains("ran to its end"), "{out}");
}
