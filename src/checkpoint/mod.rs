//! Checkpoints: a simulation in a file, from which it goes on bit for bit as if it had never
//! stopped.
//!
//! A [`Checkpoint`] holds the whole world and the state of everything that moves in it, so
//! nothing else is needed to go on, but for laws that only a program has: they are given again
//! to [`Checkpoint::simulation`]. A [`Recording`] can ride along and say where the files of the
//! run stand, so that they go on bit for bit as well.
//!
//! ```
//! # use volary::world::{AnyWorld, Document};
//! # let file = r#"{
//! #   "dimension": 2,
//! #   "time": { "end": 1 },
//! #   "agents": [{ "radius": 0.5, "positions": { "explicit": [[0, 0], [6, 0], [3, 6]] } }],
//! #   "laws": [{ "alpha_interaction": { "spacing": 7, "range": 8.4 } }]
//! # }"#;
//! # let AnyWorld::Plane(world) = Document::new("three.json", file).world("three")? else {
//! #     panic!("the world is flat");
//! # };
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("three.checkpoint");
//! use volary::checkpoint::Checkpoint;
//! use volary::simulation::Simulation;
//!
//! let mut simulation = Simulation::new(world)?;
//! for _ in 0..50 {
//!     simulation.step()?;
//! }
//! Checkpoint::of(&simulation)?.write(&path, false)?;
//!
//! let mut again: Simulation<2> = Checkpoint::read(&path)?.simulation(Vec::new())?;
//! simulation.step()?;
//! again.step()?;
//! assert_eq!(again.snapshot().step, 51);
//! assert_eq!(again.snapshot().positions, simulation.snapshot().positions);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod envelope;
mod error;
mod recording;

use std::fs::File;
use std::path::Path;

use serde::{Deserialize, Serialize};

pub use error::CheckpointError;
pub use recording::Recording;

use crate::dynamics::Engine;
use crate::file;
use crate::law::Law;
use crate::shape::In;
use crate::simulation::{Simulation, SimulationState};
use crate::world::World;
use crate::world::spec::WorldSpec;

/// A simulation between two steps, whole: world and state.
///
/// Only the version of the program that made it, on the same kind of machine, goes on bit for
/// bit; others refuse it. The file has a checksum against damage by accident. It is no guard
/// against malice: do not go on with a file from someone whom you do not trust.
#[derive(Debug, Clone, PartialEq)]
pub struct Checkpoint {
    /// What errors call it.
    file: String,
    name: String,
    world: WorldSpec,
    step: u64,
    state: Vec<u8>,
    recording: Option<Recording>,
}

/// What the file holds inside its envelope. The world is JSON, for its fields may have
/// several shapes, which only a format that describes itself can tell apart.
#[derive(Serialize, Deserialize)]
struct Content {
    name: String,
    world: String,
    step: u64,
    state: Vec<u8>,
    recording: Option<Recording>,
}

impl Checkpoint {
    /// What a simulation needs to go on from here.
    ///
    /// # Errors
    /// Where the engine cannot tell its state.
    pub fn of<const D: usize>(simulation: &Simulation<D>) -> Result<Self, CheckpointError> {
        let file = "the checkpoint".to_owned();
        let state = simulation
            .capture()
            .map_err(|e| e.to_string())
            .and_then(|state| postcard::to_stdvec(&state).map_err(|e| e.to_string()));
        let state = state.map_err(|problem| CheckpointError::Unusable {
            file: file.clone(),
            problem,
        })?;
        Ok(Self {
            file,
            name: simulation.world().name.clone(),
            world: simulation.world().spec.clone(),
            step: simulation.snapshot().step,
            state,
            recording: None,
        })
    }

    /// The same, with a note of the files that the run writes.
    pub fn with_recording(mut self, recording: Recording) -> Self {
        self.recording = Some(recording);
        self
    }

    /// Name of the world.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The world, every default filled in.
    pub fn world(&self) -> &WorldSpec {
        &self.world
    }

    /// Steps taken so far.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// The files that the run writes, where it noted them.
    pub fn recording(&self) -> Option<&Recording> {
        self.recording.as_ref()
    }

