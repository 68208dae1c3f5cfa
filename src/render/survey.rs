//! What a trace holds, found out before anything of it is drawn.

use crate::math::Vector;
use crate::render::RenderError;
use crate::shape::{Bounds, Pose};
use crate::trace::record::{Contact, Frame, ObstaclePose, Partner, Record};
use crate::world::{World, vector};

use super::extent::{around, extent_of};

/// What a trace holds: its times, how far what moves comes, what it touches.
#[derive(Debug, Clone)]
pub struct Survey<const D: usize> {
    /// Time of each frame.
    pub times: Vec<f64>,
    /// Lowest and highest corner of the box that holds all bodies, frame by frame.
    pub extents: Vec<Bounds<D>>,
    /// Lowest and highest corner of the box that holds all bodies in all frames, or in those that
    /// [`Survey::during`] names.
    pub bodies: Bounds<D>,
    /// Lowest and highest corner of the box that holds all moving obstacles at all times, but for
    /// those without bounds; nothing where none moves.
    pub movers: Option<Bounds<D>>,
    /// Half the sides of the smallest box that holds all bodies at each time, with their mean
    /// position in its middle.
    pub spread: Vector<D>,
    /// Largest speed.
    pub speed: f64,
    /// The contacts, in the order of the trace.
    pub touches: Vec<Touch<D>>,
    /// What the frames record.
    pub recorded: Recorded,
    /// Whether the trace ends with its summary.
    pub complete: bool,
}

/// What some frame of the trace records.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Recorded {
    /// The edges of the proximity net.
    pub edges: bool,
    /// β-agents.
    pub beta_agents: bool,
    /// Blocked lines of sight.
    pub blocked: bool,
}

/// A contact, as far as it is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch<const D: usize> {
    /// Time at which it begins.
    pub begin: f64,
    /// Time at which it ends.
    pub end: f64,
    /// The agent.
    pub agent: usize,
    /// The other agent, where it touched one.
    pub other: Option<usize>,
    /// Where the agent was when it began.
    pub position: Vector<D>,
}

impl<const D: usize> Survey<D> {
    /// The survey of a trace of this world, of which nothing is read yet.
    pub fn new() -> Self {
        Self {
            times: Vec::new(),
            extents: Vec::new(),
            bodies: nothing(),
            movers: None,
            spread: Vector::zeros(),
            speed: 0.0,
            touches: Vec::new(),
            recorded: Recorded::default(),
            complete: false,
        }
    }

