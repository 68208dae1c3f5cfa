//! The adapter to rapier, compiled once for each dimension (see `dynamics::plane` and
//! `dynamics::space`, which say what `rapier`, `geometry` and `D` are).

#[path = "rapier/contacts.rs"]
mod contacts;

use rayon::prelude::*;

use super::rapier::math::{Pose as RapierPose, Vector as RapierVector};
use super::rapier::prelude::{
    ActiveHooks, ColliderBuilder, IntegrationParameters, PhysicsWorld, RigidBodyBuilder,
    RigidBodyHandle,
};
use super::{D, angular, geometry, matrix, rotation, spin, weight, without_gyration};
use crate::dynamics::{Drive, Engine, Physics, Steering, Touch, Unusable};
use crate::math::{Matrix, Vector};
use crate::parallel::{CHUNK, for_each};
use crate::shape::{In, Obstacle, Pose};
use crate::world::World;
use crate::world::spec::HeadingSpec;
use contacts::Surfaces;

/// Highest speed the engine lets a body have, so high that it never shows.
const NO_SPEED_CAP: f64 = 1e150;

/// The largest angle that the engine turns a body by in a step.
const LARGEST_TURN: f64 = std::f64::consts::FRAC_PI_4;

impl Engine<D> for In<D> {
    fn physics(world: &World<D>) -> Box<dyn Physics<D>> {
        Box::new(Rapier::new(world))
    }

    fn restore(world: &World<D>, saved: &[u8]) -> Result<Box<dyn Physics<D>>, Unusable> {
        let engine: PhysicsWorld = postcard::from_bytes(saved).map_err(unusable)?;
        let parts: usize = world.obstacles.iter().map(|it| it.parts().len()).sum();
        match Rapier::around(engine, world) {
            Some(rapier) if rapier.world.colliders.len() == world.agents.len() + parts => {
                Ok(Box::new(rapier))
            }
            _ => Err(Unusable("it is the state of another world".to_owned())),
        }
    }
}

fn unusable(error: postcard::Error) -> Unusable {
    Unusable(error.to_string())
}

/// The body of an agent and its collider, in a world with friction or without.
fn agent(world: &World<D>, i: usize, friction: bool) -> (RigidBodyBuilder, ColliderBuilder) {
    let (agents, physics) = (&world.agents, &world.spec.physics);
    let group = &world.spec.agents[agents.group[i]];
    let solid = &world.solids[agents.group[i]];
    let pose = RapierPose::from_parts(vector(&agents.positions[i]), rotation(&agents.rotations[i]));
    let mut body = RigidBodyBuilder::dynamic()
        .pose(pose)
        .linvel(vector(&agents.velocities[i]))
        .can_sleep(false)
        .user_data(i as u128)
        // Contacts are foreseen along a whole step's travel: of agents
        // with each other, which the engine's sweeps leave out, and with walls.
        .soft_ccd_prediction(f64::MAX);
    let turns = match solid.is_ball() {
        // Nothing can turn a ball without friction.
        true => friction,
        false => group.heading != Some(HeadingSpec::Fixed),
    };
    if !turns {
        body = body.lock_rotations();
    }
    if solid.is_ball() {
        // A ball turns alike about all axes.
        body = without_gyration(body);
    }
    // The solid was built once already when the world was made.
    let form = geometry::solid(solid.shape()).expect("made before");
    let collider = ColliderBuilder::new(form);
    let collider = match solid.is_ball() {
        true => collider.mass(agents.mass[i]),
        false => collider.mass_properties(weight(solid, agents.mass[i])),
    };
    let collider = collider
        .user_data(i as u128)
        .restitution(group.restitution.unwrap_or(physics.restitution))
        .friction(group.friction.unwrap_or(physics.friction));
    (body, collider)
}

/// Whether any surface of a world has friction.
fn has_friction(world: &World<D>) -> bool {
    let groups = world.spec.agents.iter().filter_map(|it| it.friction);
    let obstacles = world.spec.obstacles.iter().filter_map(|it| it.friction);
    world.spec.physics.friction > 0.0 || groups.chain(obstacles).any(|it| it > 0.0)
}

/// The agents and obstacles of a world in rapier.
struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    /// The obstacles that move, by index, and their bodies.
    moving: Vec<(usize, RigidBodyHandle)>,
    surfaces: Surfaces,
    /// How far the surface of each body that is not round is from its centre at most.
    reaches: Vec<(RigidBodyHandle, f64)>,
    /// How often in a step contacts are found and solved.
    passes: usize,
    /// The contacts of all passes of the last step but the last.
    earlier: Vec<Touch<D>>,
    /// How far contacts are foreseen at least, for the sake of obstacles that turn.
    foresight: f64,
    /// Whether the agents are known to the engine and not looked at again; see `settle`.
    settled: bool,
}

