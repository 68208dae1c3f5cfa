//! Checks of laws.

use super::{Check, is_nonzero, moves};
use crate::world::problem::Problem;
use crate::world::spec::{ActionSpec, Feedback, GammaSpec, LawSpec, NavigationSpec};
use crate::world::words::number;

impl Check {
    /// Checks a law; those that it stands among may give what it leaves out.
    pub(super) fn law(&mut self, path: &str, law: &LawSpec, laws: &[LawSpec]) {
        match law {
            LawSpec::AlphaInteraction(law) => {
                let path = format!("{path}.alpha_interaction");
                if law.spacing >= law.range {
                    let what = format!("must be less than {}, the range", number(law.range));
                    self.add(format!("{path}.spacing"), what);
                }
                self.action(&path, &law.action);
            }
            LawSpec::ObstacleAvoidance(law) => {
                let path = format!("{path}.obstacle_avoidance");
                if law.standoff > law.range {
                    let what = format!("must be at most {}, the range", number(law.range));
                    self.add(format!("{path}.standoff"), what);
                }
                self.action(&path, &law.action);
                let rate = law.gain * law.damping;
                self.damping(&format!("{path}.damping"), "times the gain", rate);
                if let Some(gamma) = &law.gamma {
                    self.gamma(&format!("{path}.gamma"), gamma, laws);
                }
            }
            LawSpec::Navigation(law) => self.navigation(&format!("{path}.navigation"), law),
        }
    }

    /// Linear feedback on the velocity is stable at rates below 2n²/((n + 1)(2n − 1)) over
    /// the step only, with n substeps (see the coupling of laws to bodies);
    /// above, the run would be noise.
    fn damping(&mut self, path: &str, times: &str, rate: f64) {
        let n = self.substeps as f64;
        let limit = 2.0 * n * n / ((n + 1.0) * (2.0 * n - 1.0));
        self.stable(path, times, rate, limit / self.step);
    }

    fn stable(&mut self, path: &str, times: &str, rate: f64, limit: f64) {
        if rate >= limit {
            let limit = number(limit);
            let what = format!("{times} must be below {limit} to be stable at this step");
            let problem = Problem::new(path, what.trim_start());
            self.problems.push(problem.hint("a smaller `time.step`"));
        }
    }

    fn action(&mut self, law: &str, action: &ActionSpec) {
        if action.repulsion < action.attraction {
            let least = number(action.attraction);
            let what = format!("must be at least {least}, the attraction");
            self.add(format!("{law}.action.repulsion"), what);
        }
    }

    fn gamma(&mut self, path: &str, gamma: &GammaSpec, laws: &[LawSpec]) {
        if let Some(direction) = &gamma.direction {
            self.direction(&format!("{path}.direction"), direction);
            return;
        }
        let follows = |law: &LawSpec| matches!(law, LawSpec::Navigation(law) if moves(law));
        if !laws.iter().any(follows) {
            let what = "missing field `direction`, as no navigation law has a velocity to follow";
            self.add(path, what);
        }
    }

    fn navigation(&mut self, path: &str, law: &NavigationSpec) {
        if law.destination.is_none() && law.velocity.is_none() {
            self.add(path, "must have a `destination` or a `velocity`");
        }
        if law.feedback == Feedback::Linear {
            self.damping(&format!("{path}.velocity_gain"), "", law.velocity_gain);
            if law.destination.is_some() {
                // An oscillator of frequency ω needs ωh < 2.
                let limit = 4.0 / (self.step * self.step);
                self.stable(
                    &format!("{path}.position_gain"),
                    "",
                    law.position_gain,
                    limit,
                );
            }
        }
        if let Some(destination) = &law.destination {
            self.vector(&format!("{path}.destination"), destination);
        }
        if let Some(velocity) = &law.velocity {
            let at = format!("{path}.velocity");
            if self.vector(&at, velocity) && law.destination.is_some() && is_nonzero(velocity) {
                let what = "contradicts the destination, at which agents come to rest";
                self.problems
                    .push(Problem::new(at, what).hint("keep one of the two"));
            }
        }
    }
}
