//! Balanced graphs that hang together, Proposition 1.

use super::model::Model;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::net::{is_strongly_connected, symmetric_connectivity};

const ABOUT: About = About {
    name: "shi-wang-chu/strong-connectivity",
    source: "Shi, Wang & Chu, Proposition 1, and the text below (10)",
    reading: Reading::Printed,
    statement: "A weakly connected graph whose weights are balanced is strongly connected, and the \
                second smallest eigenvalue λ2 of L + Lᵀ is above 0.",
    hypotheses: "The weights w_ij of the control are balanced, and their graph is weakly \
                 connected.",
    measured: "λ2 of L + Lᵀ in every observation, over the largest degree, or 0 where some agent \
               does not reach every other along arcs; it is to be at least 1e-12.",
    tolerance: "None: 1e-12 stands for 0, since rounding of the eigenvalues is smaller.",
};

/// See the file.
pub(super) struct StrongConnectivity;

impl<const D: usize> Claim<D> for StrongConnectivity {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::of_states();
        judging.suppose("there are two agents or more", run.world.agents.len() > 1);
        model.suppose_balance(&mut judging);
        model.suppose_connection(&mut judging);
        let connectivity = run.series(|seen| {
            let weights = model.weights(seen);
            let largest = weights.out_degrees().into_iter().fold(0.0, f64::max);
            match is_strongly_connected(&weights) {
                true => symmetric_connectivity(&weights).map_or(f64::NAN, |it| it / largest),
                false => 0.0,
            }
        });
        let count = connectivity.len();
        judging.bound(Bound {
            name: "λ2(L + Lᵀ)/max_i L_ii",
            times: run.times(),
            values: connectivity,
            bounds: vec![1e-12; count],
            slack: vec![0.0; count],
            side: Side::Above,
            scale: 1.0,
        });
        Some(judging.finding())
    }
}
