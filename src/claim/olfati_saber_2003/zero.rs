//! What Propositions 2 and 3 share: energies that have become zero, nets that stay as they are.

use super::model::{Model, Others};
use crate::claim::{Bound, Judging, Side};
use crate::metric::{Observation, relative_kinetic_energy};
use crate::net::{LinkChanges, Net};

/// An energy is zero below this share of h0: no run reaches zero itself.
pub(super) const ZERO: f64 = 1e-6;

impl<'r, const D: usize> Model<'r, D> {
    /// The lesser and the greater potential of a link whose length is off by `error`.
    pub fn potentials_at(&self, error: f64) -> [f64; 2] {
        let action = &self.pair.action;
        let [a, b] = [action.potential(error), action.potential(-error)];
        [a.min(b), a.max(b)]
    }

    /// The observations from the first on from which all values are small, supposed to be two or
    /// more.
    pub fn tail(
        &self,
        judging: &mut Judging,
        name: &str,
        values: &[f64],
        small: f64,
    ) -> Option<&'r [Observation<D>]> {
        self.suppose(judging, Others::Any);
        let large = values
            .iter()
            .rposition(|value| *value > small || value.is_nan());
        let first = large.map_or(0, |last| last + 1);
        let tail = &self.run.observations[first..];
        let late = values.iter().rev().take(2).copied();
        judging.suppose_less(
            format!("{name} stays zero from some time on"),
            late.fold(0.0, f64::max),
            small,
        );
        judging.suppose("it is seen more than once", tail.len() > 1);
        judging.is_supposed().then_some(tail)
    }

    /// The conclusions that distances and links stay what they are at the beginning of a tail.
    pub fn is_rigid(&self, judging: &mut Judging, tail: &[Observation<D>]) {
        let start = &tail[0];
        let net = self.net(start);
        let (mut changes, mut switched, mut bounds, mut slack) = (vec![], vec![], vec![], vec![]);
        let mut path = 0.0;
        for (k, seen) in tail.iter().enumerate() {
            if let Some(before) = k.checked_sub(1).map(|k| &tail[k]) {
                let energy = |seen: &Observation<D>| relative_kinetic_energy(&seen.velocities);
                let fastest = 2.0 * energy(before).max(energy(seen)).sqrt();
                path += 2.0 * fastest * (seen.time - before.time);
            }
            changes.push(largest_change(start, seen));
            switched.push(self.largest_switch(&net, seen));
            bounds.push(path);
            slack.push(self.run.position_slack(seen, self.spec.range));
        }
        for (name, values) in [
            ("change of a distance", changes),
            ("|q_j − q_i| − r where links changed", switched),
        ] {
            judging.bound(Bound {
                name,
                times: tail.iter().map(|seen| seen.time).collect(),
                values,
                bounds: bounds.clone(),
                slack: slack.clone(),
                side: Side::Below,
                scale: self.spec.range,
            });
        }
    }

    /// How far from the range a pair is that is linked in one net and not in the other.
    fn largest_switch(&self, net: &Net, seen: &Observation<D>) -> f64 {
        let changes = LinkChanges::between(net, &self.net(seen));
        let pairs = changes.created.iter().chain(&changes.lost);
        let off = pairs.map(|&[i, j]| {
            let distance = (seen.positions[j] - seen.positions[i]).norm();
            (distance - self.spec.range).abs()
        });
        off.fold(0.0, f64::max)
    }
}

/// The largest difference between the distances of the same two agents in two states.
pub(super) fn largest_change<const D: usize>(a: &Observation<D>, b: &Observation<D>) -> f64 {
    let mut largest = 0.0;
    for i in 0..a.positions.len() {
        for j in 0..i {
            let distance = |seen: &Observation<D>| (seen.positions[i] - seen.positions[j]).norm();
            largest = f64::max(largest, (distance(a) - distance(b)).abs());
        }
    }
    largest
}
