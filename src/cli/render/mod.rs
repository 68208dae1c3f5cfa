//! `volary render`: what happens in a trace, drawn.

mod arguments;
mod job;

use volary::file::check_whole;
use volary::picture::FileKind;
use volary::render::open;
use volary::stop::Stop;
use volary::world::AnyWorld;

use super::{Refusal, files};
pub(super) use arguments::RenderArguments;
use job::Job;

/// Draws what happens in a trace.
pub(super) fn render(arguments: &RenderArguments, stop: &Stop) -> Result<(), Refusal> {
    let films = FileKind::of(&arguments.out)
        .map_err(Refusal::bad_input)?
        .is_film();
    arguments.check(films)?;
    files::apart(&[
        ("trace", Some(&arguments.trace)),
        ("picture", Some(&arguments.out)),
    ])?;
    check_whole(&arguments.out, arguments.force).map_err(files::refuse_file)?;
    if arguments.trace.exists() && !arguments.trace.is_file() && !arguments.trace.is_dir() {
        return Err(Refusal::bad_input(format!(
            "{}: a trace is read twice to be drawn, so it must be a regular file",
            arguments.trace.display()
        )));
    }
    let (world, reader) = open(&arguments.trace).map_err(|error| arguments.refuse(error))?;
    arguments.threads.install(|| match world {
        AnyWorld::Plane(world) => Job {
            arguments,
            films,
            world: &world,
            stop,
        }
        .start(reader),
        AnyWorld::Space(world) => Job {
            arguments,
            films,
            world: &world,
            stop,
        }
        .start(reader),
    })
}
