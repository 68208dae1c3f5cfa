//! The adapter to rapier, compiled once for each dimension (see `dynamics::plane` and
//! `dynamics::space`, which say what `rapier`, `geometry` and `D` are).

use super::rapier::geometry::ContactPair;
use super::rapier::math::Vector as RapierVector;
use super::rapier::prelude::{
    ColliderBuilder, ColliderHandle, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle,
};
use super::{D, geometry};
use crate::dynamics::{Drive, Engine, Physics, Touch, Touched, Unusable};
use crate::math::Vector;
use crate::shape::In;
use crate::world::World;

/// Highest speed the engine lets a body have, so high that it never shows.
const NO_SPEED_CAP: f64 = 1e150;

impl Engine<D> for In<D> {
    fn physics(world: &World<D>) -> Box<dyn Physics<D>> {
        Box::new(Rapier::new(world))
    }

    fn restore(world: &World<D>, saved: &[u8]) -> Result<Box<dyn Physics<D>>, Unusable> {
        let engine: PhysicsWorld = postcard::from_bytes(saved).map_err(unusable)?;
        let agents = world.agents.len();
        let mut bodies = vec![None; agents];
        for (handle, body) in engine.bodies.iter() {
            if let Some(place) = bodies.get_mut(body.user_data as usize) {
                *place = Some(handle);
            }
        }
        let bodies: Option<Vec<_>> = bodies.into_iter().collect();
        match bodies {
            Some(bodies) if engine.colliders.len() == agents + world.obstacles.len() => {
                Ok(Box::new(Rapier {
                    world: engine,
                    bodies,
                }))
            }
            _ => Err(Unusable("it is the state of another world".to_owned())),
        }
    }
}

fn unusable(error: postcard::Error) -> Unusable {
    Unusable(error.to_string())
}

/// The agents and obstacles of a world in rapier.
struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
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
        parameters.dt = world.spec.time.step;
        parameters.num_solver_iterations = physics.solver_iterations;
        parameters.length_unit = physics.length_unit;
        parameters.normalized_max_linear_velocity = NO_SPEED_CAP / physics.length_unit;
        // The ledger reads distances and impulses, so they must be those of this step
        // and of every contact.
        parameters.contact_recycling = false;
        parameters.contact_clustering = false;

        let agents = &world.agents;
        let bodies: Vec<_> = (0..agents.len())
            .map(|i| {
                let mut body = RigidBodyBuilder::dynamic()
                    .translation(vector(&agents.positions[i]))
                    .linvel(vector(&agents.velocities[i]))
                    .can_sleep(false)
                    .user_data(i as u128)
                    // Contacts are foreseen along a whole step's travel: of agents
                    // with each other, which the engine's sweeps leave out, and with walls.
                    .soft_ccd_prediction(f64::MAX);
                if physics.friction == 0.0 {
                    // Nothing can turn a ball without friction.
                    body = body.lock_rotations();
                }
                let collider = ColliderBuilder::ball(agents.radius[i])
                    .mass(agents.mass[i])
                    .user_data(i as u128)
                    .restitution(physics.restitution)
                    .friction(physics.friction);
                engine.insert(body, collider).0
            })
            .collect();
        for (index, obstacle) in world.obstacles.iter().enumerate() {
            // The shape was built once already when the obstacle was made.
            let Some(solid) = geometry::solid(&obstacle.shape) else {
                continue;
            };
            let collider = ColliderBuilder::new(solid)
                .position(geometry::pose(&obstacle.pose))
                .user_data((bodies.len() + index) as u128)
                .restitution(physics.restitution)
                .friction(physics.friction);
            engine.insert_collider(collider, None);
        }
        Self {
            world: engine,
            bodies,
        }
    }

    /// What a collider belongs to, by its user data: the agents count first, then the
    /// obstacles.
    fn owner(&self, collider: ColliderHandle) -> Touched {
        let index = self.world.colliders[collider].user_data as usize;
        match index.checked_sub(self.bodies.len()) {
            None => Touched::Agent(index),
            Some(obstacle) => Touched::Obstacle(obstacle),
        }
    }

    fn touch(&self, pair: &ContactPair) -> Option<Touch<D>> {
        let mut gap = f64::INFINITY;
        let mut impulse = 0.0;
        let mut normal = RapierVector::ZERO;
        for manifold in pair.manifolds() {
            for point in &manifold.points {
                impulse += point.data.impulse;
                if point.dist < gap {
                    gap = point.dist;
                    normal = manifold.data.normal;
                }
            }
        }
        // The engine calls a pair in contact from a gap of 2% of a length unit on.
        if impulse <= 0.0 && gap > 0.0 {
            return None;
        }
        let (first, second) = (self.owner(pair.collider1), self.owner(pair.collider2));
        let (agent, touched, normal) = match (first, second) {
            (Touched::Agent(a), Touched::Agent(b)) if b < a => (b, first, -normal),
            (Touched::Agent(a), _) => (a, second, normal),
            (Touched::Obstacle(_), Touched::Agent(b)) => (b, first, -normal),
            (Touched::Obstacle(_), Touched::Obstacle(_)) => return None,
        };
        Some(Touch {
            agent,
            touched,
            gap,
            impulse,
            approach_speed: 0.0,
            normal: normal.to_array().into(),
            position: Vector::zeros(),
        })
    }
}

impl Physics<D> for Rapier {
    fn read(&self, positions: &mut [Vector<D>], velocities: &mut [Vector<D>]) {
        let out = positions.iter_mut().zip(velocities);
        for ((position, velocity), handle) in out.zip(&self.bodies) {
            let body = &self.world.bodies[*handle];
            *position = body.translation().to_array().into();
            *velocity = body.linvel().to_array().into();
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
        self.world.step();
    }

    fn detect(&mut self) {
        self.world.detect_collisions(&(), &());
    }

    fn touches(&self, out: &mut Vec<Touch<D>>) {
        let pairs = self.world.narrow_phase.contact_pairs();
        out.extend(pairs.filter_map(|pair| self.touch(pair)));
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
