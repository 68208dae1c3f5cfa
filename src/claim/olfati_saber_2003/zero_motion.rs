//! What it means that relative velocities are zero, Proposition 2 ii and iii.

use super::model::Model;
use super::zero::{ZERO, largest_change};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::Vector;
use crate::metric::{Observation, relative_kinetic_energy};

const MOTION: About = About {
    name: "olfati-saber-2003/zero-relative-motion",
    source: "Olfati-Saber (2003), Proposition 2 ii and iii",
    reading: Reading::Printed,
    statement: "Where K_r = 0 for all t ≥ t0, the distance between any two agents stays constant, and \
                so does the topology of the net.",
    hypotheses: "An (α, α) interaction; from some observation on, K_r ≤ 1e-6 h0 in all, two or more.",
    measured: "From then on, how much any distance has changed, and how far from the range any pair \
               is whose link came or went, against twice ∫2√K_r dt: no distance changes faster than \
               2√K_r.",
    tolerance: "Of points 100 times the integrator's accuracy, of bodies step² times accelerations.",
};

/// Proposition 2 ii, first half, and iii.
pub(super) struct ZeroMotion;

impl<const D: usize> Claim<D> for ZeroMotion {
    fn about(&self) -> &'static About {
        &MOTION
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        let energies = run.series(|seen| relative_kinetic_energy(&seen.velocities));
        let least = ZERO * model.link_energy();
        if let Some(tail) = model.tail(&mut judging, "K_r", &energies, least) {
            model.is_rigid(&mut judging, tail);
        }
        Some(judging.finding())
    }
}

const CONVERSE: About = About {
    name: "olfati-saber-2003/constant-distances",
    source: "Olfati-Saber (2003), Proposition 2 ii, second half",
    reading: Reading::Printed,
    statement: "Where all distances stay constant, K_r = 0: if the net is a flock, no two agents are \
                at one place, and no two with different velocities have p_j − p_i orthogonal to \
                q_j − q_i.",
    hypotheses: "An (α, α) interaction; from some observation on, all distances are within 1e-6 r of \
                 those at the end, and the three conditions are met, the last with |cos| ≥ 0.01.",
    measured: "K_r from then on, against N s²/4, where s = 100 · 1e-6 r/Δt is the fastest that two \
               agents can differ by and change their distance by no more in the time Δt between \
               observations.",
    tolerance: "That bound; it is 0 for distances that are constant.",
};

/// Proposition 2 ii, second half.
pub(super) struct ConstantDistances;

impl<const D: usize> Claim<D> for ConstantDistances {
    fn about(&self) -> &'static About {
        &CONVERSE
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        let off = run.series(|seen| largest_change(run.last(), seen));
        let allowed = 1e-6 * model.spec.range;
        let Some(tail) = model.tail(&mut judging, "changes of distances", &off, allowed) else {
            return Some(judging.finding());
        };
        let pauses = tail.windows(2).map(|two| two[1].time - two[0].time);
        let fastest = 100.0 * allowed / pauses.fold(f64::INFINITY, f64::min);
        let flock = |seen| model.net(seen).partition().is_flock();
        judging.suppose("the net is a flock", tail.iter().all(flock));
        let (mut apart, mut oblique) = (true, true);
        for seen in tail {
            for_pairs(seen, |offset, velocity| {
                let (distance, speed) = (offset.norm(), velocity.norm());
                apart &= distance > 0.0;
                let along = offset.dot(&velocity).abs();
                oblique &= speed <= fastest || along >= 0.01 * distance * speed;
            });
        }
        judging.suppose("no two agents are at one place", apart);
        judging.suppose(
            "no two with different velocities move at right angles to the line between them",
            oblique,
        );
        let agents = run.world.agents.len() as f64;
        let bound = 0.25 * agents * fastest * fastest;
        let values = tail
            .iter()
            .map(|seen| relative_kinetic_energy(&seen.velocities));
        judging.bound(Bound {
            name: "K_r",
            times: tail.iter().map(|seen| seen.time).collect(),
            values: values.collect(),
            bounds: vec![bound; tail.len()],
            slack: vec![0.0; tail.len()],
            side: Side::Below,
            scale: bound,
        });
        Some(judging.finding())
    }
}

/// Calls with q_j − q_i and p_j − p_i of every two agents.
fn for_pairs<const D: usize>(seen: &Observation<D>, mut visit: impl FnMut(Vector<D>, Vector<D>)) {
    for i in 0..seen.positions.len() {
        for j in 0..i {
            visit(
                seen.positions[j] - seen.positions[i],
                seen.velocities[j] - seen.velocities[i],
            );
        }
    }
}
