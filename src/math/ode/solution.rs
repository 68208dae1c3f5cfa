//! A solution on its way: how long its steps are, and where they end.

mod jumps;

use std::fmt;

use super::{Method, Stand, System};

/// A solution of a system on its way.
pub struct Solution<S, M> {
    system: S,
    method: M,
    time: f64,
    state: Vec<f64>,
    /// The next step to try.
    step: f64,
    tolerance: f64,
    slope: Vec<f64>,
    /// Whether `slope` is that of the state.
    known: bool,
    jumps: usize,
    /// Scratch: the state and slope at the end of a step, and how the slope changes, where that
    /// is known.
    end: Vec<f64>,
    after: Vec<f64>,
    bends: Vec<f64>,
    bent: bool,
}

/// The integration cannot go on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stuck {
    /// The time that was reached.
    pub time: f64,
    /// Over what.
    pub over: Stumble,
}

/// What an integration gets stuck over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stumble {
    /// No step, however short, is as exact as asked for, or there are numbers that are not
    /// finite.
    Error,
    /// Nothing: the system wants to stop.
    Stopped,
}

impl fmt::Display for Stuck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the integration gets stuck at time {}", self.time)
    }
}

impl std::error::Error for Stuck {}

impl<S: System, M: Method> Solution<S, M> {
    /// A solution that is at `state` at `time`. The error that a step makes in an entry is
    /// kept below tolerance × its scale, see [`System::scale`].
    pub fn new(system: S, method: M, time: f64, state: Vec<f64>, tolerance: f64) -> Self {
        let mut solution = Self {
            system,
            method,
            time,
            slope: vec![0.0; state.len()],
            end: state.clone(),
            after: vec![0.0; state.len()],
            bends: Vec::new(),
            bent: false,
            state,
            step: 0.0,
            tolerance,
            known: false,
            jumps: 0,
        };
        solution.system.settle(time, &solution.state);
        solution.know();
        // A first step over which the straight line changes little; what follows adapts.
        let entries = solution.slope.iter().zip(&solution.state).enumerate();
        let fastest = entries
            .map(|(k, (slope, y))| slope.abs() / solution.system.scale(k, *y, *y))
            .filter(|rate| rate.is_finite())
            .fold(0.0, f64::max);
        solution.step = libm::pow(tolerance, 1.0 / M::POWER) / fastest.max(1e-6);
        solution
    }

    /// The same, with a step to try first.
    pub fn with_step(self, step: f64) -> Self {
        Self { step, ..self }
    }

    /// The time reached.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The state at that time.
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// The next step that it would try.
    pub fn next_step(&self) -> f64 {
        self.step
    }

    /// How often the slope has jumped.
    pub fn jumps(&self) -> usize {
        self.jumps
    }

    /// The method, to go on with elsewhere.
    pub fn into_method(self) -> M {
        self.method
    }

    /// Goes on to a time, and ends there exactly.
    ///
    /// # Errors
    /// Where it gets stuck.
    pub fn advance_to(&mut self, end: f64) -> Result<(), Stuck> {
        while self.time < end {
            let (before, free) = (self.time, self.step);
            self.advance_until(end)?;
            if self.time >= end {
                // The last step was as short as it had to be, not as it needed to be.
                self.step = self.step.max(free.min(10.0 * (end - before)));
            }
        }
        Ok(())
    }

    /// Takes one step, as long as its error allows.
    ///
    /// # Errors
    /// Where it gets stuck.
    pub fn advance(&mut self) -> Result<(), Stuck> {
        self.advance_until(f64::INFINITY)
    }

