//! Driving a flock into a pattern about its mean position.
//!
//! u_i = γ w_i, or normalised u_i = γ w_i/(1 + Σ_j |w_j|), where w_i is the way from agent i to the
//! nearest point of the pattern. Li, Liu & Wu, "Flocking and pattern motion in a modified
//! Cucker-Smale model". With y_i = x_i − x̄:
//!
//! | law | w_i | source |
//! |---|---|---|
//! | `line_pattern` | ⟨y_i, l⟩l − y_i | (4) |
//! | `line_pattern`, normalised | the same | (14) |
//! | `ball_pattern`, normalised | (1 − R/\|y_i\|)(−y_i) | (6), (15) |
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `direction` | l, made a unit vector | 1 |
//! | `radius` | R | length |
//! | `strength` | γ (1 in (6), (14), (15)) | 1/time²; normalised, an acceleration |
//!
//! The pattern is a line or, in the plane, a circle and, in space, a sphere. The mean and the
//! sum are over the agents that the law acts on, as they truly are. Forces to a line add up to
//! zero; those to a ball do not, in general. An agent at its very centre has no way to go, and
//! gets no force. Normalised, forces grow as the pattern nears, and their sizes add up to less
//! than γ.

use crate::law::Law;
use crate::math::{Vector, direction};
use crate::sense::Scene;
use crate::world::spec::{BallPatternSpec, LinePatternSpec};
use crate::world::vector;

/// Driving a flock into a pattern about its mean position; see the module.
#[derive(Debug, Clone)]
pub struct Pattern<const D: usize> {
    shape: Shape<D>,
    strength: f64,
    normalised: bool,
    /// For each agent of the world, whether the law acts on it.
    acts_on: Vec<bool>,
    /// γ, or γ/(1 + Σ|w|).
    gain: f64,
}

/// A pattern about the origin.
#[derive(Debug, Clone, Copy)]
enum Shape<const D: usize> {
    /// The line along a unit vector.
    Line(Vector<D>),
    /// The circle or sphere of a radius.
    Ball(f64),
}

impl<const D: usize> Shape<D> {
    /// The way from a point to the nearest one of the pattern.
    fn way(self, from: &Vector<D>) -> Vector<D> {
        match self {
            Self::Line(along) => along * from.dot(&along) - from,
            Self::Ball(radius) => direction(from) * (radius - from.norm()),
        }
    }
}

impl<const D: usize> Pattern<D> {
    /// A line, with the parameters of a checked world file, that acts on the agents of the
    /// world for which `acts_on` is true.
    pub fn line(spec: &LinePatternSpec, acts_on: Vec<bool>) -> Self {
        let along = direction(&vector(&spec.direction));
        Self::new(Shape::Line(along), spec.strength, spec.normalised, acts_on)
    }

    /// A circle or sphere, likewise.
    pub fn ball(spec: &BallPatternSpec, acts_on: Vec<bool>) -> Self {
        let shape = Shape::Ball(spec.radius);
        Self::new(shape, spec.strength, spec.normalised, acts_on)
    }

    fn new(shape: Shape<D>, strength: f64, normalised: bool, acts_on: Vec<bool>) -> Self {
        Self {
            shape,
            strength,
            normalised,
            acts_on,
            gain: 0.0,
        }
    }

    fn way(&self, scene: &Scene<'_, D>, i: usize) -> Vector<D> {
        self.shape.way(&(scene.positions[i] - scene.mean_position))
    }
}

impl<const D: usize> Law<D> for Pattern<D> {
    fn name(&self) -> &str {
        match self.shape {
            Shape::Line(_) => "line_pattern",
            Shape::Ball(_) => "ball_pattern",
        }
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        self.gain = self.strength;
        if self.normalised {
            let lengths = scene.in_world_order(|place| self.way(scene, place).norm());
            let acting = lengths.zip(&self.acts_on).filter(|(_, acts)| **acts);
            let sum: f64 = acting.map(|(length, _)| length).sum();
            self.gain /= 1.0 + sum;
        }
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (i, acceleration) in (first..).zip(out) {
            *acceleration += self.way(scene, i) * self.gain;
        }
    }
}
