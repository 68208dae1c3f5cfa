//! What energy leaves of distances: no pair comes nearer, none farther apart, than it can pay.

use super::damping::Damping;
use super::model::Model;
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::metric::diameter;

const ABOUT: About = About {
    name: "shi-wang-chu/bounded-distances",
    source: "Shi, Wang & Chu, proof of Theorem 1: compactness of Ω, (7)",
    reading: Reading::Sharpened,
    statement: "No two agents are ever farther apart than the R with V(R) + (N − 2) V(R/2) = \
                J(0) less the least potential of all other pairs: of two agents R apart every \
                third is R/2 away from one. The paper says that there is a bound.",
    hypotheses: "Control (6) or (15) with balanced weights, no other forces but damping.",
    measured: "The largest distance of two agents.",
    tolerance: "Of points 100 times the integrator's accuracy, of bodies step² times accelerations.",
};

/// See the file.
pub(super) struct BoundedDistances;

impl<const D: usize> Claim<D> for BoundedDistances {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose(&mut judging, Damping::Any);
        model.suppose_balance(&mut judging);
        if let Some(farthest) = model.farthest() {
            let count = run.observations.len();
            let largest = run.series(|seen| diameter(&seen.positions));
            let slack = run.series(|seen| run.position_slack(seen, farthest));
            judging.bound(Bound {
                name: "d_X",
                times: run.times(),
                values: largest,
                bounds: vec![farthest; count],
                slack,
                side: Side::Below,
                scale: farthest,
            });
        }
        Some(judging.finding())
    }
}

impl<const D: usize> Model<'_, D> {
    /// The energy that falls, at the start: J* as seen from the velocity that is kept, where one
    /// is; with damping J.
    fn energy_to_spend(&self) -> f64 {
        let start = self.run.start();
        match self.is_undamped() {
            true => self.energy(start, &self.errors(start)),
            false => self.energy(start, &start.velocities),
        }
    }

    /// How near two agents can come: the r with V(r) = J(0) less the least potentials of all
    /// other pairs. Nothing where the potential has no least value.
    pub fn nearest(&self) -> Option<f64> {
        let (least, at) = self.least()?;
        let energy = self.energy_to_spend() - (self.pairs() - 1.0) * least;
        let exceeds = |r: f64| self.potential().value(r) > energy;
        let mut far = at;
        let mut near = 0.5 * at;
        while !exceeds(near) {
            (near, far) = (0.5 * near, near);
        }
        Some(halve(near, far, exceeds))
    }

    /// How far two agents can part.
    fn farthest(&self) -> Option<f64> {
        let (least, at) = self.least()?;
        let others = self.inertia.len() as f64 - 2.0;
        let energy = self.energy_to_spend() - (self.pairs() - 1.0 - others) * least;
        let value = |r: f64| self.potential().value(r);
        let exceeds = |r: f64| value(r) + others * value(0.5 * r) > energy;
        // From here on both potentials rise.
        let mut near = 2.0 * at;
        let mut far = 2.0 * near;
        while !exceeds(far) && far.is_finite() {
            (near, far) = (far, 2.0 * far);
        }
        far.is_finite().then(|| halve(far, near, exceeds))
    }
}

/// The place between two at which something begins to be true, on the side where it is.
fn halve(mut yes: f64, mut no: f64, is_true: impl Fn(f64) -> bool) -> f64 {
    // Twice as often as a number has digits.
    for _ in 0..100 {
        let middle = 0.5 * (yes + no);
        match is_true(middle) {
            true => yes = middle,
            false => no = middle,
        }
    }
    yes
}
