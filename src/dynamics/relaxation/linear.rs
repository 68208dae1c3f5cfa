//! Relaxation at fixed rates: v̇ = Q v + b.
//!
//! Q has rates q_ij ≥ 0 off its diagonal and row sums of at most 0: the generator of a Markov
//! chain. With λ the largest rate at which anyone leaves, P = I + Q/λ is a matrix of weights,
//! none below 0, and (uniformization; A. Jensen, "Markoff chains as an aid in the study of
//! Markoff processes", 1953)
//!
//! v(t) = v + Σ_k P(X > k) P^k (Q v + b)/λ, with X of the Poisson distribution of mean λt:
//!
//! a mean of T^k(v) for the map T(v) = P v + b/λ. Where b is zero every T(v)_i is a mean of
//! velocities, so v(t) stays in their convex hull for any λt. The terms P^k (Q v + b)/λ
//! soon become the same for all agents where everyone influences everyone; then the rest of
//! the sum is known. Where they do not, the number of terms follows λt, and where that would
//! take longer t is halved until they are few, and the solution doubled back.

use nalgebra::DMatrix;

use super::poisson::Tails;
use crate::law::Pulls;
use crate::math::Vector;

/// Terms that are always summed before the solution is found by doubling.
const FEW_TERMS: usize = 256;

/// What is neglected, as a share of the velocities.
const ROUNDING: f64 = 1e-16;

/// The relaxation of some velocities at fixed rates.
pub(super) struct Linear<'a, const D: usize> {
    pulls: &'a Pulls<D>,
    /// Rate of each row of the pulls.
    rates: &'a [f64],
    /// What accelerates each agent besides.
    drift: &'a [Vector<D>],
    /// λ.
    fastest: f64,
    /// Whether every rate is one of following: Q's rows sum to 0.
    closed: bool,
}

impl<'a, const D: usize> Linear<'a, D> {
    pub(super) fn new(pulls: &'a Pulls<D>, rates: &'a [f64], drift: &'a [Vector<D>]) -> Self {
        let mut leaving = vec![0.0; drift.len()];
        for (row, rate) in pulls.rows().iter().zip(rates) {
            leaving[row.agent] += rate * row.weight;
        }
        Self {
            pulls,
            rates,
            drift,
            fastest: leaving.into_iter().fold(0.0, f64::max),
            closed: pulls.rows().iter().all(|row| row.told_weight == 0.0),
        }
    }

    /// The velocities after some time.
    pub(super) fn after(&self, time: f64, velocities: &[Vector<D>]) -> Vec<Vector<D>> {
        let mean = self.fastest * time;
        // Also where the rates are too small, or not finite, to be told apart from none.
        if !(mean > 0.0 && mean.is_finite()) {
            let moved = velocities.iter().zip(self.drift);
            return moved.map(|(v, drift)| v + drift * time).collect();
        }
        self.summed(mean, velocities, self.worthwhile(mean))
            .unwrap_or_else(|| self.doubled(mean, velocities))
    }

    /// How many terms take no longer than doubling would: each goes once through all links,
    /// for every component, and that is some thirty products of matrices.
    fn worthwhile(&self, mean: f64) -> usize {
        let agents = self.drift.len() as f64;
        let links: usize = self
            .pulls
            .rows()
            .iter()
            .map(|row| self.pulls.count(row))
            .sum();
        let doubling = agents * agents * agents * (25.0 + libm::log2(mean).max(0.0));
        let terms = doubling / (D * (links + self.drift.len())) as f64;
        FEW_TERMS.max(terms as usize)
    }

    /// What the pulls alone accelerate each agent by at these velocities.
    fn pulled(&self, velocities: &[Vector<D>]) -> Vec<Vector<D>> {
        let mut pulled = vec![Vector::zeros(); velocities.len()];
        for (row, rate) in self.pulls.rows().iter().zip(self.rates) {
            pulled[row.agent] += self.pulls.drive(row, velocities) * *rate;
        }
        pulled
    }

    /// P x, written into `out`.
    fn apply(&self, x: &[Vector<D>], out: &mut [Vector<D>]) {
        out.copy_from_slice(x);
        for (row, rate) in self.pulls.rows().iter().zip(self.rates) {
            let here = x[row.agent];
            let mut sum = here * -row.told_weight;
            for (agent, weight) in self.pulls.terms(row) {
                sum += (x[agent] - here) * weight;
            }
            out[row.agent] += sum * (rate / self.fastest);
        }
    }

