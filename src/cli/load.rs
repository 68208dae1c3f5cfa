//! Finding and reading a world that the command line names.

use std::io::IsTerminal;
use std::path::Path;

use volary::world::{AnyWorld, Document, Override, shipped};

use super::Refusal;

/// Reads a world: a file, or else a shipped world of that name.
pub(super) fn load(world: &str, overrides: Vec<Override>) -> Result<AnyWorld, Refusal> {
    let (name, document) = find(world)?;
    let document = document.with(overrides);
    document
        .world(name)
        .map_err(|report| Refusal::bad_input(report.render(std::io::stderr().is_terminal())))
}

/// The document of a world, and the name it runs under.
fn find(world: &str) -> Result<(String, Document), Refusal> {
    let path = Path::new(world);
    if path.is_file() {
        let text = std::fs::read_to_string(path)
            .map_err(|error| Refusal::bad_input(format!("{world}: cannot be read: {error}")))?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        return Ok((name.into_owned(), Document::new(world, text)));
    }
    if let Some(text) = shipped::get(world) {
        return Ok((world.to_owned(), Document::new(world, text)));
    }
    let hint = match shipped::nearest(world) {
        Some(near) => format!("did you mean {near}? "),
        None => String::new(),
    };
    Err(Refusal::bad_input(format!(
        "{world}: neither a world file nor a shipped world; {hint}`volary worlds` lists them"
    )))
}
