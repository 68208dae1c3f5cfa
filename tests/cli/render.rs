//! `volary render`: pictures and films of traces, and what is said of bad ones.

use std::fs;

use crate::scene::{Scene, crowd};

/// A folder with a world and its trace, `w.jsonl`, of 11 frames from 0 to 1.
fn drawn(dimension: usize) -> Scene {
    let scene = Scene::with(&crowd(dimension));
    scene.succeeds("run w.json --trace w.jsonl --quiet");
    scene
}

#[test]
fn every_kind_of_file_is_written() {
    let scene = drawn(2);
    let kinds: [(&str, &[u8]); 4] = [
        ("p.svg", b"<svg"),
        ("p.png", b"\x89PNG"),
        ("p.gif", b"GIF89a"),
        ("p.apng", b"\x89PNG"),
    ];
    for (name, magic) in kinds {
        assert_eq!(
            scene.succeeds(&format!("render w.jsonl -o {name} --size 200x150")),
            ""
        );
        assert!(scene.bytes(name).starts_with(magic), "{name}");
    }
    scene.succeeds("render w.jsonl -o strip.svg --at 0.7,0,0.31 --hide legend");
    let strip = String::from_utf8(scene.bytes("strip.svg")).unwrap();
    let places = ["t = 0.7", "t = 0.0", "t = 0.3"].map(|time| strip.find(time));
    assert!(
        places.iter().all(Option::is_some) && places.is_sorted(),
        "{places:?}"
    );
    scene.succeeds("render w.jsonl -o over.svg --at 0,1 --overlay --force");
    scene.succeeds("render w.jsonl -o far.png --show grid --view 1e16,0,10000000000000004,4");
    scene.succeeds("render w.jsonl -o untimed.svg --at 0,1 --hide time");
    let untimed = String::from_utf8(scene.bytes("untimed.svg")).unwrap();
    assert!(!untimed.contains("t = "), "{untimed}");
    scene.succeeds(
        "render w.jsonl -o most.png --only bodies,edges,velocities,trails --color component \
         --theme dark --follow --trail 0.3",
    );
}

#[test]
fn space_is_drawn_and_gone_round() {
    let scene = drawn(3);
    scene.succeeds("render w.jsonl -o p.png --camera=-120,-20 --size 200x150");
    scene.succeeds("render w.jsonl -o p.gif --orbit 90 --speed 2 --size 160x120");
}

#[test]
fn existing_files_are_kept() {
    let scene = drawn(2);
    scene.put("p.svg", "mine");
    scene.fails(
        "render w.jsonl -o p.svg",
        2,
        &["p.svg exists already; --force overwrites it"],
    );
    assert_eq!(scene.bytes("p.svg"), b"mine");
    scene.succeeds("render w.jsonl -o p.svg --force");
    assert!(scene.bytes("p.svg").starts_with(b"<svg"));
}