    /// Takes one step, not beyond `end`.
    fn advance_until(&mut self, end: f64) -> Result<(), Stuck> {
        self.know();
        if self.system.stopped() {
            return Err(self.stuck(Stumble::Stopped));
        }
        let Some(mut aim) = self.aim(end - self.time) else {
            return Ok(());
        };
        loop {
            let left = end - self.time;
            let free = self.step;
            let wanted = free.min(aim.limit);
            // No crumb is left to the next step.
            let last = wanted >= left * (1.0 - 1e-9);
            let step = if last { left } else { wanted };
            let reached = if last { end } else { self.time + step };
            let error = self.attempt(step);
            if self.system.stopped() {
                return Err(self.stuck(Stumble::Stopped));
            }
            match error {
                Some(error) if error <= 1.0 => {
                    if self.meet(&mut aim, step, reached) {
                        let next = step * factor::<M>(error);
                        // A step that had to be short tells less of how long it may be.
                        let short = step < 0.9 * free;
                        self.step = if short { next.max(free) } else { next };
                        return Ok(());
                    }
                }
                _ => {
                    let error = error.unwrap_or(f64::NAN);
                    self.step = f64::min(self.step, step) * factor::<M>(error).min(0.9);
                    if self.time + self.step <= self.time || !self.step.is_normal() {
                        return Err(self.stuck(Stumble::Error));
                    }
                }
            }
        }
    }

    /// Finds the slope of the state.
    fn know(&mut self) {
        if !self.known {
            self.system.slope(self.time, &self.state, &mut self.slope);
            self.known = true;
        }
    }

    fn attempt(&mut self, step: f64) -> Option<f64> {
        let stand = Stand {
            time: self.time,
            state: &self.state,
            slope: &self.slope,
            tolerance: self.tolerance,
        };
        self.method
            .attempt(&mut self.system, stand, step, &mut self.end)
    }

    /// Goes on to where the last attempt ended.
    fn accept(&mut self, time: f64) {
        self.time = time;
        std::mem::swap(&mut self.state, &mut self.end);
        self.known = false;
    }

    fn stuck(&self, over: Stumble) -> Stuck {
        Stuck {
            time: self.time,
            over,
        }
    }
}

