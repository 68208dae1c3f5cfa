//! How near the leading order (4.19) is: section 4.1.

use super::fast::{Member, agreed, companions, family, is_fast, suppose};
use crate::claim::{About, Claim, Finding, Judging, MovedBy, Reading, Run};
use crate::reduced::FastFlocking;
use crate::world::World;

const HYPOTHESES: &str = "The family (4.1) with ε < 1: alignment by positions alone, with gains and \
                          influences of Assumptions 1 and 2, and steering by each agent's own state \
                          and the time; velocities that agree to a hundredth by half time.";
const MEASURED: &str = "The largest |x_i − x_i0| and |v_i − v_i0| of the last half of the run, and of \
                        the same world with ε/√10 and ε/10; between each two the slope of the \
                        logarithm of the error over that of ε.";
const TOLERANCE: &str = "0.05 for slopes: errors are ε times something and ε² times something, the \
                         first of which tells.";

const PRINTED: About = About {
    name: "djokam-rathinam/leading-order-printed",
    source: "Djokam & Rathinam, section 4, (4.19) from v^f(0) as in (4.25)",
    reading: Reading::Misprinted,
    statement: "The leading order from v^f(0) = Σ π_i v_i(0) is off by O(ε), in positions and, after \
                the layer, in velocities.",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

const CORRECTED: About = About {
    name: "djokam-rathinam/leading-order-corrected",
    source: "Djokam & Rathinam, section 4, (4.19) from the limit of the layer (4.23)",
    reading: Reading::Corrected,
    statement: "The leading order from the limit of the layer is off by O(ε), in positions and, \
                after the layer, in velocities.",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

/// See the file.
pub(super) enum LeadingOrder {
    Printed,
    Corrected,
}

/// Errors of a run of the family against its leading order, by time.
struct Errors {
    positions: Vec<f64>,
    velocities: Vec<f64>,
}

impl LeadingOrder {
    fn errors<const D: usize>(&self, member: &Member<'_, D>) -> Option<Errors> {
        let mut reduced = FastFlocking::new(member.world).ok()?;
        if matches!(self, Self::Printed) {
            reduced.start = reduced.printed;
        }
        let times: Vec<f64> = member.seen.iter().map(|seen| seen.time).collect();
        let course = reduced.leading_order(&times).ok()?;
        let (mut positions, mut velocities) = (Vec::new(), Vec::new());
        for (leading, seen) in course.iter().zip(member.seen) {
            let [position, velocity] = leading.errors(&seen.positions, &seen.velocities);
            positions.push(position);
            velocities.push(velocity);
        }
        Some(Errors {
            positions,
            velocities,
        })
    }
}

impl<const D: usize> Claim<D> for LeadingOrder {
    fn about(&self) -> &'static About {
        match self {
            Self::Printed => &PRINTED,
            Self::Corrected => &CORRECTED,
        }
    }

    fn companions(&self, world: &World<D>) -> Vec<World<D>> {
        companions(world)
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        if !is_fast(run.world) {
            return None;
        }
        let mut judging = Judging::new(run);
        suppose(&mut judging, run);
        let late = run
            .observations
            .partition_point(|seen| seen.time < 0.5 * run.last().time);
        let soon = agreed(&run.observations).is_some_and(|k| k < late);
        judging.suppose("velocities agree to a hundredth by half time", soon);
        let name = Claim::<D>::about(self).name;
        let family = family(run, name);
        if let (MovedBy::Bodies { step }, Some(family)) = (run.moved_by, &family) {
            let least = family.iter().map(|it| it.epsilon);
            let least = least.fold(f64::INFINITY, f64::min);
            // Bodies come to agree in the first step, and are off by its size from then on.
            let fine = step <= 0.1 * least * (1.0 + 1e-9);
            judging.suppose("the step of bodies is at most a tenth of the least ε", fine);
        }
        let Some(family) = family.filter(|_| judging.is_supposed()) else {
            return Some(judging.finding());
        };
        let errors: Option<Vec<Errors>> = family.iter().map(|it| self.errors(it)).collect();
        let Some(errors) = errors else {
            judging.suppose("the leading order can be computed", false);
            return Some(judging.finding());
        };
        let times = run.times();
        judging.plot("max|x_i − x_i0|", &times, &errors[0].positions);
        judging.plot("max|v_i − v_i0|", &times, &errors[0].velocities);
        for (what, of) in [
            ("max|x_i − x_i0|", positions as fn(&Errors) -> &[f64]),
            ("max|v_i − v_i0|", velocities),
        ] {
            let largest = |errors: &Errors| of(errors)[late..].iter().copied().fold(0.0, f64::max);
            let largest: Vec<f64> = errors.iter().map(largest).collect();
            for (member, error) in family.iter().zip(&largest) {
                judging.measure(format!("{what} at ε = {}", member.epsilon), *error);
            }
            for k in 1..family.len() {
                let [coarse, fine] = [k - 1, k].map(|k| (family[k].epsilon, largest[k]));
                let slope = (coarse.1 / fine.1).ln() / (coarse.0 / fine.0).ln();
                let name = format!("slope of {what} from ε = {} to {}", coarse.0, fine.0);
                judging.equal(&name, slope, 1.0, 0.05, 1.0);
            }
        }
        Some(judging.finding())
    }
}

fn positions(errors: &Errors) -> &[f64] {
    &errors.positions
}

fn velocities(errors: &Errors) -> &[f64] {
    &errors.velocities
}
