//! `volary run --profile`.

use crate::scene::{Scene, crowd};

/// The parts of a run, with their seconds and percentages, from what it prints.
fn parts(printed: &str) -> Vec<(String, f64, f64)> {
    let table = printed.split("where the time went\n").nth(1);
    let table = table.unwrap_or_else(|| panic!("no table in\n{printed}"));
    let part = |line: &str| {
        let (name, numbers) = line.split_at(26);
        let mut numbers = numbers.split_whitespace();
        let mut number = || numbers.find_map(|word| word.parse::<f64>().ok()).unwrap();
        (name.trim().to_owned(), number(), number())
    };
    table.lines().map(part).collect()
}

#[test]
fn a_run_tells_where_its_time_went() {
    let bodies = [
        "senses",
        "law alpha_interaction",
        "law obstacle_avoidance",
        "law navigation",
        "engine",
        "contacts",
        "coupling",
        "ledger",
        "metrics",
        "trace",
        "the rest",
    ];
    for dimension in [2, 3] {
        let scene = Scene::with(&crowd(dimension));
        let printed = scene.succeeds("run w.json --profile --trace t.jsonl.gz --until 1");
        let found = parts(&printed);
        let names: Vec<_> = found.iter().map(|(name, ..)| name.as_str()).collect();
        assert_eq!(names, bodies, "{printed}");
        let all: f64 = found.iter().map(|(.., share)| share).sum();
        assert!((all - 100.0).abs() < 1.0, "{printed}");
        // Each of them does something, however quick; the other parts may round to 0.
        for name in ["engine", "metrics"] {
            let (.., share) = found.iter().find(|it| it.0 == name).unwrap();
            assert!(*share > 0.0, "{name} in\n{printed}");
        }
        assert!(
            !scene
                .succeeds("run w.json --until 1")
                .contains("where the time")
        );
    }
}

#[test]
fn points_have_a_solver_and_nothing_to_touch() {
    let scene = Scene::with(&crowd(2));
    let printed = scene.succeeds("run w.json --profile --quiet --dynamics points --until 1");
    let found = parts(&printed);
    let names: Vec<_> = found.iter().map(|(name, ..)| name.as_str()).collect();
    assert!(
        names.contains(&"solver") && !names.contains(&"engine"),
        "{printed}"
    );
}
