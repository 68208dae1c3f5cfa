//! Reports in files.

use std::fs;

use serde_json::{Value, json};
use volary::validate::form::{check, html, markdown, write};
use volary::validate::report::Report;

use crate::sample::{full, report};

#[test]
fn the_name_chooses_the_form() {
    let folder = tempfile::tempdir().unwrap();
    let report = full();
    let read = |name: &str| {
        let path = folder.path().join(name);
        check(&path, false).unwrap();
        assert!(!path.exists(), "checking writes nothing");
        write(&path, &report, false).unwrap();
        let again = write(&path, &report, false).unwrap_err();
        assert!(again.to_string().contains("exists already"), "{again}");
        assert!(check(&path, false).is_err());
        write(&path, &report, true).unwrap();
        fs::read_to_string(path).unwrap()
    };
    assert_eq!(read("r.HTML"), html(&report));
    assert_eq!(read("r.md"), markdown(&report));
    let back: Report = serde_json::from_str(&read("r.json")).unwrap();
    assert_eq!(back, report);
}

#[test]
fn other_names_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["r", "r.txt", "r.json.gz", ".json"] {
        let path = folder.path().join(name);
        let errors = [check(&path, true), write(&path, &full(), true)];
        for error in errors.map(Result::unwrap_err) {
            let says = format!("{name}: the name of a report ends in .json, .md or .html");
            assert!(error.to_string().ends_with(&says), "{error}");
        }
    }
    let missing = folder.path().join("no/r.json");
    assert!(check(&missing, false).is_err());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn what_json_cannot_hold_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.json");
    let mut report = full();
    report.worlds[0].end = f64::NAN;
    let error = write(&path, &report, false).unwrap_err().to_string();
    assert!(error.contains("worlds[0].end"), "{error}");
    assert!(!path.exists());
}

#[test]
fn reports_keep_to_their_schema() {
    let validator = jsonschema::validator_for(&volary::schema::validation()).unwrap();
    for report in [full(), report(Vec::new())] {
        let value = serde_json::to_value(&report).unwrap();
        if let Err(error) = validator.validate(&value) {
            panic!("{}: {error}", error.instance_path());
        }
    }
    let right = serde_json::to_value(full()).unwrap();
    let finding = "/worlds/0/claims/0/findings/0";
    for (pointer, wrong) in [
        ("/worlds", Value::Null),
        ("/as_expected", json!("yes")),
        ("/worlds/0/runs/0/dynamics", json!("waves")),
        (&format!("{finding}/finding/verdict"), json!("splendid")),
        (&format!("{finding}/finding/curves/0/side"), json!("beside")),
        ("/worlds/0/contact/exclusions/0/outcome", json!("none")),
    ] {
        let mut report = right.clone();
        *report.pointer_mut(pointer).unwrap() = wrong;
        assert!(!validator.is_valid(&report), "{pointer}");
    }
}