    /// The simulation as it was, under the world's laws and some more: those that it had
    /// then, if any.
    ///
    /// # Errors
    /// Where the world has another dimension than `D`, or the state is none of this world.
    pub fn simulation<const D: usize>(
        &self,
        more: Vec<Box<dyn Law<D>>>,
    ) -> Result<Simulation<D>, CheckpointError>
    where
        In<D>: Engine<D>,
    {
        let world =
            World::of_points(self.name.clone(), self.world.clone()).map_err(|problems| {
                let problem = problems.first();
                self.unusable(problem.map_or_else(String::new, |problem| {
                    format!("its world's {} {}", problem.path, problem.what)
                }))
            })?;
        let state: SimulationState<D> =
            postcard::from_bytes(&self.state).map_err(|e| self.unusable(e.to_string()))?;
        Simulation::restore(world, more, state).map_err(|e| self.unusable(e.to_string()))
    }

    /// Writes it to a file, which appears whole or not at all, and is safe on the disk
    /// when this returns. An existing file is refused without `overwrite`; with it, it is
    /// there until the new one takes its place.
    ///
    /// # Errors
    /// Where the file exists or cannot be written.
    pub fn write(&self, path: &Path, overwrite: bool) -> Result<(), CheckpointError> {
        Ok(file::write_whole(path, &self.to_bytes()?, overwrite)?)
    }

    /// Finds out whether [`Checkpoint::write`] could begin now, without changing what is
    /// there.
    ///
    /// # Errors
    /// As [`Checkpoint::write`].
    pub fn check_writable(path: &Path, overwrite: bool) -> Result<(), CheckpointError> {
        Ok(file::check_whole(path, overwrite)?)
    }

    /// Reads one from a file.
    ///
    /// # Errors
    /// Where the file cannot be read, is no checkpoint, is damaged, or comes from another
    /// version of the program.
    pub fn read(path: &Path) -> Result<Self, CheckpointError> {
        let explain = |action, e| file::explain(path, action, e);
        let source = File::open(path).map_err(|e| explain("open", e))?;
        let name = path.display().to_string();
        match envelope::read(source, &name) {
            Ok(body) => Self::from_body(&body, name),
            Err(envelope::Fault::Io(e)) => Err(explain("read", e).into()),
            Err(envelope::Fault::Bad(error)) => Err(error),
        }
    }

    /// The bytes of its file.
    ///
    /// # Errors
    /// Where the world cannot be written as JSON, which does not happen to a sound one.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        let world = serde_json::to_string(&self.world);
        let content = Content {
            name: self.name.clone(),
            world: world.map_err(|e| self.unusable(e.to_string()))?,
            step: self.step,
            state: self.state.clone(),
            recording: self.recording.clone(),
        };
        let body = postcard::to_stdvec(&content).map_err(|e| self.unusable(e.to_string()))?;
        Ok(envelope::wrap(&body))
    }

    /// From the bytes of its file. Errors call it by `name`.
    ///
    /// # Errors
    /// As [`Checkpoint::read`].
    pub fn from_bytes(bytes: &[u8], name: String) -> Result<Self, CheckpointError> {
        match envelope::read(bytes, &name) {
            Ok(body) => Self::from_body(&body, name),
            Err(envelope::Fault::Io(e)) => Err(CheckpointError::Damaged {
                file: name,
                problem: e.to_string(),
            }),
            Err(envelope::Fault::Bad(error)) => Err(error),
        }
    }

    fn from_body(body: &[u8], file: String) -> Result<Self, CheckpointError> {
        let read = || {
            let content: Content = postcard::from_bytes(body).map_err(|e| e.to_string())?;
            let world = serde_json::from_str(&content.world).map_err(|e| e.to_string())?;
            Ok((content, world))
        };
        match read() {
            Ok((content, world)) => Ok(Self {
                file,
                name: content.name,
                world,
                step: content.step,
                state: content.state,
                recording: content.recording,
            }),
            Err(problem) => Err(CheckpointError::Unusable { file, problem }),
        }
    }

    fn unusable(&self, problem: String) -> CheckpointError {
        CheckpointError::Unusable {
            file: self.file.clone(),
            problem,
        }
    }
}
