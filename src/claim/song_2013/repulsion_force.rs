//! Bounds of the repulsion: Remarks 13 and 17.

use super::bonding_force::{force_bound, largest};
use super::distances::smallest_distance;
use super::model::{Model, Setting};
use crate::claim::{About, Claim, Finding, Reading, Run};
use crate::metric::diameter;

const THIRTEEN: About = About {
    name: "song-2013/remark-13-repulsion",
    source: "Song et al. (2013), Remark 13",
    reading: Reading::Printed,
    statement: "|Σ_j ∇_i Ψ(r_ij)| ≤ (N − 1) max g_r(r_ij) sup r_ij ≤ (N − 1)P(η + √(2W(0)/k_a)), \
                with g_r(r) = 2Qμ exp(−μ r²) and P = g_r(0).",
    hypotheses: "Model (8) and nothing else; W(0) finite, no two agents at one point.",
    measured: "The largest repulsion of an agent, and (N − 1) max g_r(r_ij) max r_ij, at each time.",
    tolerance: "What the integration may take accelerations off.",
};

const SEVENTEEN: About = About {
    name: "song-2013/remark-17-repulsion",
    source: "Song et al. (2013), Remark 17",
    statement: "|Σ_j ∇_i Ψ(r_ij)| ≤ (N − 1) max g_r(r_ij) sup r_ij ≤ 2(N − 1)P√(2W(0)/k_a), with \
                g_r(r) = 2Qμ exp(−μ r²) and P = g_r(0).",
    hypotheses: "Model (17) and nothing else; W(0) finite, no two agents at one point.",
    ..THIRTEEN
};

const THIRTEEN_SHARPENED: About = About {
    name: "song-2013/remark-13-repulsion-sharpened",
    reading: Reading::Sharpened,
    statement: "|Σ_j ∇_i Ψ(r_ij)| ≤ (N − 1)Q√(2μ/e), whatever W(0): r g_r(r) is largest at r = \
                1/√(2μ).",
    measured: "The largest repulsion of an agent at each time.",
    ..THIRTEEN
};

const SEVENTEEN_SHARPENED: About = About {
    name: "song-2013/remark-17-repulsion-sharpened",
    source: SEVENTEEN.source,
    hypotheses: SEVENTEEN.hypotheses,
    ..THIRTEEN_SHARPENED
};

/// See the file.
pub(super) struct RepulsionForce {
    pub(super) model: Model,
    pub(super) sharpened: bool,
}

impl<const D: usize> Claim<D> for RepulsionForce {
    fn about(&self) -> &'static About {
        match (self.model, self.sharpened) {
            (Model::Bonded, false) => &THIRTEEN,
            (Model::Bonded, true) => &THIRTEEN_SHARPENED,
            (Model::Attracted, false) => &SEVENTEEN,
            (Model::Attracted, true) => &SEVENTEEN_SHARPENED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (setting, mut judging) = self.model.of(run)?;
        let Setting {
            count,
            stiffness,
            length,
            height,
            decay,
            laws,
            ..
        } = setting;
        let reach = (2.0 * setting.start() / stiffness).sqrt();
        let forces = run.series(|seen| largest(&seen.by_law[laws[2]]));
        let (name, others) = ("max_i |repulsion|", count - 1.0);
        if self.sharpened {
            let most = height * (2.0 * decay / std::f64::consts::E).sqrt();
            force_bound(&mut judging, run, name, forces, others * most);
            return Some(judging.finding());
        }
        let steepest = 2.0 * height * decay;
        let widest = match self.model {
            Model::Bonded => length + reach,
            Model::Attracted => 2.0 * reach,
        };
        let between = run.series(|seen| {
            let nearest = smallest_distance(&seen.positions);
            let slope = steepest * libm::exp(-decay * nearest * nearest);
            others * slope * diameter(&seen.positions)
        });
        let bound = others * steepest * widest;
        let mut largest_share = 0.0f64;
        for (force, between) in forces.iter().zip(&between) {
            largest_share = largest_share.max(force / between);
        }
        judging.measure(
            "max of repulsion over (N − 1) max g_r max r_ij",
            largest_share,
        );
        force_bound(&mut judging, run, name, forces, bound);
        force_bound(
            &mut judging,
            run,
            "(N − 1) max g_r max r_ij",
            between,
            bound,
        );
        Some(judging.finding())
    }
}