    /// The sum, term by term; `None` where more than `most` would be needed.
    ///
    /// What the pulls add and what drifts besides are summed apart: the first tends to
    /// terms that are all zero, and what rounding leaves of them must not count as a drift.
    fn summed(&self, mean: f64, velocities: &[Vector<D>], most: usize) -> Option<Vec<Vector<D>>> {
        // Of a mean this far above, every tail that is asked for is 1.
        let tails = (mean <= 4.0 * most as f64).then(|| Tails::new(mean));
        let mut sum = velocities.to_vec();
        let size = velocities.iter().map(Vector::amax).fold(0.0, f64::max);
        for (drifts, mut term) in [
            (false, self.pulled(velocities)),
            (self.closed, self.drift.to_vec()),
        ] {
            term.iter_mut().for_each(|term| *term /= self.fastest);
            let largest = term.iter().map(Vector::amax).fold(0.0, f64::max);
            let small = ROUNDING * (size + if drifts { largest * mean } else { largest });
            let mut next = term.clone();
            let mut done = false;
            for k in 0..most {
                let (tail, left) = match &tails {
                    Some(tails) => (tails.tail(k), tails.sum_from(k)),
                    None => (1.0, mean - k as f64),
                };
                // If all terms from here on were the same, how far would the sum be off?
                let same = if self.closed {
                    term[0]
                } else {
                    Vector::zeros()
                };
                let apart = term.iter().map(|term| (term - same).amax());
                if apart.fold(0.0, f64::max) * left <= small {
                    let rest = if drifts { same * left } else { Vector::zeros() };
                    sum.iter_mut().for_each(|sum| *sum += rest);
                    done = true;
                    break;
                }
                for (sum, term) in sum.iter_mut().zip(&term) {
                    *sum += term * tail;
                }
                self.apply(&term, &mut next);
                std::mem::swap(&mut term, &mut next);
            }
            if !done {
                return None;
            }
        }
        Some(sum)
    }

