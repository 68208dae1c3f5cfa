//! The model of Theorem 3.1: alignment by mutual influence, and the force (4) to a line.

use crate::claim::undisturbed::{MutualAlignment, suppose_undisturbed};
use crate::claim::{Judging, Run};
use crate::math::{Vector, direction, mean};
use crate::metric::{Observation, diameter, relative_kinetic_energy};
use crate::world::spec::{KernelSpec, LawSpec};
use crate::world::{World, vector};

/// The model with its parameters, as a world has them.
pub(super) struct Setting<const D: usize> {
    /// Number of agents, N.
    pub(super) count: f64,
    /// γ.
    pub(super) strength: f64,
    /// l.
    pub(super) along: Vector<D>,
    /// Alignment, whose rates are α a_ij; nothing where influences are not mutual.
    alignment: Option<MutualAlignment>,
    /// The place of the force.
    pub(super) line: usize,
}

impl<const D: usize> Setting<D> {
    /// The model as a run's world has it, the hypotheses of Theorem 3.1 supposed; nothing where
    /// the world has no force to a line.
    pub(super) fn of(run: &Run<'_, D>) -> Option<(Self, Judging)> {
        let world = run.world;
        let mut laws = world.laws().enumerate();
        let (line, law) = laws.find_map(|(index, (_, law))| match law {
            LawSpec::LinePattern(law) => Some((index, law)),
            _ => None,
        })?;
        let mut judging = Judging::new(run);
        judging.suppose(
            "the laws are alignment and one force to a line, and no others act",
            world.laws().count() == 2,
        );
        judging.suppose(
            "the force is (4), in proportion to the distance from the line, with γ > 0; not (14)",
            !law.normalised && law.strength > 0.0,
        );
        let alignment = mutual(world);
        judging.suppose(
            "influences are mutual, a_ij = a_ji = I(r_ij)/N",
            alignment.is_some(),
        );
        let kernel = alignment.as_ref().filter(|it| it.factor > 0.0);
        let kernel = kernel.map(|it| &it.kernel);
        judging.suppose(
            "I is positive and falls strictly",
            kernel.is_some_and(falls_strictly),
        );
        judging.suppose(
            "∫ I(r) dr from 0 on is infinite",
            kernel.is_some_and(has_infinite_integral),
        );
        suppose_undisturbed(&mut judging, world);
        let setting = Self {
            count: world.agents.len() as f64,
            strength: law.strength,
            along: direction(&vector(&law.direction)),
            alignment,
            line,
        };
        Some((setting, judging))
    }

    /// αI at a distance: N times the rate at which two agents align.
    pub(super) fn influence(&self, distance: f64) -> f64 {
        let rate = self.alignment.as_ref().map(|it| it.rate(distance));
        self.count * rate.unwrap_or(0.0)
    }

    /// |v*|² + s²: twice what (7) calls no name.
    pub(super) fn energy(&self, seen: &Observation<D>) -> f64 {
        let squares = self.residuals(&seen.positions).map(|s| s * s);
        spread(&seen.velocities) + self.strength * squares.sum::<f64>()
    }

    /// d/dt (|v*|² + s²) along the motion, and what its rounding goes with: the sizes of its
    /// terms, were velocities not centred.
    pub(super) fn slope(&self, seen: &Observation<D>) -> (f64, f64) {
        let (x, v) = (mean(&seen.positions), mean(&seen.velocities));
        let (mut slope, mut size) = (0.0, 0.0);
        for (i, velocity) in seen.velocities.iter().enumerate() {
            let way = self.way(&(seen.positions[i] - x)) * self.strength;
            slope += 2.0 * (velocity - v).dot(&(seen.accelerations[i] - way));
            size += 2.0 * velocity.norm() * (seen.accelerations[i].norm() + way.norm());
        }
        (slope, size)
    }

    /// s_i of each agent: how far it is from the line through the mean.
    pub(super) fn residuals(&self, positions: &[Vector<D>]) -> impl Iterator<Item = f64> {
        let center = mean(positions);
        positions
            .iter()
            .map(move |x| self.way(&(x - center)).norm())
    }

    /// The components of vectors along the line, x̃_i or ṽ_i.
    pub(super) fn projected(&self, vectors: &[Vector<D>]) -> Vec<Vector<1>> {
        let along = vectors.iter().map(|x| Vector::<1>::new(x.dot(&self.along)));
        along.collect()
    }

    /// d_X̃.
    pub(super) fn projected_diameter(&self, seen: &Observation<D>) -> f64 {
        diameter(&self.projected(&seen.positions))
    }

    /// M* = |v*(0)|² + s²(0), and M = √(N M*/γ).
    pub(super) fn reach(&self, run: &Run<'_, D>) -> (f64, f64) {
        let most = self.energy(run.start());
        (most, (self.count * most / self.strength).sqrt())
    }

    /// The extent at which αI(√(r² + M²)) has used up a speed, from another on: by sums from
    /// below, so a little too large; infinite where it is astronomical.
    pub(super) fn longest(&self, from: f64, speed: f64, reach: f64) -> f64 {
        let (mut extent, mut left) = (from, speed);
        for _ in 0..1_000_000 {
            if left <= 0.0 {
                return extent;
            }
            let step = 1e-3 * extent.max(1.0);
            extent += step;
            left -= self.influence(extent.hypot(reach)) * step;
        }
        f64::INFINITY
    }

    /// What |v*|² + s² may be off in an observation.
    pub(super) fn slack(&self, run: &Run<'_, D>, seen: &Observation<D>) -> f64 {
        let scale = self.energy(run.start());
        2.0 * run.energy_slack(seen, scale, &mean(&seen.velocities), |_| 1.0)
    }

    /// The way from a point to the line through the origin.
    fn way(&self, from: &Vector<D>) -> Vector<D> {
        self.along * from.dot(&self.along) - from
    }
}

/// |v*|² = Σ |v_i − v̄|².
pub(super) fn spread<const D: usize>(velocities: &[Vector<D>]) -> f64 {
    2.0 * relative_kinetic_energy(velocities)
}

/// The world's first law of alignment, where it is the same between all pairs.
fn mutual<const D: usize>(world: &World<D>) -> Option<MutualAlignment> {
    world.laws().find_map(|(_, law)| match law {
        LawSpec::Alignment(law) => MutualAlignment::of(law, world),
        _ => None,
    })
}

fn falls_strictly(kernel: &KernelSpec) -> bool {
    match kernel {
        KernelSpec::CuckerSmale {
            strength, exponent, ..
        } => *strength > 0.0 && *exponent > 0.0,
        KernelSpec::Exponential { strength, .. } => *strength > 0.0,
        KernelSpec::Constant { .. } | KernelSpec::Bump { .. } => false,
    }
}

fn has_infinite_integral(kernel: &KernelSpec) -> bool {
    match kernel {
        KernelSpec::CuckerSmale { exponent, .. } => *exponent <= 0.5,
        KernelSpec::Constant { .. } => true,
        KernelSpec::Exponential { .. } | KernelSpec::Bump { .. } => false,
    }
}
