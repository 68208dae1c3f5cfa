//! Ordinary differential equations, integrated with an error that is asked for.
//!
//! The pair of orders 5 and 4 of J. R. Dormand and P. J. Prince, "A family of embedded
//! Runge-Kutta formulae", 1980: the fifth order goes on, the fourth tells the error.

use std::fmt;

/// The times of the stages, as shares of the step.
const TIMES: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];

/// What each stage after the first makes of those before it; the last is the solution of
/// order 5, so that it is the first stage of the next step.
const STAGES: [&[f64]; 6] = [
    &[0.2],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
    ],
    &[
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
    ],
    &[
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];

/// The solution of order 5 less that of order 4.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// A solution of y' = f(t, y) on its way.
pub struct DormandPrince<F> {
    slope: F,
    time: f64,
    state: Vec<f64>,
    /// The next step to try.
    step: f64,
    tolerance: f64,
    /// The slopes at the stages, one after the other.
    slopes: [Vec<f64>; 7],
    trial: Vec<f64>,
}

/// The integration cannot go on: no step, however short, is as exact as asked for, or there
/// are numbers that are not finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stuck {
    /// The time that was reached.
    pub time: f64,
}

impl fmt::Display for Stuck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the integration gets stuck at time {}", self.time)
    }
}

impl std::error::Error for Stuck {}

impl<F: FnMut(f64, &[f64], &mut [f64])> DormandPrince<F> {
    /// A solution that is at `state` at `time`. `slope(t, y, out)` writes f(t, y) into `out`.
    /// The error that a step makes in an entry y is kept below tolerance · max(1, |y|).
    pub fn new(mut slope: F, time: f64, state: Vec<f64>, tolerance: f64) -> Self {
        let mut slopes: [Vec<f64>; 7] = std::array::from_fn(|_| vec![0.0; state.len()]);
        slope(time, &state, &mut slopes[0]);
        // A first step over which the straight line changes little; what follows adapts.
        let relative = |(slope, y): (&f64, &f64)| slope.abs() / y.abs().max(1.0);
        let fastest = (slopes[0].iter().zip(&state).map(relative)).fold(0.0, f64::max);
        let step = libm::pow(tolerance, 0.2) / fastest.max(1e-6);
        Self {
            slope,
            time,
            trial: state.clone(),
            state,
            step,
            tolerance,
            slopes,
        }
    }

    /// The time reached.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The state at that time.
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// Goes on to a time, and ends there exactly.
    ///
    /// # Errors
    /// Where it gets stuck.
    pub fn advance_to(&mut self, end: f64) -> Result<(), Stuck> {
        while self.time < end {
            let free = self.step;
            let left = end - self.time;
            if free < left {
                self.advance()?;
                continue;
            }
            self.step = left;
            self.advance()?;
            if self.time >= end || end - self.time < 1e-3 * left {
                self.time = end;
                // The last step was as short as it had to be, not as it needed to be.
                self.step = self.step.max(free);
            }
        }
        Ok(())
    }

    /// Takes one step, as long as its error allows.
    ///
    /// # Errors
    /// Where it gets stuck.
    pub fn advance(&mut self) -> Result<(), Stuck> {
        loop {
            let step = self.step;
            let error = self.attempt(step);
            // Of fifth order in the step; grows and shrinks with some care.
            let factor = match error.is_finite() {
                true => (0.9 * libm::pow(error.max(1e-10), -0.2)).clamp(0.2, 5.0),
                false => 0.2,
            };
            self.step = step * factor;
            if error <= 1.0 {
                self.time += step;
                std::mem::swap(&mut self.state, &mut self.trial);
                self.slopes.swap(0, 6);
                return Ok(());
            }
            if self.time + self.step <= self.time || !self.step.is_normal() {
                return Err(Stuck { time: self.time });
            }
        }
    }

