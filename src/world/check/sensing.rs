//! Checks of sensing.

use super::{Check, size, whole_steps};
use crate::world::problem::Problem;
use crate::world::spec::{PerAgent, SensingSpec, WorldSpec};
use crate::world::words::number;

/// The most states of agents that delays may keep in memory; each takes up to 72 bytes.
const MOST_PAST_STATES: f64 = 5e7;

impl Check {
    pub(super) fn sensing(&mut self, path: &str, sensing: &SensingSpec, count: usize) {
        if let Some(PerAgent::Each(radii)) = &sensing.radius
            && radii.len() != count
        {
            let what = format!(
                "must list {count} radii, one for each agent, not {}",
                radii.len()
            );
            self.add(format!("{path}.radius"), what);
        }
        self.on_a_step(&format!("{path}.delay"), sensing.delay, self.step, 0);
    }

    /// Every agent's state is kept for as long as the longest delay.
    pub(super) fn memory_of_delays(&mut self, world: &WorldSpec) {
        let agents: f64 = world.agents.iter().filter_map(size).map(|n| n as f64).sum();
        for (index, group) in world.agents.iter().enumerate() {
            let delay = group.sensing.as_ref().map_or(0.0, |sensing| sensing.delay);
            let steps = delay.min(world.time.end) / world.time.step;
            if whole_steps(delay, self.step).is_some() && agents * steps > MOST_PAST_STATES {
                let most = (MOST_PAST_STATES / agents).floor() * self.step;
                let path = format!("agents[{index}].sensing.delay");
                let what = "keeps more past states of agents than fit in memory";
                let problem = Problem::new(path, what);
                self.problems
                    .push(problem.allowed(format!("at most {}", number(most))));
            }
        }
    }
}
