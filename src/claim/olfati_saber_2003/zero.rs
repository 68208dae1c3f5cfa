//! What zero structural energy means: Propositions 2 and 3.

use super::model::{Model, Others};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::metric::{Observation, diameter, relative_kinetic_energy};
use crate::net::{Net, defect, realisation_error};

/// An energy is zero below this share of h0: no run reaches zero itself.
const ZERO: f64 = 1e-6;

const POTENTIAL: About = About {
    name: "olfati-saber-2003/zero-potential",
    source: "Olfati-Saber (2003), Proposition 2 i, and below (47)",
    reading: Reading::Printed,
    statement: "V(q) = 0 if and only if the net is a realisation of the structural net (d_α, r), \
                whose defect factor (46) is 0 as well.",
    hypotheses: "An (α, α) interaction; the run comes to V ≤ 1e-6 h0.",
    measured: "In every observation, with e the largest | |q_j − q_i| − d_α | over the links: V is \
               at least the lesser of ψ(e) and ψ(−e), and at most |E| times the greater; so V and e \
               vanish together. The defect, with w = 1, is bounded alike.",
    tolerance: "1e-12 of h0, for rounding.",
};

/// Proposition 2 i.
pub(super) struct ZeroPotential;

impl<const D: usize> Claim<D> for ZeroPotential {
    fn about(&self) -> &'static About {
        &POTENTIAL
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run).despite_contacts();
        let (pair, h0) = (model.sharp(), model.link_energy());
        let values = run.series(|seen| model.potential(seen, &pair));
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        judging.suppose("there are links", {
            let mut nets = run.observations.iter().map(|seen| model.net(seen));
            nets.any(|net| !net.edges().is_empty())
        });
        judging.suppose_less("the run comes to V ≤ 1e-6 h0", least, ZERO * h0);
        let (mut below, mut above, mut defects, mut steepest) = (vec![], vec![], vec![], vec![]);
        for seen in &run.observations {
            let net = model.net(seen);
            let error = realisation_error(&seen.positions, &net, pair.spacing);
            let [least, most] = model.potentials_at(error);
            let links = net.edges().len() as f64;
            below.push(if links > 0.0 { least } else { 0.0 });
            above.push(links * most);
            // |∇V|² is the sum over agents of squares of at most degree × the largest force.
            let force = pair.action.force(error).max(-pair.action.force(-error));
            let squares = net
                .degrees()
                .into_iter()
                .map(|it| (it as f64 * force).powi(2));
            steepest.push(links * most + squares.sum::<f64>());
            defects.push(defect(&seen.positions, &net, &pair, 1.0));
        }
        for (name, values, bounds, side) in [
            ("V", values.clone(), below, Side::Above),
            ("V(q)", values, above, Side::Below),
            ("μ", defects, steepest, Side::Below),
        ] {
            judging.bound(Bound {
                name,
                times: run.times(),
                slack: vec![1e-12 * h0; values.len()],
                values,
                bounds,
                side,
                scale: h0,
            });
        }
        Some(judging.finding())
    }
}

const MOTION: About = About {
    name: "olfati-saber-2003/zero-relative-motion",
    source: "Olfati-Saber (2003), Proposition 2 ii and iii",
    reading: Reading::Printed,
    statement: "Where K_r = 0 for all t ≥ t0, the distance between any two agents stays constant, and \
                so does the topology of the net.",
    hypotheses: "An (α, α) interaction; from some observation on, K_r ≤ 1e-6 h0 in all, two or more.",
    measured: "From then on, how much any distance has changed, and how far from the range any pair \
               is whose link came or went, against twice ∫2√K_r dt: no distance changes faster than \
               2√K_r.",
    tolerance: "Of points 100 times the integrator's accuracy, of bodies step² times accelerations.",
};

/// Proposition 2 ii, first half, and iii.
pub(super) struct ZeroMotion;

impl<const D: usize> Claim<D> for ZeroMotion {
    fn about(&self) -> &'static About {
        &MOTION
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        let energies = run.series(|seen| relative_kinetic_energy(&seen.velocities));
        let least = ZERO * model.link_energy();
        if let Some(tail) = model.tail(&mut judging, "K_r", &energies, least) {
            model.is_rigid(&mut judging, tail);
        }
        Some(judging.finding())
    }
}

const CONVERSE: About = About {
    name: "olfati-saber-2003/constant-distances",
    source: "Olfati-Saber (2003), Proposition 2 ii, second half",
    reading: Reading::Printed,
    statement: "Where all distances stay constant, K_r = 0: if the net is a flock, no two agents are \
                at one place, and no two with different velocities have p_j − p_i orthogonal to \
                q_j − q_i.",
    hypotheses: "An (α, α) interaction; from some observation on, all distances are within 1e-6 r of \
                 those at the end, and the three conditions are met, the last with |cos| ≥ 0.01.",
    measured: "K_r from then on, against N s²/4, where s = 100 · 1e-6 r/Δt is the fastest that two \
               agents can differ by and change their distance by no more in the time Δt between \
               observations.",
    tolerance: "That bound; it is 0 for distances that are constant.",
};

/// Proposition 2 ii, second half.
pub(super) struct ConstantDistances;

