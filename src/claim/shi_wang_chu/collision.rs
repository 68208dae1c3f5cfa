//! Agents never meet, Theorems 1 and 3; and how near they come at most.

use super::damping::Damping;
use super::model::Model;
use crate::claim::{About, Bound, Claim, Exclusion, Finding, Judging, Reading, Run, Side};

const HYPOTHESES: &str = "Control (6) or (15) with balanced weights, no other forces but damping; \
                          no two agents start at the same place.";

const PRINTED: About = About {
    name: "shi-wang-chu/no-collision-printed",
    source: "Shi, Wang & Chu, Theorems 1 and 3",
    reading: Reading::Printed,
    statement: "Agents never collide: no two are ever at the same place.",
    hypotheses: HYPOTHESES,
    measured: "The smallest distance of two agents, at all times.",
    tolerance: "None.",
};

const SHARPENED: About = About {
    name: "shi-wang-chu/no-collision-sharpened",
    source: "Shi, Wang & Chu, proof of Theorem 1: J never rises",
    reading: Reading::Sharpened,
    statement: "No two agents ever come nearer than the r with V(r) = J(0) less the least \
                potentials of all other pairs; J is seen from the velocity that is kept where \
                nothing is damped. Bodies whose radius is less than r/2 never touch.",
    hypotheses: HYPOTHESES,
    measured: "The smallest distance of two agents, at all times, against r.",
    tolerance: "Of points 100 times the integrator's accuracy, of bodies step² times accelerations.",
};

/// See the file.
pub(super) struct Collision {
    pub sharpened: bool,
}

impl<const D: usize> Claim<D> for Collision {
    fn about(&self) -> &'static About {
        match self.sharpened {
            true => &SHARPENED,
            false => &PRINTED,
        }
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        suppose(&model, &mut judging);
        let (Some(closest), Some(nearest)) = (run.closest, model.nearest()) else {
            return Some(judging.finding());
        };
        // The printed one promises no more than the least distance above 0.
        let bound = if self.sharpened {
            nearest
        } else {
            f64::MIN_POSITIVE
        };
        let seen = run.last();
        judging.measure("r", nearest);
        judging.bound(Bound {
            name: "min_ij |x_i − x_j|",
            times: vec![closest.time],
            values: vec![closest.distance],
            bounds: vec![bound],
            slack: vec![match self.sharpened {
                true => run.position_slack(seen, nearest),
                false => 0.0,
            }],
            side: Side::Above,
            scale: closest.distance,
        });
        Some(judging.finding())
    }

    fn exclusion(&self, run: &Run<'_, D>) -> Option<Exclusion> {
        let model = Model::of(run).filter(|_| self.sharpened)?;
        let mut judging = Judging::new(run);
        suppose(&model, &mut judging);
        let supposed = judging.is_supposed();
        supposed
            .then(|| model.nearest())
            .flatten()
            .map(|distance| Exclusion {
                distance,
                formula: "V(r) = J(0) − (N(N − 1)/2 − 1) min V",
            })
    }
}

fn suppose<const D: usize>(model: &Model<'_, D>, judging: &mut Judging) {
    model.suppose(judging, Damping::Any);
    model.suppose_balance(judging);
    let energy = model.energy(model.run.start(), &[]);
    judging.suppose("no two agents start at the same place", energy.is_finite());
}
