//! The implicit method of order 9 for stiff equations of motion.
//!
//! Radau IIA with five stages, E. Hairer and G. Wanner, "Solving Ordinary Differential Equations
//! II", 1996, IV.8: z_i = h Σ_j a_ij f(t + c_j h, y + z_j), and y + z_5 is the state at the end. It
//! is stable however stiff the equations are, and damps what is stiff. The z are found by
//! Newton's iteration, in the eigenvectors of A⁻¹, where each is a system of its own. The error
//! is that of an embedded solution of order 5: far larger than the true one.
//!
//! The state is y = (x, v) with ẋ = v, and that is used: the matrices are those of the
//! velocities alone.

mod linear;
mod table;

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::{Method, Stand, System};
use linear::{Factors, Jacobian};
use table::{ERROR, MODES, NODES, STAGES};

/// The most rounds of Newton's iteration.
const MOST_ROUNDS: usize = 12;

/// Where the last correction is this share of the error allowed, the iteration ends.
const ENOUGH: f64 = 1e-3;

/// The Jacobian is taken anew once each round leaves more than this share of the error.
const SLOW: f64 = 0.05;

/// Radau IIA of order 9; see the module.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Radau {
    /// How the accelerations depend on the state, as it was some steps ago.
    jacobian: Option<Jacobian>,
    /// Whether that is too long ago.
    stale: bool,
    /// The length of step of the factors.
    step: f64,
    #[serde(skip)]
    factors: Option<Factors>,
    #[serde(skip)]
    ways: Vec<DVector<f64>>,
}

impl Radau {
    /// Order of the method.
    pub const ORDER: usize = 9;

    /// Whether it can go on with a system of this many coordinates of positions.
    pub fn fits(&self, coordinates: usize) -> bool {
        let jacobian = self.jacobian.as_ref();
        jacobian.is_none_or(|jacobian| jacobian.fits(coordinates))
    }

    /// A bound of the rates at which velocities decay in a state whose slope is known: the
    /// largest sum of a row of the derivatives of accelerations by velocities.
    pub fn fastest_decay(system: &mut impl System, stand: Stand<'_>) -> f64 {
        Jacobian::new(system, stand).fastest_decay()
    }
}

impl PartialEq for Radau {
    /// Whether both go on alike.
    fn eq(&self, other: &Self) -> bool {
        (&self.jacobian, self.stale, self.step) == (&other.jacobian, other.stale, other.step)
    }
}

impl Method for Radau {
    const POWER: f64 = 6.0;

    fn attempt(
        &mut self,
        system: &mut impl System,
        stand: Stand<'_>,
        step: f64,
        end: &mut Vec<f64>,
    ) -> Option<f64> {
        let fresh = self.stale || self.jacobian.is_none();
        if fresh {
            self.jacobian = Some(Jacobian::new(system, stand));
            self.stale = false;
            self.factors = None;
            self.step = step;
        }
        let attempt = self.with_jacobian(system, stand, step, end);
        if attempt.is_none() && !fresh {
            self.stale = true;
            return self.attempt(system, stand, step, end);
        }
        attempt
    }
}

impl Radau {
    fn with_jacobian(
        &mut self,
        system: &mut impl System,
        stand: Stand<'_>,
        step: f64,
        end: &mut Vec<f64>,
    ) -> Option<f64> {
        let jacobian = self.jacobian.as_ref()?;
        // Factors of nearly the same step do nearly as well.
        if (step / self.step - 1.0).abs() > 1e-3 {
            self.step = step;
            self.factors = None;
        }
        let factors = match self.factors.take() {
            Some(factors) => factors,
            None => Factors::new(jacobian, self.step)?,
        };
        self.guess(stand, step);
        let found = self.iterate(system, stand, step, &factors, end);
        let error = found.then(|| {
            end.clear();
            end.extend(sum(stand.state, &self.ways[STAGES - 1]));
            self.error(system, stand, step, &factors, end)
        });
        self.factors = Some(factors);
        error
    }

