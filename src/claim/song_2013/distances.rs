//! How near agents come to each other in a run.

use crate::claim::{Bound, Judging, Run, Side, closer};
use crate::math::Vector;

/// The smallest distance between two positions; infinite where there are fewer than two.
pub(super) fn smallest_distance<const D: usize>(positions: &[Vector<D>]) -> f64 {
    closer(None, 0.0, positions).map_or(f64::INFINITY, |closest| closest.distance)
}

/// The conclusion that no two agents come nearer than a distance, or not to it where `strict`:
/// at the observations, and when they came closest of all before bodies touched.
pub(super) fn apart<const D: usize>(
    judging: &mut Judging,
    run: &Run<'_, D>,
    distance: f64,
    strict: bool,
) {
    let seen = run.observations.iter();
    let mut nearest: Vec<(f64, f64, f64)> = seen
        .map(|seen| {
            let smallest = smallest_distance(&seen.positions);
            (seen.time, smallest, run.position_slack(seen, distance))
        })
        .collect();
    let touched = run.first_contact.unwrap_or(f64::INFINITY);
    if let Some(closest) = run.closest.filter(|it| it.time < touched) {
        let after = nearest.partition_point(|(time, ..)| *time <= closest.time);
        let slack = nearest[after.max(1) - 1].2;
        nearest.insert(after, (closest.time, closest.distance, slack));
    }
    // The least number above the bound must be reached where the bound itself must not.
    let least = match strict {
        true => distance.next_up().max(f64::MIN_POSITIVE),
        false => distance,
    };
    judging.bound(Bound {
        name: "min_{i≠j} |x_i − x_j|",
        times: nearest.iter().map(|it| it.0).collect(),
        values: nearest.iter().map(|it| it.1).collect(),
        bounds: vec![least; nearest.len()],
        slack: nearest
            .iter()
            .map(|it| if strict { 0.0 } else { it.2 })
            .collect(),
        side: Side::Above,
        scale: match distance > 0.0 {
            true => distance,
            false => smallest_distance(&run.start().positions),
        },
    });
}
