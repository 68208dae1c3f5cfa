//! Films: frames that go to their file one by one.

mod apng;
mod change;
mod clock;
mod gif;
mod kind;
mod palette;
mod video;

use std::borrow::Cow;
use std::fmt;
use std::path::Path;

use rayon::iter::{IntoParallelIterator, ParallelIterator};

pub use kind::FileKind;

use super::{PictureError, Pixels};
use crate::file::WholeFile;
use apng::Apng;
use clock::Clock;
use gif::Gif;
use palette::Palette;
use video::Video;

/// What is known of a film before its first frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reel {
    /// Width and height of every frame, in pixels.
    pub size: [u32; 2],
    /// Number of frames, at least 1.
    pub frames: u32,
    /// Frames a second, 0.1 to 240.
    pub rate: f64,
}

impl Reel {
    fn check(&self) -> Result<(), PictureError> {
        let [width, height] = self.size;
        let sides = 1..=Pixels::MOST;
        if !sides.contains(&width) || !sides.contains(&height) {
            let (width, height) = (width.into(), height.into());
            return Err(PictureError::Size { width, height });
        }
        if !(0.1..=240.0).contains(&self.rate) {
            return Err(PictureError::Rate { rate: self.rate });
        }
        if self.frames == 0 {
            return Err(PictureError::NoFrames);
        }
        Ok(())
    }

    fn clock(&self, ticks: f64) -> Clock {
        Clock {
            rate: self.rate,
            frames: self.frames,
            ticks,
        }
    }
}

/// A film on its way to its file. Nothing is kept of a frame once it is written but what the
/// next one is compared with. The file appears when the film is [finished](Film::finish); a film
/// that is dropped before leaves none. GIF and APNG play for ever.
///
/// Films know no transparency: a page that does not cover is seen over white.
pub struct Film {
    encoder: Box<dyn Encode + Send>,
    file: WholeFile,
    reel: Reel,
    /// Frames written so far.
    done: u32,
}

/// What writes the frames of one kind of film.
trait Encode {
    /// Writes the frame of this number; all of its pixels cover.
    fn add(&mut self, number: u32, pixels: &[[u8; 4]]) -> Result<(), PictureError>;

    /// Writes what comes after the last.
    fn finish(self: Box<Self>) -> Result<(), PictureError>;
}

impl Film {
    /// Begins a film, of the kind that the file's name asks for.
    ///
    /// A GIF has the up to 255 colours that do best for the `samples`, some of its frames, spread
    /// over the film; without any, shades of all colours. What matters and is in none of them
    /// may come out in another colour. It shows 50 frames a second at most, and leaves out what
    /// comes faster. The other kinds do not need samples.
    ///
    /// MP4 and WebM are made by the `ffmpeg` that the environment variable `FFMPEG` names, or
    /// else the one on the path. Sides are made even, by one row or column less.
    ///
    /// # Errors
    /// [`PictureError::Kind`], [`PictureError::Still`] where the name asks for no film;
    /// [`PictureError::Size`], [`PictureError::Rate`], [`PictureError::NoFrames`] for a reel out
    /// of range; [`PictureError::File`] where the file is there already, without `overwrite`, or
    /// cannot be written; [`PictureError::NoFfmpeg`] where that is needed and missing.
    pub fn create(
        path: &Path,
        reel: Reel,
        samples: &[Pixels],
        overwrite: bool,
    ) -> Result<Self, PictureError> {
        let ffmpeg = std::env::var_os("FFMPEG").filter(|name| !name.is_empty());
        let ffmpeg = ffmpeg.unwrap_or_else(|| "ffmpeg".into());
        let kind = FileKind::of(path)?;
        reel.check()?;
        let file = WholeFile::create(path, overwrite)?;
        let encoder: Box<dyn Encode + Send> = match kind {
            FileKind::Svg | FileKind::Png => {
                let name = path.display().to_string();
                return Err(PictureError::Still { name });
            }
            FileKind::Gif => {
                let samples: Vec<_> = samples.iter().map(covering).collect();
                let palette = match samples.is_empty() {
                    true => Palette::of_anything(),
                    false => Palette::of(samples.iter().map(|sample| &**sample)),
                };
                Box::new(Gif::new(file.handle()?, &reel, palette)?)
            }
            FileKind::Apng => Box::new(Apng::new(file.handle()?, &reel)?),
            FileKind::Mp4 | FileKind::Webm => {
                Box::new(Video::new(&ffmpeg, file.place(), kind, &reel)?)
            }
        };
        Ok(Self {
            encoder,
            file,
            reel,
            done: 0,
        })
    }