/// How far a turning obstacle's surface can move in a step beyond what its own velocity
/// tells: contacts are foreseen by velocities of bodies, not of their points.
fn sweep(obstacle: &Obstacle<D>, step: f64) -> f64 {
    let speed = obstacle.twist().map_or(0.0, |twist| {
        let rate = twist.rate.iter().map(|x| x * x).sum::<f64>().sqrt();
        match rate > 0.0 {
            true => rate * obstacle.reach(),
            false => 0.0,
        }
    });
    speed * step
}

impl Rapier {
    fn new(world: &World<D>) -> Self {
        let physics = &world.spec.physics;
        let mut engine = PhysicsWorld {
            // Gravity is part of the forces, so that it gets the same treatment.
            gravity: RapierVector::ZERO,
            ..PhysicsWorld::default()
        };
        let parameters = &mut engine.integration_parameters;
        let passes = world.spec.passes();
        parameters.dt = world.spec.time.step / passes as f64;
        parameters.num_solver_iterations = physics.solver_iterations;
        parameters.length_unit = physics.length_unit;
        parameters.normalized_max_linear_velocity = NO_SPEED_CAP / physics.length_unit;
        // The ledger reads distances and impulses, so they must be those of this step
        // and of every contact.
        parameters.contact_recycling = false;
        parameters.contact_clustering = false;

        let agents = &world.agents;
        let friction = has_friction(world);
        for i in 0..agents.len() {
            let (body, collider) = agent(world, i, friction);
            engine.insert(body, collider);
        }
        for (index, obstacle) in world.obstacles.iter().enumerate() {
            let body = obstacle.motion().map(|_| {
                // Not "position-based": such a body has no velocity yet when contacts are
                // foreseen.
                let body = RigidBodyBuilder::kinematic_velocity_based()
                    .pose(geometry::pose(&obstacle.pose))
                    .can_sleep(false)
                    // Its own travel is foreseen as that of the agents.
                    .soft_ccd_prediction(f64::MAX)
                    .user_data((agents.len() + index) as u128);
                engine.bodies.insert(body)
            });
            let own = &world.spec.obstacles[index];
            let hooks = match (own.restitution, own.friction) {
                (None, None) => ActiveHooks::empty(),
                _ => ActiveHooks::MODIFY_SOLVER_CONTACTS,
            };
            for part in obstacle.parts() {
                // The shape was built once already when the obstacle was made.
                let Some(solid) = geometry::solid(&part.shape) else {
                    continue;
                };
                let pose = match (&body, &part.pose) {
                    (None, _) => part.world_pose(&obstacle.pose),
                    (Some(_), Some(pose)) => pose.clone(),
                    (Some(_), None) => Pose::new(Vector::zeros(), [0.0; 3]),
                };
                let collider = ColliderBuilder::new(solid)
                    .position(geometry::pose(&pose))
                    // Without mass the body's centre is its frame's origin.
                    .density(0.0)
                    .user_data((agents.len() + index) as u128)
                    .active_hooks(hooks)
                    .restitution(physics.restitution)
                    .friction(physics.friction);
                engine.insert_collider(collider, body);
            }
        }
        let mut rapier = Self::around(engine, world).expect("it was just filled");
        rapier.foresee();
        rapier
    }

    /// The agents and obstacles of a world in an engine that holds them, which it may have
    /// moved already; `None` where it holds others.
    fn around(engine: PhysicsWorld, world: &World<D>) -> Option<Self> {
        let agents = world.agents.len();
        let mut bodies = vec![None; agents + world.obstacles.len()];
        for (handle, body) in engine.bodies.iter() {
            *bodies.get_mut(body.user_data as usize)? = Some(handle);
        }
        let obstacles = bodies.split_off(agents).into_iter().enumerate();
        let bodies = bodies.into_iter().collect::<Option<Vec<_>>>()?;
        let reaches = bodies.iter().enumerate().filter_map(|(i, body)| {
            let solid = &world.solids[world.agents.group[i]];
            (!solid.is_ball()).then(|| (*body, solid.radius()))
        });
        let sweeps = world.obstacles.iter();
        let farthest = sweeps
            .map(|it| sweep(it, world.spec.time.step))
            .fold(0.0, f64::max);
        let usual = IntegrationParameters::default().normalized_prediction_distance;
        Some(Self {
            moving: obstacles
                .filter_map(|(index, body)| Some((index, body?)))
                .collect(),
            reaches: reaches.collect(),
            passes: world.spec.passes(),
            earlier: Vec::new(),
            foresight: usual + farthest / world.spec.physics.length_unit,
            settled: false,
            bodies,
            world: engine,
            surfaces: Surfaces {
                agents,
                own: world
                    .spec
                    .obstacles
                    .iter()
                    .map(|own| (own.restitution, own.friction))
                    .collect(),
            },
        })
    }

    /// Spares the engine to look at every agent before every step. It keeps a list of the
    /// bodies that were lent to be changed, since it must follow what moves or wakes them;
    /// forces do neither, and are read from every body anyway. A body on the list is marked,
    /// and not put there again. The loan of all bodies begins with an empty list: so here each
    /// agent gets its mark, and the list is dropped. Nothing else may be on it, which is so
    /// right after a step.
    fn settle(&mut self) {
        if !self.settled {
            for body in &self.bodies {
                self.world.bodies.get_mut(*body);
            }
            drop(self.world.bodies.iter_mut());
            self.settled = true;
        }
    }

