//! Cucker & Dong's model, (3), and how near it lets agents come.
//!
//! With Λ = (Σ |v̂_i|²)^½, as Lemma 9 has it, the repulsion changes Λ at the rate
//! Σ_{i<j} f(r_ij²)⟨x_i − x_j, v_i − v_j⟩, which is the rate at which ½ Σ_{i<j} F(r_ij²) falls,
//! F(s) = ∫_s^∞ f. Alignment only makes Λ smaller. So E = Λ + ½ Σ_{i<j} F(r_ij²) never rises,
//! whatever β, and F(r_ij²) ≤ 2E(0). With f(s) = K/(s − d0)^θ that is
//!
//! r_ij² ≥ d0 + (K/(2(θ − 1)E(0)))^(1/(θ − 1)).

use super::distances::{apart, smallest_distance};
use crate::claim::undisturbed::{MutualAlignment, accelerates, suppose_undisturbed};
use crate::claim::{About, Claim, Exclusion, Finding, Judging, Reading, Run};
use crate::math::Vector;
use crate::metric::{diameter, relative_kinetic_energy};
use crate::world::spec::{CuckerDongSpec, LawSpec};

const PRINTED: About = About {
    name: "song-2013/cucker-dong-distance-printed",
    source: "Song et al. (2013), below (3), on Cucker & Dong (2010)",
    reading: Reading::Misprinted,
    statement: "Where β ≤ 1/2 and all |x_i(0) − x_j(0)| > d0, the distance between any two agents \
                is greater than d0. But f, which is infinite at d0, acts on the squared distance.",
    hypotheses: "Model (3) and nothing else; β ≤ 1/2; all pairs farther apart than d0 at the start.",
    measured: "The smallest distance of a pair at each time, and the smallest of all steps.",
    tolerance: "What the integration may take positions off.",
};

const CORRECTED: About = About {
    name: "song-2013/cucker-dong-distance-corrected",
    reading: Reading::Corrected,
    statement: "Where β ≤ 1/2 and all |x_i(0) − x_j(0)| > √d0, the distance between any two agents \
                is greater than √d0, for f acts on the squared distance.",
    hypotheses: "Model (3) and nothing else; β ≤ 1/2; all pairs farther apart than √d0 at the \
                 start.",
    ..PRINTED
};

const SHARPENED: About = About {
    name: "song-2013/cucker-dong-distance-sharpened",
    reading: Reading::Sharpened,
    statement: "For every β ≥ 0, E = Λ + ½ Σ_{i<j} F(r_ij²) with F(s) = ∫_s^∞ f never rises, so \
                F(r_ij²) ≤ 2E(0): for f(s) = K/(s − d0)^θ, r_ij² ≥ d0 + (K/(2(θ − 1)E(0)))^(1/(θ − \
                1)).",
    hypotheses: "Model (3) and nothing else; all pairs farther apart than √d0 at the start; f is \
                 not cut off at distances that E(0) allows.",
    measured: "The smallest distance of a pair at each time, and the smallest of all steps; E at \
               each time against the least E before.",
    tolerance: "What the integration may take positions, and energies per speed, off.",
    ..PRINTED
};

const CONSENSUS: About = About {
    name: "song-2013/cucker-dong-velocity-consensus",
    reading: Reading::Corrected,
    statement: "Where β ≤ 1/2 and all |x_i(0) − x_j(0)| > √d0, velocities tend to a common one.",
    hypotheses: CORRECTED.hypotheses,
    measured: "d_V(t), the largest difference of two velocities.",
    tolerance: "The rule for limits; what the integration may take velocities off counts as 0.",
    ..PRINTED
};

/// What is claimed of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CuckerDong {
    /// Distances above d0.
    Printed,
    /// Distances above √d0.
    Corrected,
    /// Distances as E(0) has them.
    Sharpened,
    /// That velocities agree.
    Consensus,
}