#[test]
fn bad_input_gets_one_message_and_no_file() {
    let scene = drawn(2);
    let before = scene.names();
    scene.put("text.jsonl", "hello");
    let trace = String::from_utf8(scene.bytes("w.jsonl")).unwrap();
    let header = trace.lines().next().unwrap();
    scene.put("empty.jsonl", header);
    scene.put(
        "old.jsonl",
        &trace.replacen("\"version\":1", "\"version\":99", 1),
    );
    for (arguments, says) in [
        ("absent.jsonl -o p.svg", "absent.jsonl"),
        ("text.jsonl -o p.svg", "text.jsonl is not a trace"),
        ("old.jsonl -o p.svg", "has version 99 of the trace format"),
        (
            "empty.jsonl -o p.svg",
            "empty.jsonl: the trace has no frames",
        ),
        (
            "w.jsonl -o p.bmp",
            "the name of a still ends in .svg or .png",
        ),
        ("w.jsonl -o absent/p.svg", "absent"),
        ("w.jsonl -o w.jsonl", "w.jsonl: the name of a still"),
        (
            "w.jsonl -o p.svg --at 2",
            "--at 2: w.jsonl holds times from 0 to 1",
        ),
        ("w.jsonl -o p.svg --at x", "must be a number"),
        ("w.jsonl -o p.gif --at 0.5", "--at is for stills"),
        (
            "w.jsonl -o p.gif --from 0.8 --to 0.2",
            "cannot end before it begins",
        ),
        (
            "w.jsonl -o p.gif --from -1",
            "--from -1: w.jsonl holds times from 0 to 1",
        ),
        ("w.jsonl -o p.gif --every 0", "must be a number above 0"),
        (
            "w.jsonl -o p.gif --every 1e-300",
            "w.jsonl: a film of 1e300 pictures",
        ),
        ("w.jsonl -o p.gif --speed 1e-9", "the most is 1e5"),
        (
            "w.jsonl -o p.gif --orbit 1e300",
            "must be a number from -3600",
        ),
        (
            "w.jsonl -o p.svg --at 0,1 --overlay --color speed",
            "cannot be used with",
        ),
        (
            "w.jsonl -o p.svg --overlay --at 0,0,0,0,0,0,0,0",
            "--at names 8 moments; at most 7 are drawn over each other",
        ),
        ("w.jsonl -o p.png --fps 10", "--fps is for films"),
        (
            "w.jsonl -o p.svg --camera 10,20",
            "--camera is for worlds in 3-D",
        ),
        (
            "w.jsonl -o p.gif --orbit 10",
            "--orbit is for worlds in 3-D",
        ),
        (
            "w.jsonl -o p.svg --camera 10,200",
            "two numbers, azimuth and elevation",
        ),
        (
            "w.jsonl -o p.svg --view 0,0,0,1",
            "four numbers xmin,ymin,xmax,ymax",
        ),
        (
            "w.jsonl -o p.svg --size 10x10",
            "width x height in pixels, each from 120 to 8192",
        ),
        ("w.jsonl -o p.svg --show bodeis", "did you mean bodies?"),
        ("w.jsonl -o p.svg --only", "--only"),
        ("w.jsonl -o p.svg --overlay", "--at"),
    ] {
        scene.fails(&format!("render {arguments}"), 2, &[says]);
    }
    for name in ["text.jsonl", "empty.jsonl", "old.jsonl"] {
        fs::remove_file(scene.path(name)).unwrap();
    }
    assert_eq!(scene.names(), before);
}

#[test]
fn a_cut_trace_is_drawn_up_to_the_cut() {
    let scene = drawn(2);
    let whole = scene.bytes("w.jsonl");
    let text = String::from_utf8(whole).unwrap();
    // Up to the fifth frame, and the beginning of a sixth.
    let lines: Vec<&str> = text.lines().collect();
    let is_frame = |line: &&str| line.starts_with("{\"record\":\"frame\"");
    let mut starts = (0..lines.len()).filter(|&k| is_frame(&lines[k]));
    let sixth = starts.nth(5).expect("the trace has eleven frames");
    let cut = format!("{}\n{}", lines[..sixth].join("\n"), &lines[sixth][..40]);
    scene.put("cut.jsonl", &cut);
    let done = scene.volary("render cut.jsonl -o p.svg");
    assert_eq!(done.code, Some(0), "{done:?}");
    assert_eq!(
        done.err,
        "Note: the trace ends at t = 0.4, without its summary\n"
    );
    let picture = String::from_utf8(scene.bytes("p.svg")).unwrap();
    assert!(picture.contains("t = 0.4"), "{picture}");
    assert_eq!(scene.succeeds("render cut.jsonl -o q.svg --quiet"), "");
}

#[test]
fn what_the_trace_does_not_hold_is_told() {
    let scene = drawn(2);
    let done = scene.volary("render w.jsonl -o p.svg --show beta,blocked");
    assert_eq!(done.code, Some(0), "{done:?}");
    for says in [
        "β-agents are not in the trace (record.beta_agents)",
        "record.blocked",
    ] {
        assert!(done.err.contains(says), "{done:?}");
    }
}
