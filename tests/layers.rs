//! The layers of the crate: imports point one way, downwards.

use std::path::Path;

/// From the bottom up. A module may use those before it in the list, and itself.
const LAYERS: [&str; 27] = [
    "profile",
    "parallel",
    "stop",
    "file",
    "csv",
    "math",
    "picture",
    "plot",
    "sum",
    "shape",
    "world",
    "sense",
    "net",
    "law",
    "dynamics",
    "trace",
    "metric",
    "reduced",
    "claim",
    "simulation",
    "checkpoint",
    "validate",
    "export",
    "render",
    "series",
    "figure",
    "schema",
];

fn rust_files(folder: &Path, found: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the entry can be read").path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn imports_point_downwards() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    let mut looked_at = 0;
    for file in files {
        let inside = file.strip_prefix(&source).expect("it is below src");
        let first = inside.components().next().expect("it has a name");
        let layer = first.as_os_str().to_string_lossy().replace(".rs", "");
        let Some(height) = LAYERS.iter().position(|name| *name == layer) else {
            assert!(
                ["lib", "main", "cli"].contains(&layer.as_str()),
                "{layer} has no layer"
            );
            continue;
        };
        let text = std::fs::read_to_string(&file).expect("the file can be read");
        for (number, line) in text.lines().enumerate() {
            for used in line.split("crate::").skip(1) {
                let used: String = used.chars().take_while(char::is_ascii_lowercase).collect();
                let Some(target) = LAYERS.iter().position(|name| *name == used) else {
                    continue;
                };
                looked_at += 1;
                let allowed = target <= height;
                let place = format!("{}:{}", file.display(), number + 1);
                assert!(
                    allowed,
                    "{place}: {layer} must not use {used}, which lies above it"
                );
            }
        }
    }
    assert!(
        looked_at > 50,
        "only {looked_at} imports found: is the test looking at the source?"
    );
}
