//! Films as video, by ffmpeg.

use std::ffi::OsStr;
use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::{Encode, FileKind, Reel};
use crate::picture::PictureError;
use crate::stop::Loose;

/// How much of what ffmpeg says is kept, in bytes: its last words.
const TAIL: usize = 1000;

/// Pipes frames to ffmpeg, which writes the file.
pub(super) struct Video {
    child: Arc<Mutex<Child>>,
    /// Has it ended if the process ends early: it would make a file of what it got.
    _loose: Loose,
    /// Where the frames go, until the last.
    frames: Option<ChildStdin>,
    /// What ffmpeg complained of.
    words: Option<JoinHandle<String>>,
}

impl Video {
    /// Starts `program`, which must be an ffmpeg, on the file at `place`.
    pub(super) fn new(
        program: &OsStr,
        place: &Path,
        kind: FileKind,
        reel: &Reel,
    ) -> Result<Self, PictureError> {
        let (ending, codec): (_, &[&str]) = match kind {
            FileKind::Webm => (
                "webm",
                &[
                    "-c:v",
                    "libvpx-vp9",
                    "-crf",
                    "30",
                    "-b:v",
                    "0",
                    "-row-mt",
                    "1",
                    "-deadline",
                    "good",
                    "-cpu-used",
                    "4",
                ],
            ),
            _ => (
                "mp4",
                &[
                    "-c:v",
                    "libx264",
                    "-preset",
                    "fast",
                    "-crf",
                    "20",
                    "-movflags",
                    "+faststart",
                ],
            ),
        };
        let [width, height] = reel.size;
        let mut command = Command::new(program);
        command
            .args(["-hide_banner", "-loglevel", "error", "-f", "rawvideo"])
            .args(["-pix_fmt", "rgba", "-video_size"])
            .arg(format!("{width}x{height}"))
            .args(["-framerate", &reel.rate.to_string(), "-i", "-", "-an"])
            // Colours are stored for blocks of two by two pixels, and by the rule that players
            // assume.
            .args(["-vf", FILTER, "-pix_fmt", "yuv420p"])
            .args(codec)
            .args(["-f", ending, "-y"])
            // A name that begins with a dash would be taken for an option.
            .arg(std::path::absolute(place).unwrap_or_else(|_| place.to_owned()))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        let begin = || command.spawn().map(|child| Arc::new(Mutex::new(child)));
        let kill = |child: &Arc<Mutex<Child>>| -> Box<dyn FnOnce() + Send> {
            let child = Arc::clone(child);
            // Who waits for its end holds it for a moment only.
            Box::new(move || end_now(&mut held(&child)))
        };
        let begun = Loose::end(begin, kill);
        let (child, loose) = begun.map_err(|source| match source.kind() {
            ErrorKind::NotFound => PictureError::NoFfmpeg { ending },
            _ => PictureError::Ffmpeg {
                problem: format!("{}: {source}", program.display()),
            },
        })?;
        let (words, frames) = {
            let mut child = held(&child);
            (child.stderr.take(), child.stdin.take())
        };
        Ok(Self {
            frames,
            words: words.map(|words| std::thread::spawn(|| last_words(words))),
            child,
            _loose: loose,
        })
    }

    /// Waits for the end, and tells what went wrong.
    fn end(&mut self) -> Result<(), PictureError> {
        drop(self.frames.take());
        let status = loop {
            match held(&self.child).try_wait() {
                Ok(None) => {}
                Ok(Some(status)) => break Ok(status),
                Err(error) => break Err(error),
            }
            std::thread::sleep(Duration::from_millis(5));
        };
        let words = self.words.take().map(JoinHandle::join);
        match status {
            Ok(status) if status.success() => Ok(()),
            status => {
                let words = words.and_then(Result::ok).unwrap_or_default();
                Err(PictureError::Ffmpeg {
                    problem: match (words.trim(), status) {
                        ("", Ok(status)) => status.to_string(),
                        ("", Err(error)) => error.to_string(),
                        (words, _) => words.to_owned(),
                    },
                })
            }
        }
    }
}

/// Sides made even, by a row or column less; colours by the rule of BT.709, and said so.
const FILTER: &str = "crop=trunc(iw/2)*2:trunc(ih/2)*2,\
                      scale=out_color_matrix=bt709:out_range=tv,\
                      setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709";

impl Encode for Video {
    fn add(&mut self, _: u32, pixels: &[[u8; 4]]) -> Result<(), PictureError> {
        let frames = self.frames.as_mut();
        match frames.map(|frames| frames.write_all(pixels.as_flattened())) {
            Some(Ok(())) => Ok(()),
            // It has stopped listening: why, it says itself.
            _ => {
                self.end()?;
                Err(PictureError::Ffmpeg {
                    problem: "it ended before the film did".to_owned(),
                })
            }
        }
    }

