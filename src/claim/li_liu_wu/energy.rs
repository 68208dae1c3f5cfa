//! What the proof of Theorem 3.1 says of |v*|² + s², (7) and (11).

use super::model::{Setting, spread};
use crate::claim::integral::integral;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::metric::diameter;

const NEVER_RISES: About = About {
    name: "li-liu-wu/energy-never-rises",
    source: "Li, Liu & Wu, below (7)",
    reading: Reading::Printed,
    statement: "|v*|² + s² with |v*|² = Σ |v_i − v̄|² and s² = γ Σ s_i² never rises, s_i being the \
                distance from the line through the mean.",
    hypotheses: "Model (3) with force (4), γ > 0, mutual influences a_ij = I(r_ij)/N, I positive and \
                 falling strictly, ∫ I = ∞, and nothing else.",
    measured: "Its slope along the motion, and its value at each time against the least before.",
    tolerance: "Of the slope 1e-12 of the sum of its terms' sizes, for rounding. Of the value what \
                the integration may be off.",
};

const RATE: About = About {
    name: "li-liu-wu/energy-rate-corrected",
    source: "Li, Liu & Wu, (7)",
    reading: Reading::Corrected,
    statement: "d/dt (|v*|² + s²) ≤ −2αI(d_X)|v*|², an inequality from its first line on.",
    measured: "The slope along the motion, and |v*|² + s² + ∫ 2αI(d_X)|v*|² against its value at \
               the start.",
    tolerance: "Of the slope 1e-12 of the sum of its terms' sizes, for rounding. Of the integral \
                what the integration may be off, and what the trapezoid rule may: twice h³/12 |f''| \
                of each stretch between observations.",
    ..NEVER_RISES
};

const RATE_PRINTED: About = About {
    name: "li-liu-wu/energy-rate-printed",
    source: "Li, Liu & Wu, above (7)",
    reading: Reading::Misprinted,
    statement: "d/dt (|v*|² + s²) = −2αI(d_X)|v*|²: the last lines above (7) have \"=\" where agents \
                nearer than d_X make it \"<\".",
    measured: "By how much the slope along the motion is off.",
    tolerance: "1e-9 of the sum of the terms' sizes, for rounding.",
    ..NEVER_RISES
};

const UNIFORM_RATE: About = About {
    name: "li-liu-wu/uniform-rate-corrected",
    source: "Li, Liu & Wu, (11)",
    statement: "d/dt (|v*|² + s²) ≤ −2αI(√(d*² + M²))|v*|², with d* the largest d_X̃ and M = \
                √(N M*/γ), M* = |v*(0)|² + s²(0).",
    measured: "The slope along the motion, with d* the largest extent along l that is seen; and \
               |v*|² + s² with the integral of the rate against its value at the start.",
    ..RATE
};

const UNIFORM_RATE_PRINTED: About = About {
    name: "li-liu-wu/uniform-rate-printed",
    reading: Reading::Misprinted,
    statement: "d/dt (|v*|² + s²) ≤ −2αI(d*)|v*|², with d* the largest d_X̃, (10). But d* is only the \
                extent along l.",
    ..UNIFORM_RATE
};

/// What is said of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Energy {
    /// That it never rises.
    NeverRises,
    /// (7).
    Rate,
    /// The equality above (7).
    RatePrinted,
    /// (11), of what is as wide as it can be.
    UniformRate,
    /// (11), of what is as long as it can be.
    UniformRatePrinted,
}

impl<const D: usize> Claim<D> for Energy {
    fn about(&self) -> &'static About {
        match self {
            Self::NeverRises => &NEVER_RISES,
            Self::Rate => &RATE,
            Self::RatePrinted => &RATE_PRINTED,
            Self::UniformRate => &UNIFORM_RATE,
            Self::UniformRatePrinted => &UNIFORM_RATE_PRINTED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (setting, mut judging) = Setting::of(run)?;
        let longest = run.series(|seen| setting.projected_diameter(seen));
        let longest = longest.into_iter().fold(0.0, f64::max);
        let (_, reach) = setting.reach(run);
        let rates = run.series(|seen| {
            let influence = match self {
                Self::NeverRises => 0.0,
                Self::Rate | Self::RatePrinted => setting.influence(diameter(&seen.positions)),
                Self::UniformRate => setting.influence(longest.hypot(reach)),
                Self::UniformRatePrinted => setting.influence(longest),
            };
            2.0 * influence * spread(&seen.velocities)
        });
        if matches!(self, Self::UniformRate | Self::UniformRatePrinted) {
            judging.measure("d*", longest);
        }
        let (slopes, sizes) = slopes(&setting, run);
        let scale = slopes.iter().map(|it| it.abs()).fold(0.0, f64::max);
        if *self == Self::RatePrinted {
            let off = slopes.iter().zip(&rates);
            judging.bound(Bound {
                name: "|d/dt (|v*|² + s²) + 2αI(d_X)|v*|²|",
                times: run.times(),
                values: off.map(|(slope, rate)| (slope + rate).abs()).collect(),
                bounds: vec![0.0; rates.len()],
                slack: sizes.iter().map(|size| 1e-9 * size).collect(),
                side: Side::Below,
                scale,
            });
            return Some(judging.finding());
        }
        let rounding = sizes.iter().zip(&rates);
        judging.bound(Bound {
            name: "d/dt (|v*|² + s²)",
            times: run.times(),
            bounds: rates.iter().map(|rate| -rate).collect(),
            slack: rounding.map(|(size, rate)| 1e-12 * (size + rate)).collect(),
            values: slopes,
            side: Side::Below,
            scale,
        });
        match self {
            Self::NeverRises => {
                let values = run.series(|seen| setting.energy(seen));
                let slack = run.series(|seen| setting.slack(run, seen));
                judging.never_rises("|v*|² + s²", &run.times(), &values, &slack);
            }
            _ => falls_by(&mut judging, &setting, run, &rates),
        }
        Some(judging.finding())
    }
}

/// The slopes at the observations, and the sizes of their terms.
fn slopes<const D: usize>(setting: &Setting<D>, run: &Run<'_, D>) -> (Vec<f64>, Vec<f64>) {
    let slopes = run.observations.iter().map(|seen| setting.slope(seen));
    slopes.unzip()
}

/// The conclusion that |v*|² + s² has lost at least the integral of some rates.
fn falls_by<const D: usize>(
    judging: &mut Judging,
    setting: &Setting<D>,
    run: &Run<'_, D>,
    rates: &[f64],
) {
    let lost = integral(&run.times(), rates);
    let energies = run.series(|seen| setting.energy(seen));
    let start = energies[0];
    let slack = run.observations.iter().zip(&lost.errors);
    let values = energies.iter().zip(&lost.values);
    judging.bound(Bound {
        name: "|v*|² + s² + what it had to lose",
        times: run.times(),
        values: values.map(|(energy, lost)| energy + lost).collect(),
        bounds: vec![start; rates.len()],
        slack: slack
            .map(|(seen, off)| off + setting.slack(run, seen))
            .collect(),
        side: Side::Below,
        scale: start,
    });
}
