//! The linear systems of Newton's iteration.
//!
//! For λ = γ/h, or another eigenvalue over h, (λ − J)(dx, dv) = (r, s) with J = [0 1; P Q], P and Q
//! the derivatives of the accelerations by positions and velocities. So dx = (r + dv)/λ, and
//! (λ − Q − P/λ) dv = s + P r/λ.

use nalgebra::{Complex, ComplexField, DMatrix, DVector, Dyn, LU};
use serde::{Deserialize, Serialize};

use super::table::{MODES, Mode, STAGES};
use crate::math::ode::{Stand, System};

/// How the accelerations depend on positions and velocities: P and Q.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Jacobian {
    by_position: DMatrix<f64>,
    by_velocity: DMatrix<f64>,
}

impl Jacobian {
    /// Whether it is one of this many coordinates.
    pub(super) fn fits(&self, coordinates: usize) -> bool {
        let shape = (coordinates, coordinates);
        self.by_position.shape() == shape && self.by_velocity.shape() == shape
    }

    /// By one-sided differences.
    pub(super) fn new(system: &mut impl System, stand: Stand<'_>) -> Self {
        let size = stand.state.len();
        let half = size / 2;
        let mut both = [DMatrix::zeros(half, half), DMatrix::zeros(half, half)];
        let mut moved = stand.state.to_vec();
        let mut slope = vec![0.0; size];
        for (k, y) in stand.state.iter().enumerate() {
            let far = f64::EPSILON.sqrt() * system.scale(k, *y, *y);
            moved[k] = y + far;
            let way = moved[k] - y;
            if way != 0.0 {
                system.slope(stand.time, &moved, &mut slope);
                let changes = slope[half..].iter().zip(&stand.slope[half..]);
                let column = changes.map(|(after, before)| (after - before) / way);
                let mut out = both[k / half].column_mut(k % half);
                out.iter_mut().zip(column).for_each(|(out, it)| *out = it);
            }
            moved[k] = *y;
        }
        let [by_position, by_velocity] = both;
        Self {
            by_position,
            by_velocity,
        }
    }

    /// The largest sum of the sizes of a row of Q: no rate of decay of velocities is larger.
    pub(super) fn fastest_decay(&self) -> f64 {
        let rows = self.by_velocity.row_iter();
        let sums = rows.map(|row| row.iter().map(|entry| entry.abs()).sum::<f64>());
        sums.fold(0.0, f64::max)
    }
}

/// The factors of λ − Q − P/λ for one eigenvalue.
#[derive(Debug, Clone)]
struct Factor<T: ComplexField> {
    rate: T,
    by_position: DMatrix<T>,
    lu: LU<T, Dyn, Dyn>,
}

impl<T: ComplexField<RealField = f64>> Factor<T> {
    fn new(jacobian: &Jacobian, rate: T) -> Option<Self> {
        let convert = |matrix: &DMatrix<f64>| matrix.map(T::from_real);
        let by_position = convert(&jacobian.by_position) * (T::one() / rate.clone());
        let mut matrix = -(convert(&jacobian.by_velocity) + &by_position);
        for k in 0..matrix.nrows() {
            matrix[(k, k)] += rate.clone();
        }
        let lu = matrix.lu();
        lu.is_invertible().then_some(Self {
            rate,
            by_position,
            lu,
        })
    }

    /// (λ − J)⁻¹ of a flat vector.
    fn solve(&self, mut vector: DVector<T>) -> DVector<T> {
        let half = vector.len() / 2;
        let r = vector.rows(0, half).into_owned();
        let mut dv = vector.rows(half, half) + &self.by_position * &r;
        self.lu.solve_mut(&mut dv);
        let dx = (r + &dv) / self.rate.clone();
        vector.rows_mut(0, half).copy_from(&dx);
        vector.rows_mut(half, half).copy_from(&dv);
        vector
    }
}

/// The factors of all modes, for one length of step.
#[derive(Debug, Clone)]
pub(super) struct Factors {
    real: Factor<f64>,
    pairs: Vec<Factor<Complex<f64>>>,
}

impl Factors {
    /// Nothing where a matrix cannot be solved.
    pub(super) fn new(jacobian: &Jacobian, step: f64) -> Option<Self> {
        let complex = |mode: &Mode| Complex::new(mode.rate.0 / step, mode.rate.1 / step);
        let pairs = MODES[1..].iter();
        let pairs = pairs.map(|mode| Factor::new(jacobian, complex(mode)));
        Some(Self {
            real: Factor::new(jacobian, MODES[0].rate.0 / step)?,
            pairs: pairs.collect::<Option<_>>()?,
        })
    }

    /// (1 − hJ/γ)⁻¹ of h/γ times a vector.
    pub(super) fn damped(&self, vector: DVector<f64>) -> DVector<f64> {
        self.real.solve(vector)
    }

    /// One round of Newton's iteration: for each mode, what it changes of each z_i, from the
    /// slopes at the stages (columns) and the z_i.
    pub(super) fn corrections(
        &self,
        slopes: &DMatrix<f64>,
        ways: &[DVector<f64>],
        step: f64,
    ) -> Vec<[DVector<f64>; STAGES]> {
        let size = slopes.nrows();
        let number = |pair: (f64, f64)| Complex::new(pair.0, pair.1);
        // Row k of T⁻¹ F − λ/h T⁻¹ Z, for the eigenvalue that goes with the step.
        let residual = |mode: &Mode| -> DVector<Complex<f64>> {
            let rate = number(mode.rate) / step;
            DVector::from_fn(size, |k, _| {
                let terms = (0..STAGES).map(|j| {
                    number(mode.from[j]) * (Complex::from(slopes[(k, j)]) - rate * ways[j][k])
                });
                terms.sum::<Complex<f64>>()
            })
        };
        let mut changes = Vec::with_capacity(MODES.len());
        let change = self.real.solve(residual(&MODES[0]).map(|it| it.re));
        changes.push(std::array::from_fn(|i| &change * MODES[0].to[i].0));
        for (mode, factor) in MODES[1..].iter().zip(&self.pairs) {
            let change = factor.solve(residual(mode));
            // The conjugate adds as much.
            let real = |i: usize| change.map(|it| 2.0 * (number(mode.to[i]) * it).re);
            changes.push(std::array::from_fn(real));
        }
        changes
    }
}
