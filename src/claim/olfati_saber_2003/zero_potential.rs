//! What zero potential means, Proposition 2 i.

use super::model::Model;
use super::zero::ZERO;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::net::{defect, realisation_error};

const POTENTIAL: About = About {
    name: "olfati-saber-2003/zero-potential",
    source: "Olfati-Saber (2003), Proposition 2 i, and below (47)",
    reading: Reading::Printed,
    statement: "V(q) = 0 if and only if the net is a realisation of the structural net (d_α, r), \
                whose defect factor (46) is 0 as well.",
    hypotheses: "An (α, α) interaction; the run comes to V ≤ 1e-6 h0.",
    measured: "In every observation, with e the largest | |q_j − q_i| − d_α | over the links: V is \
               at least the lesser of ψ(e) and ψ(−e), and at most |E| times the greater; so V and e \
               vanish together. The defect, with w = 1, is bounded alike.",
    tolerance: "1e-12 of h0, for rounding.",
};

/// Proposition 2 i.
pub(super) struct ZeroPotential;

impl<const D: usize> Claim<D> for ZeroPotential {
    fn about(&self) -> &'static About {
        &POTENTIAL
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::of_states();
        let (pair, h0) = (model.sharp(), model.link_energy());
        let values = run.series(|seen| model.potential(seen, &pair));
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        judging.suppose("there are links", {
            let mut nets = run.observations.iter().map(|seen| model.net(seen));
            nets.any(|net| !net.edges().is_empty())
        });
        judging.suppose_less("the run comes to V ≤ 1e-6 h0", least, ZERO * h0);
        let (mut below, mut above, mut defects, mut steepest) = (vec![], vec![], vec![], vec![]);
        for seen in &run.observations {
            let net = model.net(seen);
            let error = realisation_error(&seen.positions, &net, pair.spacing);
            let [least, most] = model.potentials_at(error);
            let links = net.edges().len() as f64;
            below.push(if links > 0.0 { least } else { 0.0 });
            above.push(links * most);
            // |∇V|² is the sum over agents of squares of at most degree × the largest force.
            let force = pair.action.force(error).max(-pair.action.force(-error));
            let squares = net
                .degrees()
                .into_iter()
                .map(|it| (it as f64 * force).powi(2));
            steepest.push(links * most + squares.sum::<f64>());
            defects.push(defect(&seen.positions, &net, &pair, 1.0));
        }
        for (name, values, bounds, side) in [
            ("V", values.clone(), below, Side::Above),
            ("V(q)", values, above, Side::Below),
            ("μ", defects, steepest, Side::Below),
        ] {
            judging.bound(Bound {
                name,
                times: run.times(),
                slack: vec![1e-12 * h0; values.len()],
                values,
                bounds,
                side,
                scale: h0,
            });
        }
        Some(judging.finding())
    }
}
