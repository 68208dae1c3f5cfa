//! Traces as they lie, in the eyes of readers that make one column of each field: each line is
//! an object that names its kind, and a field has one type in all records that have it.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::scene::{Scene, crowd};

/// The type of each field so far, by its path; lists share one for all elements.
type Types = BTreeMap<String, &'static str>;

/// Adds the types of a value's fields.
///
/// # Errors
/// The first field that has another type than before.
fn add(path: &str, value: &Value, types: &mut Types) -> Result<(), String> {
    let kind = match value {
        // Every type has a null.
        Value::Null => return Ok(()),
        Value::Bool(_) => "truth",
        Value::Number(number) if number.is_f64() => "number with a point",
        Value::Number(_) => "whole number",
        Value::String(_) => "text",
        Value::Array(_) => "list",
        Value::Object(_) => "object",
    };
    let known = types.entry(path.to_owned()).or_insert(kind);
    if *known != kind {
        return Err(format!("{path} is a {known}, and a {kind}"));
    }
    match value {
        Value::Array(list) => list
            .iter()
            .try_for_each(|one| add(&format!("{path}[]"), one, types)),
        Value::Object(fields) => {
            let mut fields = fields.iter();
            fields.try_for_each(|(name, one)| add(&format!("{path}.{name}"), one, types))
        }
        _ => Ok(()),
    }
}

/// The types of a trace, but for those inside its world: a world's lists of laws, shapes and
/// groups hold objects of many kinds.
fn types(trace: &str) -> Result<Types, String> {
    let mut types = Types::new();
    for line in trace.lines() {
        let mut record: Value = serde_json::from_str(line).map_err(|e| e.to_string())?;
        if !record["record"].is_string() {
            return Err(format!("no record: {line}"));
        }
        if record["record"] == "header" {
            record["world"] = json!({});
        }
        add("", &record, &mut types)?;
    }
    Ok(types)
}

#[test]
fn a_field_has_one_type() {
    let everything = "--set record.accelerations=true --set record.beta_agents=true \
        --set record.edges=true --set record.net=true --set record.links=true \
        --set record.laws=true --set record.blocked=true --quiet --trace t.jsonl --force";
    let mut seen = Types::new();
    for (world, until) in [
        ("two.json", 1.0),
        ("three.json", 1.0),
        ("courses/rods", 0.2),
        ("courses/rotating-door", 0.2),
        ("djokam-rathinam/mill-ring-3d", 0.2),
        ("song-2013/example-18", 0.2),
    ] {
        let scene = Scene::new();
        scene.put("two.json", &crowd(2).to_string());
        scene.put("three.json", &crowd(3).to_string());
        scene.succeeds(&format!(
            "run {world} --until {until} --set record.every=0.1 {everything}"
        ));
        let trace = String::from_utf8(scene.bytes("t.jsonl")).unwrap();
        let types = types(&trace).unwrap_or_else(|problem| panic!("{world}: {problem}"));
        // Nowhere but in rotations do two worlds differ.
        for (path, kind) in types {
            let known = *seen.entry(path.clone()).or_insert(kind);
            assert!(
                known == kind || path.contains("rotation"),
                "{world}: {path} is a {kind}"
            );
        }
    }
    for path in [
        ".time",
        ".metrics.density",
        ".net.rigid",
        ".laws.energy",
        ".position[]",
        ".final.order",
        ".obstacles[].rotation",
        ".rotations[]",
        ".beta_agents[].distance",
        ".links[][]",
    ] {
        assert!(seen.contains_key(path), "nothing recorded {path}: {seen:?}");
    }
}

#[test]
fn other_types_are_noticed() {
    let frame = r#"{"record":"frame","time":0.0,"metrics":{"density":null}}"#;
    for (line, problem) in [
        (
            r#"{"record":"frame","time":1}"#,
            ".time is a number with a point, and a whole number",
        ),
        (
            r#"{"record":"frame","metrics":{"density":1.0},"time":"now"}"#,
            ".time",
        ),
        (r#"{"record":"contact","metrics":[1.0,2]}"#, ".metrics"),
        (r#"{"record":"contact","position":[1.0,2]}"#, ".position[]"),
        (r#"{"time":0.0}"#, "no record"),
    ] {
        let found = types(&format!("{frame}\n{line}\n")).unwrap_err();
        assert!(found.contains(problem), "{found}");
    }
    assert!(types(&format!("{frame}\n{}\n", frame.replace("null", "1.0"))).is_ok());
}
