//! The adapter to rapier, compiled once for each dimension (see `dynamics::plane` and
//! `dynamics::space`, which say what `rapier`, `geometry` and `D` are).

#[path = "rapier/contacts.rs"]
mod contacts;
#[path = "rapier/turning.rs"]
mod turning;
#[path = "rapier/units.rs"]
mod units;

use rayon::prelude::*;

use super::rapier::math::Vector as RapierVector;
use super::rapier::prelude::{
    ActiveHooks, ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle,
};
use super::{D, angular, geometry, matrix, rotation, spin, weight, without_gyration};
use crate::dynamics::contact::{CROWDED, Change, can_turn, has_friction};
use crate::dynamics::{Drive, Engine, Physics, Steering, Touch, Unusable};
use crate::math::{Matrix, Vector};
use crate::parallel::{CHUNK, for_each};
use crate::shape::{In, Pose};
use crate::world::World;
use contacts::Surfaces;
use turning::lacking;
use units::Units;

/// Highest speed the engine lets a body have, so high that it never shows.
const NO_SPEED_CAP: f64 = 1e150;

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
fn agent(
    world: &World<D>,
    i: usize,
    friction: bool,
    units: &Units,
) -> (RigidBodyBuilder, ColliderBuilder) {
    let (agents, physics) = (&world.agents, &world.spec.physics);
    let group = &world.spec.agents[agents.group[i]];
    let solid = &world.solids[agents.group[i]];
    let pose = Pose::from_matrix(agents.positions[i], agents.rotations[i]);
    let mut body = RigidBodyBuilder::dynamic()
        .pose(units.pose(&pose))
        .linvel(units.length(&agents.velocities[i]))
        .can_sleep(false)
        // A blow may set it spinning as fast as it will. In space gyroscopic forces, which the
        // engine takes explicitly, would make fast spins faster.
        .allow_fast_rotation(D == 2)
        .user_data(i as u128);
    if !can_turn(world, agents.group[i], friction) {
        body = body.lock_rotations();
    }
    if solid.is_ball() {
        // A ball turns alike about all axes.
        body = without_gyration(body);
    }
    let mass = units.mass(agents.mass[i]);
    // The solid was built once already when the world was made.
    let shape = units.shape(solid.shape());
    let collider = ColliderBuilder::new(geometry::solid(&shape).expect("made before"));
    let collider = match solid.is_ball() {
        true => collider.mass(mass),
        false => collider.mass_properties(weight(solid, mass, units.scale())),
    };
    let collider = collider
        .user_data(i as u128)
        // The engine holds together what it is told to, and lets nothing bounce.
        .active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS)
        .restitution(0.0)
        .friction(group.friction.unwrap_or(physics.friction));
    (body, collider)
}

/// The agents and obstacles of a world in rapier.
struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    /// The agents that can turn.
    turning: Vec<RigidBodyHandle>,
    /// The obstacles that move, by index, and their bodies.
    moving: Vec<(usize, RigidBodyHandle)>,
    surfaces: Surfaces,
    units: Units,
    /// Whether the agents are known to the engine and not looked at again; see `settle`.
    settled: bool,
}

impl Rapier {
    fn new(world: &World<D>) -> Self {
        let physics = &world.spec.physics;
        let mut engine = PhysicsWorld {
            // Gravity is part of the forces, so that it gets the same treatment.
            gravity: RapierVector::ZERO,
            ..PhysicsWorld::default()
        };
        let units = Units::new(world);
        let parameters = &mut engine.integration_parameters;
        parameters.dt = world.spec.time.step;
        parameters.num_solver_iterations = physics.solver_iterations;
        parameters.length_unit = units.rest;
        parameters.normalized_max_linear_velocity = NO_SPEED_CAP / units.rest;
        // As far from each other as what it is told to hold may be.
        let widest = world.solids.iter().map(|solid| solid.radius());
        let widest = widest.fold(0.0, f64::max) * units.scale();
        parameters.normalized_prediction_distance = CROWDED * widest / units.rest;
        // What moves fast is followed by us.
        parameters.max_ccd_substeps = 0;
        // The ledger reads distances and impulses, so they must be those of this step
        // and of every contact.
        parameters.contact_recycling = false;
        parameters.contact_clustering = false;

        let agents = &world.agents;
        let friction = has_friction(world);
        for i in 0..agents.len() {
            let (body, collider) = agent(world, i, friction, &units);
            engine.insert(body, collider);
        }
        for (index, obstacle) in world.obstacles.iter().enumerate() {
            let body = obstacle.motion().map(|_| {
                // Not "position-based": such a body has no velocity yet when contacts are
                // solved.
                let body = RigidBodyBuilder::kinematic_velocity_based()
                    .pose(units.pose(&obstacle.pose))
                    .can_sleep(false)
                    .user_data((agents.len() + index) as u128);
                engine.bodies.insert(body)
            });
            let own = &world.spec.obstacles[index];
            let hooks = match own.friction {
                None => ActiveHooks::empty(),
                Some(_) => ActiveHooks::MODIFY_SOLVER_CONTACTS,
            };
            for (number, part) in obstacle.parts().iter().enumerate() {
                // The shape was built once already when the obstacle was made.
                let Some(solid) = geometry::solid(&units.shape(&part.shape)) else {
                    continue;
                };
                let pose = match (&body, &part.pose) {
                    (None, _) => part.world_pose(&obstacle.pose),
                    (Some(_), Some(pose)) => pose.clone(),
                    (Some(_), None) => Pose::new(Vector::zeros(), [0.0; 3]),
                };
                let collider = ColliderBuilder::new(solid)
                    .position(units.pose(&pose))
                    // Without mass the body's centre is its frame's origin.
                    .density(0.0)
                    .user_data((number as u128) << 64 | (agents.len() + index) as u128)
                    .active_hooks(hooks)
                    .restitution(0.0)
                    .friction(physics.friction);
                engine.insert_collider(collider, body);
            }
        }
        Self::around(engine, world).expect("it was just filled")
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
        let friction = has_friction(world);
        let groups = bodies.iter().zip(&world.agents.group);
        let turning = groups.filter(|(_, group)| can_turn(world, **group, friction));
        Some(Self {
            turning: turning.map(|(handle, _)| *handle).collect(),
            moving: obstacles
                .filter_map(|(index, body)| Some((index, body?)))
                .collect(),
            units: Units::new(world),
            settled: false,
            bodies,
            world: engine,
            surfaces: Surfaces {
                agents,
                friction: world
                    .spec
                    .obstacles
                    .iter()
                    .map(|own| own.friction)
                    .collect(),
                lasting: Vec::new(),
            },
        })
    }

