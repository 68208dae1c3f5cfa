//! The protocols keep the mean velocity, section 10.

use super::model::{Model, Others};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::{Vector, mean};

const ABOUT: About = About {
    name: "olfati-saber-2003/momentum",
    source: "Olfati-Saber (2003), before (48)",
    reading: Reading::Printed,
    statement: "The (α, α) protocols sum to zero over all agents, so where nothing else acts the \
                mean velocity never changes.",
    hypotheses: "A protocol between all agents, who see their neighbours as they are.",
    measured: "|Σ u_i| over Σ |u_i|; where no other forces act also how far the mean velocity is from \
               the one at the start, over the largest velocity.",
    tolerance: "1e-9, for rounding: every step of every integrator here keeps what the laws keep.",
};

/// See the file.
pub(super) struct Momentum;

impl<const D: usize> Claim<D> for Momentum {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose(&mut judging, Others::Any);
        let mut pushed = run.observations.iter();
        let pushed = pushed.any(|seen| seen.by_law[model.index].iter().any(|u| u.norm() > 0.0));
        judging.suppose("the protocol acts on some agents", pushed);
        let mut bound = |name, values: Vec<f64>| {
            judging.bound(Bound {
                name,
                times: run.times(),
                bounds: vec![0.0; values.len()],
                slack: vec![1e-9; values.len()],
                values,
                side: Side::Below,
                scale: 0.0,
            });
        };
        let sums = run.series(|seen| {
            let controls = &seen.by_law[model.index];
            let sum: Vector<D> = controls.iter().sum();
            sum.norm() / controls.iter().map(|u| u.norm()).sum::<f64>().max(1e-300)
        });
        bound("|Σ u_i|/Σ |u_i|", sums);
        let mut alone = Judging::new(run);
        model.suppose(&mut alone, Others::None);
        if alone.is_supposed() {
            let start = mean(&run.start().velocities);
            let speeds = run.observations.iter().flat_map(|seen| &seen.velocities);
            let fastest = speeds.map(|v| v.norm()).fold(1e-300, f64::max);
            let drift = run.series(|seen| (mean(&seen.velocities) - start).norm() / fastest);
            bound("|p̄(t) − p̄(0)|/max |p|", drift);
        }
        Some(judging.finding())
    }
}
