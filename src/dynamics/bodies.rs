//! The coupling of a flock to rigid bodies, second order in the step.
//!
//! In a step of size h with n solver substeps and the acceleration F held fixed, the engine
//! does u ← u + hF and x ← x + h u + h²F(n + 1)/(2n). Taken as they stand, u and x follow
//! the equations of motion to first order only. But if u is read as the velocity at time
//! t − h/(2n), half a substep earlier, then
//!
//! - the position update is exact to second order;
//! - the velocity update is, when F is the acceleration in the middle of the interval that
//!   u spans, at t + h/2 − h/(2n): F_k = a_k + (n − 1)/(2n) (a_k − a_{k−1});
//! - the velocity at t is u + h/(2n) F_{k−1}, to second order.
//!
//! For n = 1 this is the leapfrog: F_k = a_k, and u lives half a step behind. The laws stay
//! as they are, each is evaluated once a step, and forces that sum to zero keep the
//! momentum. The price is stability: velocity feedback of rate λ needs
//! λh < 2n²/((n + 1)(2n − 1)), which is 1 for n = 1 and not below 8/9 for any n.
//!
//! A body that is held against another has its velocity read as it stands: the engine's
//! velocity after a contact is the one it moves on with. Blows are not the engine's: it takes
//! the step as if nothing met but what lasts, and `contact` follows the bounces on the ways
//! that it gives, each of which is the parabola x + v s + F s²/2 from the velocity v at the
//! start of the step.

mod decision;
mod impacts;
mod state;
mod touch;

pub use state::BodiesState;

use crate::dynamics::actuator::Actuators;
use crate::dynamics::attitude::Attitudes;
use crate::dynamics::contact::Contacts;
use crate::dynamics::failure::{Failure, LARGEST};
use crate::dynamics::{Cuts, Drive, Engine, Gaps, Physics, Snapshot, Strain, Touch, turn};
use crate::law::{Flock, Pulls, State};
use crate::math::{Matrix, Vector, axis};

use crate::profile::Stopwatch;
use crate::shape::{In, Obstacle, Pose};
use crate::world::World;
use decision::Verdict;

/// Agents as rigid bodies.
pub struct Bodies<const D: usize> {
    physics: Box<dyn Physics<D>>,
    groups: Vec<usize>,
    masses: Vec<f64>,
    actuators: Actuators,
    /// How the bodies stand; nothing where all are balls.
    attitudes: Option<Attitudes<D>>,
    gravity: Vector<D>,
    step_size: f64,
    substeps: f64,
    step: u64,
    /// Positions and velocities of the step that is being taken.
    next: (Vec<Vector<D>>, Vec<Vector<D>>),
    positions: Vec<Vector<D>>,
    /// Velocities at the time of the positions: those that laws and observers see.
    velocities: Vec<Vector<D>>,
    /// Where the bodies head: balls where their velocities point, or last pointed.
    headings: Vec<Vector<D>>,
    /// The obstacles where they are now, and where they will be at the end of the step.
    obstacles: Vec<Obstacle<D>>,
    /// Velocities as the engine has them, half a substep behind.
    engine_velocities: Vec<Vector<D>>,
    /// What the laws ask for now, and what they asked for a step ago.
    wanted: Vec<Vector<D>>,
    wanted_before: Vec<Vector<D>>,
    /// What the actuators exert, what is applied in all, and the accelerations it causes.
    pushes: Vec<Vector<D>>,
    forces: Vec<Vector<D>>,
    applied: Vec<Vector<D>>,
    /// From the velocity that the engine will have to that at the end of the step.
    ahead: Vec<Vector<D>>,
    /// Where laws pull softly, what of `ahead` makes velocities of third order, and what was
    /// applied in the last step, if nothing was touched in it; else empty.
    late: Vec<Vector<D>>,
    earlier: Vec<Option<Vector<D>>>,
    /// The pulls of the laws that relax.
    pulls: Pulls<D>,
    touches: Vec<Touch<D>>,
    contacts: Contacts<D>,
    /// Whether each body was pressed against another in the step.
    pressed: Vec<bool>,
    /// Where the obstacles stood at the start of the step.
    stood: Vec<Pose<D>>,
    /// How the bodies stood then, where they turn.
    stood_turned: Vec<Matrix<D>>,
    /// Scratch: what came of the decisions for each chunk of agents.
    verdicts: Vec<Verdict<D>>,
    /// The engine's own steps, and finding out what touched.
    watches: [Stopwatch; 2],
}

