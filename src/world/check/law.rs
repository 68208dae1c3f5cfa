//! Checks of laws.

use super::{Check, Motion, is_nonzero};
use crate::world::limits::MOST_LAWS;
use crate::world::problem::Problem;
use crate::world::spec::{
    ActionSpec, Feedback, GammaSpec, GroupSpec, LawSpec, NavigationSpec, ScopeSpec, Values,
    WorldSpec, acting_on, each_law,
};
use crate::world::words::{did_you_mean, number};

/// Names that a message lists.
const MOST_NAMED: usize = 20;

/// A list, and how many there are besides.
fn some_of<S: AsRef<str>>(listed: &[S], all: usize) -> String {
    let words: Vec<&str> = listed.iter().map(AsRef::as_ref).collect();
    match all > words.len() && words.len() == MOST_NAMED {
        true => format!("{}, …", words.join(", ")),
        false => words.join(", "),
    }
}

/// The velocity of the first navigation law that has one other than rest and acts on
/// every agent that laws in `scope` act on.
pub fn velocity_to_follow<'a>(
    world: &'a WorldSpec,
    scope: Option<&ScopeSpec>,
) -> Option<&'a Vec<f64>> {
    let covers = |other: Option<&ScopeSpec>| {
        // Groups are many, scopes few, and most are the same or none.
        other.is_none()
            || other.map(|it| &it.agents) == scope.map(|it| &it.agents)
            || acting_on(other, &world.agents)
                .into_iter()
                .zip(acting_on(scope, &world.agents))
                .all(|(covered, acts)| covered || !acts)
    };
    each_law(&world.laws).find_map(|(other, law)| match law {
        LawSpec::Navigation(law) => law
            .velocity
            .as_ref()
            .filter(|velocity| is_nonzero(velocity) && covers(other)),
        _ => None,
    })
}

impl Check {
    /// Checks the laws, and the scopes that they stand in.
    pub(super) fn laws(&mut self, world: &WorldSpec) {
        self.damped = vec![0.0; world.agents.len()];
        let laws = each_law(&world.laws).count();
        if laws > MOST_LAWS {
            let problem = Problem::new(
                "laws",
                format!("holds {laws} laws, those in scopes counted"),
            );
            let problem = problem.allowed(format!("at most {MOST_LAWS}"));
            return self.problems.push(problem);
        }
        for (index, law) in world.laws.iter().enumerate() {
            let path = format!("laws[{index}]");
            let LawSpec::Scope(scope) = law else {
                self.law(&path, law, None, world);
                continue;
            };
            let path = format!("{path}.scope");
            for (field, names) in [("agents", &scope.agents), ("neighbours", &scope.neighbours)] {
                for (index, name) in names.iter().flatten().enumerate() {
                    if self.is_full() {
                        return;
                    }
                    self.group_name(&format!("{path}.{field}[{index}]"), name, &world.agents);
                }
            }
            for (index, law) in scope.laws.iter().enumerate() {
                self.law(&format!("{path}.laws[{index}]"), law, Some(scope), world);
            }
        }
        self.damping_together();
    }

    /// A name must be that of one group.
    fn group_name(&mut self, path: &str, name: &str, groups: &[GroupSpec]) {
        let bearers = self.named.get(name).map_or(&[][..], Vec::as_slice);
        match bearers.len() {
            1 => {}
            0 => {
                // Of very many names, some.
                let known = groups.iter().filter_map(|it| it.name.as_deref());
                let known: Vec<&str> = known.take(MOST_NAMED).collect();
                let problem = Problem::new(path, "names no group");
                self.problems.push(match known.is_empty() {
                    true => problem.hint("give the groups names in `agents`"),
                    false => Problem {
                        hint: did_you_mean(name, known.iter().copied()),
                        ..problem.allowed(some_of(&known, groups.len()))
                    },
                });
            }
            count => {
                let bearers = bearers.iter().take(MOST_NAMED);
                let bearers: Vec<String> = bearers.map(|it| format!("agents[{it}]")).collect();
                let what = format!("names more than one group: {}", some_of(&bearers, count));
                let problem = Problem::new(path, what);
                self.problems
                    .push(problem.hint("give each group a name of its own"));
            }
        }
    }