impl CuckerDong {
    /// The hypotheses, the law, and the distance that they keep.
    fn start<'w, const D: usize>(
        self,
        run: &Run<'w, D>,
    ) -> Option<(Judging, &'w CuckerDongSpec, f64)> {
        let world = run.world;
        let laws = || world.laws().map(|(_, law)| law);
        let law = laws().find_map(|law| match law {
            LawSpec::CuckerDong(law) => Some(law),
            _ => None,
        })?;
        let aligned = laws().find_map(|law| match law {
            LawSpec::Alignment(law) => MutualAlignment::of(law, world),
            _ => None,
        });
        let mut judging = Judging::new(run);
        judging.suppose(
            "the laws are those of (3), and no others act",
            laws().count() == 2,
        );
        let decay = aligned.and_then(|it| it.decay());
        judging.suppose(
            "velocities align at the rates (2), H/(1 + r²)^β, between all pairs",
            decay.is_some(),
        );
        judging.suppose(
            "the repulsion is an acceleration, and acts between all pairs",
            law.range.is_none() && accelerates(law.acts_as, world) && law.strength > 0.0,
        );
        suppose_undisturbed(&mut judging, world);
        let start = smallest_distance(&run.start().positions);
        judging.suppose("there are two agents or more", start.is_finite());
        let root = law.squared_distance.sqrt();
        if self == Self::Printed {
            judging.suppose_less("|x_i(0) − x_j(0)| > d0", law.squared_distance, start);
        } else {
            judging.suppose_less("|x_i(0) − x_j(0)| > √d0", root, start);
        }
        let squared = start * start;
        if squared <= law.squared_distance {
            return Some((judging, law, root));
        }
        let energy = energy(law, &run.start().positions, &run.start().velocities);
        judging.measure("E(0)", energy);
        let power = 1.0 / (law.exponent - 1.0);
        let beyond = libm::pow(0.5 * law.strength * power / energy, power);
        judging.suppose_less(
            "f is not cut off where E(0) lets agents come",
            law.floor,
            beyond,
        );
        if self != Self::Sharpened {
            judging.suppose("β ≤ 1/2", decay.is_some_and(|beta| beta <= 0.5));
        }
        let distance = match self {
            Self::Printed => law.squared_distance,
            Self::Corrected | Self::Consensus => root,
            Self::Sharpened => (law.squared_distance + beyond).sqrt(),
        };
        judging.measure("√d0", root);
        Some((judging, law, distance))
    }
}

impl<const D: usize> Claim<D> for CuckerDong {
    fn about(&self) -> &'static About {
        match self {
            Self::Printed => &PRINTED,
            Self::Corrected => &CORRECTED,
            Self::Sharpened => &SHARPENED,
            Self::Consensus => &CONSENSUS,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (mut judging, law, distance) = self.start(run)?;
        match self {
            Self::Printed | Self::Corrected => {
                judging.measure("distance that is promised", distance);
                apart(&mut judging, run, distance, true);
            }
            Self::Sharpened => {
                judging.measure("distance that theory keeps", distance);
                apart(&mut judging, run, distance, false);
                let energies = run.series(|seen| energy(law, &seen.positions, &seen.velocities));
                // E goes with speeds, not with their squares: what the slack of Λ² is of Λ.
                let slack = run.series(|seen| {
                    let speed = (2.0 * relative_kinetic_energy(&seen.velocities)).sqrt();
                    let center = super::model::mean_velocity(seen);
                    let square =
                        run.energy_slack(seen, energies[0] * energies[0], &center, |_| 1.0);
                    square / speed.max(1e-3 * energies[0])
                });
                judging.never_rises("E(t)", &run.times(), &energies, &slack);
            }
            Self::Consensus => {
                let values = run.series(|seen| diameter(&seen.velocities));
                let largest = run.start().velocities.iter().map(Vector::norm);
                let floor = run.velocity_slack(run.last(), largest.fold(0.0, f64::max));
                judging.tends_to_zero("d_V(t)", &run.times(), &values, floor);
            }
        }
        Some(judging.finding())
    }

    fn exclusion(&self, run: &Run<'_, D>) -> Option<Exclusion> {
        let formula = match self {
            // What is wrong excludes nothing.
            Self::Printed | Self::Consensus => return None,
            Self::Corrected => "r_ij > √d0",
            Self::Sharpened => "∫ f(s) ds from r_ij² on ≤ 2E(0)",
        };
        let (judging, _, distance) = self.start(run)?;
        judging
            .is_supposed()
            .then_some(Exclusion { distance, formula })
    }
}

/// E = Λ + ½ Σ_{i<j} ∫ f(s) ds from r_ij² on.
fn energy<const D: usize>(
    law: &CuckerDongSpec,
    positions: &[Vector<D>],
    velocities: &[Vector<D>],
) -> f64 {
    let power = law.exponent - 1.0;
    let mut sum = 0.0;
    for (i, x) in positions.iter().enumerate() {
        for y in &positions[i + 1..] {
            let beyond = (x - y).norm_squared() - law.squared_distance;
            sum += law.strength / power / libm::pow(beyond.max(0.0), power);
        }
    }
    (2.0 * relative_kinetic_energy(velocities)).sqrt() + 0.5 * sum
}