impl<const D: usize> Bodies<D> {
    /// The bodies of a world at its start, about to obey `flock`.
    pub fn new(world: &World<D>, flock: &mut Flock<D>) -> Result<Self, Failure>
    where
        In<D>: Engine<D>,
    {
        let mut bodies = Self::around(<In<D> as Engine<D>>::physics(world), world);
        bodies.look_around();
        // The first step is taken with the forces decided here.
        bodies.ask(flock);
        bodies.decide()?;
        if bodies.pulls.is_empty() {
            // Set the engine's velocities back by half a substep. What relaxes cannot be set
            // back, and starts with a shorter step instead.
            let lag = bodies.lag();
            for (velocity, applied) in bodies.engine_velocities.iter_mut().zip(&bodies.applied) {
                *velocity -= applied * lag;
            }
            bodies.physics.set_velocities(&bodies.engine_velocities);
        }
        Ok(bodies)
    }

    /// Bodies that this engine moves, before anything has happened to them.
    fn around(physics: Box<dyn Physics<D>>, world: &World<D>) -> Self
    where
        In<D>: Engine<D>,
    {
        let agents = &world.agents;
        let zeros = vec![Vector::zeros(); agents.len()];
        let mut bodies = Self {
            physics,
            groups: agents.group.clone(),
            masses: agents.mass.clone(),
            actuators: Actuators::new(agents, world.spec.time.step),
            attitudes: Attitudes::new(world),
            gravity: world.gravity,
            step_size: world.spec.time.step,
            substeps: world.spec.physics.solver_iterations as f64,
            step: 0,
            next: (zeros.clone(), zeros.clone()),
            positions: agents.positions.clone(),
            velocities: agents.velocities.clone(),
            headings: vec![axis(0); agents.len()],
            obstacles: world.obstacles.clone(),
            engine_velocities: agents.velocities.clone(),
            wanted: zeros.clone(),
            wanted_before: zeros.clone(),
            pushes: zeros.clone(),
            forces: zeros.clone(),
            applied: zeros.clone(),
            ahead: zeros,
            late: Vec::new(),
            earlier: Vec::new(),
            pulls: Pulls::default(),
            touches: Vec::new(),
            contacts: Contacts::new(world),
            pressed: vec![false; agents.len()],
            stood: Vec::new(),
            stood_turned: Vec::new(),
            verdicts: Vec::new(),
            watches: Default::default(),
        };
        bodies.turn();
        bodies
    }

    /// Takes one step. One that fails leaves the state before it.
    pub fn step(&mut self, flock: &mut Flock<D>) -> Result<(), Failure> {
        if self.step > 0 {
            self.ask(flock);
            self.decide()?;
        }
        self.hold();
        self.move_obstacles(self.step + 1);
        let steering = match &mut self.attitudes {
            None => &[][..],
            Some(attitudes) => {
                // Where nothing is touched these are the velocities at the end of the step.
                for (i, next) in self.next.1.iter_mut().enumerate() {
                    *next = self.engine_velocities[i]
                        + self.applied[i] * self.step_size
                        + self.ahead[i];
                }
                attitudes.steer(&self.velocities, &self.next.1)
            }
        };
        let drive = Drive {
            forces: &self.forces,
            steering,
            obstacles: &self.obstacles,
            lasting: self.contacts.held(),
        };
        self.watches[0].time(|| self.physics.step(drive));
        let begin = self.watches[1].begin();
        let velocities = &mut self.engine_velocities;
        self.physics.read(&mut self.next.0, velocities);
        let taken = self.check_taken().and_then(|()| {
            self.find_touches();
            self.bounce()
        });
        self.watches[1].end(begin);
        if let Err(failure) = taken {
            self.move_obstacles(self.step);
            return Err(failure);
        }
        std::mem::swap(&mut self.positions, &mut self.next.0);
        std::mem::swap(&mut self.velocities, &mut self.next.1);
        std::mem::swap(&mut self.wanted, &mut self.wanted_before);
        self.step += 1;
        self.turn();
        Ok(())
    }

