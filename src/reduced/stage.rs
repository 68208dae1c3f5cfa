//! Laws of a world, asked for any state of its agents.

use nalgebra::DMatrix;

use crate::law::{Flock, Law, State};
use crate::math::{Gain, Matrix, Vector, direction};
use crate::shape::Obstacle;
use crate::world::World;

/// Some laws, and what stands around the agents.
pub(super) struct Stage<'w, const D: usize> {
    world: &'w World<D>,
    flock: Flock<D>,
    obstacles: Vec<Obstacle<D>>,
    headings: Vec<Vector<D>>,
    /// Of the bodies, as they stood at the start; none where all are balls.
    rotations: &'w [Matrix<D>],
}

/// How all agents pull each other in some state.
pub(super) struct Coupling {
    /// a_ij, a_ii included.
    pub influences: DMatrix<f64>,
    /// The gain of each agent; 0 of those that nothing pulls.
    pub gains: Vec<Gain>,
}

impl<'w, const D: usize> Stage<'w, D> {
    pub fn new(world: &'w World<D>, laws: Vec<Box<dyn Law<D>>>) -> Self {
        let round = world.spec.agents.iter().all(|group| group.is_round());
        Self {
            flock: Flock::with_senses(world, laws),
            obstacles: world.obstacles.clone(),
            headings: Vec::new(),
            rotations: if round { &[] } else { &world.agents.rotations },
            world,
        }
    }

    /// What the laws give each agent.
    pub fn accelerations(
        &mut self,
        time: f64,
        positions: &[Vector<D>],
        velocities: &[Vector<D>],
    ) -> Vec<Vector<D>> {
        let mut out = vec![Vector::zeros(); positions.len()];
        let (flock, state) = self.at(time, positions, velocities);
        flock.accelerations(&state, &mut out);
        out
    }

    /// Where the first law pulls each agent.
    pub fn coupling(
        &mut self,
        time: f64,
        positions: &[Vector<D>],
        velocities: &[Vector<D>],
    ) -> Coupling {
        let count = positions.len();
        let mut coupling = Coupling {
            influences: DMatrix::zeros(count, count),
            gains: vec![Gain::Constant(0.0); count],
        };
        let (flock, state) = self.at(time, positions, velocities);
        let pulls = flock.pulls_of_law(0, &state);
        for row in pulls.rows() {
            coupling.gains[row.agent] = row.gain;
            coupling.influences[(row.agent, row.agent)] = row.own;
            for (agent, weight) in pulls.terms(row) {
                coupling.influences[(row.agent, agent)] += weight;
            }
        }
        coupling
    }

    fn at<'a>(
        &'a mut self,
        time: f64,
        positions: &'a [Vector<D>],
        velocities: &'a [Vector<D>],
    ) -> (&'a mut Flock<D>, State<'a, D>) {
        let agents = &self.world.agents;
        for obstacle in &mut self.obstacles {
            obstacle.move_to(time);
        }
        self.headings.clear();
        // Who rests heads where its body does.
        self.headings
            .extend(velocities.iter().enumerate().map(|(i, velocity)| {
                let along = direction(velocity);
                match along.norm_squared() > 0.0 {
                    true => along,
                    false => agents.rotations[i].column(0).into(),
                }
            }));
        let state = State {
            time,
            positions,
            velocities,
            headings: &self.headings,
            groups: &agents.group,
            masses: &agents.mass,
            rotations: self.rotations,
            obstacles: &self.obstacles,
        };
        (&mut self.flock, state)
    }
}

impl Coupling {
    /// Q: how fast each agent turns to each other one where all velocities are nearly the
    /// same, and minus the sum of the row on the diagonal.
    pub fn rates(&self) -> DMatrix<f64> {
        let mut rates = self.influences.clone();
        for i in 0..rates.nrows() {
            let gain = self.gains[i].largest();
            rates[(i, i)] = 0.0;
            rates.row_mut(i).scale_mut(gain);
            rates[(i, i)] = -rates.row(i).iter().sum::<f64>();
        }
        rates
    }
}
