//! A trace on its way to a picture.

use volary::picture::FileKind;
use volary::render::{
    Clip, Eye, Moment, Moments, Panel, RenderError, Scene, Survey, film, overlay, strip,
};
use volary::shape::In;
use volary::stop::Stop;
use volary::trace::TraceReader;
use volary::world::World;

use super::RenderArguments;
use crate::cli::Refusal;
use crate::cli::progress::Progress;

/// Moments from which the colours of a GIF are chosen.
const SAMPLES: usize = 6;

/// A trace on its way to a picture.
pub(super) struct Job<'a, const D: usize> {
    pub(super) arguments: &'a RenderArguments,
    /// Whether it is to be a film.
    pub(super) films: bool,
    pub(super) world: &'a World<D>,
    /// Whether someone wants it to stop.
    pub(super) stop: &'a Stop,
}

impl<const D: usize> Job<'_, D>
where
    In<D>: Eye<D>,
{
    /// Reads the trace and draws what is wanted of it.
    pub(super) fn start(&self, reader: TraceReader) -> Result<(), Refusal> {
        let arguments = self.arguments;
        arguments.check_dimension(D)?;
        let spec = &self.world.spec;
        let frames = (spec.time.end / spec.record.every).ceil() as u64 + 1;
        let progress = Progress::of_frames(frames, "reading", arguments.quiet);
        let survey = Survey::read(self.world, reader, |_| progress.advance());
        progress.finish();
        let survey = survey.map_err(|error| arguments.refuse(error))?;
        let wanted = self.wanted(&survey)?;
        // A still shows where all went until then, a film where all go while it lasts.
        let bounds = |it: fn(_, _) -> _| wanted.iter().copied().reduce(it).unwrap_or(0);
        let (first, last) = (bounds(usize::min), bounds(usize::max));
        let survey = survey.during(if self.films { first } else { 0 }, last);
        let scene = Scene::new(self.world, &survey, arguments.look(&survey)?);
        self.tell(&scene, &survey);
        match self.films {
            false => self.still(&scene, &survey, &wanted),
            true => self.film(&scene, &survey, wanted),
        }
    }

    /// Numbers of the frames to draw.
    fn wanted(&self, survey: &Survey<D>) -> Result<Vec<usize>, Refusal> {
        let arguments = self.arguments;
        let span = survey.span();
        let inside = |option, time: Option<f64>| {
            time.map(|time| arguments.within(option, time, span))
                .transpose()
        };
        match self.films {
            false if arguments.at.is_empty() => Ok(vec![survey.times.len() - 1]),
            false => {
                let times = arguments.at.iter();
                let numbers =
                    times.map(|&time| Ok(survey.nearest(arguments.within("--at", time, span)?)));
                numbers.collect()
            }
            true => {
                let rate = arguments.rate();
                let pace = arguments.speed.map(|speed| speed / f64::from(rate));
                let clip = Clip {
                    from: inside("--from", arguments.from)?,
                    to: inside("--to", arguments.to)?,
                    every: arguments.every.or(pace),
                    rate,
                };
                if let (Some(from), Some(to)) = (clip.from, clip.to)
                    && from > to
                {
                    let problem =
                        format!("--from {from} --to {to}: a film cannot end before it begins");
                    return Err(Refusal::bad_input(problem));
                }
                let frames = clip.frames(survey);
                frames.map_err(|error| arguments.refuse(error))
            }
        }
    }

    /// Tells what cannot be shown.
    fn tell(&self, scene: &Scene<'_, D>, survey: &Survey<D>) {
        if self.arguments.quiet {
            return;
        }
        let cut = (!survey.complete).then(|| {
            format!(
                "the trace ends at t = {}, without its summary",
                survey.span()[1]
            )
        });
        for note in scene.notes().into_iter().chain(cut) {
            crate::cli::note(note);
        }
    }

    /// Draws moments in one picture.
    fn still(
        &self,
        scene: &Scene<'_, D>,
        survey: &Survey<D>,
        wanted: &[usize],
    ) -> Result<(), Refusal> {
        let mut order = wanted.to_vec();
        order.sort_unstable();
        order.dedup();
        let read = self.moments(survey, order.clone())?;
        let read = read.map(|moment| moment.map_err(|error| self.arguments.refuse(error)));
        let read = read.collect::<Result<Vec<Moment>, _>>()?;
        let at = |number: &usize| read.get(order.binary_search(number).ok()?).cloned();
        let moments: Vec<Moment> = wanted.iter().filter_map(at).collect();
        let picture = match moments.as_slice() {
            _ if self.arguments.overlay => overlay(scene, &moments),
            [moment] => scene.picture(moment),
            _ => strip(
                scene,
                &moments.into_iter().map(Panel::new).collect::<Vec<_>>(),
            ),
        };
        let written = picture.write(&self.arguments.out, self.arguments.force);
        written.map_err(|error| self.arguments.refuse(error.into()))
    }

    /// Draws a film.
    fn film(
        &self,
        scene: &Scene<'_, D>,
        survey: &Survey<D>,
        wanted: Vec<usize>,
    ) -> Result<(), Refusal> {
        let arguments = self.arguments;
        let samples = match FileKind::of(&arguments.out) {
            Ok(FileKind::Gif) => self.samples(survey, &wanted)?,
            _ => Vec::new(),
        };
        let progress = Progress::of_frames(wanted.len() as u64, "painting", arguments.quiet);
        let turn = arguments.orbit.unwrap_or(0.0) / f64::from(arguments.rate());
        let moments = self
            .moments(survey, wanted)?
            .enumerate()
            .map(|(number, moment)| {
                if self.stop.asked() {
                    return Err(RenderError::Stopped);
                }
                let turn = turn * number as f64;
                Ok(Moment { turn, ..moment? })
            });
        let (path, rate) = (&arguments.out, arguments.rate());
        let watch = || progress.advance();
        let done = film(path, scene, moments, rate, &samples, arguments.force, watch);
        progress.finish();
        done.map_err(|error| arguments.refuse(error))
    }

    /// Some moments of a film, from which the colours of a GIF are chosen.
    fn samples(&self, survey: &Survey<D>, wanted: &[usize]) -> Result<Vec<Moment>, Refusal> {
        let last = wanted.len() - 1;
        let some = (0..SAMPLES)
            .map(|k| wanted[k * last / (SAMPLES - 1)])
            .collect();
        let moments = self.moments(survey, some)?;
        moments
            .collect::<Result<_, _>>()
            .map_err(|error| self.arguments.refuse(error))
    }

    /// The moments of some frames, in order.
    fn moments(&self, survey: &Survey<D>, wanted: Vec<usize>) -> Result<Moments<'_, D>, Refusal> {
        let [first, last] = survey.span();
        let reader = TraceReader::open(&self.arguments.trace).map_err(Refusal::bad_input)?;
        let trail = self.arguments.trail.unwrap_or(0.1 * (last - first));
        Ok(Moments::new(self.world, reader, wanted, trail))
    }
}
