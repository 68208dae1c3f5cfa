//! Park et al.'s model, (7), which the paper says is cohesive.
//!
//! With V = ½ Σ |v̂_i|² + σK2/(4N) Σ_{i<j} (r_ij − 2R)², alignment and the damping along the bonds
//! only take from V. So σK2/(4N) (r_ij − 2R)² ≤ V(0).

use super::cohesion::{bounded, widths};
use super::distances::smallest_distance;
use crate::claim::undisturbed::{MutualAlignment, accelerates, suppose_undisturbed};
use crate::claim::{About, Claim, Finding, Judging, Reading, Run};
use crate::math::{Potential, Vector};
use crate::metric::{diameter, relative_kinetic_energy};
use crate::world::spec::LawSpec;

const PRINTED: About = About {
    name: "song-2013/park-cohesive-flocking",
    source: "Song et al. (2013), below (7), on Park et al. (2010)",
    reading: Reading::Printed,
    statement: "Model (7) exhibits cohesive flocking: distances stay bounded and velocities come to \
                agree. Of collisions it says nothing.",
    hypotheses: "Model (7) and nothing else; λ, σ, K1, K2 and R above 0, ψ ≥ 0.",
    measured: "d_X(t) and d_V(t), the largest differences of positions and of velocities.",
    tolerance: "The rules for limits; what the integration may take velocities off counts as 0.",
};

const SHARPENED: About = About {
    name: "song-2013/park-cohesion-sharpened",
    reading: Reading::Sharpened,
    statement: "|r_ij − 2R| ≤ √(4N V(0)/(σK2)) with V = ½ Σ |v̂_i|² + σK2/(4N) Σ_{i<j} (r_ij − 2R)², \
                which never rises.",
    measured: "d_X(t).",
    tolerance: "What the integration may take positions off.",
    ..PRINTED
};

/// What is claimed of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Park {
    /// Cohesive flocking.
    Printed,
    /// How wide the flock can be.
    Sharpened,
}

impl<const D: usize> Claim<D> for Park {
    fn about(&self) -> &'static About {
        match self {
            Self::Printed => &PRINTED,
            Self::Sharpened => &SHARPENED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let world = run.world;
        let laws = || world.laws().map(|(_, law)| law);
        let law = laws().find_map(|law| match law {
            LawSpec::ParkBonding(law) => Some(law),
            _ => None,
        })?;
        let aligned = laws().find_map(|law| match law {
            LawSpec::Alignment(law) => MutualAlignment::of(law, world),
            _ => None,
        });
        let mut judging = Judging::new(run);
        judging.suppose(
            "the laws are those of (7), and no others act",
            laws().count() == 2,
        );
        judging.suppose(
            "velocities align at mutual rates λψ(r)/N with λ > 0",
            aligned.is_some_and(|it| it.factor > 0.0),
        );
        judging.suppose(
            "the bonds are accelerations, act between all pairs, and have σ, K1, K2 above 0",
            law.range.is_none()
                && accelerates(law.acts_as, world)
                && law.strength * law.velocity_gain * law.position_gain > 0.0,
        );
        suppose_undisturbed(&mut judging, world);
        let start = smallest_distance(&run.start().positions);
        judging.suppose(
            "there are two agents or more, and no two start at one point",
            start > 0.0 && start.is_finite(),
        );
        match self {
            Self::Printed => {
                let times = run.times();
                judging.stays_bounded("d_X(t)", &times, &widths(run));
                let values = run.series(|seen| diameter(&seen.velocities));
                let largest = run.start().velocities.iter().map(Vector::norm);
                let floor = run.velocity_slack(run.last(), largest.fold(0.0, f64::max));
                judging.tends_to_zero("d_V(t)", &times, &values, floor);
            }
            Self::Sharpened => {
                let stiffness = 0.5 * law.strength * law.position_gain / world.agents.len() as f64;
                let length = 2.0 * law.radius;
                let energy = start_energy(Potential::Bond { stiffness, length }, run);
                judging.measure("V(0)", energy);
                let reach = (2.0 * energy / stiffness).sqrt();
                bounded(&mut judging, run, "d_X(t)", widths(run), length + reach);
            }
        }
        Some(judging.finding())
    }
}

/// V(0), with this potential of a pair.
fn start_energy<const D: usize>(bond: Potential, run: &Run<'_, D>) -> f64 {
    let seen = run.start();
    let mut energy = relative_kinetic_energy(&seen.velocities);
    for (i, x) in seen.positions.iter().enumerate() {
        for y in &seen.positions[i + 1..] {
            energy += bond.value((x - y).norm());
        }
    }
    energy
}