    /// The state now.
    pub fn snapshot(&self) -> Snapshot<'_, D> {
        Snapshot {
            step: self.step,
            time: self.time(),
            positions: &self.positions,
            velocities: &self.velocities,
            headings: &self.headings,
            rotations: self
                .attitudes
                .as_ref()
                .map(|they| &they.stances.rotations[..]),
            spins: self.attitudes.as_ref().map(|they| &they.stances.spins[..]),
            obstacles: &self.obstacles,
        }
    }

    /// The contacts of the last step, ordered by who touched what.
    pub fn touches(&self) -> &[Touch<D>] {
        &self.touches
    }

    /// The smallest gaps so far.
    pub fn gaps(&self) -> Gaps {
        self.contacts.gaps()
    }

    /// How near the run came so far to what contacts can do.
    pub fn strain(&self) -> Strain {
        self.contacts.strain()
    }

    /// Measures from now on where the time goes, or does so no longer.
    pub fn measure(&mut self, on: bool) {
        self.watches.iter().for_each(|watch| watch.run(on));
    }

    /// The seconds that went, while they were measured, to the engine and to its contacts.
    pub fn profile(&self) -> Vec<(String, f64)> {
        let parts = ["engine", "contacts"].into_iter().zip(&self.watches);
        parts
            .map(|(name, watch)| (name.to_owned(), watch.seconds()))
            .collect()
    }

    /// How often the actuators' limits cut the laws' forces.
    pub fn cuts(&self) -> Cuts {
        self.actuators.cuts()
    }

    /// The force that the laws exerted on each agent in the last step, after all cuts; at
    /// the start that of the step to come.
    pub fn pushes(&self) -> &[Vector<D>] {
        &self.pushes
    }

    /// Puts the obstacles where they are after some steps.
    fn move_obstacles(&mut self, step: u64) {
        let time = step as f64 * self.step_size;
        for obstacle in &mut self.obstacles {
            obstacle.move_to(time);
        }
    }

    fn time(&self) -> f64 {
        self.step as f64 * self.step_size
    }

    /// How long ago the engine's velocities were those of the bodies: half a substep.
    fn lag(&self) -> f64 {
        0.5 * self.step_size / self.substeps
    }

    /// The share of a step from now to the middle of what the engine's velocities span.
    fn lead(&self) -> f64 {
        (self.substeps - 1.0) / (2.0 * self.substeps)
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
            rotations: self
                .attitudes
                .as_ref()
                .map_or(&[], |they| &they.stances.rotations),
            obstacles: &self.obstacles,
        }
    }

    /// Turns the headings: of balls along the velocities, where at rest as they were.
    fn turn(&mut self) {
        turn(&mut self.headings, &self.velocities);
        if let Some(attitudes) = &self.attitudes {
            attitudes.headings(&mut self.headings);
        }
    }

    /// Whether what the engine's step gave is sound.
    fn check_taken(&self) -> Result<(), Failure> {
        let sound = |i: &usize| small(&self.next.0[*i]) && small(&self.engine_velocities[*i]);
        let broken = (0..self.masses.len()).find(|i| !sound(i));
        match broken.or_else(|| self.physics.lost().first().copied()) {
            None => Ok(()),
            Some(agent) => Err(self.broken(agent)),
        }
    }

    /// The step left no sound state of an agent.
    fn broken(&self, agent: usize) -> Failure {
        Failure::State {
            agent,
            time: (self.step + 1) as f64 * self.step_size,
        }
    }
}

/// Whether a vector is no larger than squares of it can tell; no is what no number is.
fn small<const D: usize>(vector: &Vector<D>) -> bool {
    vector.norm_squared() < LARGEST * LARGEST
}