    /// The solution over a part of the time short enough for a few terms, doubled until the
    /// time is full: v ↦ E v + c, twice, is v ↦ E² v + (E c + c).
    fn doubled(&self, mean: f64, velocities: &[Vector<D>]) -> Vec<Vector<D>> {
        let n = velocities.len();
        let (mut part, mut doublings) = (mean, 0);
        while part > 1.0 {
            part *= 0.5;
            doublings += 1;
        }
        let mut weights = DMatrix::<f64>::identity(n, n);
        // The columns of c, and one for the share of E's rows that is lost to what is told:
        // known apart, it says what the rows must add up to.
        let mut pushes = DMatrix::<f64>::zeros(n, D + 1);
        for (row, rate) in self.pulls.rows().iter().zip(self.rates) {
            let share = rate / self.fastest;
            weights[(row.agent, row.agent)] -= row.weight * share;
            for (agent, weight) in self.pulls.terms(row) {
                weights[(row.agent, agent)] += weight * share;
            }
            pushes[(row.agent, D)] += row.told_weight * share;
        }
        let told = self.pulled(&vec![Vector::zeros(); n]);
        for (i, (told, drift)) in told.iter().zip(self.drift).enumerate() {
            for axis in 0..D {
                pushes[(i, axis)] = (told[axis] + drift[axis]) / self.fastest;
            }
        }
        let tails = Tails::new(part);
        let mut step = DMatrix::<f64>::identity(n, n) * (1.0 - tails.tail(0));
        let mut pushed = &pushes * tails.tail(0);
        let mut power = DMatrix::<f64>::identity(n, n);
        for k in 1..=tails.len() {
            power = &power * &weights;
            step += &power * (tails.tail(k - 1) - tails.tail(k));
            pushed += &power * &pushes * tails.tail(k);
        }
        for _ in 0..doublings {
            pushed = &step * &pushed + &pushed;
            step = &step * &step;
            // Rounding would double with each doubling.
            for (i, mut row) in step.row_iter_mut().enumerate() {
                let sum = row.sum();
                if sum > 0.0 {
                    row *= (1.0 - pushed[(i, D)]).max(0.0) / sum;
                }
            }
        }
        let moved = (0..n).map(|i| {
            let mut sum = Vector::from_fn(|axis, _| pushed[(i, axis)]);
            for (j, velocity) in velocities.iter().enumerate() {
                sum += velocity * step[(i, j)];
            }
            sum
        });
        moved.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Gain;

    /// Numbers between 0 and 1 that look random.
    fn noise(k: usize) -> f64 {
        (k as f64 * 0.618_033_988_75 + (k * k) as f64 * 0.377).fract()
    }

    fn matrix(n: usize, coupling: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
        let entry = |i: usize, j: usize| if i == j { 0.0 } else { coupling(i, j) };
        (0..n)
            .map(|i| (0..n).map(|j| entry(i, j)).collect())
            .collect()
    }

    fn velocities(n: usize) -> Vec<Vector<3>> {
        (0..n)
            .map(|i| Vector::from_fn(|axis, _| noise(7 * i + 31 * axis) * 4.0 - 1.0))
            .collect()
    }

    /// The exponential of the whole linear system, by nalgebra.
    fn reference(
        pulls: &Pulls<3>,
        rates: &[f64],
        drift: &[Vector<3>],
        time: f64,
        start: &[Vector<3>],
    ) -> Vec<Vector<3>> {
        let n = start.len();
        let mut system = DMatrix::<f64>::zeros(n + 3, n + 3);
        for (row, rate) in pulls.rows().iter().zip(rates) {
            system[(row.agent, row.agent)] -= rate * row.weight;
            for (j, weight) in pulls.terms(row) {
                system[(row.agent, j)] += rate * weight;
            }
            for axis in 0..3 {
                system[(row.agent, n + axis)] += rate * row.told[axis];
            }
        }
        for i in 0..n {
            for axis in 0..3 {
                system[(i, n + axis)] += drift[i][axis];
            }
        }
        let flow = (system * time).exp();
        let component = |i: usize, axis: usize| {
            let moved: f64 = (0..n).map(|j| flow[(i, j)] * start[j][axis]).sum();
            moved + flow[(i, n + axis)]
        };
        (0..n)
            .map(|i| Vector::from_fn(|axis, _| component(i, axis)))
            .collect()
    }

    fn compare(pulls: &Pulls<3>, time: f64) {
        let n = pulls.rows().len();
        let rates: Vec<f64> = pulls.rows().iter().map(|row| row.gain.at(0.0)).collect();
        let start = velocities(n);
        let drift: Vec<_> = velocities(2 * n)[n..].to_vec();
        let linear = Linear::new(pulls, &rates, &drift);
        let wanted = reference(pulls, &rates, &drift, time, &start);
        let by_either = [
            linear.after(time, &start),
            linear.doubled(linear.fastest * time, &start),
        ];
        for found in by_either {
            for (found, wanted) in found.iter().zip(&wanted) {
                let error = (found - wanted).norm();
                assert!(error < 1e-10 * wanted.norm().max(1.0), "{time}: {error}");
            }
        }
    }

    #[test]
    fn the_sum_and_the_doubling_are_the_exponential() {
        let gains: Vec<Gain> = (0..6).map(|i| Gain::Constant(0.5 + noise(i))).collect();
        let pulls = Pulls::by_matrix(&gains, &matrix(6, |i, j| noise(i + 10 * j)));
        let sparse = |i: usize, j: usize| f64::from(u8::from((i + 1) % 6 == j)) * noise(i);
        let mut told = Pulls::by_matrix(&gains, &matrix(6, sparse));
        told.tell(2, 0.7, Vector::<3>::new(1.0, -2.0, 0.5));
        for time in [1e-3, 0.4, 3.0, 20.0] {
            compare(&pulls, time);
            compare(&told, time);
        }
    }

    #[test]
    fn what_mixes_slowly_is_followed_over_millions_of_mean_times() {
        // Two pairs that agree at once, and with each other at a rate of 2e-6.
        let pair = |i: usize, j: usize| if i / 2 == j / 2 { 1.0 } else { 5e-7 };
        let pulls = Pulls::by_matrix(&[Gain::Constant(1.0); 4], &matrix(4, pair));
        let start = velocities(4);
        let rest = [Vector::zeros(); 4];
        let linear = Linear::new(&pulls, &[1.0; 4], &rest);
        let time = 4e5;
        let found = linear.after(time, &start);
        let mean = (start[0] + start[1] + start[2] + start[3]) / 4.0;
        let apart = (start[0] + start[1] - start[2] - start[3]) / 4.0;
        let decay = (-2e-6f64 * time).exp();
        for (i, found) in found.iter().enumerate() {
            let side = if i < 2 { 1.0 } else { -1.0 };
            let error = (found - mean - apart * (decay * side)).norm();
            assert!(error < 1e-9, "{error}");
        }
        // However long or fast: rounding does not grow with the number of doublings.
        for time in [1e12, 1e80] {
            for found in linear.after(time, &start) {
                assert!((found - mean).norm() < 1e-12, "{time}");
            }
        }
    }

    #[test]
    fn a_common_drift_goes_on_when_all_have_agreed() {
        let pulls = Pulls::by_matrix(&[Gain::Constant(1.0); 5], &matrix(5, |_, _| 1e5));
        let start = velocities(5);
        let drift: Vec<_> = velocities(10)[5..].to_vec();
        let linear = Linear::new(&pulls, &[1.0; 5], &drift);
        let mean = |of: &[Vector<3>]| of.iter().sum::<Vector<3>>() / 5.0;
        for found in linear.after(2.0, &start) {
            let wanted = mean(&start) + mean(&drift) * 2.0;
            assert!((found - wanted).norm() < 1e-4);
        }
    }
}
