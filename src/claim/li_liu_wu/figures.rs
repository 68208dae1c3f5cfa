//! What the figures show, of forces that nothing is proved of: (14) and (15).

use super::theorem_3_1::{position_floor, velocity_floor};
use crate::claim::undisturbed::{MutualAlignment, suppose_undisturbed};
use crate::claim::{About, Claim, Finding, Judging, Reading, Run};
use crate::metric::{ball_residual, diameter, line_residual};
use crate::world::spec::{AlignmentSpec, LawSpec, NormalisationSpec};
use crate::world::{World, vector};

const LINE: About = About {
    name: "li-liu-wu/figures-1-2-line",
    source: "Li, Liu & Wu, Figures 1 and 2",
    reading: Reading::Printed,
    statement: "The figures show that with the force (14) a flock forms, and every agent comes to the \
                line; nothing is proved of it.",
    hypotheses: "Model (3) with force (14), γ = 1, influences I/N or I/Σ I with I(r) = (1 + r²)^(−β), \
                 and nothing else. Of starts they say nothing; that any will do is more than they \
                 show.",
    measured: "d_V(t), and the largest distance from the line through the mean.",
    tolerance: "The rule for limits; what the integration may take velocities and positions off \
                counts as 0.",
};

const BALL: About = About {
    name: "li-liu-wu/figures-3-4-ball",
    source: "Li, Liu & Wu, Figures 3 and 4",
    statement: "The figures show that with the force (15) a flock forms, and every agent comes to the \
                circle, in space the sphere, of radius R about the mean; nothing is proved of it.",
    hypotheses: "Model (3) with force (15), γ = 1, influences I/N or I/Σ I with I(r) = (1 + r²)^(−β), \
                 and nothing else. Of starts they say nothing; that any will do is more than they \
                 show.",
    measured: "d_V(t), and the largest distance from the circle or sphere about the mean.",
    ..LINE
};

/// What is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Figures {
    /// A line.
    Line,
    /// A circle or sphere.
    Ball,
}

impl<const D: usize> Claim<D> for Figures {
    fn about(&self) -> &'static About {
        match self {
            Self::Line => &LINE,
            Self::Ball => &BALL,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let world = run.world;
        let mut laws = world.laws().map(|(_, law)| law);
        let (normalised, strength, residuals) = laws.find_map(|law| match (self, law) {
            (Self::Line, LawSpec::LinePattern(law)) => {
                let along = vector(&law.direction);
                let residuals = run.series(|seen| line_residual(&seen.positions, &along));
                Some((law.normalised, law.strength, residuals))
            }
            (Self::Ball, LawSpec::BallPattern(law)) => {
                let residuals = run.series(|seen| ball_residual(&seen.positions, law.radius));
                Some((law.normalised, law.strength, residuals))
            }
            _ => None,
        })?;
        let mut judging = Judging::new(run);
        judging.suppose(
            "the laws are alignment and one force to a pattern, and no others act",
            world.laws().count() == 2,
        );
        judging.suppose(
            "the force is divided by 1 + Σ |w_j|, and γ = 1",
            normalised && strength == 1.0,
        );
        judging.suppose(
            "influences are I/N or I/Σ I with I(r) = (1 + r²)^(−β), β > 0",
            world.laws().any(|(_, law)| match law {
                LawSpec::Alignment(law) => is_of_the_figures(law, world),
                _ => false,
            }),
        );
        judging.suppose("there are two agents or more", world.agents.len() > 1);
        suppose_undisturbed(&mut judging, world);
        let times = run.times();
        let values = run.series(|seen| diameter(&seen.velocities));
        judging.tends_to_zero("d_V(t)", &times, &values, velocity_floor(run));
        let name = "largest distance from the pattern";
        judging.tends_to_zero(name, &times, &residuals, position_floor(run));
        Some(judging.finding())
    }
}

fn is_of_the_figures<const D: usize>(law: &AlignmentSpec, world: &World<D>) -> bool {
    // Each agent's influences may be divided by their own sum.
    let shared = AlignmentSpec {
        normalisation: NormalisationSpec::MeanField,
        ..law.clone()
    };
    let decay = MutualAlignment::of(&shared, world).and_then(|it| it.decay());
    law.normalisation != NormalisationSpec::None && decay.is_some_and(|beta| beta > 0.0)
}
