//! Checks of laws that steer along given courses.

use super::Check;
use crate::world::problem::Problem;
use crate::world::spec::{
    FlatnessSpec, LawSpec, ScopeSpec, SteeringSpec, TimeFunctionSpec, TrackingSpec,
    TrajectoriesSpec, TrajectorySpec, WorldSpec, acting_on, each_law,
};

impl Check {
    pub(super) fn tracking(&mut self, path: &str, law: &TrackingSpec, scope: Option<&ScopeSpec>) {
        self.just_one(
            path,
            [
                ("target", law.target.is_some()),
                ("targets", law.targets.is_some()),
            ],
        );
        if let Some(target) = &law.target {
            self.trajectory(&format!("{path}.target"), target);
        }
        if let Some(targets) = &law.targets {
            self.trajectories(&format!("{path}.targets"), targets, scope);
        }
        self.feedback(path, law.position_gain, law.velocity_gain);
    }

    pub(super) fn steering(&mut self, path: &str, law: &SteeringSpec, scope: Option<&ScopeSpec>) {
        self.just_one(
            path,
            [
                ("acceleration", law.acceleration.is_some()),
                ("accelerations", law.accelerations.is_some()),
            ],
        );
        if let Some(functions) = &law.acceleration {
            self.vector_of_time(&format!("{path}.acceleration"), functions);
        }
        if let Some(each) = &law.accelerations {
            let path = format!("{path}.accelerations");
            self.one_for_each(&path, each.len(), scope);
            for (index, functions) in each.iter().enumerate() {
                self.vector_of_time(&format!("{path}[{index}]"), functions);
            }
        }
    }

    pub(super) fn flatness(
        &mut self,
        path: &str,
        law: &FlatnessSpec,
        scope: Option<&ScopeSpec>,
        world: &WorldSpec,
    ) {
        let trajectories = format!("{path}.trajectories");
        self.trajectories(&trajectories, &law.trajectories, scope);
        if let TrajectoriesSpec::Each(each) = &law.trajectories {
            let jumping = |(_, trajectory): &(usize, &TrajectorySpec)| trajectory.jumps();
            for (index, _) in each.iter().enumerate().filter(jumping) {
                let what = "has a velocity that jumps, which no finite steering can fly";
                let problem = Problem::new(format!("{trajectories}[{index}]"), what);
                self.problems
                    .push(problem.hint("a `spline` through the same points can be flown"));
            }
        }
        self.feedback(path, law.position_gain, law.velocity_gain);
        // Each would add what is missing in full.
        let acts = acting_on(scope, &world.agents);
        let earlier = each_law(&world.laws).take_while(
            |(_, other)| !matches!(other, LawSpec::Flatness(it) if std::ptr::eq(it, law)),
        );
        let twice = earlier
            .filter(|(_, other)| matches!(other, LawSpec::Flatness(_)))
            .find_map(|(other, _)| {
                let others = acting_on(other, &world.agents);
                acts.iter()
                    .zip(others)
                    .position(|(acts, other)| *acts && other)
            });
        if let Some(index) = twice {
            let what = format!("agents[{index}] is steered by another flatness law already");
            let problem = Problem::new(path, what);
            self.problems
                .push(problem.hint("let each act on groups of its own, by scopes"));
        }
    }

    /// A linear feedback on position and velocity must be stable.
    pub(super) fn feedback(&mut self, path: &str, position_gain: f64, velocity_gain: f64) {
        self.damping(&format!("{path}.velocity_gain"), "", velocity_gain);
        self.stiffness(&format!("{path}.position_gain"), position_gain);
    }

    /// Of two fields of which each takes the other's place there must be one.
    fn just_one(&mut self, path: &str, fields: [(&str, bool); 2]) {
        match fields {
            [(a, false), (b, false)] => self.add(path, format!("must have `{a}` or `{b}`")),
            [(_, true), (b, true)] => {
                let [(a, _), _] = fields;
                let problem = Problem::new(format!("{path}.{b}"), format!("contradicts `{a}`"));
                self.problems.push(problem.hint("keep one of the two"));
            }
            _ => {}
        }
    }

    /// One function of time for each dimension.
    fn vector_of_time(&mut self, path: &str, functions: &[TimeFunctionSpec]) {
        if functions.len() != self.dimension {
            let (needed, found) = (self.dimension, functions.len());
            let what =
                format!("must have {needed} functions of time, one along each axis, not {found}");
            return self.add(path, what);
        }
        for (index, function) in functions.iter().enumerate() {
            self.time_function(&format!("{path}[{index}]"), function, None);
        }
    }
}
