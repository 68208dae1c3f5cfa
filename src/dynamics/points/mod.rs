//! Agents as point masses, integrated to an accuracy that is asked for.
//!
//! ẋ = v, v̇ = Σ laws + gravity, with the laws of the bodies but nothing to touch: the
//! equations of the papers themselves, and what bodies that touch nothing converge to.

mod accuracy;
mod field;
mod fitness;

pub use accuracy::{Accuracy, Solver};

use serde::{Deserialize, Serialize};

use super::failure::{Failure, LARGEST};
use super::{Snapshot, Unusable, turn};
use crate::law::{Flock, State};
use crate::math::{DormandPrince, Vector, axis};
use crate::shape::Obstacle;
use crate::world::World;
use field::Field;

/// Agents as point masses.
pub struct Points<const D: usize> {
    accuracy: Accuracy,
    groups: Vec<usize>,
    masses: Vec<f64>,
    force_limits: Vec<f64>,
    gravity: Vector<D>,
    step_size: f64,
    step: u64,
    positions: Vec<Vector<D>>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    obstacles: Vec<Obstacle<D>>,
    /// The force of the laws on each agent now.
    pushes: Vec<Vector<D>>,
}

/// What points must know between two steps, besides their world, to go on bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointsState<const D: usize> {
    accuracy: Accuracy,
    step: u64,
    positions: Vec<Vector<D>>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    pushes: Vec<Vector<D>>,
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
        let mut points = Self::around(world, accuracy);
        turn(&mut points.headings, &points.velocities);
        points.push(flock)?;
        Ok(points)
    }

    fn around(world: &World<D>, accuracy: Accuracy) -> Self {
        let agents = &world.agents;
        Self {
            accuracy,
            groups: agents.group.clone(),
            masses: agents.mass.clone(),
            force_limits: agents.force_limit.clone(),
            gravity: world.gravity,
            step_size: world.spec.time.step,
            step: 0,
            positions: agents.positions.clone(),
            velocities: agents.velocities.clone(),
            headings: vec![axis(0); agents.len()],
            obstacles: world.obstacles.clone(),
            pushes: vec![Vector::zeros(); agents.len()],
        }
    }

    /// The points of a world as they were when [`Points::capture`] gave `state`.
    ///
    /// # Errors
    /// Where the state is not one of this world.
    pub fn restore(world: &World<D>, state: PointsState<D>) -> Result<Self, Unusable> {
        let agents = world.agents.len();
        let lists = [
            &state.positions,
            &state.velocities,
            &state.headings,
            &state.pushes,
        ];
        if lists.map(Vec::len) != [agents; 4] {
            return Err(Unusable("it has another number of agents".to_owned()));
        }
        let mut points = Self {
            step: state.step,
            positions: state.positions,
            velocities: state.velocities,
            headings: state.headings,
            pushes: state.pushes,
            ..Self::around(world, state.accuracy)
        };
        points.move_obstacles();
        Ok(points)
    }

    /// What [`Points::restore`] needs.
    pub fn capture(&self) -> PointsState<D> {
        // Every field is named, so that a new one cannot be forgotten here.
        let Self {
            accuracy,
            step,
            positions,
            velocities,
            headings,
            pushes,
            // Part of the world, and of the time.
            groups: _,
            masses: _,
            force_limits: _,
            gravity: _,
            step_size: _,
            obstacles: _,
        } = self;
        PointsState {
            accuracy: *accuracy,
            step: *step,
            positions: positions.clone(),
            velocities: velocities.clone(),
            headings: headings.clone(),
            pushes: pushes.clone(),
        }
    }

    /// Goes on to the end of the world's next step. One that fails leaves the state before it.
    ///
    /// # Errors
    /// Where the state or the laws are no longer finite, or no step is short enough.
    pub fn step(&mut self, flock: &mut Flock<D>) -> Result<(), Failure> {
        let begin = self.time();
        let end = (self.step + 1) as f64 * self.step_size;
        let mut field = Field::new(self, flock);
        let state = field.flat(&self.positions, &self.velocities);
        let slope = |time: f64, y: &[f64], out: &mut [f64]| field.slope(time, y, out);
        let mut solution = DormandPrince::new(slope, begin, state, self.accuracy.relative);
        let reached = solution.advance_to(end);
        let state = solution.state().to_vec();
        reached.map_err(|stuck| Failure::Stuck { time: stuck.time })?;
        let (positions, velocities) = field::unflat::<D>(&state);
        let sound = |i: usize| positions[i].norm() < LARGEST && velocities[i].norm() < LARGEST;
        if let Some(agent) = (0..positions.len()).find(|i| !sound(*i)) {
            return Err(Failure::State { agent, time: end });
        }
        self.positions = positions;
        self.velocities = velocities;
        self.step += 1;
        turn(&mut self.headings, &self.velocities);
        self.move_obstacles();
        self.push(flock)
    }

    /// The state now.
    pub fn snapshot(&self) -> Snapshot<'_, D> {
        Snapshot {
            step: self.step,
            time: self.time(),
            positions: &self.positions,
            velocities: &self.velocities,
            headings: &self.headings,
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
            headings: &self.headings,
            groups: &self.groups,
            masses: &self.masses,
            rotations: &[],
            obstacles: &self.obstacles,
        }
    }

    /// The force that the laws exert on each agent now, within its limit.
    pub fn pushes(&self) -> &[Vector<D>] {
        &self.pushes
    }

    /// What solves the equations of motion.
    pub fn solver(&self) -> Solver {
        Solver {
            method: "Dormand-Prince 5(4)",
            order: 5,
            relative: self.accuracy.relative,
        }
    }

    fn time(&self) -> f64 {
        self.step as f64 * self.step_size
    }

    fn move_obstacles(&mut self) {
        let time = self.time();
        for obstacle in &mut self.obstacles {
            obstacle.move_to(time);
        }
    }

    /// Asks the laws for their forces now.
    fn push(&mut self, flock: &mut Flock<D>) -> Result<(), Failure> {
        let mut accelerations = vec![Vector::zeros(); self.positions.len()];
        flock.accelerations(&self.state(), &mut accelerations);
        for (i, acceleration) in accelerations.iter().enumerate() {
            if !acceleration.norm_squared().is_finite() {
                return Err(Failure::Acceleration {
                    agent: i,
                    time: self.time(),
                    value: format!("{:?}", acceleration.as_slice()),
                });
            }
            let force = acceleration * self.masses[i];
            self.pushes[i] = crate::math::shortened(force, self.force_limits[i]);
        }
        Ok(())
    }
}
