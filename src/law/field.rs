//! The vector field of a world: what its laws ask of any state of its agents.

use crate::law::{Flock, Law, State};
use crate::math::{Matrix, Vector, direction};
use crate::shape::Obstacle;
use crate::world::World;

/// Some laws, and what stands around the agents, asked for states that need not be those of
/// any run.
pub struct Field<'w, const D: usize> {
    world: &'w World<D>,
    flock: Flock<D>,
    obstacles: Vec<Obstacle<D>>,
    headings: Vec<Vector<D>>,
    /// Of the bodies, as they stood at the start; none where all are balls.
    rotations: &'w [Matrix<D>],
}

impl<'w, const D: usize> Field<'w, D> {
    /// The laws that the world's file names.
    pub fn of_world(world: &'w World<D>) -> Self {
        Self::new(world, super::build(world))
    }

    /// Some laws in a world, whose agents perceive as those of the world do.
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

    /// The world.
    pub fn world(&self) -> &'w World<D> {
        self.world
    }

    /// What the laws give each agent, gravity apart.
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

    /// The flock, and the state to ask it for.
    pub fn at<'a>(
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
