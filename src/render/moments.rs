//! The moments of a trace that are wanted, read one after the other.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;

use crate::render::{Moment, Past, RenderError, Survey};
use crate::trace::{Record, TraceReader};
use crate::world::{AnyWorld, World};

/// The most points that a trail keeps.
const POINTS: usize = 400;

/// Opens a trace, and builds its world.
///
/// # Errors
/// A file that is no trace, or that has no sound world.
pub fn open(path: &Path) -> Result<(AnyWorld, TraceReader), RenderError> {
    let reader = TraceReader::open(path)?;
    let header = reader.header();
    let world = AnyWorld::of_points(header.name.clone(), header.world.clone());
    Ok((world.map_err(RenderError::World)?, reader))
}

impl<const D: usize> Survey<D> {
    /// Reads a trace of this world to its end, or to where it is cut, and calls `watch` with the
    /// time of each frame.
    ///
    /// # Errors
    /// A trace that is broken, does not fit the world, or has no frame.
    pub fn read(
        world: &World<D>,
        reader: TraceReader,
        mut watch: impl FnMut(f64),
    ) -> Result<Self, RenderError> {
        let mut survey = Self::new();
        for record in reader {
            let record = record?;
            survey.take(world, &record)?;
            if let Record::Frame(frame) = &record {
                watch(frame.time);
            }
        }
        survey.finish()
    }
}

/// Reads some frames of a trace, with what trails need of the time before each. No more of the
/// trace is held than that.
#[derive(Debug)]
pub struct Moments<'a, const D: usize> {
    world: &'a World<D>,
    reader: TraceReader,
    /// Numbers of the frames that are wanted, the next one last.
    wanted: Vec<usize>,
    /// Number of the frame to read next.
    next: usize,
    /// The frame read last.
    last: Option<Moment>,
    /// How long trails are, and how far apart in time their points.
    trail: f64,
    apart: f64,
    past: VecDeque<Arc<Past>>,
}

impl<'a, const D: usize> Moments<'a, D> {
    /// The frames of these numbers, which may repeat but not decrease, with trails over a time.
    pub fn new(world: &'a World<D>, reader: TraceReader, wanted: Vec<usize>, trail: f64) -> Self {
        let mut wanted = wanted;
        wanted.reverse();
        Self {
            world,
            reader,
            wanted,
            next: 0,
            last: None,
            trail,
            apart: 0.0,
            past: VecDeque::new(),
        }
    }

    /// The next moment; nothing where the trace ends before it.
    fn read(&mut self, number: usize) -> Result<Option<Moment>, RenderError> {
        if number < self.next {
            return Ok(self.last.clone());
        }
        while let Some(record) = self.reader.next().transpose()? {
            let Record::Frame(frame) = record else {
                continue;
            };
            let here = self.next;
            self.next += 1;
            if here == number {
                super::survey::fits(self.world, &frame)?;
                let mut moment = Moment::new(frame);
                moment.trail = self.trail_at(moment.frame.time);
                if self.trail > 0.0 {
                    self.remember(moment.frame.time, moment.frame.positions.clone());
                }
                self.last = Some(moment.clone());
                return Ok(Some(moment));
            }
            if self.trail > 0.0 {
                self.remember(frame.time, frame.positions);
            }
        }
        Ok(None)
    }

    fn trail_at(&self, time: f64) -> Vec<Arc<Past>> {
        let young = self
            .past
            .iter()
            .filter(|past| past.time >= time - self.trail);
        young.cloned().collect()
    }

    fn remember(&mut self, time: f64, positions: Vec<Vec<f64>>) {
        while self
            .past
            .front()
            .is_some_and(|past| past.time < time - self.trail)
        {
            self.past.pop_front();
        }
        if self
            .past
            .back()
            .is_some_and(|past| time - past.time < self.apart)
        {
            return;
        }
        self.past.push_back(Arc::new(Past { time, positions }));
        if self.past.len() > POINTS {
            // Half of the points are enough, and then only every other new one.
            let all = std::mem::take(&mut self.past);
            let [first, last] = [all.front(), all.back()].map(|it| it.map_or(0.0, |it| it.time));
            self.apart = 2.0 * (last - first) / POINTS as f64 * (1.0 - 1e-9);
            self.past = all.into_iter().step_by(2).collect();
        }
    }
}

impl<const D: usize> Iterator for Moments<'_, D> {
    type Item = Result<Moment, RenderError>;

    fn next(&mut self) -> Option<Self::Item> {
        let number = self.wanted.pop()?;
        let moment = self.read(number).transpose();
        if !matches!(moment, Some(Ok(_))) {
            self.wanted.clear();
        }
        moment
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.wanted.len(), Some(self.wanted.len()))
    }
}

impl<const D: usize> ExactSizeIterator for Moments<'_, D> {}
