//! Alignment alone keeps no mill ring: Lemma 2.
//!
//! The printed proof takes a_ik > 0 for granted where it has "<", but the lemma holds without:
//! of the fastest agent i, ⟨v̄_i, v_i⟩ = |v_i|² only where v_j = v_i for all j with a_ij > 0, and
//! then v̇_i = 0. Sharper, |v̄_i| ≤ |v_i| gives ⟨v̇_i, v_i⟩ ≤ −|v̇_i|²/(2α_i): the fastest agent
//! slows down as it turns.

use super::friction_power::{power, rounding};
use super::model::Model;
use super::ring::Ring;
use super::spread::{grows_at_most, largest_speed, velocity_spread};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};

const LEMMA: About = About {
    name: "djokam-rathinam/mill-ring",
    source: "Djokam & Rathinam, Lemma 2; the proof completed for a_ik = 0",
    reading: Reading::Printed,
    statement: "The only mill ring (2.10) of the model (2.6) is at rest: agents that start on one \
                and move do not stay on it.",
    hypotheses: "The model (2.6): alignment of all agents, and nothing else; a start on a mill \
                 ring that turns.",
    measured: "The largest max|v_i − v_i*| of the run, with v_i* where the ring through the start \
               has the agents.",
    tolerance: "The slack of velocities, which the run must leave the ring by more than; nothing \
                is said of runs shorter than a hundredth of a turn.",
};

const SHARPENED: About = About {
    name: "djokam-rathinam/mill-ring-sharpened",
    source: "Djokam & Rathinam, Lemma 2, with |v̄_i| ≤ |v_i| for the fastest agent",
    reading: Reading::Sharpened,
    statement: "d/dt ½|v_i|² ≤ −|v̇_i|²/(2α_i) for the fastest agent: it cannot turn without \
                slowing down.",
    hypotheses: "The model (2.6): alignment of all agents, and nothing else; velocities that \
                 differ at the start.",
    measured: "d/dt ½|v_i|² of the fastest agent at each observation; and that the largest speed \
               does not rise from one to the next.",
    tolerance: "1e-12 of its speed times its acceleration for the derivative, which is rounded at \
                that size; between observations the slack of velocities.",
};

/// See the file.
pub(super) enum MillRing {
    Lemma,
    Sharpened,
}

impl<const D: usize> Claim<D> for MillRing {
    fn about(&self) -> &'static About {
        match self {
            Self::Lemma => &LEMMA,
            Self::Sharpened => &SHARPENED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose_alone(&mut judging);
        match self {
            Self::Lemma => leaves_the_ring(&mut judging, run),
            Self::Sharpened => slows_down(&mut judging, run, &model),
        }
        Some(judging.finding())
    }
}

fn leaves_the_ring<const D: usize>(judging: &mut Judging, run: &Run<'_, D>) {
    let ring = Ring::through(run.start());
    judging.suppose("agents start on a mill ring that turns", ring.is_some());
    let (Some(ring), true) = (ring, judging.is_supposed()) else {
        return;
    };
    let apart = run.series(|seen| {
        let pairs = ring.at(seen.time).into_iter().zip(&seen.velocities);
        let apart = pairs.map(|(there, v)| (v - there.velocity).norm());
        apart.fold(0.0, f64::max)
    });
    judging.plot("max|v_i − v_i*|", &run.times(), &apart);
    judging.measure("time of a turn", ring.period());
    let most = (0..apart.len()).max_by(|i, j| apart[*i].total_cmp(&apart[*j]));
    let (Some(most), true) = (most, run.last().time >= 0.01 * ring.period()) else {
        return;
    };
    let fastest = largest_speed(run.start());
    let seen = &run.observations[most];
    judging.bound(Bound {
        name: "the largest max|v_i − v_i*|",
        times: vec![seen.time],
        values: vec![apart[most]],
        bounds: vec![0.0],
        slack: vec![-run.velocity_slack(seen, fastest)],
        side: Side::Above,
        scale: fastest,
    });
}

fn slows_down<const D: usize>(judging: &mut Judging, run: &Run<'_, D>, model: &Model<'_, '_, D>) {
    let differ = velocity_spread(run.start()).length > 0.0;
    judging.suppose("velocities differ at the start", differ);
    if !judging.is_supposed() {
        return;
    }
    let terms = model.all_terms();
    let lost = run.observations.iter().zip(&terms).map(|(seen, terms)| {
        let square = |i: &usize| seen.velocities[*i].norm_squared();
        let fastest = (0..terms.gains.len()).max_by(|i, j| square(i).total_cmp(&square(j)));
        let lost = |i: usize| {
            let turning = seen.accelerations[i].norm_squared();
            if turning > 0.0 {
                -0.5 * turning / terms.gains[i]
            } else {
                0.0
            }
        };
        fastest.map_or(0.0, lost)
    });
    judging.bound(Bound {
        name: "d/dt ½|v_i|² of the fastest",
        times: run.times(),
        bounds: lost.collect(),
        values: run.series(power),
        slack: run.series(rounding),
        side: Side::Below,
        scale: 0.0,
    });
    let speeds = run.series(largest_speed);
    let none = vec![0.0; speeds.len()];
    let fastest = speeds[0];
    grows_at_most(judging, run, "max|v_i|", &speeds, &none, |seen| {
        run.velocity_slack(seen, fastest)
    });
}
