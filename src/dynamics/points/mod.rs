//! Agents as point masses, integrated to an accuracy that is asked for.
//!
//! ẋ = v, v̇ = Σ laws + gravity, with the laws of the bodies but nothing to touch: the
//! equations of the papers themselves, and what bodies that touch nothing converge to.
//!
//! The solver chooses its own steps, and ends them where the world's steps end: every state
//! that observers see is one that it has computed, none is interpolated. Where laws pull so
//! stiffly that an explicit solver would need many steps for one of the world's, an implicit
//! one takes them. Where a pair of agents comes within a distance at which some law jumps,
//! or leaves it, a step ends; until then the pair is held on the side where it was, so that no step
//! sees both. A pair that the laws drive back to such a distance from both sides comes and goes ever
//! faster. Once it gets no farther from it than an error in a position may be, or has crossed it
//! 200 times, each within a five-hundredth of the step that the solver would take without, it slides
//! there: see `sliding.rs`. A pair that crosses as often and does not slide is for the length of such
//! a step looked at twenty times only. So the work is bounded.
//!
//! Other corners and jumps, of obstacles, fields of view, lines of sight and functions of time, are
//! left to the control of the error.

mod accuracy;
mod agents;
mod course;
mod field;
mod fitness;
mod gaps;
mod integrator;
mod links;
mod sliding;
mod watched;

pub use accuracy::{Accuracy, Solver};

use serde::{Deserialize, Serialize};

use super::failure::{Failure, LARGEST};
use super::{Gaps, Snapshot, Unusable, turn};
use crate::law::{Flock, State};
use crate::math::{Stuck, Stumble, Vector, axis};
use crate::shape::Obstacle;
use crate::stop::Stop;
use crate::world::World;
use agents::Agents;
use field::{Field, read};
use gaps::{GapWatch, Taken};
use integrator::Integrator;

/// Agents as point masses.
pub struct Points<const D: usize> {
    accuracy: Accuracy,
    integrator: Integrator,
    agents: Agents<D>,
    step_size: f64,
    step: u64,
    positions: Vec<Vector<D>>,
    velocities: Vec<Vector<D>>,
    obstacles: Vec<Obstacle<D>>,
    /// The force of the laws on each agent now.
    pushes: Vec<Vector<D>>,
    radii: Vec<f64>,
    gaps: GapWatch,
    stop: Stop,
}

/// What points must know between two steps, besides their world, to go on bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointsState<const D: usize> {
    accuracy: Accuracy,
    integrator: Integrator,
    largest: [f64; 2],
    step: u64,
    positions: Vec<Vector<D>>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    pushes: Vec<Vector<D>>,
    gaps: GapWatch,
    /// The pairs that slide, and at which distances.
    #[serde(default)]
    sliding: Vec<([u32; 2], f64)>,
}

impl<const D: usize> Points<D> {
    /// The agents of a world at its start, about to obey `flock`.
    ///
    /// # Errors
    /// Where the laws give no finite acceleration at the start, or the world has what points
    /// have not: shapes other than balls, senses with a delay, noise or dropout, limits of the
    /// force's rate or of the speed.
    pub fn new(
        world: &World<D>,
        flock: &mut Flock<D>,
        accuracy: Accuracy,
    ) -> Result<Self, Failure> {
        accuracy.check()?;
        fitness::check(world)?;
        let mut points = Self::around(world, flock, accuracy);
        points.turn();
        points.push(flock)?;
        let (positions, radii) = (&points.positions, &points.radii);
        points.gaps.begin(positions, radii, &points.obstacles);
        let state = points.flat();
        let field = Field::new(&mut points.agents, flock, &points.stop, accuracy.relative);
        points.integrator = Integrator::choose(field, &state, points.step_size);
        Ok(points)
    }

    fn around(world: &World<D>, flock: &Flock<D>, accuracy: Accuracy) -> Self {
        let agents = &world.agents;
        let headings = vec![axis(0); agents.len()];
        Self {
            accuracy,
            integrator: Integrator::default(),
            agents: Agents::new(world, flock, &headings),
            step_size: world.spec.time.step,
            step: 0,
            positions: agents.positions.clone(),
            velocities: agents.velocities.clone(),
            obstacles: world.obstacles.clone(),
            pushes: vec![Vector::zeros(); agents.len()],
            radii: agents.radius.clone(),
            gaps: GapWatch::default(),
            stop: Stop::default(),
        }
    }

    /// The points of a world as they were when [`Points::capture`] gave `state`, under the
    /// same flock.
    ///
    /// # Errors
    /// Where the state is not one of this world.
    pub fn restore(
        world: &World<D>,
        flock: &Flock<D>,
        state: PointsState<D>,
    ) -> Result<Self, Unusable> {
        let agents = world.agents.len();
        let lists = [
            &state.positions,
            &state.velocities,
            &state.headings,
            &state.pushes,
        ];
        if lists.map(Vec::len) != [agents; 4] || !state.integrator.fits(agents * D) {
            return Err(Unusable("it has another number of agents".to_owned()));
        }
        let mut points = Self {
            integrator: state.integrator,
            step: state.step,
            positions: state.positions,
            velocities: state.velocities,
            pushes: state.pushes,
            gaps: state.gaps,
            ..Self::around(world, flock, state.accuracy)
        };
        points.agents.headings = state.headings;
        points.agents.largest = state.largest;
        points.agents.sliding = state.sliding;
        points.move_obstacles();
        Ok(points)
    }

