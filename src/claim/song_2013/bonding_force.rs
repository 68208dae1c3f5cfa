//! Bounds of the forces that hold a flock together: Remarks 13 and 17.

use super::model::{Model, Setting, mean_position};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::Vector;

const BONDS: About = About {
    name: "song-2013/remark-13-bonding-force-corrected",
    source: "Song et al. (2013), Remark 13",
    reading: Reading::Corrected,
    statement: "|k_a Σ_j (r_ij − η)/r_ij (x_j − x_i)| ≤ (N − 1)√(2k_a W(0)): the inequality as it \
                stands, of the term of (8), without the stray factor √(2W(0)/k_a) with which the \
                sentence names that term.",
    hypotheses: "Model (8) and nothing else; W(0) finite, no two agents at one point.",
    measured: "The largest such sum of an agent at each time.",
    tolerance: "What the integration may take accelerations off.",
};

const STRAY: About = About {
    name: "song-2013/remark-13-bonding-force-printed",
    reading: Reading::Misprinted,
    statement: "With the stray factor of the print, |k_a Σ_j (r_ij − η)/r_ij (x_j − x_i)| \
                √(2W(0)/k_a) ≤ (N − 1)√(2k_a W(0)). Nothing proves it.",
    measured: "The largest such sum of an agent at each time, times √(2W(0)/k_a).",
    ..BONDS
};

const BONDS_SHARPENED: About = About {
    name: "song-2013/remark-13-bonding-force-sharpened",
    reading: Reading::Sharpened,
    statement: "|k_a Σ_j (r_ij − η)/r_ij (x_j − x_i)| ≤ √(2(N − 1)k_a W(0)): an agent's bonds \
                together have no more than W(0), and (Σ_j |r_ij − η|)² ≤ (N − 1) Σ_j (r_ij − η)².",
    ..BONDS
};

const ATTRACTION: About = About {
    name: "song-2013/remark-17-attraction-corrected",
    source: "Song et al. (2013), Remark 17",
    reading: Reading::Corrected,
    statement: "|−k_a x̂_i| = k_a |x_i − x_c| ≤ √(2k_a W(0)).",
    hypotheses: "Model (17) and nothing else; W(0) finite, no two agents at one point.",
    measured: "max_i k_a |x_i − x_c| at each time, as the law gives it.",
    ..BONDS
};

const ATTRACTION_PRINTED: About = About {
    name: "song-2013/remark-17-attraction-printed",
    reading: Reading::Misprinted,
    statement: "k_a |x_i| ≤ √(2k_a W(0)), with the position x_i where x̂_i = x_i − x_c is meant. A \
                flock that moves on breaks it.",
    measured: "max_i k_a |x_i| at each time.",
    ..ATTRACTION
};

/// Which bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BondingForce {
    /// Of Remark 13.
    Bonds,
    /// Of Remark 13, with its stray factor.
    Stray,
    /// Of Remark 13, sharpened.
    BondsSharpened,
    /// Of Remark 17, of x̂.
    Attraction,
    /// Of Remark 17, of x.
    AttractionPrinted,
}

impl<const D: usize> Claim<D> for BondingForce {
    fn about(&self) -> &'static About {
        match self {
            Self::Bonds => &BONDS,
            Self::Stray => &STRAY,
            Self::BondsSharpened => &BONDS_SHARPENED,
            Self::Attraction => &ATTRACTION,
            Self::AttractionPrinted => &ATTRACTION_PRINTED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = match self {
            Self::Bonds | Self::Stray | Self::BondsSharpened => Model::Bonded,
            Self::Attraction | Self::AttractionPrinted => Model::Attracted,
        };
        let (setting, mut judging) = model.of(run)?;
        let Setting {
            count,
            stiffness,
            laws,
            ..
        } = setting;
        let energy = setting.start();
        let unit = (2.0 * stiffness * energy).sqrt();
        let (name, factor, bound) = match self {
            Self::Bonds => ("max_i |bonding force|", 1.0, (count - 1.0) * unit),
            Self::Stray => (
                "max_i |bonding force| √(2W(0)/k_a)",
                (2.0 * energy / stiffness).sqrt(),
                (count - 1.0) * unit,
            ),
            Self::BondsSharpened => ("max_i |bonding force|", 1.0, (count - 1.0).sqrt() * unit),
            Self::Attraction => ("max_i |attraction|", 1.0, unit),
            Self::AttractionPrinted => ("max_i k_a |x_i|", stiffness, unit),
        };
        let values = run.series(|seen| match self {
            Self::AttractionPrinted => factor * largest(&seen.positions),
            _ => factor * largest(&seen.by_law[laws[1]]),
        });
        force_bound(&mut judging, run, name, values, bound);
        if *self == Self::Attraction {
            // The force is what the formula says it is.
            let values = run.series(|seen| {
                let center = mean_position(seen);
                let away = seen.positions.iter().zip(&seen.by_law[laws[1]]);
                let off = away.map(|(x, force)| (force + (x - center) * stiffness).norm());
                off.fold(0.0, f64::max)
            });
            judging.bound(Bound {
                name: "max_i |attraction + k_a x̂_i|",
                times: run.times(),
                bounds: vec![0.0; values.len()],
                slack: run.series(|seen| 1e-12 * stiffness * largest(&seen.positions)),
                values,
                side: Side::Below,
                scale: unit,
            });
        }
        Some(judging.finding())
    }
}

/// The length of the longest vector.
pub(super) fn largest<const D: usize>(vectors: &[Vector<D>]) -> f64 {
    vectors.iter().map(Vector::norm).fold(0.0, f64::max)
}

/// The conclusion that a force never exceeds a bound.
pub(super) fn force_bound<const D: usize>(
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
        slack: run.series(|seen| run.acceleration_slack(seen, bound)),
        side: Side::Below,
        scale: bound,
    });
}