    /// A first guess of the z: accelerations as they are.
    fn guess(&mut self, stand: Stand<'_>, step: f64) {
        let half = stand.state.len() / 2;
        let acceleration = &stand.slope[half..];
        self.ways.clear();
        self.ways.extend(NODES.iter().map(|node| {
            let time = node * step;
            DVector::from_fn(stand.state.len(), |k, _| match k < half {
                true => time * (stand.slope[k] + 0.5 * time * acceleration[k]),
                false => time * stand.slope[k],
            })
        }));
    }

    /// Newton's iteration for the z; whether it found them.
    fn iterate(
        &mut self,
        system: &mut impl System,
        stand: Stand<'_>,
        step: f64,
        factors: &Factors,
        scratch: &mut Vec<f64>,
    ) -> bool {
        let size = stand.state.len();
        let mut slopes = DMatrix::zeros(size, STAGES);
        let mut before = f64::INFINITY;
        for round in 0..MOST_ROUNDS {
            for (stage, way) in self.ways.iter().enumerate() {
                scratch.clear();
                scratch.extend(sum(stand.state, way));
                let time = stand.time + NODES[stage] * step;
                let out = &mut slopes.as_mut_slice()[stage * size..(stage + 1) * size];
                system.slope(time, scratch, out);
            }
            let mut largest: f64 = 0.0;
            for mode in factors.corrections(&slopes, &self.ways, step) {
                for (way, change) in self.ways.iter_mut().zip(&mode) {
                    *way += change;
                }
                let last = &mode[STAGES - 1];
                largest = largest.max(share(system, stand, last.as_slice()));
            }
            if !largest.is_finite() {
                return false;
            }
            let rate = largest / before;
            // What is left after this round, if all go on as these.
            let left = match rate < 1.0 {
                true => largest * rate / (1.0 - rate),
                false => largest,
            };
            if largest <= ENOUGH * 1e-3 || (round > 0 && left <= ENOUGH) {
                self.stale = rate > SLOW && round > 1;
                return true;
            }
            if round > 1 && rate >= 1.0 {
                return false;
            }
            before = largest;
        }
        false
    }

    /// The error of a step, as a share of the one allowed.
    fn error(
        &self,
        system: &mut impl System,
        stand: Stand<'_>,
        step: f64,
        factors: &Factors,
        scratch: &mut [f64],
    ) -> f64 {
        let gamma = MODES[0].rate.0;
        let mut ways = DVector::zeros(stand.state.len());
        for (weight, way) in ERROR.iter().zip(&self.ways) {
            ways.axpy(gamma / step * weight, way, 1.0);
        }
        let filtered = |slope: &[f64]| {
            let sum = DVector::from_column_slice(slope) + &ways;
            factors.damped(sum)
        };
        let error = filtered(stand.slope);
        let first = share(system, stand, error.as_slice());
        if first <= 1.0 || !first.is_finite() {
            return first;
        }
        // What is stiff is overestimated by far after a change; once more does away with that.
        let moved: Vec<f64> = sum(stand.state, &error).collect();
        let mut slope = vec![0.0; scratch.len()];
        system.slope(stand.time, &moved, &mut slope);
        f64::min(first, share(system, stand, filtered(&slope).as_slice()))
    }
}

/// The largest of some changes of the state, as a share of the error allowed.
fn share(system: &impl System, stand: Stand<'_>, changes: &[f64]) -> f64 {
    let mut largest: f64 = 0.0;
    for (k, (y, change)) in stand.state.iter().zip(changes).enumerate() {
        let allowed = system.scale(k, *y, *y + *change) * stand.tolerance;
        let share = match change.abs() {
            0.0 => 0.0,
            change => change / allowed,
        };
        if !share.is_finite() {
            return f64::NAN;
        }
        largest = largest.max(share);
    }
    largest
}

fn sum<'a>(state: &'a [f64], way: &'a DVector<f64>) -> impl Iterator<Item = f64> + 'a {
    state.iter().zip(way.iter()).map(|(y, z)| y + z)
}