    /// Tries a step; its largest error, as a share of the one allowed.
    fn attempt(&mut self, step: f64) -> f64 {
        for (stage, weights) in STAGES.iter().enumerate() {
            for (k, trial) in self.trial.iter_mut().enumerate() {
                let terms = weights.iter().zip(&self.slopes);
                let sum: f64 = terms.map(|(weight, slopes)| weight * slopes[k]).sum();
                *trial = self.state[k] + step * sum;
            }
            let time = self.time + TIMES[stage + 1] * step;
            (self.slope)(time, &self.trial, &mut self.slopes[stage + 1]);
        }
        let mut largest: f64 = 0.0;
        for (k, (before, after)) in self.state.iter().zip(&self.trial).enumerate() {
            let terms = ERROR.iter().zip(&self.slopes);
            let error: f64 = terms.map(|(weight, slopes)| weight * slopes[k]).sum();
            let scale = before.abs().max(after.abs()).max(1.0) * self.tolerance;
            let share = (step * error).abs() / scale;
            if share.is_nan() {
                return f64::NAN;
            }
            largest = largest.max(share);
        }
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spiral run through faster and faster, with a known solution.
    fn spiral(t: f64, y: &[f64], out: &mut [f64]) {
        // y = e^(−t/5) (cos t², sin t²).
        out[0] = -0.2 * y[0] - 2.0 * t * y[1];
        out[1] = -0.2 * y[1] + 2.0 * t * y[0];
    }

    fn exact(t: f64) -> [f64; 2] {
        let (sin, cos) = (t * t).sin_cos();
        [(-0.2 * t).exp() * cos, (-0.2 * t).exp() * sin]
    }

    fn error(y: &[f64], t: f64) -> f64 {
        let [a, b] = exact(t);
        (y[0] - a).hypot(y[1] - b)
    }

    #[test]
    fn fixed_steps_are_of_order_five_and_know_their_error() {
        let errors = [20, 40, 80].map(|steps| {
            let mut solution = DormandPrince::new(spiral, 0.0, vec![1.0, 0.0], 1e300);
            for _ in 0..steps {
                solution.step = 2.0 / f64::from(steps);
                solution.advance().expect("finite numbers");
            }
            error(solution.state(), 2.0)
        });
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((4.7..5.6).contains(&order), "{order}: {errors:?}");
        }
        // The estimate is that of order 4: a share of about h of a step's own size to the 4th.
        let mut estimates = [0.1, 0.05].map(|step| {
            let mut solution = DormandPrince::new(spiral, 1.0, exact(1.0).to_vec(), 1.0);
            solution.attempt(step)
        });
        estimates[0] /= estimates[1];
        assert!((4.5..5.5).contains(&estimates[0].log2()), "{estimates:?}");
    }

    #[test]
    fn tolerances_are_kept_and_ends_are_met() {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let mut solution = DormandPrince::new(spiral, 0.0, vec![1.0, 0.0], tolerance);
            for end in [0.1, 0.1, 1.0, 4.0] {
                solution.advance_to(end).expect("finite numbers");
                assert_eq!(solution.time(), end);
                let error = error(solution.state(), end);
                assert!(error < 100.0 * tolerance, "{tolerance}: {error}");
            }
        }
    }

    #[test]
    fn what_blows_up_gets_stuck_in_time() {
        let square = |_, y: &[f64], out: &mut [f64]| out[0] = y[0] * y[0];
        let mut solution = DormandPrince::new(square, 0.0, vec![1.0], 1e-9);
        let stuck = solution
            .advance_to(2.0)
            .expect_err("1/(1 − t) has no value");
        assert!((stuck.time - 1.0).abs() < 1e-3, "{stuck}");
        let nothing = |_, _: &[f64], out: &mut [f64]| out[0] = f64::NAN;
        assert!(
            DormandPrince::new(nothing, 0.0, vec![1.0], 1e-9)
                .advance()
                .is_err()
        );
    }
}