    /// Has contacts foreseen as far as obstacles and bodies that are not round can swing their
    /// ends in a step: what the engine does by itself looks along the travel of their centres
    /// alone.
    fn foresee(&mut self) {
        let swing = |(body, reach): &(RigidBodyHandle, f64)| {
            let speed = spin(self.world.bodies[*body].angvel()).norm();
            (speed * self.world.integration_parameters.dt).min(LARGEST_TURN) * reach
        };
        let widest = self.reaches.iter().map(swing).fold(0.0, f64::max);
        let parameters = &mut self.world.integration_parameters;
        // Two may swing towards each other.
        parameters.normalized_prediction_distance =
            self.foresight.max(2.0 * widest / parameters.length_unit);
    }
}

/// Positions and velocities to be read, and whose they are.
type Part<'a> = (
    (&'a mut [Vector<D>], &'a mut [Vector<D>]),
    &'a [RigidBodyHandle],
);

impl Physics<D> for Rapier {
    fn read(&self, positions: &mut [Vector<D>], velocities: &mut [Vector<D>]) {
        let read = |((positions, velocities), handles): Part<'_>| {
            let out = positions.iter_mut().zip(velocities);
            for ((position, velocity), handle) in out.zip(handles) {
                let body = &self.world.bodies[*handle];
                *position = body.translation().to_array().into();
                *velocity = body.linvel().to_array().into();
            }
        };
        let out = positions.par_chunks_mut(CHUNK);
        let out = out.zip(velocities.par_chunks_mut(CHUNK));
        for_each(
            self.bodies.len(),
            out.zip(self.bodies.par_chunks(CHUNK)),
            read,
        );
    }

    fn read_attitudes(&self, rotations: &mut [Matrix<D>], spins: &mut [Vector<3>]) {
        let out = rotations.iter_mut().zip(spins);
        for ((rotation, angular), handle) in out.zip(&self.bodies) {
            let body = &self.world.bodies[*handle];
            *rotation = matrix(body.rotation());
            *angular = spin(body.angvel());
        }
    }

    fn set_velocities(&mut self, velocities: &[Vector<D>]) {
        for (velocity, handle) in velocities.iter().zip(&self.bodies) {
            self.world.bodies[*handle].set_linvel(vector(velocity), false);
        }
    }

    fn step(&mut self, drive: Drive<'_, D>) {
        for (force, handle) in drive.forces.iter().zip(&self.bodies) {
            let body = &mut self.world.bodies[*handle];
            body.reset_forces(false);
            body.add_force(vector(force), false);
        }
        for (steering, handle) in drive.steering.iter().zip(&self.bodies) {
            let body = &mut self.world.bodies[*handle];
            // A torque lasts until it is taken back, as forces do.
            body.reset_torques(false);
            match steering {
                Steering::Free => {}
                Steering::Torque(torque) => body.add_torque(angular(torque), false),
                Steering::Spin(spin) => body.set_angvel(angular(spin), false),
            }
        }
        let step = self.world.integration_parameters.dt * self.passes as f64;
        for (index, handle) in &self.moving {
            let Some(obstacle) = drive.obstacles.get(*index) else {
                continue;
            };
            let body = &mut self.world.bodies[*handle];
            let way = vector(&obstacle.pose.translation) - body.translation();
            body.set_linvel(way / step, false);
            let rate = obstacle.twist().map_or([0.0; 3], |twist| twist.rate);
            body.set_angvel(angular(&rate.into()), false);
        }
        let mut earlier = std::mem::take(&mut self.earlier);
        earlier.clear();
        for pass in 0..self.passes {
            if pass > 0 {
                earlier.extend(self.found());
            }
            self.foresee();
            self.world.step_with_events(&self.surfaces, &());
        }
        self.earlier = earlier;
        self.settle();
        // Exactly where they are to be: the engine's own steps would drift away.
        for (index, handle) in &self.moving {
            if let Some(obstacle) = drive.obstacles.get(*index) {
                let pose = geometry::pose(&obstacle.pose);
                self.world.bodies[*handle].set_position(pose, false);
            }
        }
    }

    fn detect(&mut self) {
        self.earlier.clear();
        self.world.detect_collisions(&self.surfaces, &());
    }

    fn touches(&self, out: &mut Vec<Touch<D>>) {
        out.extend_from_slice(&self.earlier);
        out.extend(self.found());
    }

    fn lost(&self) -> Vec<usize> {
        let lost = self.world.quarantine().bodies().iter();
        lost.filter_map(|body| self.world.bodies.get(*body))
            .map(|body| body.user_data as usize)
            .collect()
    }

    fn save(&self) -> Result<Vec<u8>, Unusable> {
        postcard::to_stdvec(&self.world).map_err(unusable)
    }
}

fn vector(v: &Vector<D>) -> RapierVector {
    <[f64; D]>::from(*v).into()
}
