//! Agreement on headings keeps their mean: (12) and (13) by Proposition 1.

use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::{Vector, axis, turn_between};
use crate::metric::Observation;
use crate::world::spec::LawSpec;

const HEADING: About = About {
    name: "olfati-saber-2003/mean-heading",
    source: "Olfati-Saber (2003), (12) and (13), by Proposition 1",
    reading: Reading::Sharpened,
    statement: "The agreement protocol (13) on a balanced net turns headings by rates that sum to \
                zero, so the sum of all headings, as angles on the circle, never changes.",
    hypotheses: "Heading consensus between all agents in the plane and no other forces, all agents \
                 seeing their neighbours as they are, none at rest.",
    measured: "|Σ ω_i| over Σ |ω_i| at each time; and how far the sum of headings, taken on the \
               circle, is from that at the start.",
    tolerance: "1e-9 for rates, for rounding. For the sum, N times the angle by which a velocity may \
                be off: of points 100 times the integrator's accuracy, of bodies step² times the jerk \
                over the least speed; the most of all times so far, since a heading stays off.",
};

/// The mean heading is kept.
pub(super) struct MeanHeading;

impl<const D: usize> Claim<D> for MeanHeading {
    fn about(&self) -> &'static About {
        &HEADING
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let world = run.world;
        let is_ours = |law: &LawSpec| matches!(law, LawSpec::HeadingConsensus(_));
        let index = world.laws().position(|(_, law)| is_ours(law))?;
        let mut judging = Judging::new(run);
        judging.suppose("headings are angles: the world is flat", D == 2);
        let mut laws = world.laws();
        let alone = laws.all(|(scope, law)| scope.is_none() && is_ours(law));
        let alone = alone && world.spec.laws.len() == 1 && world.gravity.norm() == 0.0;
        judging.suppose("no other forces act", alone);
        let speeds = run.observations.iter().flat_map(|seen| &seen.velocities);
        let slowest = speeds.map(|v| v.norm()).fold(f64::INFINITY, f64::min);
        judging.suppose("no agent is at rest", slowest > 0.0);
        if !judging.is_supposed() || run.observations.len() < 2 {
            return Some(judging.finding());
        }
        let turns = |seen: &Observation<D>| -> Vec<f64> {
            let each = seen.velocities.iter().zip(&seen.by_law[index]);
            each.map(|(v, a)| (v[0] * a[1] - v[1] * a[0]) / v.norm_squared())
                .collect()
        };
        let moves = run
            .observations
            .iter()
            .any(|seen| turns(seen).iter().any(|w| *w != 0.0));
        judging.suppose("some agents turn", moves);
        let sums = run.series(|seen| {
            let rates = turns(seen);
            let size: f64 = rates.iter().map(|rate| rate.abs()).sum();
            rates.iter().sum::<f64>().abs() / size.max(1e-300)
        });
        judging.bound(Bound {
            name: "|Σ ω_i|/Σ |ω_i|",
            times: run.times(),
            bounds: vec![0.0; sums.len()],
            slack: vec![1e-9; sums.len()],
            values: sums,
            side: Side::Below,
            scale: 1.0,
        });
        let agents = world.agents.len() as f64;
        let drift = run.series(|seen| {
            let mut sum = axis::<2>(0);
            for (v, start) in seen.velocities.iter().zip(&run.start().velocities) {
                // The product of unit numbers of the complex plane adds their angles.
                sum = turned(sum, [v[0], v[1]], 1.0);
                sum = turned(sum, [start[0], start[1]], -1.0);
            }
            turn_between(&axis(0), &sum).norm()
        });
        // What a heading was off once it stays off by.
        let mut most = 0.0;
        let slack = run.series(|seen| {
            let fastest = seen.velocities.iter().map(|v| v.norm()).fold(0.0, f64::max);
            most = f64::max(most, agents * run.velocity_slack(seen, fastest) / slowest);
            most
        });
        judging.bound(Bound {
            name: "|Σ θ_i(t) − Σ θ_i(0)|",
            times: run.times(),
            bounds: vec![0.0; drift.len()],
            slack,
            values: drift,
            side: Side::Below,
            scale: 1.0,
        });
        Some(judging.finding())
    }
}

/// A direction turned by the heading of a velocity, or back by it.
fn turned(by: Vector<2>, [x, y]: [f64; 2], sign: f64) -> Vector<2> {
    let length = x.hypot(y);
    let (cos, sin) = (x / length, sign * y / length);
    Vector::<2>::new(by[0] * cos - by[1] * sin, by[0] * sin + by[1] * cos)
}