/// By how much to lengthen a step that has made some share of the error allowed; with care.
fn factor<M: Method>(error: f64) -> f64 {
    match error.is_finite() {
        true => (0.9 * libm::pow(error.max(1e-12), -1.0 / M::POWER)).clamp(0.2, 5.0),
        false => 0.2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{DormandPrince, Radau};

    /// A spiral run through faster and faster, with a known solution.
    fn spiral(t: f64, y: &[f64], out: &mut [f64]) {
        // y = e^(−t/5) (cos t², sin t²).
        out[0] = -0.2 * y[0] - 2.0 * t * y[1];
        out[1] = -0.2 * y[1] + 2.0 * t * y[0];
    }

    fn error(y: &[f64], t: f64) -> f64 {
        let (sin, cos) = (t * t).sin_cos();
        let left = (-0.2 * t).exp();
        (y[0] - left * cos).hypot(y[1] - left * sin)
    }

    /// A swing, ẍ = −x − ẋ/5, and its solution from (1, 0).
    fn swing(_: f64, y: &[f64], out: &mut [f64]) {
        out[0] = y[1];
        out[1] = -y[0] - 0.2 * y[1];
    }

    fn swing_error(y: &[f64], t: f64) -> f64 {
        let omega = 0.99f64.sqrt();
        let (sin, cos) = (omega * t).sin_cos();
        let x = (-0.1 * t).exp() * (cos + 0.1 / omega * sin);
        (y[0] - x).abs()
    }

    fn orders<M: Method>(
        system: fn(f64, &[f64], &mut [f64]),
        method: impl Fn() -> M,
        error: fn(&[f64], f64) -> f64,
        steps: [i32; 3],
    ) -> Vec<f64> {
        let errors = steps.map(|steps| {
            let mut solution = Solution::new(system, method(), 0.0, vec![1.0, 0.0], 1e300);
            for _ in 0..steps {
                solution.step = 2.0 / f64::from(steps);
                solution.advance().expect("finite numbers");
            }
            error(solution.state(), 2.0)
        });
        let pairs = errors.windows(2);
        pairs.map(|pair| (pair[0] / pair[1]).log2()).collect()
    }

    #[test]
    fn fixed_steps_have_the_order_of_the_method() {
        for order in orders(spiral, DormandPrince::default, error, [10, 20, 40]) {
            assert!((7.3..9.0).contains(&order), "{order}");
        }
    }

    #[test]
    fn tolerances_are_kept_and_ends_are_met() {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let start = vec![1.0, 0.0];
            let mut solution =
                Solution::new(spiral, DormandPrince::default(), 0.0, start, tolerance);
            for end in [0.1, 0.1, 1.0, 4.0] {
                solution.advance_to(end).expect("finite numbers");
                assert_eq!(solution.time(), end);
                let error = error(solution.state(), end);
                assert!(error < 100.0 * tolerance, "{tolerance}: {error}");
            }
            let mut solution =
                Solution::new(swing, Radau::default(), 0.0, vec![1.0, 0.0], tolerance);
            solution.advance_to(5.0).expect("finite numbers");
            let error = swing_error(solution.state(), 5.0);
            assert!(error < 10.0 * tolerance + 1e-14, "{tolerance}: {error}");
        }
    }

    #[test]
    fn what_blows_up_gets_stuck_in_time() {
        let square = |_: f64, y: &[f64], out: &mut [f64]| out[0] = y[0] * y[0];
        let method = DormandPrince::default();
        let mut solution = Solution::new(square, method, 0.0, vec![1.0], 1e-9);
        let stuck = solution
            .advance_to(2.0)
            .expect_err("1/(1 − t) has no value");
        assert!((stuck.time - 1.0).abs() < 1e-3, "{stuck}");
        let nothing = |_: f64, _: &[f64], out: &mut [f64]| out.fill(f64::NAN);
        for both in [
            Solution::new(nothing, DormandPrince::default(), 0.0, vec![1.0, 1.0], 1e-9).advance(),
            Solution::new(nothing, Radau::default(), 0.0, vec![1.0, 1.0], 1e-9).advance(),
        ] {
            assert_eq!(both.map_err(|stuck| stuck.over), Err(Stumble::Error));
        }
    }

    /// A ball that bounces between heights 0 and 1, at which a constant force sets in.
    struct Hover {
        above: bool,
        crossed: Vec<f64>,
    }

    impl System for Hover {
        fn slope(&mut self, _: f64, y: &[f64], out: &mut [f64]) {
            out[0] = y[1];
            out[1] = if self.above { -3.0 } else { 2.0 };
        }

        fn peek(&mut self, _: f64, y: &[f64], out: &mut [f64]) {
            out[0] = y[1];
            out[1] = if y[0] > 1.0 { -3.0 } else { 2.0 };
        }

        fn margin(&mut self, _: f64, y: &[f64]) -> f64 {
            if self.above { y[0] - 1.0 } else { 1.0 - y[0] }
        }

        fn hindsight(&mut self, y: &[f64], slope: &[f64]) -> Option<f64> {
            // The straight line alone: the rest is up to the rounds.
            Some((y[0] - 1.0) / slope[0])
        }

        fn cross(&mut self, time: f64, _: f64, _: &mut [f64]) -> usize {
            self.above = !self.above;
            self.crossed.push(time);
            1
        }
    }

    #[test]
    fn steps_end_where_the_slope_jumps() {
        let hover = Hover {
            above: false,
            crossed: Vec::new(),
        };
        let mut solution = Solution::new(hover, DormandPrince::default(), 0.0, vec![0.0; 2], 1e-9);
        solution.advance_to(10.0).expect("finite numbers");
        // Up to 1 in a second, at 2; then 4/3 of one above, and two below.
        let (mut time, mut above) = (1.0, true);
        for crossed in &solution.system.crossed {
            assert!((crossed - time).abs() < 1e-9, "{crossed} {time}");
            time += if above { 4.0 / 3.0 } else { 2.0 };
            above = !above;
        }
        assert_eq!(solution.jumps(), 6);
    }
}