    /// What [`Points::restore`] needs.
    pub fn capture(&self) -> PointsState<D> {
        // Every field is named, so that a new one cannot be forgotten here.
        let Self {
            accuracy,
            integrator,
            agents,
            step,
            positions,
            velocities,
            pushes,
            gaps,
            // Part of the world, and of the time.
            step_size: _,
            radii: _,
            obstacles: _,
            // Given anew.
            stop: _,
        } = self;
        PointsState {
            accuracy: *accuracy,
            integrator: integrator.clone(),
            largest: agents.largest,
            step: *step,
            positions: positions.clone(),
            velocities: velocities.clone(),
            headings: agents.headings.clone(),
            pushes: pushes.clone(),
            gaps: gaps.clone(),
            sliding: agents.sliding.clone(),
        }
    }

    /// Stops from now on where somebody asks for it, also within a step.
    pub fn heed(&mut self, stop: Stop) {
        self.stop = stop;
    }

    /// Goes on to the end of the world's next step. One that fails, or was stopped, leaves the
    /// state before it.
    ///
    /// # Errors
    /// Where the state or the laws are no longer finite, the integration gets stuck, or somebody
    /// asked to stop.
    pub fn step(&mut self, flock: &mut Flock<D>) -> Result<(), Failure> {
        let times = [self.time(), (self.step + 1) as f64 * self.step_size];
        let mut state = self.flat();
        self.agents.measure(&self.positions, &self.velocities);
        let relative = self.accuracy.relative;
        let field = Field::new(&mut self.agents, flock, &self.stop, relative);
        let done = self.integrator.advance(field, &mut state, times, relative);
        done.map_err(|Stuck { time, over }| match over {
            Stumble::Error => Failure::Stuck { time },
            Stumble::Stopped => Failure::Stopped,
        })?;
        let half = state.len() / 2;
        let (mut positions, mut velocities) = (self.positions.clone(), self.velocities.clone());
        read(&state[..half], &mut positions);
        read(&state[half..], &mut velocities);
        let sound = |i: usize| positions[i].norm() < LARGEST && velocities[i].norm() < LARGEST;
        if let Some(agent) = (0..positions.len()).find(|i| !sound(*i)) {
            return Err(Failure::State {
                agent,
                time: times[1],
            });
        }
        let before = (
            std::mem::replace(&mut self.positions, positions),
            std::mem::replace(&mut self.velocities, velocities),
        );
        self.step += 1;
        let crossed = self.agents.note_sliding(&self.positions);
        self.integrator.note_jumps(crossed);
        self.turn();
        self.move_obstacles();
        self.gaps.look(&Taken {
            times,
            positions: [&before.0, &self.positions],
            velocities: [&before.1, &self.velocities],
            radii: &self.radii,
            obstacles: &self.obstacles,
        });
        self.push(flock)
    }

    /// The state now.
    pub fn snapshot(&self) -> Snapshot<'_, D> {
        Snapshot {
            step: self.step,
            time: self.time(),
            positions: &self.positions,
            velocities: &self.velocities,
            headings: &self.agents.headings,
            rotations: None,
            spins: None,
            obstacles: &self.obstacles,
        }
    }

    /// The state now, as laws see it.
    pub fn state(&self) -> State<'_, D> {
        State {
            time: self.time(),
            positions: &self.positions,
            velocities: &self.velocities,
            headings: &self.agents.headings,
            groups: &self.agents.groups,
            masses: &self.agents.masses,
            rotations: &[],
            obstacles: &self.obstacles,
        }
    }

    /// The force that the laws exert on each agent now, within its limit.
    pub fn pushes(&self) -> &[Vector<D>] {
        &self.pushes
    }

    /// The smallest gaps so far between the bodies that they would be, at any time: each step is
    /// taken as a cubic through its states. Those of moving obstacles are looked at at the ends of
    /// steps only.
    pub fn gaps(&self) -> Gaps {
        self.gaps.gaps()
    }

    /// What solves the equations of motion.
    pub fn solver(&self) -> Solver {
        self.integrator.solver(self.accuracy.relative)
    }

    fn time(&self) -> f64 {
        self.step as f64 * self.step_size
    }

    fn flat(&self) -> Vec<f64> {
        let vectors = self.positions.iter().chain(&self.velocities);
        vectors.flat_map(|v| v.as_slice().iter().copied()).collect()
    }

    fn turn(&mut self) {
        turn(&mut self.agents.headings, &self.velocities);
    }

    fn move_obstacles(&mut self) {
        let time = self.time();
        for obstacle in &mut self.obstacles {
            obstacle.move_to(time);
        }
    }

    /// Asks the laws for their forces now.
    fn push(&mut self, flock: &mut Flock<D>) -> Result<(), Failure> {
        let mut wanted = vec![Vector::zeros(); self.positions.len()];
        if self.agents.sliding.is_empty() {
            flock.accelerations(&self.state(), &mut wanted);
        } else {
            let (time, state) = (self.time(), self.flat());
            let relative = self.accuracy.relative;
            let field = Field::new(&mut self.agents, flock, &self.stop, relative);
            wanted = field.accelerations(time, &state);
        }
        for (i, wanted) in wanted.iter().enumerate() {
            if !wanted.norm_squared().is_finite() {
                return Err(Failure::Acceleration {
                    agent: i,
                    time: self.time(),
                    value: format!("{:?}", wanted.as_slice()),
                });
            }
            self.pushes[i] = self.agents.force(i, wanted);
        }
        Ok(())
    }
}