    fn finish(mut self: Box<Self>) -> Result<(), PictureError> {
        self.end()
    }
}

impl Drop for Video {
    fn drop(&mut self) {
        if self.frames.take().is_some() {
            // Nobody wants the film any more.
            end_now(&mut held(&self.child));
        }
    }
}

fn held(child: &Mutex<Child>) -> MutexGuard<'_, Child> {
    child.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends a program. Best effort: it may have ended by itself.
fn end_now(child: &mut Child) {
    let _ = child.kill();
    let _ = child.wait();
}

/// Reads to the end, and keeps the last lines.
fn last_words(mut source: impl Read) -> String {
    let (mut kept, mut buffer) = (Vec::new(), [0; 4096]);
    while let Ok(count @ 1..) = source.read(&mut buffer) {
        kept.extend_from_slice(&buffer[..count]);
        let old = kept.len().saturating_sub(TAIL);
        kept.drain(..old);
    }
    String::from_utf8_lossy(&kept).into_owned()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use crate::picture::{Color, Picture};

    const REEL: Reel = Reel {
        size: [4, 2],
        frames: 3,
        rate: 12.5,
    };

    /// Lets a program that does this have a film, and gives what comes of it and what the
    /// program wrote.
    fn film(script: &str, kind: FileKind) -> (Result<(), PictureError>, Vec<u8>) {
        let folder = tempfile::tempdir().unwrap();
        let (program, place) = (folder.path().join("ffmpeg"), folder.path().join("film"));
        // Written by another process, for none that is started meanwhile may hold it open.
        let write = "printf '#!/bin/sh\n%s\n' \"$1\" > \"$2\" && chmod +x \"$2\"";
        let mut shell = Command::new("sh");
        shell.args(["-c", write, "sh", script]).arg(&program);
        assert!(shell.status().unwrap().success());
        let page = Picture::new([4.0, 2.0], Color::hex(0x102030), "");
        let pixels = page.paint().unwrap();
        let (pixels, _) = pixels.premultiplied().as_chunks::<4>();
        let mut video = Video::new(program.as_os_str(), &place, kind, &REEL).unwrap();
        let frames: Result<(), _> = (0..3).try_for_each(|k| video.add(k, pixels));
        let done = frames.and_then(|()| Box::new(video).finish());
        (done, std::fs::read(&place).unwrap_or_default())
    }

    /// Writes its arguments, and how many bytes it got, to the file it is told.
    const FAKE: &str = r#"for last; do :; done; echo "$@" > "$last"; wc -c >> "$last""#;

    #[test]
    fn frames_go_to_the_program_that_writes_the_file() {
        for (kind, codec) in [
            (FileKind::Mp4, "-c:v libx264 "),
            (FileKind::Webm, "-c:v libvpx-vp9 "),
        ] {
            let (done, written) = film(FAKE, kind);
            done.unwrap();
            let written = String::from_utf8(written).unwrap();
            let (arguments, bytes) = written.split_once('\n').unwrap();
            for part in [
                "-f rawvideo -pix_fmt rgba -video_size 4x2 -framerate 12.5 -i - ",
                " -pix_fmt yuv420p ",
                codec,
            ] {
                assert!(arguments.contains(part), "{arguments}");
            }
            assert_eq!(bytes.trim(), (4 * 4 * 2 * 3).to_string());
        }
    }

    #[test]
    fn what_went_wrong_is_told_in_the_words_of_the_program() {
        let noise = "for k in 1 2 3 4 5 6 7 8 9; do printf '%0200d' 0 >&2; done";
        let script = format!("cat > /dev/null; {noise}; echo 'Unknown encoder' >&2; exit 3");
        let message = film(&script, FileKind::Mp4).0.unwrap_err().to_string();
        assert!(message.starts_with("ffmpeg failed: 0"), "{message}");
        assert!(message.ends_with("Unknown encoder"), "{message}");
        assert!(message.len() < TAIL + 30);
        let message = film("cat > /dev/null; exit 3", FileKind::Mp4).0;
        let message = message.unwrap_err().to_string();
        assert!(message.contains("exit status: 3"), "{message}");
    }

    #[test]
    fn a_missing_program_is_named() {
        let place = Path::new("film");
        let nobody = OsStr::new("/nowhere/ffmpeg");
        let missing = Video::new(nobody, place, FileKind::Webm, &REEL);
        assert_eq!(
            missing.err().unwrap().to_string(),
            "webm needs ffmpeg, which was not found; .gif and .apng need nothing"
        );
        let folder = tempfile::tempdir().unwrap();
        let unfit = Video::new(folder.path().as_os_str(), place, FileKind::Mp4, &REEL);
        let message = unfit.err().unwrap().to_string();
        assert!(message.starts_with("ffmpeg failed: "), "{message}");
    }
}
