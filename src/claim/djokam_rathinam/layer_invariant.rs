//! What the layer conserves: (4.24).

use super::fast::{is_fast, suppose};
use super::model::Model;
use super::spread::largest_speed;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::Vector;
use crate::reduced::FastFlocking;
use crate::world::spec::GainSpec;

const MEASURED: &str = "|Σ π_i ξ_i(u_i)u_i|, the rate at which Σ π_i Z_i changes in the layer, with the \
                        influences of the start and the velocities of each observation.";
const TOLERANCE: &str = "1e-9 of Σ π_i ξ_i|u_i| and 1e-13 of Σ π_i ξ_i max|v_j|, for rounding: it is an \
                         identity.";

const PRINTED: About = About {
    name: "djokam-rathinam/layer-invariant-printed",
    source: "Djokam & Rathinam, (4.24)",
    reading: Reading::Misprinted,
    statement: "Σ π_i Z_i(τ) does not change in the layer (4.23).",
    hypotheses: "The family (4.1) with ε < 1: alignment by positions alone, with gains and \
                 influences of Assumptions 1 and 2, and steering by each agent's own state and the \
                 time.",
    measured: MEASURED,
    tolerance: TOLERANCE,
};

const CORRECTED: About = About {
    name: "djokam-rathinam/layer-invariant-corrected",
    source: "Djokam & Rathinam, (4.24), for gains that do not fall",
    reading: Reading::Corrected,
    statement: "Σ π_i Z_i(τ) does not change in the layer (4.23) where ξ_i(u) = ξ_i(0) for all u.",
    hypotheses: "As printed, and gains that do not depend on u.",
    measured: MEASURED,
    tolerance: TOLERANCE,
};

/// See the file.
pub(super) enum LayerInvariant {
    Printed,
    Corrected,
}

impl<const D: usize> Claim<D> for LayerInvariant {
    fn about(&self) -> &'static About {
        match self {
            Self::Printed => &PRINTED,
            Self::Corrected => &CORRECTED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run).filter(|_| is_fast(run.world))?;
        let mut judging = Judging::new(run);
        suppose(&mut judging, run);
        if matches!(self, Self::Corrected) {
            let constant = matches!(model.law.gain, GainSpec::Constant(_));
            judging.suppose("gains do not depend on u", constant);
        }
        if !judging.is_supposed() {
            return Some(judging.finding());
        }
        let reduced = FastFlocking::new(run.world).ok()?;
        let influences = model.terms(run.start())?.influences;
        let (mut rates, mut slack, mut largest) = (Vec::new(), Vec::new(), 0.0f64);
        for seen in &run.observations {
            let (mut sum, mut size, mut gains) = (Vector::<D>::zeros(), 0.0, 0.0);
            for (i, v) in seen.velocities.iter().enumerate() {
                let others = seen.velocities.iter().enumerate();
                let u: Vector<D> = others.map(|(j, w)| (w - v) * influences[(i, j)]).sum();
                let gain = reduced.weights[i] * model.gain_within(i, u.norm())?;
                sum += u * gain;
                size += gain * u.norm();
                gains += gain;
            }
            rates.push(sum.norm());
            slack.push(1e-9 * size + 1e-13 * gains * largest_speed(seen));
            largest = largest.max(size);
        }
        judging.bound(Bound {
            name: "|Σ π_i ξ_i(u_i)u_i|",
            times: run.times(),
            bounds: vec![0.0; rates.len()],
            values: rates,
            slack,
            side: Side::Below,
            scale: largest,
        });
        Some(judging.finding())
    }
}
