//! The mill ring (2.10) that agents are on, if they are on one.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use crate::math::{Moment, Trajectory, Vector};
use crate::metric::Observation;

/// How far, as a share, agents may be from a ring that they are said to be on.
const ROUNDING: f64 = 1e-9;

/// The motion (2.10) of each agent: circles about one axis, at rates of their own.
pub(super) struct Ring<const D: usize> {
    agents: Vec<Trajectory<D>>,
}

impl<const D: usize> Ring<D> {
    /// The ring that goes through a state. Nothing where there is none: velocities must span a
    /// plane, and there must be a centre from which each is at right angles.
    pub fn through(seen: &Observation<D>) -> Option<Self> {
        let (positions, velocities) = (&seen.positions, &seen.velocities);
        // ⟨v_i, c⟩ = ⟨v_i, x_i⟩ for all i; P is the projection onto the plane.
        let mut matrix = DMatrix::<f64>::zeros(D, D);
        let mut right = DVector::<f64>::zeros(D);
        for (x, v) in positions.iter().zip(velocities) {
            let v = DVector::from_column_slice(v.as_slice());
            let x = DVector::from_column_slice(x.as_slice());
            right += &v * v.dot(&x);
            matrix += &v * v.transpose();
        }
        let flat = ROUNDING * matrix.amax();
        if flat <= 0.0 || matrix.rank(flat) != 2 {
            return None;
        }
        let inverse = matrix.clone().pseudo_inverse(flat).ok()?;
        let center = Vector::<D>::from_column_slice((&inverse * right).as_slice());
        let plane = &inverse * matrix;
        let plane = |x: Vector<D>| {
            let projected = &plane * DVector::from_column_slice(x.as_slice());
            Vector::<D>::from_column_slice(projected.as_slice())
        };
        let size = positions.iter().map(|x| (x - center).norm());
        let size = size.fold(0.0, f64::max);
        let circle = |(x, v): (&Vector<D>, &Vector<D>)| {
            let (arm, speed) = (plane(x - center), v.norm());
            if speed == 0.0 {
                return Some(Trajectory::rest(*x));
            }
            let radius = arm.norm();
            let slanted = arm.dot(v).abs() > ROUNDING * speed * size;
            let out_of_plane = (v - plane(*v)).norm() > ROUNDING * speed;
            if slanted || out_of_plane || radius <= ROUNDING * size {
                return None;
            }
            Some(Trajectory::Ellipse {
                center: x - arm,
                half_axes: [arm, v * (radius / speed)],
                angular_velocity: speed / radius,
                phase: 0.0,
            })
        };
        let agents = positions.iter().zip(velocities).map(circle);
        Some(Self {
            agents: agents.collect::<Option<_>>()?,
        })
    }

    /// Where it has all agents some time later.
    pub fn at(&self, time: f64) -> Vec<Moment<D>> {
        self.agents.iter().map(|it| it.at(time)).collect()
    }

    /// The shortest time of a full turn.
    pub fn period(&self) -> f64 {
        let rates = self.agents.iter().map(|it| match it {
            Trajectory::Ellipse {
                angular_velocity, ..
            } => *angular_velocity,
            _ => 0.0,
        });
        TAU / rates.fold(0.0, f64::max)
    }
}