    /// The survey of records at hand.
    ///
    /// # Errors
    /// Frames or contacts that do not fit the world, or no frame at all.
    pub fn of<'a>(
        world: &World<D>,
        records: impl IntoIterator<Item = &'a Record>,
    ) -> Result<Self, RenderError> {
        let mut survey = Self::new();
        for record in records {
            survey.take(world, record)?;
        }
        survey.finish()
    }

    /// Takes a record in.
    ///
    /// # Errors
    /// Where it does not fit the world.
    pub fn take(&mut self, world: &World<D>, record: &Record) -> Result<(), RenderError> {
        match record {
            Record::Header(_) => {}
            Record::Frame(frame) => self.take_frame(world, frame)?,
            Record::Contact(contact) => self.take_contact(world, contact)?,
            Record::Summary(_) => self.complete = true,
        }
        Ok(())
    }

    /// Itself, when all is taken in.
    ///
    /// # Errors
    /// Where there was no frame, or positions are too far apart.
    pub fn finish(self) -> Result<Self, RenderError> {
        if self.times.is_empty() {
            return Err(RenderError::Empty);
        }
        let movers = self.movers.unwrap_or(self.bodies);
        for (min, max) in [self.bodies, movers] {
            // With room for what is drawn around them.
            if !(max - min).iter().all(|side| (side * 1e9).is_finite()) {
                return Err(RenderError::Boundless);
            }
        }
        Ok(self)
    }

    /// The same, with the scene of a few frames only, from one number to another, both included:
    /// what is drawn before or after them need not fit in.
    pub fn during(self, first: usize, last: usize) -> Self {
        let extents = self.extents.get(first..=last).unwrap_or(&self.extents);
        let bodies = extents
            .iter()
            .fold(nothing(), |all, extent| around(Some(all), *extent));
        Self { bodies, ..self }
    }

    /// Number of the frame nearest to a time; of two the earlier.
    pub fn nearest(&self, time: f64) -> usize {
        let behind = self.times.partition_point(|&other| other < time);
        match behind {
            0 => 0,
            _ if behind == self.times.len() => behind - 1,
            _ if time - self.times[behind - 1] <= self.times[behind] - time => behind - 1,
            _ => behind,
        }
    }

    /// Time of the first frame and of the last.
    pub fn span(&self) -> [f64; 2] {
        let first = self.times.first().copied().unwrap_or(0.0);
        [first, self.times.last().copied().unwrap_or(first)]
    }

    fn take_frame(&mut self, world: &World<D>, frame: &Frame) -> Result<(), RenderError> {
        fits(world, frame)?;
        if self.times.last().is_some_and(|&last| frame.time <= last) {
            return Err(RenderError::Frame {
                time: frame.time,
                problem: "it does not come after the frame before it".to_owned(),
            });
        }
        self.times.push(frame.time);
        let positions: Vec<Vector<D>> = frame.positions.iter().map(|it| vector(it)).collect();
        let middle = crate::math::mean(&positions);
        let mut extent = nothing();
        for (position, &radius) in positions.iter().zip(&world.agents.radius) {
            let reach = Vector::repeat(radius);
            extent = around(Some(extent), (position - reach, position + reach));
            self.spread = self.spread.sup(&((position - middle).abs() + reach));
        }
        self.extents.push(extent);
        self.bodies = around(Some(self.bodies), extent);
        for velocity in &frame.velocities {
            self.speed = self.speed.max(vector::<D>(velocity).norm());
        }
        for pose in frame.obstacles.iter().flatten() {
            let (obstacle, pose) = (&world.obstacles[pose.obstacle], posed(pose));
            if let Some(extent) = extent_of(obstacle.parts(), &pose) {
                self.movers = Some(around(self.movers, extent));
            }
        }
        self.recorded.edges |= frame.edges.is_some();
        self.recorded.beta_agents |= frame.beta_agents.is_some();
        self.recorded.blocked |= frame.blocked.is_some();
        Ok(())
    }

    fn take_contact(&mut self, world: &World<D>, contact: &Contact) -> Result<(), RenderError> {
        let others = match contact.with {
            Partner::Agent => world.agents.len(),
            Partner::Obstacle => world.obstacles.len(),
        };
        if contact.agent >= world.agents.len() || contact.other >= others {
            return Err(RenderError::Frame {
                time: contact.begin,
                problem: "a contact names an agent or obstacle that it does not have".to_owned(),
            });
        }
        self.touches.push(Touch {
            begin: contact.begin,
            end: contact.end,
            agent: contact.agent,
            other: (contact.with == Partner::Agent).then_some(contact.other),
            position: vector(&contact.position),
        });
        Ok(())
    }
}

impl<const D: usize> Default for Survey<D> {
    fn default() -> Self {
        Self::new()
    }
}

/// A box that holds nothing.
fn nothing<const D: usize>() -> Bounds<D> {
    let infinity = Vector::repeat(f64::INFINITY);
    (infinity, -infinity)
}

/// Where a moving obstacle is.
pub(super) fn posed<const D: usize>(pose: &ObstaclePose) -> Pose<D> {
    Pose::new(vector(&pose.position), pose.rotation.turn())
}

/// Refuses a frame that does not fit the world, so that drawing need not look again.
pub(super) fn fits<const D: usize>(world: &World<D>, frame: &Frame) -> Result<(), RenderError> {
    check(world, frame).map_err(|problem| RenderError::Frame {
        time: frame.time,
        problem,
    })
}

/// Finds what of a frame does not fit the world.
fn check<const D: usize>(world: &World<D>, frame: &Frame) -> Result<(), String> {
    let (agents, obstacles) = (world.agents.len(), world.obstacles.len());
    let counts = [
        ("positions", frame.positions.len()),
        ("velocities", frame.velocities.len()),
        (
            "rotations",
            frame.rotations.as_ref().map_or(agents, Vec::len),
        ),
    ];
    for (what, count) in counts {
        if count != agents {
            return Err(format!("it has {count} {what} of {agents} agents"));
        }
    }
    let vectors = frame.positions.iter().chain(&frame.velocities);
    if let Some(vector) = vectors.into_iter().find(|vector| vector.len() != D) {
        let found = vector.len();
        return Err(format!(
            "a position or velocity has {found} numbers instead of {D}"
        ));
    }
    let pairs = frame.edges.iter().chain(&frame.blocked).flatten();
    let betas = frame.beta_agents.iter().flatten().map(|it| it.agent);
    if let Some(agent) = pairs
        .flatten()
        .copied()
        .chain(betas)
        .find(|&it| it >= agents)
    {
        return Err(format!("it names agent {agent} of {agents}"));
    }
    let poses = frame.obstacles.iter().flatten();
    if let Some(pose) = poses.into_iter().find(|pose| pose.obstacle >= obstacles) {
        return Err(format!(
            "it names obstacle {} of {obstacles}",
            pose.obstacle
        ));
    }
    Ok(())
}
