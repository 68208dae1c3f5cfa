//! Checks of patterns.

use super::Check;
use crate::world::spec::{BallPatternSpec, LinePatternSpec};

impl Check {
    pub(super) fn line_pattern(&mut self, path: &str, law: &LinePatternSpec) {
        self.direction(&format!("{path}.direction"), &law.direction);
        self.pull_to_pattern(path, law.strength);
    }

    pub(super) fn ball_pattern(&mut self, path: &str, law: &BallPatternSpec) {
        self.pull_to_pattern(path, law.strength);
    }

    /// Where the pattern is near, normalised or not, the strength is a stiffness.
    fn pull_to_pattern(&mut self, path: &str, strength: f64) {
        self.stiffness(&format!("{path}.strength"), strength);
    }
}
