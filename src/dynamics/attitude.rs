//! How bodies that are not round stand, and what turns them.
//!
//! A steering torque is a force like the laws': it is given to the engine, so walls and
//! neighbours resist it. So they do where the heading follows the velocity: not the rotation is
//! set but the angular velocity that the body begins the step with, and contacts are solved
//! from there.
//!
//! Torques are of first order in the step: each is taken at the start of the step.

use serde::{Deserialize, Serialize};

use crate::dynamics::contact::has_friction;
use crate::dynamics::{Physics, Steering};
use crate::math::{Matrix, Vector, axis, direction};
use crate::world::World;
use crate::world::spec::{HeadingSpec, TorqueSpec};

/// The largest angle by which a heading is turned to the velocity in a step.
const MOST_IN_A_STEP: f64 = std::f64::consts::FRAC_PI_4;

/// The attitudes of all bodies; each list has one entry for each agent.
pub(super) struct Attitudes<const D: usize> {
    rules: Vec<Rule>,
    /// Inertia tensor in the body's frame.
    inertias: Vec<Matrix<3>>,
    step: f64,
    steering: Vec<Steering>,
    pub(super) stances: Stances<D>,
}

/// How bodies stand and turn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Stances<const D: usize> {
    pub(super) rotations: Vec<Matrix<D>>,
    pub(super) spins: Vec<Vector<3>>,
}

impl<const D: usize> Stances<D> {
    /// Of how many bodies; 0 where the lists differ.
    pub(super) fn len(&self) -> usize {
        match self.rotations.len() == self.spins.len() {
            true => self.spins.len(),
            false => 0,
        }
    }
}

/// What turns a body.
#[derive(Debug, Clone)]
enum Rule {
    /// Nothing; it is round, and heads where it moves.
    Round,
    /// Nothing of ours.
    None,
    Torque(TorqueSpec),
    /// At most so fast.
    Turn(f64),
}

impl<const D: usize> Attitudes<D> {
    /// The attitudes of a world's bodies at the start; `None` where all are balls
    /// that nothing turns.
    pub(super) fn new(world: &World<D>) -> Option<Self> {
        if world.solids.iter().all(|solid| solid.is_ball()) && !has_friction(world) {
            return None;
        }
        let agents = &world.agents;
        let groups = || agents.group.iter().zip(&agents.mass);
        let rules = groups().map(|(&group, _)| match &world.spec.agents[group].heading {
            _ if world.solids[group].is_ball() => Rule::Round,
            None => Rule::Torque(TorqueSpec::default()),
            Some(HeadingSpec::Torque(torque)) => Rule::Torque(torque.clone()),
            Some(HeadingSpec::Velocity(turn)) => {
                let rate = turn.turn_rate.unwrap_or(f64::INFINITY);
                Rule::Turn(rate.min(MOST_IN_A_STEP / world.spec.time.step))
            }
            Some(HeadingSpec::Free | HeadingSpec::Fixed) => Rule::None,
        });
        let inertias = groups().map(|(&group, mass)| {
            let solid = &world.solids[group];
            solid.inertia() * (mass / solid.volume())
        });
        Some(Self {
            rules: rules.collect(),
            inertias: inertias.collect(),
            step: world.spec.time.step,
            steering: vec![Steering::Free; agents.len()],
            stances: Stances {
                rotations: agents.rotations.clone(),
                spins: vec![Vector::zeros(); agents.len()],
            },
        })
    }

    /// What turns the bodies in the next step, given their velocities now and those
    /// that they will have at its end if they touch nothing.
    pub(super) fn steer(&mut self, velocities: &[Vector<D>], next: &[Vector<D>]) -> &[Steering] {
        for i in 0..self.rules.len() {
            self.steering[i] = match &self.rules[i] {
                Rule::Round | Rule::None => Steering::Free,
                Rule::Torque(torque) => Steering::Torque(self.torque(i, torque, &velocities[i])),
                Rule::Turn(rate) => {
                    let spin = self.way_to(i, &next[i]) / self.step;
                    Steering::Spin(at_most(*rate, spin))
                }
            };
        }
        &self.steering
    }

    /// Writes the headings of the bodies that are not round.
    pub(super) fn headings(&self, out: &mut [Vector<D>]) {
        for (i, heading) in out.iter_mut().enumerate() {
            if !matches!(self.rules[i], Rule::Round) {
                *heading = self.heading(i);
            }
        }
    }

    /// Reads how the bodies stand after a step.
    pub(super) fn read(&mut self, physics: &dyn Physics<D>) {
        physics.read_attitudes(&mut self.stances.rotations, &mut self.stances.spins);
    }

    fn heading(&self, i: usize) -> Vector<D> {
        self.stances.rotations[i].column(0).into()
    }

    fn torque(&self, i: usize, torque: &TorqueSpec, velocity: &Vector<D>) -> Vector<3> {
        let acceleration =
            self.way_to(i, velocity) * torque.gain - self.stances.spins[i] * torque.damping();
        let rotation = in_space(&self.stances.rotations[i]);
        let wanted = rotation * (self.inertias[i] * rotation.tr_mul(&acceleration));
        at_most(torque.limit.unwrap_or(f64::INFINITY), wanted)
    }

    /// The way from a body's heading to the direction of `velocity`, as the axis to turn about
    /// times 2 sin(θ/2), θ the angle; zero at rest. It grows up to θ = π, and needs
    /// no arc functions, which differ between platforms.
    fn way_to(&self, i: usize, velocity: &Vector<D>) -> Vector<3> {
        let (heading, target) = (self.heading(i), direction(velocity));
        if target.norm_squared() == 0.0 {
            return Vector::zeros();
        }
        let across = embed(&heading).cross(&embed(&target));
        let sine = across.norm();
        if sine > 1e-12 {
            return across * ((target - heading).norm() / sine);
        }
        if heading.dot(&target) > 0.0 {
            return across;
        }
        // Straight back: either way round is as good.
        in_space(&self.stances.rotations[i]).column(2) * 2.0
    }
}

/// The vector itself, or one of the largest length along it.
fn at_most(largest: f64, vector: Vector<3>) -> Vector<3> {
    let length = vector.norm();
    if length > largest {
        vector * (largest / length)
    } else {
        vector
    }
}

fn embed<const D: usize>(vector: &Vector<D>) -> Vector<3> {
    Vector::<3>::from_fn(|k, _| if k < D { vector[k] } else { 0.0 })
}

/// The rotation in space; one in the plane is about the third axis.
fn in_space<const D: usize>(rotation: &Matrix<D>) -> Matrix<3> {
    Matrix::<3>::from_fn(|i, j| match i < D && j < D {
        true => rotation[(i, j)],
        false => axis::<3>(i)[j],
    })
}
