//! What protocol (36) leaves out of (35): the bound (37), in two readings.

use super::model::{Model, Others};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::{AlphaPair, Bump, Fade, Vector, direction};
use crate::metric::Observation;
use crate::world::spec::AlphaProtocol;

const HYPOTHESES: &str = "An (α, α) protocol with smooth weights; some agents are neighbours.";
const MEASURED: &str =
    "Both sides in every observation, from positions alone; L_ρ is π/(2(1 − k0)).";
const TOLERANCE: &str =
    "1e-9 of the bound and 1e-14 of what N links could add to it, for rounding.";

/// (37), with the smooth potential, or the nonsmooth one that its proof needs.
pub(super) struct Approximation {
    about: &'static About,
    sharp: bool,
}

pub(super) const PRINTED: Approximation = Approximation {
    about: &About {
        name: "olfati-saber-2003/approximation-error-printed",
        source: "Olfati-Saber (2003), (37)",
        reading: Reading::Misprinted,
        statement: "Σ |u_i − û_i| ≤ (2 L_ρ/r) V(q) for protocols (35) and (36), with the smooth V of \
                    the smooth net that they are for.",
        hypotheses: HYPOTHESES,
        measured: MEASURED,
        tolerance: TOLERANCE,
    },
    sharp: false,
};

pub(super) const CORRECTED: Approximation = Approximation {
    about: &About {
        name: "olfati-saber-2003/approximation-error-corrected",
        source: "Olfati-Saber (2003), (37) with the nonsmooth V",
        reading: Reading::Corrected,
        statement: "Σ |u_i − û_i| ≤ (2 L_ρ/r) V(q) with the nonsmooth V: near the range the smooth \
                    weight vanishes faster than its slope, and the smooth V with it.",
        hypotheses: HYPOTHESES,
        measured: MEASURED,
        tolerance: TOLERANCE,
    },
    sharp: true,
};

impl<const D: usize> Claim<D> for Approximation {
    fn about(&self) -> &'static About {
        self.about
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::of_states();
        let smooth = [
            AlphaProtocol::Smooth,
            AlphaProtocol::SmoothWeightedDamping,
            AlphaProtocol::Approximate,
        ];
        model.suppose_protocol(&mut judging, "one with smooth weights", &smooth);
        model.suppose(&mut judging, Others::Any);
        let mut nets = run.observations.iter().map(|seen| model.net(seen));
        let linked = nets.any(|net| !net.edges().is_empty());
        judging.suppose("some agents are neighbours", linked);
        let (range, start) = (model.spec.range, model.spec.bump_start);
        let steepest = 0.5 * std::f64::consts::PI / (1.0 - start);
        let pair = if self.sharp {
            model.sharp()
        } else {
            model.smooth()
        };
        let bounds = run.series(|seen| 2.0 * steepest / range * model.potential(seen, &pair));
        let rounding =
            1e-14 * steepest / range * model.link_energy() * run.world.agents.len() as f64;
        let most = bounds.iter().copied().fold(0.0, f64::max);
        judging.bound(Bound {
            name: "Σ |u_i − û_i|",
            times: run.times(),
            values: run.series(|seen| left_out(&model, seen)),
            // V itself is rounded, at the size of the potentials that make it up.
            slack: bounds
                .iter()
                .map(|bound| 1e-9 * bound.abs() + rounding)
                .collect(),
            bounds,
            side: Side::Below,
            scale: most,
        });
        Some(judging.finding())
    }
}

/// Σ |u_i − û_i|.
fn left_out<const D: usize>(model: &Model<'_, D>, seen: &Observation<D>) -> f64 {
    let exact = model.smooth();
    let approximate = AlphaPair {
        fade: Fade::Approximate(Bump::new(model.spec.bump_start)),
        ..exact
    };
    let mut differences = vec![Vector::<D>::zeros(); seen.positions.len()];
    for &[i, j] in model.net(seen).edges() {
        let offset = seen.positions[j] - seen.positions[i];
        let distance = offset.norm();
        let difference = exact.force(distance) - approximate.force(distance);
        let along = direction(&offset) * difference;
        differences[i] += along;
        differences[j] -= along;
    }
    differences.iter().map(|difference| difference.norm()).sum()
}
