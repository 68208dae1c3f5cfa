//! How wide a flock can be: (15) and (22).

use super::model::{Model, Setting, mean_position};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::metric::diameter;

const TEN: About = About {
    name: "song-2013/theorem-10-cohesion",
    source: "Song et al. (2013), Theorem 10, (14), (15)",
    reading: Reading::Printed,
    statement: "For every pair |r_ij − η| ≤ √(2W(0)/k_a), so |x_i − x_j| ≤ η + √(2W(0)/k_a).",
    hypotheses: "Model (8) and nothing else; W(0) finite, no two agents at one point.",
    measured: "d_X(t), the largest distance of a pair, and max |r_ij − η|.",
    tolerance: "What the integration may take positions off.",
};

const SIXTEEN: About = About {
    name: "song-2013/theorem-16-cohesion",
    source: "Song et al. (2013), Theorem 16, (21), (22)",
    statement: "|x_i − x_c| ≤ R = √(2W(0)/k_a), so |x_i − x_j| ≤ 2R.",
    hypotheses: "Model (17) and nothing else; W(0) finite, no two agents at one point.",
    measured: "max |x̂_i|, and d_X(t), the largest distance of a pair.",
    ..TEN
};

const SHARPENED: About = About {
    name: "song-2013/theorem-16-cohesion-sharpened",
    source: "Song et al. (2013), Theorem 16, (21)",
    reading: Reading::Sharpened,
    statement: "|x_i − x_j| ≤ 2√(W(0)/k_a): of two agents |x̂_i|² + |x̂_j|² ≤ 2W(0)/k_a, and \
                |x_i − x_j|² is at most twice that.",
    measured: "d_X(t), the largest distance of a pair.",
    ..SIXTEEN
};

/// See the file.
pub(super) struct Cohesion {
    pub(super) model: Model,
    pub(super) sharpened: bool,
}

impl<const D: usize> Claim<D> for Cohesion {
    fn about(&self) -> &'static About {
        match (self.model, self.sharpened) {
            (Model::Bonded, _) => &TEN,
            (Model::Attracted, false) => &SIXTEEN,
            (Model::Attracted, true) => &SHARPENED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (setting, mut judging) = self.model.of(run)?;
        let Setting {
            stiffness, length, ..
        } = setting;
        let reach = (2.0 * setting.start() / stiffness).sqrt();
        let (name, values, bound) = match self.model {
            Model::Bonded => (
                "max |r_ij − η|",
                run.series(|seen| {
                    let nearest = super::smallest_distance(&seen.positions);
                    let farthest = diameter(&seen.positions);
                    (farthest - length).max(length - nearest)
                }),
                length + reach,
            ),
            Model::Attracted => (
                "max |x_i − x_c|",
                run.series(|seen| {
                    let center = mean_position(seen);
                    let away = seen.positions.iter().map(|x| (x - center).norm());
                    away.fold(0.0, f64::max)
                }),
                2.0 * reach,
            ),
        };
        if self.sharpened {
            bounded(
                &mut judging,
                run,
                "d_X(t)",
                widths(run),
                reach * 2f64.sqrt(),
            );
        } else {
            bounded(&mut judging, run, name, values, reach);
            bounded(&mut judging, run, "d_X(t)", widths(run), bound);
        }
        Some(judging.finding())
    }
}

/// d_X at each time.
pub(super) fn widths<const D: usize>(run: &Run<'_, D>) -> Vec<f64> {
    run.series(|seen| diameter(&seen.positions))
}

/// The conclusion that a length never exceeds a bound.
pub(super) fn bounded<const D: usize>(
    judging: &mut Judging,
    run: &Run<'_, D>,
    name: &str,
    values: Vec<f64>,
    bound: f64,
) {
    judging.bound(Bound {
        name,
        times: run.times(),
        bounds: vec![bound; values.len()],
        values,
        slack: run.series(|seen| run.position_slack(seen, bound)),
        side: Side::Below,
        scale: bound,
    });
}
