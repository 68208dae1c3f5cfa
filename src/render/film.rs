//! A scene as a film.

use std::path::Path;

use crate::picture::{Film, Picture, Pixels, Reel};
use crate::render::{Moment, RenderError, Scene};

/// Films a scene: the moments one after the other, `rate` of them a second. What does not move
/// is painted once, the rest on all threads; `watch` hears of each moment as it is read. The
/// `samples` are some of the moments, for the colours of a GIF. The file appears when the film is
/// whole.
///
/// # Errors
/// What moments cannot be read, painted or written for.
pub fn film<const D: usize>(
    path: &Path,
    scene: &Scene<'_, D>,
    moments: impl ExactSizeIterator<Item = Result<Moment, RenderError>>,
    rate: u32,
    samples: &[Moment],
    overwrite: bool,
    mut watch: impl FnMut(),
) -> Result<(), RenderError> {
    let still = scene.still();
    let base = still.paint()?;
    let paint = |moment: &Moment| -> Result<Pixels, RenderError> {
        let mut picture = Picture::new(still.size, still.background, "");
        picture.marks = scene.moving(moment);
        Ok(picture.paint_over(&base)?)
    };
    let samples: Result<Vec<_>, _> = samples.iter().map(paint).collect();
    let reel = Reel {
        size: [base.width(), base.height()],
        frames: u32::try_from(moments.len()).unwrap_or(u32::MAX),
        rate: rate.into(),
    };
    let mut film = Film::create(path, reel, &samples?, overwrite)?;
    film.shoot(moments.inspect(|_| watch()), |moment| paint(&moment?))?;
    Ok(film.finish()?)
}
