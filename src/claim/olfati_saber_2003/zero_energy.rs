//! What zero structural energy means, Proposition 3.

use super::model::Model;
use super::zero::ZERO;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::metric::diameter;
use crate::net::realisation_error;

const ENERGY: About = About {
    name: "olfati-saber-2003/zero-energy",
    source: "Olfati-Saber (2003), Proposition 3",
    reading: Reading::Printed,
    statement: "Where H_s = 0 for all t ≥ t0, the net keeps its topology and is a realisation of \
                (d_α, r), all distances stay constant, and all velocities are equal.",
    hypotheses: "An (α, α) interaction; from some observation on, the nonsmooth H_s ≤ 1e-6 h0 in \
                 all, two or more.",
    measured: "From then on: the potential of the worst link, which is at most H_s; differences of \
               velocities, at most 2√H_s; changes of distances and links, as in \
               zero-relative-motion.",
    tolerance: "1e-12 of h0 for rounding; of points 100 times the integrator's accuracy, of bodies \
                step² times accelerations.",
};

/// Proposition 3.
pub(super) struct ZeroEnergy;

impl<const D: usize> Claim<D> for ZeroEnergy {
    fn about(&self) -> &'static About {
        &ENERGY
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        let (pair, h0) = (model.sharp(), model.link_energy());
        let energies = run.series(|seen| model.energy(seen, &pair));
        let Some(tail) = model.tail(&mut judging, "H_s", &energies, ZERO * h0) else {
            return Some(judging.finding());
        };
        let first = run.observations.len() - tail.len();
        let worst = tail.iter().map(|seen| {
            let error = realisation_error(&seen.positions, &model.net(seen), pair.spacing);
            model.potentials_at(error)[0]
        });
        let spread = tail.iter().map(|seen| diameter(&seen.velocities));
        let equal = energies[first..]
            .iter()
            .map(|energy| 2.0 * (energy.max(0.0) + 1e-12 * h0).sqrt());
        for (name, values, bounds) in [
            (
                "max ψ over the links",
                worst.collect(),
                energies[first..].to_vec(),
            ),
            ("d_V", spread.collect::<Vec<f64>>(), equal.collect()),
        ] {
            judging.bound(Bound {
                name,
                times: tail.iter().map(|seen| seen.time).collect(),
                values,
                bounds,
                slack: vec![1e-12 * h0; tail.len()],
                side: Side::Below,
                scale: h0,
            });
        }
        model.is_rigid(&mut judging, tail);
        Some(judging.finding())
    }
}
