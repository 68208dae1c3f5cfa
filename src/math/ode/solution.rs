//! A solution on its way: how long its steps are, and where they end.

use std::fmt;

use super::{Attempt, Method, Stand, System};

/// How often the slope may jump on the way to a time that is to be reached. A slope that
/// drives the state back to where it jumps, from both sides, jumps without end.
const MOST_JUMPS: usize = 10_000;

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
    end: Vec<f64>,
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
    /// The slope jumps again and again.
    Jumps,
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
            state,
            step: 0.0,
            tolerance,
            known: false,
            jumps: 0,
        };
        solution.system.settle(&solution.state);
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
        loop {
            let left = end - self.time;
            // No crumb is left to the next step.
            let last = self.step >= left * (1.0 - 1e-9);
            let step = if last { left } else { self.step };
            let error = match self.attempt(step) {
                Attempt::Done { error, .. } if error <= 1.0 => {
                    self.accept(if last { end } else { self.time + step });
                    self.step = step * factor::<M>(error);
                    return Ok(());
                }
                Attempt::Done { error, .. } => error,
                Attempt::Lost => f64::NAN,
                Attempt::Crossed { share, margin } => {
                    match self.stop_before([share * step, margin], step, end)? {
                        None => return Ok(()),
                        Some(error) => error,
                    }
                }
            };
            self.step = f64::min(self.step, step) * factor::<M>(error).min(0.9);
            if self.time + self.step <= self.time || !self.step.is_normal() {
                return Err(self.stuck(Stumble::Error));
            }
        }
    }

    /// Goes on to where the slope jumps within a step that crosses that place, or as near to
    /// it as no stage crosses it; `beyond` are time and margin of what is known to lie
    /// beyond. Where a step on the way is not exact enough, stays, and returns its error.
    fn stop_before(&mut self, beyond: [f64; 2], step: f64, end: f64) -> Result<Option<f64>, Stuck> {
        let hair = f64::EPSILON * self.time.abs().max(step);
        let mut low = [0.0, self.system.margin(&self.state)];
        let mut high = step;
        let mut beyond = beyond;
        for round in 0.. {
            if high - low[0] <= 2.0 * hair {
                break;
            }
            // Where the line through both margins crosses zero; in the middle now and then,
            // so that the interval shrinks whatever the margins are like.
            let crossing = low[0] + (beyond[0] - low[0]) * (low[1] / (low[1] - beyond[1]));
            let inside = crossing > low[0] && crossing < high;
            let tried = match inside && round % 3 != 2 {
                true => crossing,
                false => 0.5 * (low[0] + high),
            };
            match self.attempt(tried) {
                Attempt::Done { error, margin } if error <= 1.0 => low = [tried, margin],
                Attempt::Done { error, .. } => return Ok(Some(error)),
                Attempt::Lost => return Ok(Some(f64::NAN)),
                Attempt::Crossed { share, margin } => {
                    high = tried;
                    beyond = [share * tried, margin];
                }
            }
            if low[0] > 0.0 && low[1] == 0.0 {
                break;
            }
        }
        let begin = self.time;
        if low[0] > 0.0 && matches!(self.attempt(low[0]), Attempt::Done { .. }) {
            self.accept(self.time + low[0]);
            self.know();
            self.step = step;
        }
        self.jump(hair, end)?;
        match self.time > begin {
            true => Ok(None),
            false => Err(self.stuck(Stumble::Jumps)),
        }
    }

    /// Goes straight on over the place where the slope jumps, if it is but hairs away: so far
    /// that no slope of the near side is used any more.
    fn jump(&mut self, hair: f64, end: f64) -> Result<(), Stuck> {
        let mut way = hair;
        while way <= 64.0 * hair {
            let line = self.state.iter().zip(&self.slope);
            self.end.clear();
            self.end.extend(line.map(|(y, slope)| y + way * slope));
            if self.system.margin(&self.end) < 0.0 {
                self.accept(f64::min(self.time + way, end));
                self.system.settle(&self.state);
                self.jumps += 1;
                return match self.jumps > MOST_JUMPS {
                    true => Err(self.stuck(Stumble::Jumps)),
                    false => Ok(()),
                };
            }
            way *= 2.0;
        }
        Ok(())
    }

    /// Finds the slope of the state.
    fn know(&mut self) {
        if !self.known {
            self.system.slope(self.time, &self.state, &mut self.slope);
            self.known = true;
        }
    }

    fn attempt(&mut self, step: f64) -> Attempt {
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
