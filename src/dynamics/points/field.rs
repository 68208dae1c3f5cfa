//! The equations of motion: from a state to its rate of change.

use super::agents::Agents;
use super::sliding;
use super::watched::{Side, Watched};
use crate::dynamics::turn;
use crate::law::{Flock, State};
use crate::math::{System, Vector};
use crate::sense::Hold;
use crate::stop::Stop;

/// The rate of change of a state under a flock. States are flat: the coordinates of all
/// positions, agent by agent, then those of all velocities.
pub(super) struct Field<'a, const D: usize> {
    agents: &'a mut Agents<D>,
    flock: &'a mut Flock<D>,
    stop: Stop,
    /// The accuracy that pairs which come and go are judged by.
    accuracy: f64,
    /// Whether the jump to be crossed may be disregarded from now on.
    faint: bool,
    /// Scratch.
    positions: Vec<Vector<D>>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    accelerations: Vec<Vector<D>>,
    earlier: [Vec<Vector<D>>; 3],
    holds: Vec<Hold>,
}

/// Pairs that slide, and the accelerations with none of them within and with each alone.
type Sides<const D: usize> = (Vec<Watched>, Vec<Vector<D>>, Vec<Vec<Vector<D>>>);

impl<'a, const D: usize> Field<'a, D> {
    pub(super) fn new(
        agents: &'a mut Agents<D>,
        flock: &'a mut Flock<D>,
        stop: &Stop,
        accuracy: f64,
    ) -> Self {
        let zeros = || vec![Vector::zeros(); agents.groups.len()];
        Self {
            positions: zeros(),
            velocities: zeros(),
            headings: zeros(),
            accelerations: zeros(),
            earlier: [zeros(), zeros(), zeros()],
            holds: Vec::new(),
            stop: stop.clone(),
            accuracy,
            faint: false,
            agents,
            flock,
        }
    }

    fn read(&mut self, state: &[f64]) {
        let half = state.len() / 2;
        read(&state[..half], &mut self.positions);
        read(&state[half..], &mut self.velocities);
    }

    /// What the laws want of the agents in the state that was read, with some pairs held besides;
    /// pairs that are beyond a jump are held before it where `before` says so.
    fn wanted(&mut self, time: f64, before: bool, more: &[Hold]) {
        self.holds.clear();
        if before {
            self.agents.links.hold(&self.positions, &mut self.holds);
        }
        self.holds.extend_from_slice(more);
        self.headings.copy_from_slice(&self.agents.headings);
        turn(&mut self.headings, &self.velocities);
        for obstacle in &mut self.agents.obstacles {
            obstacle.move_to(time);
        }
        let now = State {
            time,
            positions: &self.positions,
            velocities: &self.velocities,
            headings: &self.headings,
            groups: &self.agents.groups,
            masses: &self.agents.masses,
            rotations: &[],
            obstacles: &self.agents.obstacles,
        };
        self.flock
            .accelerations_held(&now, &self.holds, &mut self.accelerations);
        for (i, wanted) in self.accelerations.iter_mut().enumerate() {
            // What is not cut is what the laws want to the last bit.
            if self.agents.force_limits[i].is_finite() {
                *wanted = self.agents.force(i, wanted) / self.agents.masses[i];
            }
        }
    }

    /// The accelerations by the laws in the state that was read, and the weights of the pairs that
    /// slide.
    fn accelerate(&mut self, time: f64, before: bool) -> Vec<f64> {
        let sliding = self.agents.links.sliding();
        if sliding.is_empty() {
            self.wanted(time, before, &[]);
            return Vec::new();
        }
        let (pairs, beyond, within) = self.sides(time, before, &sliding);
        let state = [&self.positions[..], &self.velocities];
        let weights = sliding::weights(&pairs, state, &beyond, &within);
        sliding::mixed(&beyond, &within, &weights, &mut self.accelerations);
        weights
    }

