//! Steps that end where the slope jumps.
//!
//! The system holds its slope as it was before a jump, so that a step may go too far: it says how
//! long ago the jump was crossed. Where that is little the state is taken back along its slope,
//! else the step is tried anew, that much shorter. Every round ends the step or shortens it, so
//! that the work is bounded, whatever the system says.

use super::Solution;
use crate::math::ode::{Method, System};

/// The change of a step by a jump up to which the place of that does not matter, as a share of
/// the error allowed.
const HIDDEN: f64 = 0.01;

/// What is second order in a way along the slope, as a share of the error allowed.
const STRAIGHT: f64 = 0.01;

/// Steps are not aimed at jumps that are nearer than this share of a step: it is quicker to go
/// too far and come back.
const NEAREST: f64 = 1e-6;

/// How many rounds go by what the system says, before the step is halved.
const MOST_ROUNDS: usize = 8;

/// How long steps may become for the sake of jumps, and how often one was met in vain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Aim {
    pub limit: f64,
    dipped: bool,
    rounds: usize,
}

impl<S: System, M: Method> Solution<S, M> {
    /// What time is known to.
    fn hair(&self) -> f64 {
        8.0 * f64::EPSILON * self.time.abs().max(self.step)
    }

    /// Where the next step is to end for the sake of jumps; nothing if one has been crossed
    /// instead, at next to no distance.
    pub(super) fn aim(&mut self, left: f64) -> Option<Aim> {
        let foreseen = self.system.foresee(&self.state, &self.slope);
        if foreseen <= self.hair() {
            self.cross();
            return None;
        }
        if foreseen < left && self.bent && self.is_straight(foreseen) {
            self.end.clone_from(&self.state);
            self.go_along(foreseen);
            std::mem::swap(&mut self.state, &mut self.end);
            self.time += foreseen;
            self.cross();
            return None;
        }
        Some(Aim {
            limit: foreseen.max(NEAREST * self.step),
            dipped: false,
            rounds: 0,
        })
    }

    /// Ends a step at `end`, which is exact enough, unless it must be tried anew for the sake
    /// of jumps: then `aim` says how far.
    pub(super) fn meet(&mut self, aim: &mut Aim, step: f64, reached: f64) -> bool {
        let margin = self.system.margin(reached, &self.end);
        if margin.is_nan() {
            aim.limit = 0.5 * step;
            return false;
        }
        let mut after = std::mem::take(&mut self.after);
        self.system.slope(reached, &self.end, &mut after);
        self.after = after;
        if margin >= 0.0 {
            if !aim.dipped
                && let Some(dip) =
                    self.system
                        .dip(step, [&self.state, &self.slope], [&self.end, &self.after])
            {
                aim.dipped = true;
                aim.limit = dip;
                return false;
            }
            self.bend(step);
            self.accept(reached);
            std::mem::swap(&mut self.slope, &mut self.after);
            self.known = !self.system.arrive(reached, &self.state);
            return true;
        }
        if step <= self.hair() {
            self.accept(reached);
            self.cross();
            return true;
        }
        let ago = self.system.hindsight(&self.end, &self.after);
        self.bend(step);
        match ago {
            Some(ago) if ago < 0.5 * step && self.is_straight(ago) => {
                std::mem::swap(&mut self.slope, &mut self.after);
                self.go_along(-ago);
                self.accept(reached - ago);
                self.cross();
                return true;
            }
            None if margin > -1e-9 => {
                self.accept(reached);
                self.cross();
                return true;
            }
            _ => {}
        }
        if aim.rounds == 0 && self.is_hidden(step, reached) {
            self.accept(reached);
            self.system.disregard();
            self.cross();
            return true;
        }
        aim.rounds += 1;
        aim.limit = match ago {
            Some(ago) if ago < step && aim.rounds < MOST_ROUNDS => step - ago,
            None if aim.rounds < MOST_ROUNDS => {
                let before = self.system.margin(self.time, &self.state).clamp(0.0, 1e300);
                step * (before / (before - margin)).clamp(0.1, 0.9)
            }
            _ => 0.5 * step,
        };
        self.bent = false;
        false
    }

    /// Goes over to the other side of the jump.
    fn cross(&mut self) {
        self.jumps += self.system.cross(self.time, self.step, &mut self.state);
        self.known = false;
        self.bent = false;
    }

    /// Whether the slope beyond the jump differs by so little that its place does not matter.
    fn is_hidden(&mut self, step: f64, reached: f64) -> bool {
        let mut beyond = vec![0.0; self.end.len()];
        self.system.peek(reached, &self.end, &mut beyond);
        let entries = beyond.iter().zip(&self.after).enumerate();
        for (k, (beyond, before)) in entries {
            let scale = self.system.scale(k, self.state[k], self.end[k]);
            let share = step * (beyond - before).abs() / (scale * self.tolerance);
            if !(share <= HIDDEN || *beyond == *before) {
                return false;
            }
        }
        true
    }

    /// Notes how the slope changes over a step.
    fn bend(&mut self, step: f64) {
        self.bends.clear();
        let slopes = self.slope.iter().zip(&self.after);
        self.bends
            .extend(slopes.map(|(before, after)| (after - before) / step));
        self.bent = true;
    }

    /// Whether a way along the slope, and its change, is as exact as a step.
    fn is_straight(&self, way: f64) -> bool {
        let entries = self.bends.iter().enumerate();
        entries
            .map(|(k, bend)| (k, 0.5 * way * way * bend.abs()))
            .all(|(k, bend)| {
                let scale = self.system.scale(k, self.state[k], self.state[k]);
                bend <= STRAIGHT * self.tolerance * scale
            })
    }

    /// Moves `end` along the slope, which is the one there.
    fn go_along(&mut self, way: f64) {
        let rates = self.slope.iter().zip(&self.bends);
        for (y, (slope, bend)) in self.end.iter_mut().zip(rates) {
            *y += way * (slope + 0.5 * way * bend);
        }
    }
}
