//! Dynamics: what moves the agents.
//!
//! [`Bodies`] couples a flock to rigid bodies in rapier. The engine itself sits behind
//! [`Physics`], written once and compiled for each dimension. [`Points`] integrates the same
//! flock as the point masses of the papers, to a stated accuracy. A [`Mover`] is one of them.

mod actuator;
mod attitude;
mod bodies;
mod contact;
mod failure;
mod mover;
mod points;
mod relaxation;

pub use actuator::Cuts;
pub use bodies::{Bodies, BodiesState};
use contact::{Change, Pair};
pub use contact::{Closest, Gaps, Strain, Touch, Touched};
pub use failure::Failure;
pub use mover::{Dynamics, Mover, MoverState};
pub use points::{Accuracy, Points, PointsState, Solver};

use rayon::prelude::*;
use thiserror::Error;

use crate::math::{Matrix, Vector, direction};
use crate::parallel::{CHUNK, for_each};
use crate::shape::{Geometry, In, Obstacle};
use crate::world::World;

/// The state of the agents at the end of a step, for those who observe.
#[derive(Debug, Clone, Copy)]
pub struct Snapshot<'a, const D: usize> {
    /// Steps taken so far.
    pub step: u64,
    /// Time, step × size of the step.
    pub time: f64,
    /// Position of each agent.
    pub positions: &'a [Vector<D>],
    /// Velocity of each agent.
    pub velocities: &'a [Vector<D>],
    /// Heading of each agent, a unit vector: of a ball where its velocity points, or last
    /// pointed; of any other body its first axis.
    pub headings: &'a [Vector<D>],
    /// Rotation of each body, from its own frame to the world's; `None` in worlds of
    /// balls alone.
    pub rotations: Option<&'a [Matrix<D>]>,
    /// Angular velocity of each body, in the plane the last component alone; `None` in worlds
    /// of balls alone. As the engine has it, half a substep late: of first order.
    pub spins: Option<&'a [Vector<3>]>,
    /// The obstacles, where they are now.
    pub obstacles: &'a [Obstacle<D>],
}

/// Turns headings along the velocities; of who rests, it stays as it was.
fn turn<const D: usize>(headings: &mut [Vector<D>], velocities: &[Vector<D>]) {
    let agents = headings.len();
    let chunks = headings.par_chunks_mut(CHUNK);
    let chunks = chunks.zip(velocities.par_chunks(CHUNK));
    for_each(agents, chunks, |(headings, velocities)| {
        for (heading, velocity) in headings.iter_mut().zip(velocities) {
            let along = direction(velocity);
            if along.norm_squared() > 0.0 {
                *heading = along;
            }
        }
    });
}

/// What drives the bodies through one step.
#[derive(Debug, Clone, Copy)]
pub struct Drive<'a, const D: usize> {
    /// Force on each agent.
    pub forces: &'a [Vector<D>],
    /// How each agent is turned; empty where none is.
    pub steering: &'a [Steering],
    /// The obstacles, where they are at the end of the step.
    pub obstacles: &'a [Obstacle<D>],
    /// The pairs that are held together, in their order: no others touch.
    pub lasting: &'a [Pair],
}

/// What turns a body in a step, besides contacts. In the plane the last component counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Steering {
    /// Nothing.
    Free,
    /// A torque, held over the step.
    Torque(Vector<3>),
    /// The angular velocity that it begins the step with.
    Spin(Vector<3>),
}

/// A world of rigid bodies: one for each agent, and the obstacles.
pub trait Physics<const D: usize>: Send + Sync {
    /// Copies the positions and the engine's velocities of the agents.
    fn read(&self, positions: &mut [Vector<D>], velocities: &mut [Vector<D>]);

    /// Copies the rotations and angular velocities of the agents.
    fn read_attitudes(&self, rotations: &mut [Matrix<D>], spins: &mut [Vector<3>]);

    /// Sets the velocity of each agent.
    fn set_velocities(&mut self, velocities: &[Vector<D>]);

    /// Takes one step under these forces, in place of those of the step before. An empty
    /// list of forces leaves them as they were, at first none.
    fn step(&mut self, drive: Drive<'_, D>);

    /// Puts a body where its bounces led it.
    #[doc(hidden)]
    fn place(&mut self, change: &Change<D>);

    /// Appends the contacts of the last step that were held; times, `position` and the speeds
    /// are left at zero. An obstacle of several parts may come once for each.
    fn touches(&self, out: &mut Vec<Touch<D>>);

    /// The agents that the engine gave up because their state became non-finite.
    fn lost(&self) -> Vec<usize>;

    /// Everything that the engine must know to go on bit for bit, in a form of its own:
    /// forces apart, which each step sets anew.
    ///
    /// # Errors
    /// What keeps the engine's state from being written.
    fn save(&self) -> Result<Vec<u8>, Unusable>;
}

/// A state that cannot be saved or taken up again.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Unusable(pub String);

/// Access to the engine of one dimension; implemented by [`In<2>`] and [`In<3>`].
pub trait Engine<const D: usize>: Geometry<D> {
    /// The bodies of a world, at its start.
    fn physics(world: &World<D>) -> Box<dyn Physics<D>>;

