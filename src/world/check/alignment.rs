//! Checks of velocity alignment.

use super::drag::largest_rate;
use super::{Check, LARGEST, size};
use crate::world::limits::MOST_ARCS;
use crate::world::problem::Problem;
use crate::world::spec::{
    ActsAs, AlignmentSpec, GainSpec, GraphSpec, KernelSpec, NormalisationSpec, OpenLoopSpec,
    RelaxationSpec, ScopeSpec, Values, VaryingGainSpec, WorldSpec, seen_by,
};
use crate::world::words::number;

impl Check {
    /// Checks an alignment law.
    pub(super) fn alignment(
        &mut self,
        path: &str,
        law: &AlignmentSpec,
        scope: Option<&ScopeSpec>,
        world: &WorldSpec,
    ) {
        self.finite(&format!("{path}.range"), law.range);
        self.alignment_summation(path, law, scope, world);
        let at_zero = law.kernel.influence().largest();
        if at_zero > LARGEST {
            let what = format!("gives an influence of {} at distance 0", number(at_zero));
            let problem = Problem::new(format!("{path}.kernel"), what);
            self.problems.push(problem.allowed("at most 1e100"));
        }
        if let Some(sight) = &law.line_of_sight
            && (sight.agents, sight.obstacles) == (1.0, 1.0)
        {
            let what = "changes nothing: must have a factor below 1 for `agents` or `obstacles`";
            self.add(format!("{path}.line_of_sight"), what);
        }
        self.gain(&format!("{path}.gain"), &law.gain, scope);
        if let Some(graph) = &law.graph {
            self.graph(&format!("{path}.graph"), graph);
        }
        if law.relaxation == RelaxationSpec::Never
            && let Some(rate) = rate(law, scope, world)
        {
            let times = match law.acts_as {
                _ if law.epsilon != 1.0 => "over epsilon, times the largest sum of influences,",
                ActsAs::Force => "over the mass, times the largest sum of influences,",
                ActsAs::Acceleration => "times the largest sum of influences",
            };
            self.damping(&format!("{path}.gain"), times, rate);
        }
    }

    fn gain(&mut self, path: &str, gain: &GainSpec, scope: Option<&ScopeSpec>) {
        match gain {
            GainSpec::Constant(values) => self.values(path, values, scope),
            GainSpec::Varying(VaryingGainSpec::Bounded { bound, scale }) => {
                let path = format!("{path}.bounded");
                self.values(&format!("{path}.bound"), bound, scope);
                self.values(&format!("{path}.scale"), scale, scope);
                let (single, list) = match scale {
                    Values::All(scale) => (Some(*scale), &[][..]),
                    Values::Each(scales) => (None, &scales[..]),
                };
                let entries = list.iter().enumerate();
                let paths =
                    entries.map(|(index, scale)| (format!("{path}.scale[{index}]"), *scale));
                let single = single.map(|scale| (format!("{path}.scale"), scale));
                for (path, scale) in single.into_iter().chain(paths) {
                    if scale == 0.0 {
                        let problem = Problem::new(path, "must be greater than 0");
                        self.problems.push(problem.allowed("greater than 0"));
                    }
                }
            }
            GainSpec::Varying(VaryingGainSpec::OpenLoop(functions)) => {
                let path = format!("{path}.open_loop");
                match functions {
                    OpenLoopSpec::All(function) => self.time_function(&path, function, Some(0.0)),
                    OpenLoopSpec::Each(functions) => {
                        self.one_for_each(&path, functions.len(), scope);
                        for (index, function) in functions.iter().enumerate() {
                            self.time_function(&format!("{path}[{index}]"), function, Some(0.0));
                        }
                    }
                }
            }
        }
    }

