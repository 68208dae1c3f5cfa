//! No two agents collide where W(0) < Ψ(0), and how far apart they stay.

use super::distances::apart;
use super::model::{Model, Setting};
use crate::claim::{About, Claim, Exclusion, Finding, Judging, Reading, Run};

const TEN: About = About {
    name: "song-2013/theorem-10-collision-avoidance",
    source: "Song et al. (2013), Theorem 10",
    reading: Reading::Printed,
    statement: "Where W(0) < Ψ(0) = Q, no two agents ever collide: |x_i − x_j| > 0.",
    hypotheses: "Model (8) and nothing else; no two agents start at one point; W(0) < Q.",
    measured: "The smallest distance of a pair at each time, and the smallest of all steps.",
    tolerance: "None: a distance above 0 is asked for.",
};

const SIXTEEN: About = About {
    name: "song-2013/theorem-16-collision-avoidance",
    source: "Song et al. (2013), Theorem 16",
    hypotheses: "Model (17) and nothing else; no two agents start at one point; W(0) < Q.",
    ..TEN
};

const TEN_SHARPENED: About = About {
    name: "song-2013/theorem-10-distance-sharpened",
    reading: Reading::Sharpened,
    statement: "Where W(0) < Q, |x_i − x_j| ≥ Ψ⁻¹(W(0)) = √(ln(Q/W(0))/μ), since Ψ(r_ij) ≤ W(t) ≤ \
                W(0).",
    tolerance: "What the integration may take positions off.",
    ..TEN
};

const SIXTEEN_SHARPENED: About = About {
    name: "song-2013/theorem-16-distance-sharpened",
    source: SIXTEEN.source,
    hypotheses: SIXTEEN.hypotheses,
    ..TEN_SHARPENED
};

const TEN_SHARPEST: About = About {
    name: "song-2013/theorem-10-distance-sharpest",
    statement: "|x_i − x_j| is at least the r < r* with u(r) = W(0) − (M − 1)u(r*), where u(r) = \
                k_a/2 (r − η)² + Ψ(r) is least at r*, and M = N(N − 1)/2: every other pair has at \
                least u(r*).",
    hypotheses: "Model (8) and nothing else; no two agents start at one point; W(0) < u(0) + (M − \
                 1)u(r*).",
    ..TEN_SHARPENED
};

const SIXTEEN_SHARPEST: About = About {
    name: "song-2013/theorem-16-distance-sharpest",
    source: SIXTEEN.source,
    statement: "|x_i − x_j| is at least the r < r* with u(r) = W(0) − (M − 1)u(r*), where u(r) = \
                k_a/(2N) r² + Ψ(r) is least at r*, and M = N(N − 1)/2: by Lemma 9 the centre term \
                is shared out among the pairs, and every other pair has at least u(r*).",
    hypotheses: "Model (17) and nothing else; no two agents start at one point; W(0) < u(0) + (M \
                 − 1)u(r*).",
    ..TEN_SHARPENED
};

/// How much of the energy is made use of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sharpness {
    /// That it rules out distance 0.
    Printed,
    /// That Ψ(r_ij) is at most all of it.
    Sharpened,
    /// That every pair takes a part of it.
    Sharpest,
}

/// See the file.
pub(super) struct CollisionAvoidance {
    pub(super) model: Model,
    pub(super) sharpness: Sharpness,
}

impl CollisionAvoidance {
    /// The hypotheses, and the distance that they keep.
    fn start<const D: usize>(&self, run: &Run<'_, D>) -> Option<(Judging, f64)> {
        let (setting, mut judging) = self.model.of(run)?;
        let Setting {
            count,
            height,
            decay,
            pair,
            ..
        } = setting;
        let energy = setting.start();
        let others = 0.5 * count * (count - 1.0) - 1.0;
        let distance = match self.sharpness {
            Sharpness::Printed | Sharpness::Sharpened => {
                judging.suppose_less("W(0) < Ψ(0) = Q", energy, height);
                libm::sqrt(libm::log(height / energy).max(0.0) / decay)
            }
            Sharpness::Sharpest => {
                let elsewhere = others * pair.value(pair.rest());
                let most = pair.value(0.0) + elsewhere;
                judging.suppose_less("W(0) < u(0) + (M − 1)u(r*)", energy, most);
                judging.measure("r*", pair.rest());
                pair.nearest(energy - elsewhere)
            }
        };
        match self.sharpness {
            Sharpness::Printed => Some((judging, 0.0)),
            _ => {
                judging.measure("distance that theory keeps", distance);
                Some((judging, distance))
            }
        }
    }
}

impl<const D: usize> Claim<D> for CollisionAvoidance {
    fn about(&self) -> &'static About {
        match (self.model, self.sharpness) {
            (Model::Bonded, Sharpness::Printed) => &TEN,
            (Model::Bonded, Sharpness::Sharpened) => &TEN_SHARPENED,
            (Model::Bonded, Sharpness::Sharpest) => &TEN_SHARPEST,
            (Model::Attracted, Sharpness::Printed) => &SIXTEEN,
            (Model::Attracted, Sharpness::Sharpened) => &SIXTEEN_SHARPENED,
            (Model::Attracted, Sharpness::Sharpest) => &SIXTEEN_SHARPEST,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (mut judging, distance) = self.start(run)?;
        apart(
            &mut judging,
            run,
            distance,
            self.sharpness == Sharpness::Printed,
        );
        Some(judging.finding())
    }

    fn exclusion(&self, run: &Run<'_, D>) -> Option<Exclusion> {
        let (judging, distance) = self.start(run)?;
        judging.is_supposed().then_some(Exclusion {
            distance,
            formula: match self.sharpness {
                Sharpness::Printed => "W(t) ≤ W(0) < Ψ(0)",
                Sharpness::Sharpened => "Ψ(r_ij) ≤ W(0)",
                Sharpness::Sharpest => "u(r_ij) ≤ W(0) − (M − 1) min u",
            },
        })
    }
}
