//! Lemma 9: differences and deviations from the mean.

use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::Vector;
use crate::world::spec::LawSpec;
use crate::world::vector;

const ABOUT: About = About {
    name: "song-2013/lemma-9",
    source: "Song et al. (2013), Lemma 9",
    reading: Reading::Printed,
    statement: "Σ_{i<j} |ẑ_j − ẑ_i|² = N Σ_i |ẑ_i|² with ẑ_i = z_i − z̄: of positions and of \
                velocities, with the means that the laws' record has.",
    hypotheses: "None: it holds for all numbers. Looked at where a law is one of the paper's.",
    measured: "The difference of the two sides over the larger one.",
    tolerance: "1e-9, for rounding and what cancels in flocks far from the origin.",
};

/// See the file.
pub(super) struct Lemma9;

impl<const D: usize> Claim<D> for Lemma9 {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let of_the_paper = |law: &LawSpec| {
            matches!(
                law,
                LawSpec::PairPotential(_) | LawSpec::CuckerDong(_) | LawSpec::ParkBonding(_)
            )
        };
        run.world.laws().find(|(_, law)| of_the_paper(law))?;
        let mut judging = Judging::of_states();
        let seen = || run.observations.iter().chain(&run.after_contact);
        let times: Vec<f64> = seen().map(|seen| seen.time).collect();
        for (name, values) in [
            (
                "of positions, |Σ_{i<j} |ẑ_j − ẑ_i|² / (N Σ |ẑ_i|²) − 1|",
                seen()
                    .map(|seen| off(&seen.positions, &vector(&seen.laws.mean_position)))
                    .collect::<Vec<f64>>(),
            ),
            (
                "of velocities, |Σ_{i<j} |ẑ_j − ẑ_i|² / (N Σ |ẑ_i|²) − 1|",
                seen()
                    .map(|seen| off(&seen.velocities, &vector(&seen.laws.mean_velocity)))
                    .collect(),
            ),
        ] {
            judging.bound(Bound {
                name,
                times: times.clone(),
                bounds: vec![0.0; values.len()],
                slack: vec![1e-9; values.len()],
                values,
                side: Side::Below,
                scale: 1e-9,
            });
        }
        Some(judging.finding())
    }
}

/// By what share the two sides differ; 0 where both vanish against the size of the vectors.
fn off<const D: usize>(vectors: &[Vector<D>], mean: &Vector<D>) -> f64 {
    let mut pairs = 0.0;
    for (i, a) in vectors.iter().enumerate() {
        for b in &vectors[i + 1..] {
            pairs += (b - a).norm_squared();
        }
    }
    let (mut deviations, mut sizes) = (0.0, 0.0);
    for z in vectors {
        deviations += (z - mean).norm_squared();
        sizes += z.norm_squared();
    }
    let count = vectors.len() as f64;
    let rounding = 1e-15 * count * sizes;
    let difference = (pairs - count * deviations).abs();
    if difference <= rounding {
        return 0.0;
    }
    difference / pairs.max(count * deviations)
}