    /// Writes the next frame.
    ///
    /// # Errors
    /// [`PictureError::OtherSize`] for a frame of another size than the reel's;
    /// [`PictureError::Frames`] for one more than it has; and where writing fails, after which
    /// the film cannot go on.
    pub fn add(&mut self, frame: &Pixels) -> Result<(), PictureError> {
        let (found, expected) = ([frame.width(), frame.height()], self.reel.size);
        if found != expected {
            return Err(PictureError::OtherSize { found, expected });
        }
        if self.done == self.reel.frames {
            return Err(self.miscounted(self.done + 1));
        }
        let added = self.encoder.add(self.done, &covering(frame));
        added.map_err(|error| named(error, &self.file))?;
        self.done += 1;
        Ok(())
    }

    /// Paints frames on all threads, and writes them in their order: while some are painted,
    /// those before are written. `frames` is asked for one after the other.
    ///
    /// # Errors
    /// Those of `paint` and of [`Film::add`]; of many, that of the first frame that has one.
    pub fn shoot<T: Send, E: From<PictureError> + Send>(
        &mut self,
        frames: impl IntoIterator<Item = T>,
        paint: impl Fn(T) -> Result<Pixels, E> + Sync,
    ) -> Result<(), E> {
        let mut frames = frames.into_iter();
        let mut painted = Vec::new();
        let many = self.at_once();
        loop {
            let next: Vec<T> = frames.by_ref().take(many).collect();
            let (last, before) = (next.is_empty(), std::mem::take(&mut painted));
            let (written, now): (Result<(), E>, Vec<Result<Pixels, E>>) = rayon::join(
                || {
                    before
                        .into_iter()
                        .try_for_each(|frame| Ok(self.add(&frame?)?))
                },
                || next.into_par_iter().map(&paint).collect(),
            );
            written?;
            if last {
                return Ok(());
            }
            painted = now;
        }
    }

    /// How many frames are painted at once: enough for all threads, and not more than fit into
    /// 256 MiB.
    fn at_once(&self) -> usize {
        let [width, height] = self.reel.size.map(|side| side as usize);
        let fit = (256 << 20) / (4 * width * height);
        (4 * rayon::current_num_threads()).min(fit).max(1)
    }

    /// Ends the film and gives the file its name.
    ///
    /// # Errors
    /// [`PictureError::Frames`] where frames are missing, and where writing fails. Then there is
    /// no file.
    pub fn finish(self) -> Result<(), PictureError> {
        if self.done != self.reel.frames {
            return Err(self.miscounted(self.done));
        }
        let ended = self.encoder.finish();
        ended.map_err(|error| named(error, &self.file))?;
        Ok(self.file.finish()?)
    }

    fn miscounted(&self, found: u32) -> PictureError {
        let expected = self.reel.frames;
        PictureError::Frames { found, expected }
    }
}

impl fmt::Debug for Film {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Film")
            .field("file", &self.file)
            .field("reel", &self.reel)
            .field("done", &self.done)
            .finish_non_exhaustive()
    }
}

/// What the system says, with the name of the file.
fn named(error: PictureError, file: &WholeFile) -> PictureError {
    match error {
        PictureError::Png(png::EncodingError::IoError(error))
        | PictureError::Gif(::gif::EncodingError::Io(error)) => file.failure(error).into(),
        error => error,
    }
}

/// The pixels of a frame, over white where they do not cover.
fn covering(frame: &Pixels) -> Cow<'_, [[u8; 4]]> {
    let (pixels, _) = frame.premultiplied().as_chunks::<4>();
    if pixels.iter().all(|pixel| pixel[3] == 255) {
        return Cow::Borrowed(pixels);
    }
    let over = pixels.iter().map(|&[red, green, blue, opacity]| {
        let white = 255 - opacity;
        [red + white, green + white, blue + white, 255]
    });
    Cow::Owned(over.collect())
}
