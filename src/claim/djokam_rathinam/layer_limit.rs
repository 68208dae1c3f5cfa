//! The velocity that a flock comes to in the layer: (4.25).

use super::fast::{Member, agreed, companions, family, is_fast, suppose};
use super::spread::velocity_spread;
use crate::claim::{About, Claim, Finding, Judging, Reading, Run};
use crate::math::{Matrix, Vector, axis};
use crate::reduced::FastFlocking;
use crate::world::World;

/// What v^f(0) may be off, as a share of d_V(0).
const SHARE: f64 = 0.01;

const HYPOTHESES: &str = "The family (4.1) with ε < 1: alignment by positions alone, with gains and \
                          influences of Assumptions 1 and 2, and steering by each agent's own state \
                          and the time; velocities that agree to a hundredth by half time.";
const MEASURED: &str = "At twice the time at which velocities agree to a hundredth, Σ π_i v_i of the \
                        run and of the same world with ε/√10 and ε/10; the v^f(0) from which (4.19) \
                        goes through it, for each; and the parabola through these at ε = 0.";
const TOLERANCE: &str = "0.01 d_V(0); the parabola must be within half of that of the straight line \
                         through the two least ε.";

const PRINTED: About = About {
    name: "djokam-rathinam/layer-limit-printed",
    source: "Djokam & Rathinam, (4.25)",
    reading: Reading::Misprinted,
    statement: "The flock's velocity after the layer is v^f(0) = Σ π_i v_i(0).",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

const CORRECTED: About = About {
    name: "djokam-rathinam/layer-limit-corrected",
    source: "Djokam & Rathinam, (4.23), whose gain is ξ(V̄ − V) and not ξ(0)",
    reading: Reading::Corrected,
    statement: "The flock's velocity after the layer is the limit of (4.23) as τ → ∞.",
    hypotheses: HYPOTHESES,
    measured: MEASURED,
    tolerance: TOLERANCE,
};

/// See the file.
pub(super) enum LayerLimit {
    Printed,
    Corrected,
}

impl<const D: usize> Claim<D> for LayerLimit {
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
        let after = agreed(&run.observations).map(|k| (2 * k).max(1));
        let after = after.filter(|k| *k < run.observations.len());
        judging.suppose(
            "velocities agree to a hundredth by half time",
            after.is_some(),
        );
        let name = Claim::<D>::about(self).name;
        let family = family(run, name).filter(|_| judging.is_supposed());
        let (Some(family), Some(after)) = (family, after) else {
            return Some(judging.finding());
        };
        let starts: Option<Vec<_>> = family.iter().map(|it| start(it, after)).collect();
        let (Some(starts), Ok(reduced)) = (starts, FastFlocking::new(run.world)) else {
            judging.suppose("the leading order can be computed", false);
            return Some(judging.finding());
        };
        let found = at_zero(&family, &starts);
        let line = at_zero(&family[1..], &starts[1..]);
        let claimed = match self {
            Self::Printed => reduced.printed,
            Self::Corrected => reduced.start,
        };
        judging.measure("time", run.observations[after].time);
        for k in 0..D {
            let axis = ["x", "y", "z"][k];
            judging.measure(format!("v^f(0) of the run, {axis}"), found[k]);
            judging.measure(format!("v^f(0) claimed, {axis}"), claimed[k]);
        }
        let scale = velocity_spread(run.start()).length;
        judging.suppose_less(
            "the parabola and the line agree",
            (found - line).norm(),
            0.5 * SHARE * scale,
        );
        let off = (claimed - found).norm();
        judging.equal("|v^f(0) claimed − found|", off, 0.0, SHARE * scale, scale);
        Some(judging.finding())
    }
}

/// The v^f(0) from which the leading order goes through Σ π_i v_i of an observation.
fn start<const D: usize>(member: &Member<'_, D>, after: usize) -> Option<Vector<D>> {
    let mut reduced = FastFlocking::new(member.world).ok()?;
    let seen = &member.seen[after];
    let terms = reduced.weights.iter().zip(&seen.velocities);
    let there: Vector<D> = terms.map(|(weight, v)| v * *weight).sum();
    let mut end = |start: Vector<D>| {
        reduced.start = start;
        let course = reduced.leading_order(&[seen.time]).ok()?;
        Some(course[0].velocity)
    };
    // Newton's method; steering is linear as a rule, and then one step is enough.
    let mut guess = there;
    let width = 1e-4 * (1.0 + guess.norm());
    for _ in 0..3 {
        let now = end(guess)?;
        let mut slopes = Matrix::<D>::zeros();
        for k in 0..D {
            let moved = end(guess + axis::<D>(k) * width)?;
            slopes.set_column(k, &((moved - now) / width));
        }
        guess -= slopes.try_inverse()? * (now - there);
    }
    Some(guess)
}

/// The polynomial in ε through some values, at ε = 0.
fn at_zero<const D: usize>(family: &[Member<'_, D>], values: &[Vector<D>]) -> Vector<D> {
    let mut sum = Vector::zeros();
    for (member, value) in family.iter().zip(values) {
        let others = family.iter().map(|it| it.epsilon);
        let others = others.filter(|it| *it != member.epsilon);
        let weight: f64 = others.map(|it| it / (it - member.epsilon)).product();
        sum += value * weight;
    }
    sum
}
