//! `volary claims`, and worlds that expect something of claims.

use serde_json::{Value, json};

use crate::scene::{Scene, crowd};

const CLAIM: &str = "djokam-rathinam/acceleration-bound";

#[test]
fn claims_are_listed_with_their_statements() {
    let scene = Scene::new();
    let list = scene.succeeds("claims");
    let words = list.split_whitespace().collect::<Vec<_>>().join(" ");
    let about = volary::claim::abouts();
    for claim in &about {
        let (paper, name) = claim.name.split_once('/').unwrap();
        assert!(list.lines().any(|line| line == paper), "{paper}: {list}");
        assert!(list.lines().any(|line| line.trim_start().starts_with(name)));
        let statement = claim.statement.split_whitespace().collect::<Vec<_>>();
        assert!(
            words.contains(&statement.join(" ")),
            "{}: {list}",
            claim.name
        );
    }
    let wide = |line: &&str| line.chars().count() > 100;
    assert_eq!(list.lines().find(wide), None);
}

#[test]
fn a_claim_is_printed_in_full() {
    let scene = Scene::new();
    let one = scene.succeeds(&format!("claims {CLAIM}"));
    assert!(one.starts_with(&format!("{CLAIM}\n")), "{one}");
    for label in [
        "source",
        "reading",
        "statement",
        "hypotheses",
        "measured",
        "tolerance",
    ] {
        let has = |line: &str| line.starts_with(&format!("  {label} "));
        assert!(one.lines().any(has), "{label}: {one}");
    }
    let of_paper = scene.succeeds("claims djokam-rathinam");
    assert!(of_paper.contains(&one), "{of_paper}");
    // Named twice, printed once.
    let twice = scene.succeeds(&format!("claims djokam-rathinam/ {CLAIM}"));
    assert_eq!(twice, of_paper);
}

#[test]
fn claims_come_as_json() {
    let scene = Scene::new();
    let read = |arguments: &str| -> Vec<Value> {
        serde_json::from_str(&scene.succeeds(arguments)).unwrap()
    };
    let all = read("claims --json");
    assert_eq!(all.len(), volary::claim::abouts().len());
    let one = read(&format!("claims --json {CLAIM}"));
    assert_eq!(one.len(), 1);
    assert!(all.contains(&one[0]));
    assert_eq!(one[0]["name"], CLAIM);
    assert_eq!(one[0]["reading"], "printed");
    for field in ["source", "statement", "hypotheses", "measured", "tolerance"] {
        assert!(
            one[0][field].as_str().is_some_and(|text| !text.is_empty()),
            "{field}"
        );
    }
}

#[test]
fn unknown_claims_are_bad_input() {
    let scene = Scene::new();
    for (name, says) in [
        ("djokam-rathinam/aceleration-bound", CLAIM),
        ("acceleration-bound", CLAIM),
        ("djokam-ratinam", "did you mean djokam-rathinam?"),
        ("gravity", "`volary claims` lists them"),
    ] {
        let no = format!("{name}: no claim or paper of that name");
        scene.fails(&format!("claims {CLAIM} {name}"), 2, &[&no, says]);
    }
}

#[test]
fn what_a_world_expects_of_claims_is_checked_with_it() {
    let with = |claims: Value| {
        let mut world = crowd(2);
        world["claims"] = claims;
        Scene::with(&world)
    };
    let expects = |claim: &str, verdict: &str| json!({ "claim": claim, "expect": verdict });
    let on = |dynamics: &str, verdict: &str| json!({ "claim": CLAIM, "expect": verdict, "dynamics": dynamics });
    let misspelt = with(json!([expects(
        "djokam-rathinam/aceleration-bound",
        "holds"
    )]));
    for command in ["check", "run"] {
        misspelt.fails(
            &format!("{command} w.json"),
            2,
            &[
                "w.json:1:",
                "claims[0].claim = \"djokam-rathinam/aceleration-bound\": is not the name of a claim",
                "did you mean djokam-rathinam/acceleration-bound?",
            ],
        );
    }
    let twice = with(json!([expects(CLAIM, "holds"), on("points", "violated")]));
    twice.fails(
        "check w.json",
        2,
        &["claims[1].expect = \"violated\": is said before of the same claim and dynamics"],
    );
    let apart = with(json!([on("bodies", "holds"), on("points", "violated")]));
    apart.succeeds("check w.json");
    // What is set from the command line is found there.
    let set = "--set claims[0].claim=gravity";
    apart.fails(
        &format!("run w.json {set}"),
        2,
        &["claims[0].claim=gravity"],
    );
    assert_eq!(apart.names(), ["w.json"]);
}
