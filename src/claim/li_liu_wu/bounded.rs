//! How wide the flock can get: (8), what follows from it, and (10).

use super::model::{Setting, spread};
use crate::claim::{About, Bound, Claim, Finding, Reading, Run, Side};
use crate::metric::diameter;

const EIGHT: About = About {
    name: "li-liu-wu/bound-8-corrected",
    source: "Li, Liu & Wu, (8)",
    reading: Reading::Corrected,
    statement: "s_i ≤ Σ s_i ≤ M = √(N M*/γ) with M* = |v*(0)|² + s²(0), s_i being the distance from \
                the line through the mean.",
    hypotheses: "Model (3) with force (4), γ > 0, mutual influences a_ij = I(r_ij)/N, I positive and \
                 falling strictly, ∫ I = ∞, and nothing else.",
    measured: "Σ s_i at each time.",
    tolerance: "What the integration may take positions off, times N.",
};

const EIGHT_PRINTED: About = About {
    name: "li-liu-wu/bound-8-printed",
    reading: Reading::Misprinted,
    statement: "s_i ≤ Σ s_i ≤ M = √(N/γ) M*, the root over N/γ alone; by the line above it M* belongs \
                under it. Where M* < 1 the bound is too small.",
    ..EIGHT
};

const DIAMETER: About = About {
    name: "li-liu-wu/diameter",
    source: "Li, Liu & Wu, below (8)",
    reading: Reading::Printed,
    statement: "d_X ≤ √(d_X̃² + M²), with d_X̃ the extent along l and M = √(N M*/γ).",
    measured: "d_X at each time.",
    tolerance: "What the integration may take positions off.",
    ..EIGHT
};

const PROJECTED: About = About {
    name: "li-liu-wu/projected-diameter",
    source: "Li, Liu & Wu, (10), by the Lyapunov functional of Ha & Liu",
    reading: Reading::Sharpened,
    statement: "The extent along l stays bounded, by d* with α ∫ I(√(r² + M²)) dr from d_X̃(0) to d* \
                = √2 (Σ |ṽ_i(0) − mean|²)^½, for |ṽ*| + α/√2 ∫ I(√(r² + M²)) dr up to d_X̃ never \
                rises.",
    measured: "d_X̃(t), and d*, found by sums from below.",
    tolerance: "What the integration may take positions off.",
    ..EIGHT
};

/// What is bounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bounded {
    /// The distances from the line.
    Eight,
    /// The same as printed.
    EightPrinted,
    /// The distances between agents.
    Diameter,
    /// The extent along the line.
    Projected,
}

impl<const D: usize> Claim<D> for Bounded {
    fn about(&self) -> &'static About {
        match self {
            Self::Eight => &EIGHT,
            Self::EightPrinted => &EIGHT_PRINTED,
            Self::Diameter => &DIAMETER,
            Self::Projected => &PROJECTED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (setting, mut judging) = Setting::of(run)?;
        let (most, reach) = setting.reach(run);
        judging.measure("M*", most);
        judging.measure("M = √(N M*/γ)", reach);
        let count = run.observations.len();
        let (name, values, bounds, times_off) = match self {
            Self::Eight | Self::EightPrinted => {
                let bound = match self {
                    Self::EightPrinted => (setting.count / setting.strength).sqrt() * most,
                    _ => reach,
                };
                let sums = run.series(|seen| setting.residuals(&seen.positions).sum());
                ("Σ s_i", sums, vec![bound; count], setting.count)
            }
            Self::Diameter => {
                let widths = run.series(|seen| diameter(&seen.positions));
                let bounds = run.series(|seen| setting.projected_diameter(seen).hypot(reach));
                ("d_X(t)", widths, bounds, 1.0)
            }
            Self::Projected if judging.is_supposed() => {
                let start = run.start();
                let along = setting.projected(&start.velocities);
                let speed = spread(&along).sqrt();
                let from = setting.projected_diameter(start);
                let bound = setting.longest(from, 2f64.sqrt() * speed, reach);
                judging.measure("d*", bound);
                let extents = run.series(|seen| setting.projected_diameter(seen));
                ("d_X̃(t)", extents, vec![bound; count], 1.0)
            }
            Self::Projected => return Some(judging.finding()),
        };
        let slack = run.observations.iter().zip(&bounds);
        let slack = slack.map(|(seen, bound)| times_off * run.position_slack(seen, *bound));
        judging.bound(Bound {
            name,
            times: run.times(),
            slack: slack.collect(),
            values,
            bounds,
            side: Side::Below,
            scale: 0.0,
        });
        Some(judging.finding())
    }
}
