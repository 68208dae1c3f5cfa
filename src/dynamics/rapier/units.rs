//! The units of the engine: powers of two of the world's.
//!
//! The engine compares lengths, and inverse masses, with fixed numbers. In units near the size and
//! the mass of the smallest body these numbers mean the same in every world; and to scale by a
//! power of two changes no digit, so a world and the same world times such a power have the same
//! bits.

use super::super::rapier::math::{Pose as RapierPose, Vector as RapierVector};
use super::super::{D, rotation};
use crate::math::Vector;
use crate::shape::{Pose, Shape};
use crate::world::World;

/// Units of length and mass; that of time is the world's.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    length: f64,
    mass: f64,
    /// What the world's length unit is in the engine's: near 1.
    pub(super) rest: f64,
}

/// The power of two nearest to a positive number, as exponents go.
fn power(number: f64) -> f64 {
    // Within what leaves squares finite.
    number.log2().round().clamp(-300.0, 300.0).exp2()
}

impl Units {
    pub(super) fn new(world: &World<D>) -> Self {
        let smallest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::INFINITY, f64::min);
        let unit = match world.spec.physics.length_unit {
            Some(unit) => unit,
            None => 2.0 * smallest(&mut world.solids.iter().map(|solid| solid.radius())),
        };
        let length = power(unit);
        Self {
            length,
            mass: power(smallest(&mut world.agents.mass.iter().copied())),
            rest: unit / length,
        }
    }

    /// By what lengths are multiplied.
    pub(super) fn scale(&self) -> f64 {
        1.0 / self.length
    }

    /// A length, velocity or acceleration for the engine.
    pub(super) fn length(&self, vector: &Vector<D>) -> RapierVector {
        <[f64; D]>::from(vector / self.length).into()
    }

    /// One that the engine tells.
    pub(super) fn read(&self, vector: RapierVector) -> Vector<D> {
        Vector::from(vector.to_array()) * self.length
    }

    pub(super) fn force(&self, force: &Vector<D>) -> RapierVector {
        <[f64; D]>::from(force / self.length / self.mass).into()
    }

    pub(super) fn torque(&self, torque: &Vector<3>) -> Vector<3> {
        torque / self.length / self.length / self.mass
    }

    /// An impulse that the engine tells.
    pub(super) fn impulse(&self, impulse: f64) -> f64 {
        impulse * self.length * self.mass
    }

    /// A distance that the engine tells.
    pub(super) fn distance(&self, distance: f64) -> f64 {
        distance * self.length
    }

    pub(super) fn mass(&self, mass: f64) -> f64 {
        mass / self.mass
    }

    pub(super) fn pose(&self, pose: &Pose<D>) -> RapierPose {
        RapierPose::from_parts(self.length(&pose.translation), rotation(pose.rotation()))
    }

    pub(super) fn shape(&self, shape: &Shape<D>) -> Shape<D> {
        shape.scaled(self.scale())
    }
}
