//! Which frames of a trace make a film.

use crate::render::{RenderError, Survey};

/// A piece of a run, as a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clip {
    /// Time at which it begins; absent means the first frame.
    pub from: Option<f64>,
    /// Time at which it ends; absent means the last frame.
    pub to: Option<f64>,
    /// Time between its pictures, above 0; absent means the time between the frames of the trace,
    /// or more where that would make the film longer than [`Clip::LONGEST`].
    pub every: Option<f64>,
    /// Pictures in a second of film.
    pub rate: u32,
}

impl Clip {
    /// Length in seconds of a film that does not say how fast time passes.
    pub const LONGEST: f64 = 20.0;

    /// The most pictures of a film.
    pub const MOST: f64 = 100_000.0;

    /// Numbers of the frames that are nearest to the times of the pictures. Where pictures are
    /// closer in time than frames, a frame is there more than once.
    ///
    /// # Errors
    /// More pictures than [`Clip::MOST`].
    pub fn frames<const D: usize>(&self, survey: &Survey<D>) -> Result<Vec<usize>, RenderError> {
        let [first, last] = survey.span();
        let (from, to) = (self.from.unwrap_or(first), self.to.unwrap_or(last));
        let every = self.every.unwrap_or_else(|| {
            let gaps = survey.times.len().max(2) - 1;
            let apart = (last - first) / gaps as f64;
            let pictures = Self::LONGEST * f64::from(self.rate) - 1.0;
            apart.max((to - from) / pictures)
        });
        let pictures = match every > 0.0 {
            // What is a whole number but for rounding is one.
            true => ((to - from) / every * (1.0 + 1e-9)).floor().max(0.0),
            false => 0.0,
        };
        if pictures >= Self::MOST {
            return Err(RenderError::TooLong { pictures });
        }
        let time = |k: usize| from + every * k as f64;
        Ok((0..=pictures as usize)
            .map(|k| survey.nearest(time(k)))
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn survey(times: impl IntoIterator<Item = f64>) -> Survey<2> {
        Survey {
            times: times.into_iter().collect(),
            ..Survey::new()
        }
    }

    const ALL: Clip = Clip {
        from: None,
        to: None,
        every: None,
        rate: 25,
    };

    #[test]
    fn a_short_run_has_all_its_frames() {
        let survey = survey((0..100).map(|k| f64::from(k) * 0.1));
        assert_eq!(ALL.frames(&survey).unwrap(), (0..100).collect::<Vec<_>>());
    }

    #[test]
    fn a_long_run_takes_twenty_seconds() {
        let survey = survey((0..5001).map(f64::from));
        let frames = ALL.frames(&survey).unwrap();
        assert_eq!(frames.len(), 500);
        assert_eq!((frames[0], frames[499]), (0, 5000));
    }

    #[test]
    fn pieces_and_paces_are_kept() {
        let survey = survey((0..11).map(f64::from));
        let clip = Clip {
            from: Some(2.0),
            to: Some(4.0),
            every: Some(0.5),
            ..ALL
        };
        assert_eq!(clip.frames(&survey).unwrap(), [2, 2, 3, 3, 4]);
        for every in [1e-5, 1e-300] {
            let clip = Clip {
                every: Some(every),
                ..ALL
            };
            let refused = clip.frames(&survey);
            assert!(matches!(refused, Err(RenderError::TooLong { .. })));
        }
    }

    #[test]
    fn a_single_frame_is_a_film_of_one_picture() {
        assert_eq!(ALL.frames(&survey([3.0])).unwrap(), [0]);
    }
}
