//! The flocking separation principle, Proposition 6.

use super::energy::dissipates;
use super::model::{Model, Others};
use crate::claim::falling::rounding;
use crate::claim::{About, Claim, Falling, Finding, Judging, Reading, Run};
use crate::math::{Vector, mean, saturate};
use crate::metric::Observation;
use crate::world::spec::{AlphaProtocol, Feedback, LawSpec, NavigationSpec, Steered};
use crate::world::{vector, vector_or_zero};

const HYPOTHESES: &str = "Protocol (48) with u^α of (35), its damping weighted or not, and ū of (64) \
                          to a sink or (66) to a group velocity, the same for all agents; no other \
                          forces.";
const TOLERANCE: &str = "Of energies: of points 100 times the integrator's accuracy, of bodies step² \
                         times speeds, jerks and accelerations. Of rates 1e-9 of the powers they are \
                         the sums of and 1e-12 of the largest, for rounding.";

const fn about(name: &'static str, statement: &'static str, measured: &'static str) -> About {
    About {
        name,
        source: "Olfati-Saber (2003), Proposition 6, (62) to (66)",
        reading: Reading::Printed,
        statement,
        hypotheses: HYPOTHESES,
        measured,
        tolerance: TOLERANCE,
    }
}

/// A part of the principle.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Structural,
    Translational,
    Whole,
}

/// Proposition 6.
pub(super) struct Separation {
    about: &'static About,
    part: Part,
}

pub(super) const STRUCTURAL: Separation = Separation {
    about: &about(
        "olfati-saber-2003/separation-structural",
        "dH_s/dt does not depend on ū, and is not above 0: it is −c1 Σ a_ij |p_j − p_i|², as without \
         navigation.",
        "H_s in every observation; its rate by all accelerations, against the formula.",
    ),
    part: Part::Structural,
};

pub(super) const TRANSLATIONAL: Separation = Separation {
    about: &about(
        "olfati-saber-2003/separation-translational",
        "dH_tr/dt does not depend on u^α, and is not above 0: it is −c2 (p̄ − p_d)·φ(p̄ − p_d).",
        "H_tr in every observation; its rate by all accelerations, against the formula.",
    ),
    part: Part::Translational,
};

pub(super) const WHOLE: Separation = Separation {
    about: &about(
        "olfati-saber-2003/separation-whole",
        "H = H_s + H_tr never rises.",
        "H in every observation; its rate by all accelerations.",
    ),
    part: Part::Whole,
};

impl<const D: usize> Claim<D> for Separation {
    fn about(&self) -> &'static About {
        self.about
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let navigation = navigation(run)?;
        let mut judging = Judging::new(run);
        let smooth = [AlphaProtocol::Smooth, AlphaProtocol::SmoothWeightedDamping];
        model.suppose_protocol(&mut judging, "(35)", &smooth);
        model.suppose(&mut judging, Others::Common);
        let group = Group::of(navigation);
        let one = run
            .world
            .laws()
            .filter(|(_, law)| is_navigation(law))
            .count()
            == 1;
        judging.suppose(
            "ū is (64), to a sink, or (66), to a group velocity",
            one && group.is_printed,
        );
        judging.suppose("no gravity acts", run.world.gravity.norm() == 0.0);
        if self.part == Part::Structural {
            dissipates(&model, &mut judging, "H_s", false);
            return Some(judging.finding());
        }
        if run.observations.len() < 2 {
            return Some(judging.finding());
        }
        let agents = run.world.agents.len() as f64;
        let (mut values, mut slack, mut rates, mut sizes) = (vec![], vec![], vec![], vec![]);
        let mut off: f64 = 0.0;
        for seen in &run.observations {
            let energy = group.energy(seen);
            let (rate, size) = group.power(seen);
            let share = |_| 1.0 / agents;
            let mut error = run.energy_slack(seen, energy, &group.velocity, share);
            off = off.max((rate - group.dissipation(seen)).abs());
            let (mut value, mut total, mut total_size) = (energy, rate, size);
            if self.part == Part::Whole {
                let structural = model.energy(seen, &model.pair);
                let (rate, size) = model.power(seen, &seen.accelerations);
                error += model.energy_slack(seen, structural);
                value += structural;
                total += rate;
                total_size += size;
            }
            values.push(value);
            slack.push(error);
            rates.push(total);
            sizes.push(total_size);
        }
        let largest = sizes.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        judging.falls(Falling {
            name: if self.part == Part::Whole {
                "H"
            } else {
                "H_tr"
            },
            times: run.times(),
            values,
            slack,
            rates,
            rate_slack: rounding(&sizes),
        });
        judging.equal(
            "max |dH_tr/dt + c2 (p̄ − p_d)·φ(p̄ − p_d)|, a share",
            off / largest,
            0.0,
            1e-9,
            1.0,
        );
        Some(judging.finding())
    }
}

pub(super) fn navigation<'r, const D: usize>(run: &Run<'r, D>) -> Option<&'r NavigationSpec> {
    run.world.laws().find_map(|(_, law)| match law {
        LawSpec::Navigation(law) => Some(law),
        _ => None,
    })
}

pub(super) fn is_navigation(law: &LawSpec) -> bool {
    matches!(law, LawSpec::Navigation(_))
}

/// The translational dynamics, (23), and its energy.
struct Group<const D: usize> {
    /// Whether this is (64) or (66).
    is_printed: bool,
    destination: Option<Vector<D>>,
    velocity: Vector<D>,
    /// What V_tr is multiplied by; 1 in the paper.
    position_gain: f64,
    /// c2.
    velocity_gain: f64,
}

impl<const D: usize> Group<D> {
    fn of(law: &NavigationSpec) -> Self {
        let velocity: Vector<D> = vector_or_zero(&law.velocity);
        let one_aim = law.destination.is_none() || velocity.norm() == 0.0;
        Self {
            is_printed: law.steer == Steered::Mean && law.feedback == Feedback::Bounded && one_aim,
            destination: law.destination.as_deref().map(vector),
            velocity,
            position_gain: law.position_gain,
            velocity_gain: law.velocity_gain,
        }
    }

    /// The way from the sink to the mean position, and what the mean velocity is off.
    fn errors(&self, seen: &Observation<D>) -> [Vector<D>; 2] {
        let place = self.destination.map(|to| mean(&seen.positions) - to);
        [
            place.unwrap_or_else(Vector::zeros),
            mean(&seen.velocities) - self.velocity,
        ]
    }

    /// H_tr, (49).
    fn energy(&self, seen: &Observation<D>) -> f64 {
        let [place, velocity] = self.errors(seen);
        let potential = (1.0 + place.norm_squared()).sqrt() - 1.0;
        self.position_gain * potential + 0.5 * velocity.norm_squared()
    }

    /// Its rate by velocities and accelerations, and the size of the powers that make it up.
    fn power(&self, seen: &Observation<D>) -> (f64, f64) {
        let [place, velocity] = self.errors(seen);
        let potential = self.position_gain * saturate(&place).dot(&mean(&seen.velocities));
        let kinetic = velocity.dot(&mean(&seen.accelerations));
        // Beside these two, what the protocol's forces sum up to is rounded.
        let forces = seen
            .accelerations
            .iter()
            .map(|a| a.norm())
            .fold(0.0, f64::max);
        let size = potential.abs() + kinetic.abs() + velocity.norm() * forces;
        (potential + kinetic, size)
    }

    /// The same by (63) and (65).
    fn dissipation(&self, seen: &Observation<D>) -> f64 {
        let [_, velocity] = self.errors(seen);
        -self.velocity_gain * velocity.dot(&saturate(&velocity))
    }
}
