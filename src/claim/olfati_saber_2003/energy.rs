//! Structural energy falls: Propositions 4 and 5.

use super::model::{Model, Others};
use crate::claim::falling::rounding;
use crate::claim::{About, Claim, Falling, Finding, Judging, MovedBy, Reading, Run};
use crate::metric::Observation;
use crate::net::LinkChanges;
use crate::world::spec::AlphaProtocol;

const TOLERANCE: &str = "Of energies: of points 100 times the integrator's accuracy, of bodies \
                         step² times speeds, jerks and accelerations, and for links that came or \
                         went one step of their power, which jumps there. Of rates 1e-9 of the \
                         powers they are the sums of and 1e-12 of the largest, for rounding.";

pub(super) const fn about(
    name: &'static str,
    source: &'static str,
    reading: Reading,
    [statement, hypotheses, measured]: [&'static str; 3],
) -> About {
    About {
        name,
        source,
        reading,
        statement,
        hypotheses,
        measured,
        tolerance: TOLERANCE,
    }
}

/// A statement that H_s, or what is left of it without the jumps, never rises.
pub(super) struct Dissipation {
    about: &'static About,
    protocol: AlphaProtocol,
    protocol_name: &'static str,
}

/// Proposition 4 goes from one switch to the next. Since links come and go where their potential
/// is h0, the energy less h0 for each link knows no switches.
pub(super) const NONSMOOTH: Dissipation = Dissipation {
    about: &about(
        "olfati-saber-2003/nonsmooth-dissipation",
        "Olfati-Saber (2003), Proposition 4 with (31) and (61)",
        Reading::Sharpened,
        [
            "Under (34), H_s never rises between two switches of the net: dH_s/dt = \
             −c1 Σ |p_j − p_i|² over the links. Across switches, H_s − h0 |E| never rises, with |E| \
             the number of links.",
            "Protocol (34) between all agents, no other forces.",
            "H_s − h0 |E| in every observation, which in between switches is H_s but for a \
             constant; the rate of H_s by velocities and accelerations, against the formula.",
        ],
    ),
    protocol: AlphaProtocol::Nonsmooth,
    protocol_name: "(34)",
};

pub(super) const SMOOTH: Dissipation = Dissipation {
    about: &about(
        "olfati-saber-2003/smooth-dissipation",
        "Olfati-Saber (2003), Proposition 5",
        Reading::Printed,
        [
            "Under (35), its damping unweighted as printed, the smooth H_s never rises: dH_s/dt = \
             −c1 Σ |p_j − p_i|² over the links.",
            "Protocol (35) with the printed damping between all agents, no other forces.",
            "H_s in every observation; its rate by velocities and accelerations, against the \
             formula.",
        ],
    ),
    protocol: AlphaProtocol::Smooth,
    protocol_name: "(35)",
};

pub(super) const WEIGHTED: Dissipation = Dissipation {
    about: &about(
        "olfati-saber-2003/weighted-dissipation",
        "Olfati-Saber (2003), Proposition 5, for (35) with weighted damping",
        Reading::Corrected,
        [
            "Under (35) with its damping weighted by a_ij, so that it does not jump at the range, \
             the smooth H_s never rises: dH_s/dt = −c1 Σ a_ij |p_j − p_i|² over the links.",
            "Protocol (35) with weighted damping between all agents, no other forces.",
            "H_s in every observation; its rate by velocities and accelerations, against the \
             formula.",
        ],
    ),
    protocol: AlphaProtocol::SmoothWeightedDamping,
    protocol_name: "(35) with weighted damping",
};

impl<const D: usize> Claim<D> for Dissipation {
    fn about(&self) -> &'static About {
        self.about
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose_protocol(&mut judging, self.protocol_name, &[self.protocol]);
        model.suppose(&mut judging, Others::None);
        let switching = self.protocol == AlphaProtocol::Nonsmooth;
        let name = if switching { "H_s − h0 |E|" } else { "H_s" };
        dissipates(&model, &mut judging, name, switching);
        Some(judging.finding())
    }
}

/// The conclusion that the energy of the model's protocol never rises, and falls as (61) says.
/// Accelerations common to all agents have no part in it.
pub(super) fn dissipates<const D: usize>(
    model: &Model<'_, D>,
    judging: &mut Judging,
    name: &str,
    switching: bool,
) {
    let run = model.run;
    if run.observations.len() < 2 {
        return;
    }
    let (mut values, mut slack) = (Vec::new(), Vec::new());
    let (mut rates, mut sizes, mut off) = (Vec::new(), Vec::new(), 0.0);
    let mut jumps = 0.0;
    for (k, seen) in run.observations.iter().enumerate() {
        let energy = model.energy(seen, &model.pair);
        let links = model.net(seen).edges().len() as f64;
        let constant = if switching {
            model.link_energy() * links
        } else {
            0.0
        };
        values.push(energy - constant);
        jumps += k.checked_sub(1).map_or(0.0, |before| {
            power_of_switches(model, &run.observations[before], seen)
        });
        // Errors at switches stay in the energy.
        slack.push(model.energy_slack(seen, energy.max(constant)) + jumps);
        let (rate, size) = model.power(seen, &seen.accelerations);
        rates.push(rate);
        sizes.push(size);
        off = f64::max(off, (rate - model.dissipation(seen)).abs());
    }
    let largest = sizes.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    judging.falls(Falling {
        name,
        times: run.times(),
        values,
        slack,
        rates,
        rate_slack: rounding(&sizes),
    });
    judging.equal(
        "max |dH_s/dt + c1 Σ a_ij |p_j − p_i|²|, a share",
        off / largest,
        0.0,
        1e-9,
        1.0,
    );
}

/// Of bodies, what a step gets wrong of the energy where links come or go in it: a step of the
/// power of their force, which jumps there.
fn power_of_switches<const D: usize>(
    model: &Model<'_, D>,
    before: &Observation<D>,
    after: &Observation<D>,
) -> f64 {
    let MovedBy::Bodies { step } = model.run.moved_by else {
        return 0.0;
    };
    let changes = LinkChanges::between(&model.net(before), &model.net(after));
    let pair = &model.pair;
    let force = pair.force(pair.range * (1.0 - 1e-12)).abs();
    let damping = match model.spec.protocol {
        AlphaProtocol::SmoothWeightedDamping => 0.0,
        _ => model.spec.damping,
    };
    let power = |&[i, j]: &[usize; 2]| {
        let speed = |seen: &Observation<D>| (seen.velocities[j] - seen.velocities[i]).norm();
        let speed = f64::max(speed(before), speed(after));
        (force + damping * speed) * speed
    };
    let changed = changes.created.iter().chain(&changes.lost);
    changed
        .map(power)
        .fold(0.0, |sum, power| sum + step * power)
}
