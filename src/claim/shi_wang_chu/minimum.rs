//! What the final formation minimises, Theorems 1 and 3.

use super::damping::Damping;
use super::descent::{BUDGET, descend, total};
use super::model::{Model, gradient};
use crate::claim::{About, Claim, Finding, Judging, Reading, Run, vanishes};
use crate::math::{Vector, mean};
use crate::sense::LinkDraws;

/// From how many stretched configurations the claim goes down to look for minima, from how many
/// of the end with one agent thrown over to the other side, and from how many scattered ones.
const STRETCHED: usize = 12;
const THROWN: usize = 12;
const SCATTERED: usize = 24;

/// The largest factor by which they are stretched.
const STRETCH: f64 = 3.0;

const HYPOTHESES: &str = "Control (6) or (15), weights balanced and weakly connected, no other \
                          forces but damping.";

const PRINTED: About = About {
    name: "shi-wang-chu/global-minimum-printed",
    source: "Shi, Wang & Chu, Theorems 1 and 3",
    reading: Reading::Misprinted,
    statement: "The final configuration globally minimises the potentials of all agents.",
    hypotheses: HYPOTHESES,
    measured: "The potential V_end of the minimum below the last state, once forces are seen to \
               tend to 0, and that of minima found by going down from other places: the start, its \
               first axis stretched by a dozen factors from 1/3 to 3; the end, with one of up to a \
               dozen agents thrown over to the other side; two dozen random ones as wide as the end. \
               It is global where each pair has its own least potential, which few agents can \
               have; violated where a lower one was found; undecided otherwise.",
    tolerance: "A thousandth of V_end less the sum of the pairs' least potentials; descents are \
                exact to much less.",
};

const CORRECTED: About = About {
    name: "shi-wang-chu/critical-point-corrected",
    source: "Shi, Wang & Chu, proof of Theorem 1: v̇ = 0 in the largest invariant set of E",
    reading: Reading::Corrected,
    statement: "The final configuration is a critical point of the potential of all pairs.",
    hypotheses: HYPOTHESES,
    measured: "The largest |∇_i V| of all agents, judged as a limit.",
    tolerance: "The rule for limits; of points 100 times the integrator's accuracy, of bodies \
                step times jerks, cannot be told from 0.",
};

/// As printed.
pub(super) struct GlobalMinimum;

/// As corrected.
pub(super) struct CriticalPoint;

fn supposed<'r, const D: usize>(run: &'r Run<'r, D>) -> Option<(Model<'r, D>, Judging)> {
    let model = Model::of(run)?;
    let mut judging = Judging::new(run);
    model.suppose(&mut judging, Damping::Any);
    model.suppose_balance(&mut judging);
    model.suppose_connection(&mut judging);
    Some((model, judging))
}

/// The largest force on an agent at each time, and what it cannot be told from 0 by.
fn slopes<const D: usize>(model: &Model<'_, D>) -> (Vec<f64>, f64) {
    let run = model.run;
    let slopes = run.series(|seen| {
        let slopes = gradient(model.potential(), &seen.positions);
        slopes.iter().map(|g| g.norm()).fold(0.0, f64::max)
    });
    let floor = run.acceleration_slack(run.last(), model.largest_pull(run.last()));
    let heaviest = model.inertia.iter().copied().fold(0.0, f64::max);
    (slopes, floor * f64::max(heaviest, 1.0))
}

impl<const D: usize> Claim<D> for CriticalPoint {
    fn about(&self) -> &'static About {
        &CORRECTED
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (model, mut judging) = supposed(run)?;
        let (slopes, floor) = slopes(&model);
        judging.tends_to_zero("max_i |∇_i V|", &run.times(), &slopes, floor);
        Some(judging.finding())
    }
}

impl<const D: usize> Claim<D> for GlobalMinimum {
    fn about(&self) -> &'static About {
        &PRINTED
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let (model, mut judging) = supposed(run)?;
        let Some((least, _)) = model.least().filter(|_| judging.is_supposed()) else {
            return Some(judging.finding());
        };
        let (slopes, floor) = slopes(&model);
        judging.tends_to_zero("max_i |∇_i V|", &run.times(), &slopes, floor);
        let settled = vanishes(&run.times(), &slopes, floor).seen == Some(true);
        let potential = model.potential();
        let absolute = model.pairs() * least;
        let end = descend(potential, &run.last().positions);
        let excess = end - absolute;
        judging.measure("V at the end", total(potential, &run.last().positions));
        judging.measure("V_end", end);
        judging.measure("N(N − 1)/2 min V", absolute);
        if !settled {
            return Some(judging.finding());
        }
        let tolerance = 1e-3 * excess;
        let mut best = end;
        for positions in starts(&run.start().positions, &run.last().positions) {
            best = best.min(descend(potential, &positions));
            if best < end - tolerance {
                break;
            }
        }
        // Rounding of as many potentials.
        let rounding = 1e-9 * model.pairs() * (1.0 + least.abs());
        if excess <= rounding {
            judging.equal("V_end", end, absolute, rounding, absolute.abs());
        } else if best < end - tolerance {
            judging.equal("the lowest V found", best, end, tolerance, excess);
        } else {
            judging.undecided(format!(
                "no lower minimum was found from {} configurations, with {BUDGET} potentials of \
                 pairs each; that is no proof that there is none",
                STRETCHED + THROWN.min(run.last().positions.len()) + SCATTERED
            ));
        }
        Some(judging.finding())
    }
}

/// Where to look for lower minima. What started near a minimum ends there however it is
/// stretched: so others are far from the start, and the same in every run of a flock as wide.
fn starts<'a, const D: usize>(
    start: &'a [Vector<D>],
    end: &'a [Vector<D>],
) -> impl Iterator<Item = Vec<Vector<D>>> + 'a {
    // Shapes that differ are what leads to minima that differ.
    let stretched = (0..STRETCHED).map(|k| {
        let exponent = 2.0 * k as f64 / (STRETCHED - 1) as f64 - 1.0;
        let factor = libm::pow(STRETCH, exponent);
        let mut positions = start.to_vec();
        positions.iter_mut().for_each(|x| x[0] *= factor);
        positions
    });
    let center = mean(end);
    let thrown = (0..THROWN.min(end.len())).map(move |agent| {
        let mut positions = end.to_vec();
        positions[agent] = center * 2.0 - positions[agent];
        positions
    });
    let squares: f64 = end.iter().map(|x| (x - center).norm_squared()).sum();
    let width = (squares / (D * end.len()).max(1) as f64).sqrt();
    let scattered = (0..SCATTERED).map(move |k| {
        let draw = |agent| LinkDraws::new(0, k as u64, agent, agent).offset_error(width);
        (0..end.len()).map(|agent| center + draw(agent)).collect()
    });
    stretched.chain(thrown).chain(scattered)
}
