//! Every bad world in `tests/bad` fails with exactly the message beside it.
//!
//! `VOLARY_BLESS=1 cargo test --test bad_worlds` writes the messages anew; look at
//! each of them before you keep it. `VOLARY_SHOW=1` with `--nocapture` prints them
//! as a terminal would show them.

use std::path::{Path, PathBuf};
use std::{env, fs};

use proptest::prelude::*;
use volary::world::document::Document;
use volary::world::shipped;

fn bad_worlds() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad");
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut worlds: Vec<PathBuf> = entries
        .filter(|path| path.extension().is_some_and(|it| it == "json"))
        .collect();
    worlds.sort();
    worlds
}

#[test]
fn bad_worlds_say_what_is_wrong() {
    let (bless, show) = (
        env::var_os("VOLARY_BLESS").is_some(),
        env::var_os("VOLARY_SHOW").is_some(),
    );
    let worlds = bad_worlds();
    assert!(worlds.len() >= 16);
    let mut wrong = Vec::new();
    for path in worlds {
        let name = path.file_name().unwrap().to_str().unwrap();
        let document = Document::new(name, fs::read_to_string(&path).unwrap());
        let report = document.world("bad").expect_err(name);
        let message = format!("{report}\n");
        if show {
            println!("{}", report.render(true));
        }
        let drawn = report.render(false);
        for line in message.lines() {
            // The drawing names the same place: name:line:column.
            let place = line.split(": ").next().unwrap();
            assert!(drawn.contains(place), "{place} is not in\n{drawn}");
        }
        let beside = path.with_extension("expected");
        if bless {
            fs::write(&beside, &message).unwrap();
        }
        let expected = fs::read_to_string(&beside).unwrap_or_default();
        if message != expected {
            wrong.push(format!(
                "{name}\n--- expected\n{expected}--- found\n{message}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_shipped_world_reads() {
    for name in shipped::names() {
        let document = Document::new(name.as_str(), shipped::get(&name).unwrap());
        if let Err(report) = document.world(name.as_str()) {
            panic!("{report}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever happens to a file, reading it gives a world or a report.
    #[test]
    fn no_text_panics(edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4), 1..4)) {
        const TOKENS: &[u8] = b"{}[],:\"-+.eE019 \n\\/tnu";
        let mut bytes = shipped::get("olfati-saber-2003/six-obstacles").unwrap().as_bytes().to_vec();
        for (at, byte, kind) in edits {
            let at = at.index(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => bytes[at] = TOKENS[byte as usize % TOKENS.len()],
                2 => bytes.insert(at, TOKENS[byte as usize % TOKENS.len()]),
                _ => drop(bytes.drain(at..bytes.len().min(at + 1 + byte as usize))),
            }
            if bytes.is_empty() {
                break;
            }
        }
        let document = Document::new("mutated.json", String::from_utf8_lossy(&bytes));
        if let Err(report) = document.spec() {
            prop_assert!(report.problems().len() > 0);
            prop_assert!(report.to_string().starts_with("mutated.json"));
            prop_assert!(!report.render(true).is_empty());
        }
    }
}
