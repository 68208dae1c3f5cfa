//! What dissipation ends in: the limits of Propositions 4 and 5.

use super::model::{Model, Others};
use crate::claim::{About, Claim, Finding, Judging, Reading, Run};
use crate::math::direction;
use crate::metric::diameter;
use crate::net::Net;
use crate::world::spec::AlphaProtocol;

const MEASURED: &str = "The largest difference of two velocities, and the fastest change of a \
                        distance between two agents, both judged as limits.";
const TOLERANCE: &str = "The rule for limits; of points 100 times the integrator's accuracy, of \
                         bodies step² times the jerk, cannot be told from 0.";

const fn about(
    name: &'static str,
    source: &'static str,
    reading: Reading,
    statement: &'static str,
    hypotheses: &'static str,
) -> About {
    About {
        name,
        source,
        reading,
        statement,
        hypotheses,
        measured: MEASURED,
        tolerance: TOLERANCE,
    }
}

/// Agents that stay joined come to move with one velocity, their distances preserved.
pub(super) struct Flocking {
    about: &'static About,
    protocol: AlphaProtocol,
    protocol_name: &'static str,
}

pub(super) const NONSMOOTH: Flocking = Flocking {
    about: &about(
        "olfati-saber-2003/nonsmooth-flocking",
        "Olfati-Saber (2003), Proposition 4",
        Reading::Printed,
        "Under (34), where the net switches finitely often and ends as a flock, all agents come to \
         move with the same velocity, and their distances are preserved.",
        "Protocol (34) with c1 > 0, no other forces; no switch is seen in the last half of the run, \
         and the net is a flock there.",
    ),
    protocol: AlphaProtocol::Nonsmooth,
    protocol_name: "(34)",
};

pub(super) const SMOOTH: Flocking = Flocking {
    about: &about(
        "olfati-saber-2003/smooth-flocking",
        "Olfati-Saber (2003), Proposition 5",
        Reading::Printed,
        "Under (35), its damping unweighted as printed, where the net is a flock from some time on, \
         all agents come to move with the same velocity, and their distances are preserved.",
        "Protocol (35) with the printed damping, c1 > 0, no other forces; the net is a flock in the \
         last half of the run.",
    ),
    protocol: AlphaProtocol::Smooth,
    protocol_name: "(35)",
};

/// The weight of the least link that counts, with weighted damping.
const LEAST_WEIGHT: f64 = 0.01;

pub(super) const WEIGHTED: Flocking = Flocking {
    about: &about(
        "olfati-saber-2003/weighted-flocking",
        "Olfati-Saber (2003), Proposition 5, for (35) with weighted damping",
        Reading::Corrected,
        "Under (35) with its damping weighted by a_ij, where links whose weights stay above some \
         a > 0 join all agents from some time on, all agents come to move with the same velocity, \
         and their distances are preserved. That the net is a flock is not enough: a link at the \
         range damps nothing.",
        "Protocol (35) with weighted damping, c1 > 0, no other forces; links with a_ij ≥ 0.01 join \
         all agents in the last half of the run.",
    ),
    protocol: AlphaProtocol::SmoothWeightedDamping,
    protocol_name: "(35) with weighted damping",
};

impl<const D: usize> Claim<D> for Flocking {
    fn about(&self) -> &'static About {
        self.about
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose_protocol(&mut judging, self.protocol_name, &[self.protocol]);
        model.suppose(&mut judging, Others::None);
        judging.suppose("velocities are damped: c1 > 0", model.spec.damping > 0.0);
        let nets: Vec<Net> = self.late_nets(&model);
        judging.suppose(
            "the net is a flock in the last half of the run",
            nets.iter().all(|net| net.partition().is_flock()),
        );
        if self.protocol == AlphaProtocol::Nonsmooth {
            judging.suppose(
                "the net does not switch in the last half of the run",
                nets.windows(2).all(|two| two[0] == two[1]),
            );
        }
        let fastest = run.series(|seen| diameter(&seen.velocities));
        let speeds = run.start().velocities.iter().map(|v| v.norm());
        let floor = run.velocity_slack(run.last(), speeds.fold(0.0, f64::max));
        let stretch = run.series(|seen| {
            let mut fastest = 0.0;
            for (i, (x, v)) in seen.positions.iter().zip(&seen.velocities).enumerate() {
                for (y, w) in seen.positions[..i].iter().zip(&seen.velocities) {
                    let along = direction(&(x - y));
                    fastest = f64::max(fastest, along.dot(&(v - w)).abs());
                }
            }
            fastest
        });
        judging.tends_to_zero("d_V", &run.times(), &fastest, floor);
        judging.tends_to_zero("max_ij |d|q_j − q_i|/dt|", &run.times(), &stretch, floor);
        Some(judging.finding())
    }
}

impl Flocking {
    /// The nets of the last half of the run, of the links that damp.
    fn late_nets<const D: usize>(&self, model: &Model<'_, D>) -> Vec<Net> {
        let run = model.run;
        let half = 0.5 * run.last().time;
        let late = run.observations.iter().filter(|seen| seen.time >= half);
        let net = late.map(|seen| {
            let net = model.net(seen);
            match self.protocol {
                AlphaProtocol::SmoothWeightedDamping => {
                    let links = net.edges().iter().copied();
                    let damp = links.filter(|link| model.weight(seen, *link) >= LEAST_WEIGHT);
                    Net::from_edges(net.agents(), damp)
                }
                _ => net,
            }
        });
        net.collect()
    }
}