    /// Turns bodies on by what the engine's turning lacks. Its colliders follow with the next
    /// step, for the little that it is.
    fn turn_on(&mut self) {
        let parameters = &self.world.integration_parameters;
        let substeps = parameters.num_solver_iterations;
        let substep = parameters.dt / substeps as f64;
        for handle in &self.turning {
            let spin = spin(self.world.bodies[*handle].angvel());
            if let Some((axis, angle)) = lacking(&spin, substep, substeps) {
                let body = &mut self.world.bodies[*handle];
                let stands = Pose::from_matrix(Vector::zeros(), matrix(body.rotation()));
                let turned = stands.turned(&Vector::zeros(), axis, angle);
                body.set_rotation(rotation(turned.rotation()), false);
            }
        }
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
                *position = self.units.read(body.translation());
                *velocity = self.units.read(body.linvel());
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
            self.world.bodies[*handle].set_linvel(self.units.length(velocity), false);
        }
    }

    fn step(&mut self, drive: Drive<'_, D>) {
        for (force, handle) in drive.forces.iter().zip(&self.bodies) {
            let body = &mut self.world.bodies[*handle];
            body.reset_forces(false);
            body.add_force(self.units.force(force), false);
        }
        for (steering, handle) in drive.steering.iter().zip(&self.bodies) {
            let body = &mut self.world.bodies[*handle];
            // A torque lasts until it is taken back, as forces do.
            body.reset_torques(false);
            match steering {
                Steering::Free => {}
                Steering::Torque(torque) => {
                    body.add_torque(angular(&self.units.torque(torque)), false);
                }
                Steering::Spin(spin) => body.set_angvel(angular(spin), false),
            }
        }
        let step = self.world.integration_parameters.dt;
        for (index, handle) in &self.moving {
            let Some(obstacle) = drive.obstacles.get(*index) else {
                continue;
            };
            let body = &mut self.world.bodies[*handle];
            let way = self.units.length(&obstacle.pose.translation) - body.translation();
            body.set_linvel(way / step, false);
            let rate = obstacle.twist().map_or([0.0; 3], |twist| twist.rate);
            body.set_angvel(angular(&rate.into()), false);
        }
        self.surfaces.lasting.clear();
        self.surfaces.lasting.extend_from_slice(drive.lasting);
        self.world.step_with_events(&self.surfaces, &());
        self.settle();
        self.turn_on();
        // Exactly where they are to be: the engine's own steps would drift away.
        for (index, handle) in &self.moving {
            if let Some(obstacle) = drive.obstacles.get(*index) {
                let pose = self.units.pose(&obstacle.pose);
                self.world.bodies[*handle].set_position(pose, false);
            }
        }
    }

    fn place(&mut self, change: &Change<D>) {
        let pose = Pose::from_matrix(change.position, change.rotation);
        let body = &mut self.world.bodies[self.bodies[change.agent]];
        let pose = self.units.pose(&pose);
        body.set_position(pose, false);
        body.set_linvel(self.units.length(&change.velocity), false);
        body.set_angvel(angular(&change.spin), false);
        // The engine does not look at agents that settled; their colliders it does.
        for collider in body.colliders().to_vec() {
            self.world.colliders[collider].set_position(pose);
        }
    }

    fn touches(&self, out: &mut Vec<Touch<D>>) {
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