impl<const D: usize> Claim<D> for ConstantDistances {
    fn about(&self) -> &'static About {
        &CONVERSE
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        let off = run.series(|seen| largest_change(run.last(), seen));
        let allowed = 1e-6 * model.spec.range;
        let Some(tail) = model.tail(&mut judging, "changes of distances", &off, allowed) else {
            return Some(judging.finding());
        };
        let pauses = tail.windows(2).map(|two| two[1].time - two[0].time);
        let fastest = 100.0 * allowed / pauses.fold(f64::INFINITY, f64::min);
        let flock = |seen| model.net(seen).partition().is_flock();
        judging.suppose("the net is a flock", tail.iter().all(flock));
        let (mut apart, mut oblique) = (true, true);
        for seen in tail {
            for_pairs(seen, |offset, velocity| {
                let (distance, speed) = (offset.norm(), velocity.norm());
                apart &= distance > 0.0;
                let along = offset.dot(&velocity).abs();
                oblique &= speed <= fastest || along >= 0.01 * distance * speed;
            });
        }
        judging.suppose("no two agents are at one place", apart);
        judging.suppose(
            "no two with different velocities move at right angles to the line between them",
            oblique,
        );
        let agents = run.world.agents.len() as f64;
        let bound = 0.25 * agents * fastest * fastest;
        let values = tail
            .iter()
            .map(|seen| relative_kinetic_energy(&seen.velocities));
        judging.bound(Bound {
            name: "K_r",
            times: tail.iter().map(|seen| seen.time).collect(),
            values: values.collect(),
            bounds: vec![bound; tail.len()],
            slack: vec![0.0; tail.len()],
            side: Side::Below,
            scale: bound,
        });
        Some(judging.finding())
    }
}

const ENERGY: About = About {
    name: "olfati-saber-2003/zero-energy",
    source: "Olfati-Saber (2003), Proposition 3",
    reading: Reading::Printed,
    statement: "Where H_s = 0 for all t ≥ t0, the net keeps its topology and is a realisation of \
                (d_α, r), all distances stay constant, and all velocities are equal.",
    hypotheses: "An (α, α) interaction; from some observation on, the nonsmooth H_s ≤ 1e-6 h0 in \
                 all, two or more.",
    measured: "From then on: the potential of the worst link, which is at most H_s; differences of \
               velocities, at most 2√H_s; changes of distances and links, as in \
               zero-relative-motion.",
    tolerance: "1e-12 of h0 for rounding; of points 100 times the integrator's accuracy, of bodies \
                step² times accelerations.",
};

/// Proposition 3.
pub(super) struct ZeroEnergy;

impl<const D: usize> Claim<D> for ZeroEnergy {
    fn about(&self) -> &'static About {
        &ENERGY
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        let (pair, h0) = (model.sharp(), model.link_energy());
        let energies = run.series(|seen| model.energy(seen, &pair));
        let Some(tail) = model.tail(&mut judging, "H_s", &energies, ZERO * h0) else {
            return Some(judging.finding());
        };
        let first = run.observations.len() - tail.len();
        let worst = tail.iter().map(|seen| {
            let error = realisation_error(&seen.positions, &model.net(seen), pair.spacing);
            model.potentials_at(error)[0]
        });
        let spread = tail.iter().map(|seen| diameter(&seen.velocities));
        let equal = energies[first..]
            .iter()
            .map(|energy| 2.0 * energy.max(0.0).sqrt());
        for (name, values, bounds) in [
            (
                "max ψ over the links",
                worst.collect(),
                energies[first..].to_vec(),
            ),
            ("d_V", spread.collect::<Vec<f64>>(), equal.collect()),
        ] {
            judging.bound(Bound {
                name,
                times: tail.iter().map(|seen| seen.time).collect(),
                values,
                bounds,
                slack: vec![1e-12 * h0; tail.len()],
                side: Side::Below,
                scale: h0,
            });
        }
        model.is_rigid(&mut judging, tail);
        Some(judging.finding())
    }
}

impl<'r, const D: usize> Model<'r, D> {
    /// The lesser and the greater potential of a link whose length is off by `error`.
    fn potentials_at(&self, error: f64) -> [f64; 2] {
        let action = &self.pair.action;
        let [a, b] = [action.potential(error), action.potential(-error)];
        [a.min(b), a.max(b)]
    }

    /// The observations from the first on from which all values are small, supposed to be two or
    /// more.
    fn tail(
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
    fn is_rigid(&self, judging: &mut Judging, tail: &[Observation<D>]) {
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
        let changes = crate::net::LinkChanges::between(net, &self.net(seen));
        let pairs = changes.created.iter().chain(&changes.lost);
        let off = pairs.map(|&[i, j]| {
            let distance = (seen.positions[j] - seen.positions[i]).norm();
            (distance - self.spec.range).abs()
        });
        off.fold(0.0, f64::max)
    }
}

/// The largest difference between the distances of the same two agents in two states.
fn largest_change<const D: usize>(a: &Observation<D>, b: &Observation<D>) -> f64 {
    let mut largest = 0.0;
    for i in 0..a.positions.len() {
        for j in 0..i {
            let distance = |seen: &Observation<D>| (seen.positions[i] - seen.positions[j]).norm();
            largest = f64::max(largest, (distance(a) - distance(b)).abs());
        }
    }
    largest
}

/// Calls with q_j − q_i and p_j − p_i of every two agents.
fn for_pairs<const D: usize>(
    seen: &Observation<D>,
    mut visit: impl FnMut(crate::math::Vector<D>, crate::math::Vector<D>),
) {
    for i in 0..seen.positions.len() {
        for j in 0..i {
            visit(
                seen.positions[j] - seen.positions[i],
                seen.velocities[j] - seen.velocities[i],
            );
        }
    }
}