    fn graph(&mut self, path: &str, graph: &GraphSpec) {
        let agents = self.agents;
        let most = agents.saturating_mul(agents.saturating_sub(1));
        match graph {
            GraphSpec::Matrix(rows) => {
                let path = format!("{path}.matrix");
                if self.square(&path, rows, agents) {
                    for (index, row) in rows.iter().enumerate() {
                        self.numbers(&format!("{path}[{index}]"), row);
                        if row[index] != 0.0 {
                            let what = "must be 0: no agent follows itself";
                            self.add(format!("{path}[{index}][{index}]"), what);
                        }
                    }
                }
            }
            GraphSpec::OpenLoop(rows) => {
                let path = format!("{path}.open_loop");
                if self.square(&path, rows, agents) {
                    for (i, row) in rows.iter().enumerate() {
                        for (j, function) in row.iter().enumerate() {
                            self.time_function(&format!("{path}[{i}][{j}]"), function, Some(0.0));
                        }
                    }
                }
            }
            GraphSpec::Complete { .. } if most > MOST_ARCS => {
                let what = format!("makes {most} arcs");
                let problem = Problem::new(format!("{path}.complete"), what);
                let problem = problem.allowed(format!("at most {MOST_ARCS}"));
                self.problems
                    .push(problem.hint("without a graph, a constant kernel joins all"));
            }
            GraphSpec::Random { arcs, .. } if *arcs < agents || *arcs > most.min(MOST_ARCS) => {
                let path = format!("{path}.random.arcs");
                if agents < 2 {
                    return self.add(path, "needs two agents or more to join");
                }
                let what = format!("does not fit a graph that joins {agents} agents");
                let allowed = match agents <= MOST_ARCS {
                    true => format!("{agents} to {}", most.min(MOST_ARCS)),
                    false => format!("at most {MOST_ARCS} agents"),
                };
                self.problems
                    .push(Problem::new(path, what).allowed(allowed));
            }
            GraphSpec::Ring { .. } | GraphSpec::Complete { .. } | GraphSpec::Random { .. } => {}
        }
    }

    /// A matrix must have one row and one column for each agent. Returns whether it does.
    fn square<T>(&mut self, path: &str, rows: &[Vec<T>], agents: usize) -> bool {
        let known = self.problems.len();
        let mut count = |path: String, found: usize, what: &str| {
            if found != agents {
                let what = format!("must have {agents} {what}, one for each agent, not {found}");
                self.add(path, what);
            }
        };
        count(path.to_owned(), rows.len(), "rows");
        for (index, row) in rows.iter().enumerate() {
            count(format!("{path}[{index}]"), row.len(), "entries");
        }
        self.problems.len() == known
    }
}

/// The law's rate at its largest, where the file alone tells it: where the influences on an
/// agent add up to 1, or are the same at any distance and weakened by nothing.
fn rate(law: &AlignmentSpec, scope: Option<&ScopeSpec>, world: &WorldSpec) -> Option<f64> {
    let gain = match &law.gain {
        GainSpec::Constant(values) => values.largest(),
        GainSpec::Varying(VaryingGainSpec::Bounded {
            bound: Values::All(bound),
            scale: Values::All(scale),
        }) => bound / scale,
        GainSpec::Varying(_) => return None,
    };
    let gain = largest_rate(law.acts_as, std::iter::repeat(gain), scope, world);
    let seen = (world.agents.iter().zip(seen_by(scope, &world.agents)))
        .filter_map(|(group, seen)| size(group).filter(|_| seen))
        .fold(0, usize::saturating_add) as f64;
    let plain = law.range.is_none()
        && law.graph.is_none()
        && law.orientation.is_none()
        && law.masking.is_none()
        && law.line_of_sight.is_none();
    let sum = match (law.normalisation, &law.kernel) {
        (NormalisationSpec::MotschTadmor, _) => 1.0,
        (NormalisationSpec::None, KernelSpec::Constant { strength }) if plain => {
            strength * (seen - 1.0).max(0.0)
        }
        (NormalisationSpec::MeanField, KernelSpec::Constant { strength }) if plain => {
            strength * (1.0 - 1.0 / seen.max(1.0))
        }
        _ => return None,
    };
    Some(gain / law.epsilon * sum)
}
