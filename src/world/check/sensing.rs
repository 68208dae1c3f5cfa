//! Checks of sensing.

use super::{Check, whole_steps};
use crate::world::limits::{MOST_IN_LAWS, MOST_IN_NET};
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

    /// What is recorded must be had in some time, and fit in memory.
    pub(super) fn memory_of_records(&mut self, world: &WorldSpec) {
        for (field, on, most) in [
            ("net", world.record.net, MOST_IN_NET),
            ("laws", world.record.laws, MOST_IN_LAWS),
        ] {
            if on && self.agents > most {
                let what = format!(
                    "must be false for {} agents: its time grows too fast with their number",
                    self.agents
                );
                let problem = Problem::new(format!("record.{field}"), what);
                self.problems
                    .push(problem.allowed(format!("true for at most {most} agents")));
            }
        }
    }

    /// Every agent's state is kept for as long as the longest delay.
    pub(super) fn memory_of_delays(&mut self, world: &WorldSpec) {
        let agents = self.agents as f64;
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
