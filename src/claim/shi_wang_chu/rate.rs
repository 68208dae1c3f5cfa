//! How fast the energy of the error system falls: 3.1.3, in three readings.

use super::damping::Damping;
use super::model::Model;
use crate::claim::falling::rounding;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::mean;
use crate::net::symmetric_connectivity;

const HYPOTHESES: &str = "Control (6) or (15), weights balanced and weakly connected, no other \
                          forces; damping only where it is compensated.";
const MEASURED: &str = "dJ*/dt by velocities and accelerations, against the bound.";
const TOLERANCE: &str =
    "1e-9 of the powers that the rate is the sum of, and 1e-12 of the largest, for rounding.";

const fn about(name: &'static str, reading: Reading, statement: &'static str) -> About {
    About {
        name,
        source: "Shi, Wang & Chu, 3.1.3, below (18)",
        reading,
        statement,
        hypotheses: HYPOTHESES,
        measured: MEASURED,
        tolerance: TOLERANCE,
    }
}

/// A reading of the inequality.
pub(super) struct Rate {
    about: &'static About,
    /// What λ2 is multiplied by.
    factor: f64,
    /// Whether errors are those from their mean, which is orthogonal to what L + Lᵀ sends to 0.
    about_mean: bool,
}

pub(super) const PRINTED: Rate = Rate {
    about: &about(
        "shi-wang-chu/rate-printed",
        Reading::Misprinted,
        "dJ*/dt ≤ −λ2 e_vᵀe_v, with λ2 the second smallest eigenvalue of L + Lᵀ and e_v the \
         velocities as seen from the centre of mass.",
    ),
    factor: 1.0,
    about_mean: false,
};

pub(super) const HALVED: Rate = Rate {
    about: &about(
        "shi-wang-chu/rate-halved",
        Reading::Misprinted,
        "dJ*/dt ≤ −(λ2/2) e_vᵀe_v: as printed, with the ½ of (18), which got lost. Still wrong \
         where masses differ, for then e_v is not orthogonal to 1.",
    ),
    factor: 0.5,
    about_mean: false,
};

pub(super) const CORRECTED: Rate = Rate {
    about: &about(
        "shi-wang-chu/rate-corrected",
        Reading::Corrected,
        "dJ*/dt ≤ −(λ2/2) |e_v − mean(e_v)|².",
    ),
    factor: 0.5,
    about_mean: true,
};

impl<const D: usize> Claim<D> for Rate {
    fn about(&self) -> &'static About {
        self.about
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose(&mut judging, Damping::None);
        model.suppose_balance(&mut judging);
        model.suppose_connection(&mut judging);
        let connectivity = symmetric_connectivity(&model.weights(run.start())).unwrap_or(0.0);
        judging.measure("λ2(L + Lᵀ)", connectivity);
        let (mut rates, mut bounds, mut sizes) = (Vec::new(), Vec::new(), Vec::new());
        for seen in &run.observations {
            let errors = model.errors(seen);
            let (rate, size) = model.power(seen, &errors);
            let center = mean(&errors) * f64::from(u8::from(self.about_mean));
            let squares = errors.iter().map(|e| (e - center).norm_squared());
            let squares: f64 = squares.sum();
            rates.push(rate);
            bounds.push(-self.factor * connectivity * squares);
            sizes.push(size);
        }
        judging.bound(Bound {
            name: "dJ*/dt",
            times: run.times(),
            values: rates,
            bounds,
            slack: rounding(&sizes),
            side: Side::Below,
            scale: 0.0,
        });
        Some(judging.finding())
    }
}
