//! Steps that end where the slope jumps.

use super::{Solution, Stuck, Stumble};
use crate::math::ode::{Attempt, Method, System};

/// How often steps may stop for jumps before the integration gives up. A slope that drives the
/// state back to where it jumps, from both sides, jumps without end.
const MOST_STOPS: usize = 100_000;

/// The error of a step through a jump up to which that is let pass, as a share of the one
/// allowed.
const HIDDEN: f64 = 0.01;

impl<S: System, M: Method> Solution<S, M> {
    /// Takes a step through a jump that is too small to show in its error: where agents have
    /// come to rest at the place of the jump, rounding takes them to and fro.
    pub(super) fn go_through(&mut self, step: f64, reached: f64) -> bool {
        let attempt = self.attempt_as(step, true);
        match attempt {
            Attempt::Done { error, margin } if error <= HIDDEN => {
                self.accept(reached);
                self.system.settle(&self.state);
                self.jumps += usize::from(margin < 0.0);
                self.step = step;
                true
            }
            _ => false,
        }
    }

    /// Goes on to where the slope jumps within a step that crosses that place, or as near to
    /// it as no stage crosses it; `beyond` are time and margin of what is known to lie
    /// beyond. Where a step on the way is not exact enough, stays, and returns its error.
    pub(super) fn stop_before(
        &mut self,
        beyond: [f64; 2],
        step: f64,
        end: f64,
    ) -> Result<Option<f64>, Stuck> {
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
        self.stops += 1;
        if self.stops > MOST_STOPS {
            return Err(self.stuck(Stumble::Jumps));
        }
        // The way over may be many hairs: rounding hides how far a state is that creeps up.
        let moved = self.time > begin;
        self.jump(262_144.0 * hair, end, moved);
        Ok(None)
    }

    /// Goes straight on over the place where the slope jumps, if that is at most `farthest`
    /// away: so little that no slope of the near side is used any more. If it is not there,
    /// stays, or goes on all the same.
    fn jump(&mut self, farthest: f64, end: f64, may_stay: bool) {
        let mut way = f64::EPSILON * self.time.abs().max(farthest);
        loop {
            let line = self.state.iter().zip(&self.slope);
            self.end.clear();
            self.end.extend(line.map(|(y, slope)| y + way * slope));
            let crossed = self.system.margin(&self.end) < 0.0;
            let last = 2.0 * way > farthest;
            if crossed || (last && !may_stay) {
                self.accept(f64::min(self.time + way, end));
                self.system.settle(&self.state);
                self.jumps += usize::from(crossed);
            }
            if crossed || last {
                return;
            }
            way *= 2.0;
        }
    }
}
