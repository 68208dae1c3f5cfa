//! The checked-in schemas are those of the code, and the shipped worlds keep to them.
//!
//! `VOLARY_BLESS=1 cargo test --test schema` writes the schemas anew.

use std::path::{Path, PathBuf};
use std::{env, fs};

use serde_json::{Value, json};
use volary::schema;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> Value {
    let text =
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn worlds(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut worlds = Vec::new();
    for path in entries {
        match path.is_dir() {
            true => worlds.extend(self::worlds(&path)),
            false => worlds.push(path),
        }
    }
    worlds.retain(|path| path.extension().is_some_and(|it| it == "json"));
    worlds
}

#[test]
fn checked_in_schemas_are_current() {
    for (name, schema) in [
        ("world", schema::world()),
        ("trace", schema::trace()),
        ("summary", schema::summary()),
        ("validation", schema::validation()),
    ] {
        let path = root().join("schema").join(format!("{name}.json"));
        if env::var_os("VOLARY_BLESS").is_some() {
            fs::write(&path, schema::text(&schema)).unwrap();
        }
        let stored = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            stored == schema::text(&schema),
            "schema/{name}.json is out of date; write it anew: volary schema {name} > schema/{name}.json"
        );
    }
}

#[test]
fn every_shipped_world_names_and_keeps_the_schema() {
    let validator = jsonschema::validator_for(&schema::world()).unwrap();
    let target = root().join("schema/world.json").canonicalize().unwrap();
    let worlds = worlds(&root().join("worlds"));
    assert!(!worlds.is_empty());
    for path in worlds {
        let world = read(&path);
        let name = world["$schema"]
            .as_str()
            .unwrap_or_else(|| panic!("{}: no $schema", path.display()));
        let named = path.with_file_name(name);
        assert_eq!(
            named.canonicalize().ok().as_ref(),
            Some(&target),
            "{}",
            path.display()
        );
        if let Err(error) = validator.validate(&world) {
            panic!("{}: {}: {error}", path.display(), error.instance_path());
        }
    }
}

#[test]
fn the_schema_refuses_wrong_values() {
    let validator = jsonschema::validator_for(&schema::world()).unwrap();
    let right = json!({
        "dimension": 2,
        "time": {"end": 1},
        "agents": [{"radius": 1, "positions": {"explicit": [[0, 0]]}}],
        "laws": [{"alpha_interaction": {"spacing": 1, "range": 2}}],
    });
    assert!(validator.is_valid(&right));
    for (pointer, wrong) in [
        ("/dimension", json!(4)),
        ("/time", json!({})),
        ("/time/end", json!("soon")),
        ("/agents", json!([])),
        ("/agents/0/radius", json!(0)),
        ("/agents/0/positions", json!({"nowhere": []})),
        (
            "/laws/0",
            json!({"alpha_interaction": {"spacing": 1, "range": 2}, "navigation": {}}),
        ),
        ("/laws/0/alpha_interaction/range", json!(-1)),
        (
            "/laws/0/alpha_interaction",
            json!({"spacing": 1, "range": 2, "rnage": 2}),
        ),
    ] {
        let mut world = right.clone();
        *world.pointer_mut(pointer).unwrap() = wrong;
        assert!(!validator.is_valid(&world), "{pointer}");
    }
}