    /// Pairs that slide, and the accelerations with none of them within and with each alone.
    fn sides(&mut self, time: f64, before: bool, sliding: &[usize]) -> Sides<D> {
        let pairs = self.at(sliding);
        let mut holds: Vec<Hold> = pairs.iter().map(|one| one.held(0.0)).collect();
        self.wanted(time, before, &holds);
        let beyond = self.accelerations.clone();
        let mut within = Vec::with_capacity(pairs.len());
        for k in 0..pairs.len() {
            holds[k].share = 1.0;
            self.wanted(time, before, &holds);
            within.push(self.accelerations.clone());
            holds[k].share = 0.0;
        }
        (pairs, beyond, within)
    }

    fn at(&self, places: &[usize]) -> Vec<Watched> {
        let watched = self.agents.links.watched();
        places.iter().map(|place| watched[*place]).collect()
    }

    /// The accelerations by the laws in a state.
    pub(super) fn accelerations(mut self, time: f64, state: &[f64]) -> Vec<Vector<D>> {
        self.read(state);
        self.accelerate(time, true);
        self.accelerations
    }

    fn slope_as(&mut self, time: f64, state: &[f64], out: &mut [f64], before: bool) {
        let half = state.len() / 2;
        let (rates, gains) = out.split_at_mut(half);
        rates.copy_from_slice(&state[half..]);
        if self.stop.asked() || !state.iter().all(|value| value.is_finite()) {
            gains.fill(f64::NAN);
            return;
        }
        self.read(state);
        if !self.agents.links.follow(&self.positions) {
            gains.fill(f64::NAN);
            return;
        }
        self.accelerate(time, before);
        for (gain, wanted) in gains.chunks_exact_mut(D).zip(&self.accelerations) {
            gain.copy_from_slice((wanted + self.agents.gravity).as_slice());
        }
    }

    /// Whether a pair that has just crossed a distance slides from now on: where the laws drive
    /// it back from both sides, and it gets no farther than an error may, or has come and gone
    /// too often.
    fn slides(&mut self, time: f64, place: usize) -> bool {
        let pair = self.agents.links.watched()[place];
        if pair.crossings < 3 {
            return false;
        }
        self.agents.links.put(place, Side::Sliding);
        let sliding = self.agents.links.sliding();
        let (pairs, beyond, within) = self.sides(time, true, &sliding);
        self.agents.links.put(place, pair.side);
        let Some(k) = sliding.iter().position(|other| *other == place) else {
            return false;
        };
        let state = [&self.positions[..], &self.velocities];
        let weight = sliding::weights(&pairs, state, &beyond, &within)[k];
        let [x, v] = state;
        let bend = |a: &[Vector<D>]| pair.course([x, v, a])[2];
        let effect = bend(&within[k]) - bend(&beyond);
        if !(effect > 0.0 && weight > 0.0 && weight < 1.0) {
            return false;
        }
        // How far it gets, as a share of twice the distance.
        let rate = pair.course([x, v, v])[1];
        let far = rate * rate / (4.0 * effect * weight.min(1.0 - weight));
        let allowed = self.accuracy * self.agents.largest[0];
        0.5 * far * pair.distance <= allowed || pair.crosses_too_often()
    }

    /// Lets go those pairs that slide no more.
    fn release(&mut self, time: f64) {
        loop {
            let sliding = self.agents.links.sliding();
            let weights = self.accelerate(time, true);
            let mut all_stay = true;
            for (place, weight) in sliding.into_iter().zip(weights) {
                let side = match weight {
                    _ if weight > 1.0 => Side::Within,
                    _ if weight < 0.0 => Side::Beyond,
                    _ => continue,
                };
                self.agents.links.put(place, side);
                all_stay = false;
            }
            if all_stay {
                return;
            }
        }
    }
}

