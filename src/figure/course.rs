//! The runs that figures are drawn from.

use std::collections::{BTreeMap, BTreeSet};
use std::convert::Infallible;
use std::ops::ControlFlow;

use rayon::prelude::*;

use super::Trouble;
use crate::dynamics::{Accuracy, Dynamics, Snapshot};
use crate::math::Vector;
use crate::simulation::Simulation;
use crate::trace::record::{Frame, Outcome, Record, Summary};
use crate::world::{AnyWorld, Document, World, shipped, vector};

/// A run that a figure needs: of a shipped world in the plane, with some of its values set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Wanted {
    /// Name of the shipped world.
    pub world: &'static str,
    /// What is set in it, as `path=value`.
    pub settings: &'static [&'static str],
    /// Whether its agents are the points of the paper; bodies otherwise.
    pub points: bool,
}

/// A run: what moved, and the states that its world records.
#[derive(Debug, Clone)]
pub struct Course {
    /// The world.
    pub world: World<2>,
    /// The frames of its trace, of which there is at least one.
    pub frames: Vec<Frame>,
    /// The summary of its trace.
    pub summary: Summary,
}

/// Positions or velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Of {
    /// Positions.
    Positions,
    /// Velocities.
    Velocities,
}

impl Of {
    /// Those of all agents in a frame.
    pub fn all(self, frame: &Frame) -> &[Vec<f64>] {
        match self {
            Self::Positions => &frame.positions,
            Self::Velocities => &frame.velocities,
        }
    }

    /// The way of an agent through their space.
    pub fn track(self, frames: &[Frame], agent: usize) -> impl Iterator<Item = [f64; 2]> {
        let state = move |frame| self.all(frame)[agent].as_slice();
        frames
            .iter()
            .map(move |frame| state(frame).try_into().unwrap_or([f64::NAN; 2]))
    }

    /// A component of that of an agent against time.
    pub fn component(
        self,
        frames: &[Frame],
        agent: usize,
        axis: usize,
    ) -> impl Iterator<Item = [f64; 2]> {
        frames
            .iter()
            .map(move |frame| [frame.time, self.all(frame)[agent][axis]])
    }

    /// The same as vectors.
    pub fn vectors(self, frame: &Frame) -> Vec<Vector<2>> {
        self.all(frame).iter().map(|it| vector(it)).collect()
    }
}

/// Runs, by what was wanted.
#[derive(Debug, Default)]
pub struct Courses(BTreeMap<Wanted, Course>);

impl Wanted {
    /// A run of bodies.
    pub const fn bodies(world: &'static str, settings: &'static [&'static str]) -> Self {
        Self {
            world,
            settings,
            points: false,
        }
    }

    /// A run of points, to the solver's usual accuracy.
    pub const fn points(world: &'static str, settings: &'static [&'static str]) -> Self {
        Self {
            world,
            settings,
            points: true,
        }
    }

    /// Its world, at its start.
    ///
    /// # Errors
    /// Where there is no such world in the plane, or what is set in it makes no sense.
    pub fn load(&self) -> Result<World<2>, Trouble> {
        let refuse = |problem: String| Trouble::new(self.world, problem);
        let text = shipped::get(self.world);
        let text = text.ok_or_else(|| refuse("no shipped world of that name".to_owned()))?;
        let settings = self.settings.iter().map(|setting| setting.parse());
        let settings: Result<Vec<_>, _> = settings.collect();
        let settings = settings.map_err(|error| refuse(format!("{error}")))?;
        let document = Document::new(self.world, text).with(settings);
        match document.world(self.world) {
            Ok(AnyWorld::Plane(world)) => Ok(world),
            Ok(AnyWorld::Space(_)) => Err(refuse("figures are of the plane".to_owned())),
            Err(report) => Err(refuse(report.render(false))),
        }
    }

    /// Runs it to its end; `stepped` is called after each step.
    ///
    /// # Errors
    /// As [`Wanted::load`], and where the run cannot go on to its end.
    pub fn run(&self, stepped: &(dyn Fn() + Sync)) -> Result<Course, Trouble> {
        let world = self.load()?;
        let failed = |problem: String| Trouble::new(self.world, problem);
        let dynamics = match self.points {
            true => Dynamics::Points(Accuracy::default()),
            false => Dynamics::Bodies,
        };
        let simulation = Simulation::with_dynamics(world.clone(), Vec::new(), dynamics);
        let mut simulation = simulation.map_err(|failure| failed(failure.to_string()))?;
        let mut frames = Vec::new();
        let record = |record: Record| {
            if let Record::Frame(frame) = record {
                frames.push(frame);
            }
            Ok::<_, Infallible>(())
        };
        let watch = |_: &Snapshot<'_, 2>| {
            stepped();
            ControlFlow::Continue(())
        };
        let Ok(summary) = simulation.run(record, watch);
        match summary.outcome {
            Outcome::Completed => Ok(Course {
                world,
                frames,
                summary,
            }),
            _ => Err(failed(summary.error.unwrap_or_default())),
        }
    }
}

impl Course {
    /// The times of the frames.
    pub fn times(&self) -> Vec<f64> {
        self.frames.iter().map(|frame| frame.time).collect()
    }

    /// The first state.
    pub fn first(&self) -> &Frame {
        &self.frames[0]
    }

    /// The last state.
    pub fn last(&self) -> &Frame {
        &self.frames[self.frames.len() - 1]
    }

    /// The last frame that is not after a time; the first, where all are.
    pub fn at(&self, time: f64) -> &Frame {
        &self.frames[self.after(time).max(1) - 1]
    }

    /// Number of the first frame after a time.
    fn after(&self, time: f64) -> usize {
        // Times are steps times their size: a frame may come out a rounding late.
        let late = time + 1e-9 * time.abs().max(1.0);
        self.frames.partition_point(|frame| frame.time <= late)
    }

    /// A number of each frame.
    pub fn series(&self, of: impl FnMut(&Frame) -> f64) -> Vec<f64> {
        self.frames.iter().map(of).collect()
    }

    /// The frames up to a time, at least the first.
    pub fn until(&self, time: f64) -> &[Frame] {
        &self.frames[..self.after(time).max(1)]
    }

    /// Number of agents.
    pub fn agents(&self) -> usize {
        self.world.agents.len()
    }
}

impl Courses {
    /// Runs all that is wanted, each once, side by side; `stepped` is called after each step of
    /// any of them.
    ///
    /// # Errors
    /// The first of those of [`Wanted::run`].
    pub fn run(wanted: BTreeSet<Wanted>, stepped: &(dyn Fn() + Sync)) -> Result<Self, Trouble> {
        let courses: Result<Vec<_>, Trouble> = wanted
            .into_par_iter()
            .map(|wanted| Ok((wanted, wanted.run(stepped)?)))
            .collect();
        Ok(Self(courses?.into_iter().collect()))
    }

    /// A run.
    ///
    /// # Errors
    /// Where it was not among those wanted.
    pub fn get(&self, wanted: &Wanted) -> Result<&Course, Trouble> {
        self.0.get(wanted).ok_or_else(|| {
            Trouble::new(
                wanted.world,
                "the figure did not say that it needs this run",
            )
        })
    }
}
