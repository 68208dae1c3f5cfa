//! Finding and reading a world that the command line names.

use std::fs::File;
use std::io::{ErrorKind, IsTerminal, Read};
use std::path::Path;

use volary::validate;
use volary::world::check::Motion;
use volary::world::limits::MOST_BYTES;
use volary::world::{AnyWorld, Document, Override, Report, shipped};

use super::Refusal;
use super::progress::Progress;

/// Bytes that are read at once.
const PIECE: u64 = 1 << 20;

/// Reads a world: a file, or else a shipped world of that name.
pub(super) fn load(
    world: &str,
    overrides: Vec<Override>,
    quiet: bool,
) -> Result<AnyWorld, Refusal> {
    load_moved(world, overrides, Motion::OfBodies, quiet)
}

/// As [`load`], of a world whose agents move as bodies or as points.
pub(super) fn load_moved(
    world: &str,
    overrides: Vec<Override>,
    motion: Motion,
    quiet: bool,
) -> Result<AnyWorld, Refusal> {
    let progress = Progress::of_preparation(format!("reading {world}"), quiet);
    let found = find(world);
    let document = found.map(|(name, document)| {
        let document = document.with(overrides).moved(motion);
        let document = document.watched(progress.watch(world));
        (document.world(name), document)
    });
    progress.finish();
    let (world, document) = document?;
    let refuse = |report: Report| Refusal::BadInput(report.render(in_color()));
    let world = world.map_err(refuse)?;
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
        let text = read(path).map_err(|error| match error.kind() {
            ErrorKind::InvalidData => {
                Refusal::bad_input(format!("{world}: not a text file: it is not UTF-8"))
            }
            ErrorKind::FileTooLarge => {
                let most = MOST_BYTES >> 20;
                Refusal::bad_input(format!("{world}: too large; allowed: at most {most} MiB"))
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

/// The text of a file, if it has an end and is text. What is no text is refused as soon as that
/// shows: devices and pipes may go on for ever.
fn read(path: &Path) -> std::io::Result<String> {
    let mut file = File::open(path)?;
    if file
        .metadata()
        .is_ok_and(|data| data.is_file() && data.len() > MOST_BYTES as u64)
    {
        return Err(ErrorKind::FileTooLarge.into());
    }
    let (mut text, mut rest) = (String::new(), Vec::new());
    loop {
        let begun = rest.len();
        if file.by_ref().take(PIECE).read_to_end(&mut rest)? == 0 {
            return match begun {
                0 => Ok(text),
                // The last character is cut.
                _ => Err(ErrorKind::InvalidData.into()),
            };
        }
        let whole = match std::str::from_utf8(&rest) {
            Ok(piece) => piece.len(),
            Err(cut) if cut.error_len().is_none() => cut.valid_up_to(),
            Err(_) => return Err(ErrorKind::InvalidData.into()),
        };
        let piece = rest.drain(..whole).collect();
        let piece = String::from_utf8(piece).map_err(|_| ErrorKind::InvalidData)?;
        // No JSON holds it, and some devices nothing else.
        if text.is_empty() && piece.starts_with('\0') {
            return Err(ErrorKind::InvalidData.into());
        }
        text.push_str(&piece);
        if text.len() > MOST_BYTES {
            return Err(ErrorKind::FileTooLarge.into());
        }
    }
}

/// Whether messages are drawn in colour: for a person who did not opt out.
fn in_color() -> bool {
    let opted_out = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    std::io::stderr().is_terminal() && !opted_out
}