impl<const D: usize> System for Field<'_, D> {
    fn slope(&mut self, time: f64, state: &[f64], out: &mut [f64]) {
        self.slope_as(time, state, out, true);
    }

    fn peek(&mut self, time: f64, state: &[f64], out: &mut [f64]) {
        self.slope_as(time, state, out, false);
    }

    fn scale(&self, k: usize, before: f64, after: f64) -> f64 {
        let [far, fast] = self.agents.largest;
        let largest = match k < D * self.positions.len() {
            true => far,
            false => fast.max(far * self.agents.slowest),
        };
        largest.max(before.abs()).max(after.abs())
    }

    fn margin(&mut self, time: f64, state: &[f64]) -> f64 {
        if self.agents.links.is_empty() {
            return f64::INFINITY;
        }
        self.read(state);
        if !self.agents.links.follow(&self.positions) {
            return f64::NAN;
        }
        let margin = self.agents.links.margin(&self.positions);
        if margin < 0.0 || self.agents.links.sliding().is_empty() {
            return margin;
        }
        let weights = self.accelerate(time, true);
        let free = weights.iter().map(|weight| weight.min(1.0 - weight));
        free.fold(margin, f64::min)
    }

    fn foresee(&mut self, state: &[f64], slope: &[f64]) -> f64 {
        if self.agents.links.is_empty() {
            return f64::INFINITY;
        }
        self.read(state);
        read(&slope[state.len() / 2..], &mut self.accelerations);
        let state = [&self.positions[..], &self.velocities, &self.accelerations];
        self.agents.links.foresee(state)
    }

    fn hindsight(&mut self, state: &[f64], slope: &[f64]) -> Option<f64> {
        self.read(state);
        read(&slope[state.len() / 2..], &mut self.accelerations);
        let state = [&self.positions[..], &self.velocities, &self.accelerations];
        self.agents.links.hindsight(state)
    }

    fn dip(&mut self, step: f64, begin: [&[f64]; 2], end: [&[f64]; 2]) -> Option<f64> {
        if self.agents.links.is_empty() {
            return None;
        }
        let half = begin[0].len() / 2;
        let parts = [&begin[0][..half], &begin[0][half..], &begin[1][half..]];
        for (earlier, part) in self.earlier.iter_mut().zip(parts) {
            read(part, earlier);
        }
        self.read(end[0]);
        read(&end[1][half..], &mut self.accelerations);
        let [x, v, a] = &self.earlier;
        let later = [&self.positions[..], &self.velocities, &self.accelerations];
        self.agents.links.dip(step, [x, v, a], later)
    }

    fn cross(&mut self, time: f64, free: f64, state: &mut [f64]) -> usize {
        self.read(state);
        let faint = std::mem::take(&mut self.faint);
        let crossed = self
            .agents
            .links
            .cross([time, free], &self.positions, faint);
        let (count, mut caught) = (crossed.len(), false);
        for place in crossed {
            if self.slides(time, place) {
                self.agents.links.put(place, Side::Sliding);
                caught = true;
            }
        }
        let sliding = self.agents.links.sliding();
        if sliding.is_empty() {
            return count;
        }
        if caught {
            let pairs = self.at(&sliding);
            let masses = &self.agents.masses;
            sliding::put_right(&pairs, masses, &mut self.positions, &mut self.velocities);
            let vectors = self.positions.iter().chain(&self.velocities);
            for (place, vector) in state.chunks_exact_mut(D).zip(vectors) {
                place.copy_from_slice(vector.as_slice());
            }
        }
        self.release(time);
        count
    }

    fn arrive(&mut self, time: f64, state: &[f64]) -> bool {
        if self.agents.links.is_empty() {
            return false;
        }
        read(&state[..state.len() / 2], &mut self.positions);
        self.agents.links.arrive(time, &self.positions)
    }

    fn disregard(&mut self) {
        self.faint = true;
    }

    fn settle(&mut self, time: f64, state: &[f64]) {
        if self.agents.links.is_empty() {
            return;
        }
        self.read(state);
        let Agents { links, sliding, .. } = &mut *self.agents;
        links.settle(&self.positions, sliding);
        if !self.agents.sliding.is_empty() {
            self.release(time);
        }
    }

    fn stopped(&self) -> bool {
        self.stop.asked()
    }
}

/// Reads vectors, one after the other, from their coordinates.
pub(super) fn read<const D: usize>(coordinates: &[f64], vectors: &mut [Vector<D>]) {
    for (vector, coordinates) in vectors.iter_mut().zip(coordinates.chunks_exact(D)) {
        vector.copy_from_slice(coordinates);
    }
}
