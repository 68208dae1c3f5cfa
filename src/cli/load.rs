//! Finding and reading a world that the command line names.

use std::io::{ErrorKind, IsTerminal};
use std::path::Path;

use volary::validate;
use volary::world::check::Motion;
use volary::world::{AnyWorld, Document, Override, Report, shipped};

use super::Refusal;

/// Reads a world: a file, or else a shipped world of that name.
pub(super) fn load(world: &str, overrides: Vec<Override>) -> Result<AnyWorld, Refusal> {
    load_moved(world, overrides, Motion::OfBodies)
}

/// As [`load`], of a world whose agents move as bodies or as points.
pub(super) fn load_moved(
    world: &str,
    overrides: Vec<Override>,
    motion: Motion,
) -> Result<AnyWorld, Refusal> {
    let (name, document) = find(world)?;
    let document = document.with(overrides).moved(motion);
    let refuse = |report: Report| Refusal::BadInput(report.render(in_color()));
    let world = document.world(name).map_err(refuse)?;
    // Worlds know no claims, so what is wrong with those they name shows only here.
    let problems = match &world {
        AnyWorld::Plane(world) => validate::problems(&world.spec),
        AnyWorld::Space(world) => validate::problems(&world.spec),
    };
    match problems.is_empty() {
        true => Ok(world),
        false => Err(refuse(document.report(problems))),
    }
}

/// Overrides as the command line has them, `path=value`.
pub(super) fn overrides(settings: &[String]) -> Result<Vec<Override>, Refusal> {
    let parsed = settings.iter().map(|setting| {
        let parsed: Result<Override, _> = setting.parse();
        parsed.map_err(|error| Refusal::bad_input(format!("--set: {error}")))
    });
    parsed.collect()
}

/// The document of a world, and the name it runs under.
fn find(world: &str) -> Result<(String, Document), Refusal> {
    let path = Path::new(world);
    // A pipe will do as well as a file.
    if path.exists() && !path.is_dir() {
        let text = std::fs::read_to_string(path).map_err(|error| match error.kind() {
            ErrorKind::InvalidData => {
                Refusal::bad_input(format!("{world}: not a text file: it is not UTF-8"))
            }
            _ => Refusal::bad_input(format!("{world}: cannot be read: {error}")),
        })?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        return Ok((name.into_owned(), Document::new(world, text)));
    }
    if let Some(text) = shipped::get(world) {
        return Ok((world.to_owned(), Document::new(world, text)));
    }
    if path.is_dir() {
        return Err(Refusal::bad_input(format!("{world}: this is a folder")));
    }
    let hint = match shipped::nearest(world) {
        Some(near) => format!("did you mean {near}? "),
        None => String::new(),
    };
    Err(Refusal::bad_input(format!(
        "{world}: neither a file nor a shipped world; {hint}`volary worlds` lists them"
    )))
}

/// Whether messages are drawn in colour: for a person who did not opt out.
fn in_color() -> bool {
    let opted_out = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    std::io::stderr().is_terminal() && !opted_out
}