    /// The bodies of a world as they were when [`Physics::save`] gave `saved`.
    ///
    /// # Errors
    /// Where `saved` is not what the same version saved of the same world.
    fn restore(world: &World<D>, saved: &[u8]) -> Result<Box<dyn Physics<D>>, Unusable>;
}

#[path = "."]
#[allow(clippy::duplicate_mod, reason = "one source for both dimensions")]
mod plane {
    use crate::shape::plane as geometry;
    use rapier2d as rapier;
    const D: usize = 2;

    #[path = "rapier.rs"]
    mod adapter;

    use super::{Matrix, Vector};
    use crate::shape::Solid;
    use rapier::dynamics::{MassProperties, RigidBodyBuilder};
    use rapier::math::{AngVector, Rotation, Vector as EngineVector};

    /// A body without gyroscopic forces: there are none in the plane.
    fn without_gyration(body: RigidBodyBuilder) -> RigidBodyBuilder {
        body
    }

    /// Mass and moment of inertia of a solid whose centroid is its frame's origin, its lengths
    /// times a scale.
    fn weight(solid: &Solid<D>, mass: f64, scale: f64) -> MassProperties {
        let moment = solid.inertia()[(2, 2)] / solid.volume() * scale * scale * mass;
        MassProperties::new(EngineVector::ZERO, mass, moment)
    }

    fn matrix(rotation: &Rotation) -> Matrix<D> {
        Matrix::<D>::new(rotation.re, -rotation.im, rotation.im, rotation.re)
    }

    fn rotation(matrix: &Matrix<D>) -> Rotation {
        Rotation::from_cos_sin_unchecked(matrix[(0, 0)], matrix[(1, 0)])
    }

    fn spin(angular: AngVector) -> Vector<3> {
        Vector::<3>::new(0.0, 0.0, angular)
    }

    fn angular(spin: &Vector<3>) -> AngVector {
        spin.z
    }
}

#[path = "."]
#[allow(clippy::duplicate_mod, reason = "one source for both dimensions")]
mod space {
    use crate::shape::space as geometry;
    use rapier3d as rapier;
    const D: usize = 3;

    #[path = "rapier.rs"]
    mod adapter;

    use super::{Matrix, Vector};
    use crate::shape::Solid;
    use rapier::dynamics::{MassProperties, RigidBodyBuilder};
    use rapier::math::{AngVector, Matrix as EngineMatrix, Rotation, Vector as EngineVector};

    /// A body without gyroscopic forces.
    fn without_gyration(body: RigidBodyBuilder) -> RigidBodyBuilder {
        body.gyroscopic_forces_enabled(false)
    }

    /// Mass and inertia tensor of a solid whose centroid is its frame's origin, its lengths times
    /// a scale.
    fn weight(solid: &Solid<D>, mass: f64, scale: f64) -> MassProperties {
        let tensor = solid.inertia() / solid.volume() * scale * scale * mass;
        let columns: [f64; 9] = std::array::from_fn(|k| tensor.as_slice()[k]);
        let tensor = EngineMatrix::from_cols_array(&columns);
        MassProperties::with_inertia_matrix(EngineVector::ZERO, mass, tensor)
    }

    fn matrix(rotation: &Rotation) -> Matrix<D> {
        Matrix::<D>::from_column_slice(&EngineMatrix::from_quat(*rotation).to_cols_array())
    }

    fn rotation(matrix: &Matrix<D>) -> Rotation {
        let columns: [f64; 9] = std::array::from_fn(|k| matrix.as_slice()[k]);
        Rotation::from_mat3(&EngineMatrix::from_cols_array(&columns)).normalize()
    }

    fn spin(angular: AngVector) -> Vector<3> {
        angular.to_array().into()
    }

    fn angular(spin: &Vector<3>) -> AngVector {
        <[f64; 3]>::from(*spin).into()
    }
}

const _: () = {
    // Both dimensions must have an engine, or no world of that dimension could run.
    const fn has_engine<const D: usize>()
    where
        In<D>: Engine<D>,
    {
    }
    has_engine::<2>();
    has_engine::<3>();
};