    /// Checks a law; the world's other laws may give what it leaves out.
    fn law(&mut self, path: &str, law: &LawSpec, scope: Option<&ScopeSpec>, world: &WorldSpec) {
        self.acted_on = self.groups(scope);
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
                    let follows = velocity_to_follow(world, scope).is_some();
                    let is_scope = |law: &LawSpec| matches!(law, LawSpec::Scope(_));
                    let scoped = world.laws.iter().any(is_scope);
                    self.gamma(&format!("{path}.gamma"), gamma, scoped, follows);
                }
            }
            LawSpec::Navigation(law) => self.navigation(&format!("{path}.navigation"), law),
            LawSpec::HeadingConsensus(_) => {}
            LawSpec::Tracking(law) => {
                self.tracking(&format!("{path}.tracking"), law, scope);
            }
            LawSpec::Steering(law) => {
                self.steering(&format!("{path}.steering"), law, scope);
            }
            LawSpec::Flatness(law) => {
                self.flatness(&format!("{path}.flatness"), law, scope, world);
            }
            LawSpec::Alignment(law) => {
                self.alignment(&format!("{path}.alignment"), law, scope, world);
            }
            LawSpec::PairPotential(law) => {
                self.pair_potential(&format!("{path}.pair_potential"), law, scope, world);
            }
            LawSpec::CuckerDong(law) => self.cucker_dong(&format!("{path}.cucker_dong"), law),
            LawSpec::ParkBonding(law) => {
                self.park_bonding(&format!("{path}.park_bonding"), law, scope, world);
            }
            LawSpec::FirstOrderFlow(law) => {
                self.first_order_flow(&format!("{path}.first_order_flow"), law);
            }
            LawSpec::LinePattern(law) => self.line_pattern(&format!("{path}.line_pattern"), law),
            LawSpec::BallPattern(law) => self.ball_pattern(&format!("{path}.ball_pattern"), law),
            LawSpec::Friction(law) => {
                self.friction(&format!("{path}.friction"), law, scope, world);
            }
            LawSpec::FrictionCompensation(law) => {
                let path = format!("{path}.friction_compensation");
                self.friction_compensation(&path, law, scope);
            }
            LawSpec::SelfPropulsion(law) => {
                self.self_propulsion(&format!("{path}.self_propulsion"), law, scope, world);
            }
            LawSpec::Scope(_) => {
                let problem = Problem::with_name(format!("{path}.scope"), "is inside a scope");
                self.problems
                    .push(problem.hint("scopes stand side by side, each in `laws`"));
            }
        }
    }

    /// Linear feedback on the velocity is stable at rates below 2n²/((n + 1)(2n − 1)) over
    /// the step only, with n substeps (see the coupling of laws to bodies);
    /// above, the run would be noise.
    pub(super) fn damping(&mut self, path: &str, times: &str, rate: f64) {
        let n = self.substeps as f64;
        let limit = 2.0 * n * n / ((n + 1.0) * (2.0 * n - 1.0));
        let before = self.problems.len();
        self.stable(path, times, rate, limit / self.step);
        if self.problems.len() == before {
            match &self.acted_on {
                None => self.damped_all += rate,
                Some(groups) => groups.iter().for_each(|&it| self.damped[it] += rate),
            }
        }
    }

    /// Laws that are stable one by one may not be so together.
    fn damping_together(&mut self) {
        self.acted_on = Some(Vec::new());
        for (group, rate) in std::mem::take(&mut self.damped).into_iter().enumerate() {
            let rate = rate + self.damped_all;
            let before = self.problems.len();
            let what = format!(
                "damp the velocities of agents[{group}] at {} together,",
                number(rate)
            );
            self.damping("laws", &format!("{what} which"), rate);
            if self.problems.len() > before {
                return;
            }
        }
    }

    /// Linear feedback on the position is stable at stiffnesses (1/time²) below 4/step²: an
    /// oscillator of frequency ω needs ωh < 2.
    pub(super) fn stiffness(&mut self, path: &str, stiffness: f64) {
        self.stable(path, "", stiffness, 4.0 / (self.step * self.step));
    }

    fn stable(&mut self, path: &str, times: &str, rate: f64, limit: f64) {
        // Points' solver chooses its own steps.
        if rate >= limit && self.motion == Motion::OfBodies {
            let limit = number(limit);
            let what = format!("{times} must be below {limit} to be stable at this step");
            let problem = Problem::new(path, what.trim_start());
            self.problems.push(problem.hint("a smaller `time.step`"));
        }
    }

    /// The groups that laws in a scope act on; nothing for all of them.
    fn groups(&self, scope: Option<&ScopeSpec>) -> Option<Vec<usize>> {
        let names = scope?.agents.as_ref()?;
        let groups = names.iter().filter_map(|name| self.named.get(name));
        let mut groups: Vec<usize> = groups.flatten().copied().collect();
        groups.sort_unstable();
        groups.dedup();
        Some(groups)
    }

    /// A list with one entry for each agent that a law acts on must have that many.
    pub(super) fn one_for_each(&mut self, path: &str, entries: usize, scope: Option<&ScopeSpec>) {
        let agents = match self.groups(scope) {
            None => self.agents,
            Some(groups) => groups
                .iter()
                .map(|&it| self.sizes[it])
                .fold(0, usize::saturating_add),
        };
        if entries != agents {
            let what = format!("must have {agents} entries, one for each agent, not {entries}");
            self.add(path, what);
        }
    }

    /// Values for each agent that a law acts on.
    pub(super) fn values(&mut self, path: &str, values: &Values, scope: Option<&ScopeSpec>) {
        if let Values::Each(values) = values {
            self.one_for_each(path, values.len(), scope);
        }
    }

    fn action(&mut self, law: &str, action: &ActionSpec) {
        if action.repulsion < action.attraction {
            let least = number(action.attraction);
            let what = format!("must be at least {least}, the attraction");
            self.add(format!("{law}.action.repulsion"), what);
        }
    }

    fn gamma(&mut self, path: &str, gamma: &GammaSpec, scoped: bool, follows: bool) {
        if let Some(direction) = &gamma.direction {
            self.direction(&format!("{path}.direction"), direction);
        } else if !follows {
            let agents = if scoped {
                " for all of these agents"
            } else {
                ""
            };
            let what = format!(
                "missing field `direction`, as no navigation law{agents} has a velocity to follow"
            );
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
                self.stiffness(&format!("{path}.position_gain"), law.position_gain);
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
