//! What only the fields of a world together can tell: lengths of vectors and
//! lists, order of limits, contradictions. What one field alone can tell, the
//! schema checks.

mod agents;
mod alignment;
mod drag;
mod law;
mod obstacle;
mod pair_force;
mod pattern;
mod sensing;
mod start;
mod steering;
mod summation;
mod time_function;
mod trajectory;

pub use law::velocity_to_follow;

pub use super::limits::{MOST_AGENTS, MOST_STEPS};

use std::collections::HashMap;

use super::limits::{MOST_PARTS, MOST_PROBLEMS, MOST_UNBOUNDED};
use super::problem::Problem;
use super::spec::*;
use super::validate;
use super::words::number;

/// Everything wrong with a world, wherever it comes from; of a
/// [`Document`](super::document::Document) that has been read, nothing is.
pub fn problems(world: &WorldSpec) -> Vec<Problem> {
    all_problems(world, Motion::OfBodies)
}

/// What the agents of a world are moved as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Motion {
    /// Rigid bodies, whose steps must be short enough for what the laws feed back.
    #[default]
    OfBodies,
    /// Points, whose solver chooses its own steps.
    OfPoints,
}

/// As [`problems`], of a world whose agents move as bodies or as points.
pub fn all_problems(world: &WorldSpec, motion: Motion) -> Vec<Problem> {
    let problems = match serde_json::to_value(world) {
        // What is not finite turns into null here, and so is found.
        Ok(value) => validate::problems(&value),
        Err(error) => vec![Problem::new("", error.to_string())],
    };
    match problems.is_empty() {
        true => joint_problems(world, motion),
        false => problems,
    }
}

/// Everything wrong with a world that agrees with the schema.
pub(super) fn joint_problems(world: &WorldSpec, motion: Motion) -> Vec<Problem> {
    let substeps = world.physics.solver_iterations;
    let mut check = Check {
        motion,
        ..Check::new(world.dimension, world.time.step, substeps)
    };
    check.time(&world.time, &world.record);
    if let Some(gravity) = &world.physics.gravity {
        check.vector("physics.gravity", gravity);
    }
    for (index, group) in world.agents.iter().enumerate() {
        if check.is_full() {
            return check.problems;
        }
        check.group(&format!("agents[{index}]"), group);
    }
    check.count(&world.agents);
    for (index, obstacle) in world.obstacles.iter().enumerate() {
        if check.is_full() {
            return check.problems;
        }
        check.obstacle(&format!("obstacles[{index}]"), obstacle);
    }
    check.number_of_parts(&world.obstacles);
    check.memory_of_delays(world);
    check.memory_of_records(world);
    check.laws(world);
    check.problems
}

/// How many whole steps make up a time; nothing where it is between two.
pub fn whole_steps(time: f64, step: f64) -> Option<u64> {
    let steps = time / step;
    let nearest = steps.round();
    // The quotient of two decimal fractions is off by rounding, relative to itself;
    // but a thousandth of a step is never rounding.
    let slack = (1e-9 * nearest).clamp(1e-9, 1e-3);
    let whole = nearest <= u64::MAX as f64 && (steps - nearest).abs() <= slack;
    whole.then_some(nearest as u64)
}

/// As [`whole_steps`], for a field that must have `least` or more.
///
/// # Errors
/// What is wrong with the field of this path.
pub fn on_a_step(path: &str, time: f64, step: f64, least: u64) -> Result<u64, Problem> {
    let steps = whole_steps(time, step).filter(|steps| *steps >= least);
    steps.ok_or_else(|| {
        let what = format!("must be a whole number of steps of {}", number(step));
        Problem {
            hint: nearest_times(time, step),
            ..Problem::new(path, what)
        }
    })
}

/// The number of agents of a group: as given, or as many as its positions make.
pub fn size(group: &GroupSpec) -> Option<usize> {
    start::positions(group).or(group.count)
}

/// Largest size of a number.
pub const LARGEST: f64 = 1e100;

struct Check {
    dimension: usize,
    step: f64,
    substeps: usize,
    motion: Motion,
    /// Agents of the world, and of each group.
    agents: usize,
    sizes: Vec<usize>,
    /// The groups of each name.
    named: HashMap<String, Vec<usize>>,
    /// The groups that the law being checked acts on; nothing for all of them.
    acted_on: Option<Vec<usize>>,
    /// For each group, the rate at which the laws in scopes checked so far damp its velocities.
    damped: Vec<f64>,
    /// As much for all groups, by laws in no scope.
    damped_all: f64,
    problems: Vec<Problem>,
}

impl Check {
    fn new(dimension: usize, step: f64, substeps: usize) -> Self {
        Self {
            dimension,
            step,
            substeps,
            motion: Motion::OfBodies,
            agents: 0,
            sizes: Vec::new(),
            named: HashMap::new(),
            acted_on: None,
            damped: Vec::new(),
            damped_all: 0.0,
            problems: Vec::new(),
        }
    }

    fn add(&mut self, path: impl Into<String>, what: impl Into<String>) {
        self.problems.push(Problem::new(path, what));
    }

    /// A vector must have as many numbers as the world has dimensions. Returns
    /// whether it does.
    fn vector(&mut self, path: &str, vector: &[f64]) -> bool {
        let fits = vector.len() == self.dimension;
        if !fits {
            let what = format!("must have {} numbers, not {}", self.dimension, vector.len());
            self.add(path, what);
        } else if !vector.iter().all(|x| x.abs() <= LARGEST) {
            // Squares of lengths must stay finite.
            let problem = Problem::new(path, "holds a number too large to compute with");
            self.problems.push(problem.allowed("-1e100 to 1e100"));
        }
        fits
    }

    fn optional_vector(&mut self, path: &str, vector: &Option<Vec<f64>>) {
        if let Some(vector) = vector {
            self.vector(path, vector);
        }
    }

    fn vectors(&mut self, path: &str, vectors: &[Vec<f64>]) {
        for (index, vector) in vectors.iter().enumerate() {
            self.vector(&format!("{path}[{index}]"), vector);
        }
    }

    /// A vector that gives a direction must have one.
    fn direction(&mut self, path: &str, vector: &[f64]) {
        if self.vector(path, vector) && !is_nonzero(vector) {
            self.add(path, "must not be all zeros, since it gives a direction");
        }
    }

    /// The corners of a box; they may share coordinates only where `flat`.
    fn corners(&mut self, path: &str, min: &[f64], max: &[f64], flat: bool) {
        let fits = self.vector(&format!("{path}.min"), min);
        if !self.vector(&format!("{path}.max"), max) || !fits {
            return;
        }
        for (axis, (low, high)) in min.iter().zip(max).enumerate() {
            if low > high || (low == high && !flat) {
                let bound = if flat { "at most" } else { "less than" };
                let what = format!(
                    "must be {bound} {}, its counterpart in `max`",
                    number(*high)
                );
                self.add(format!("{path}.min[{axis}]"), what);
            }
        }
    }

    fn time(&mut self, time: &TimeSpec, record: &RecordSpec) {
        let step = time.step;
        let most = MOST_STEPS as f64;
        if time.end / step > most {
            let what = format!("makes {} steps", number(time.end / step));
            let problem = Problem::new("time.end", what);
            self.problems
                .push(problem.allowed(format!("at most {}", number(most))));
        } else {
            self.on_a_step("time.end", time.end, step, 0);
        }
        self.on_a_step("record.every", record.every, step, 1);
    }

    /// A time must be a whole number of steps, and at least some number of them.
    fn on_a_step(&mut self, path: &str, time: f64, step: f64, least: u64) {
        self.problems
            .extend(on_a_step(path, time, step, least).err());
    }

    /// What may be absent must still be finite; the schema cannot tell, since
    /// JSON writes both as null.
    fn finite(&mut self, path: &str, x: Option<f64>) {
        if x.is_some_and(|x| !x.is_finite()) {
            self.add(path, "must be finite");
        }
    }

    /// Whether there are so many problems that no more are wanted.
    fn is_full(&self) -> bool {
        self.problems.len() >= MOST_PROBLEMS
    }

    /// Counts the agents, and notes who is called what.
    fn count(&mut self, groups: &[GroupSpec]) {
        self.sizes = groups.iter().map(|it| size(it).unwrap_or(0)).collect();
        let total = self.sizes.iter().copied().fold(0, usize::saturating_add);
        self.agents = total;
        if total > MOST_AGENTS {
            let problem = Problem::new("agents", format!("adds up to {total} agents"));
            self.problems
                .push(problem.allowed(format!("at most {MOST_AGENTS}")));
        }
        for (index, group) in groups.iter().enumerate() {
            if let Some(name) = &group.name {
                self.named.entry(name.clone()).or_default().push(index);
            }
        }
    }

    /// Obstacles are built part by part, and those without bounds are near everything.
    fn number_of_parts(&mut self, obstacles: &[ObstacleSpec]) {
        let mut parts = 0usize;
        let mut unbounded = 0;
        for (index, obstacle) in obstacles.iter().enumerate() {
            let (own, endless) = obstacle::parts(&obstacle.shape);
            (parts, unbounded) = (parts.saturating_add(own), unbounded + endless);
            let (kind, count, most) = if parts > MOST_PARTS {
                ("convex parts", parts, MOST_PARTS)
            } else if unbounded > MOST_UNBOUNDED {
                ("parts without bounds", unbounded, MOST_UNBOUNDED)
            } else {
                continue;
            };
            let what = format!("makes {count} {kind} of obstacles, with those before it");
            let problem = Problem::new(format!("obstacles[{index}].shape"), what);
            return self
                .problems
                .push(problem.allowed(format!("at most {most}")));
        }
    }
}

fn is_nonzero(vector: &[f64]) -> bool {
    vector.iter().any(|&x| x != 0.0)
}

/// The times on either side that are whole numbers of steps.
fn nearest_times(time: f64, step: f64) -> Option<String> {
    let steps = (time / step).floor();
    let (below, above) = (number(steps * step), number((steps + 1.0) * step));
    match steps >= 1.0 {
        // Steps far below rounding leave nothing to choose.
        _ if below == above => None,
        true => Some(format!("{below} or {above} would fit")),
        false => Some(format!("{above} would fit")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_steps_forgives_rounding_only() {
        assert_eq!(whole_steps(0.3, 0.1), Some(3));
        assert_eq!(whole_steps(60.0, 0.01), Some(6000));
        assert_eq!(whole_steps(0.0, 0.01), Some(0));
        assert_eq!(whole_steps(60.004, 0.01), None);
        assert_eq!(whole_steps(1e6 * 0.001, 0.001), Some(1_000_000));
        // A long run is no excuse for half a step.
        assert_eq!(whole_steps(1e7 + 0.005, 0.01), None);
        assert_eq!(whole_steps(1e300, 1e-10), None);
    }

    #[test]
    fn worlds_made_in_code_are_checked_as_well() {
        let text = crate::world::shipped::get("olfati-saber-2003/six-obstacles").unwrap();
        let right: WorldSpec = serde_json::from_str(text).unwrap();
        assert_eq!(problems(&right), []);
        let bad = |change: fn(&mut WorldSpec)| {
            let mut world = right.clone();
            change(&mut world);
            problems(&world)
                .into_iter()
                .map(|one| one.path)
                .collect::<Vec<_>>()
        };
        assert_eq!(bad(|world| world.time.step = 0.0), ["time.step"]);
        assert_eq!(
            bad(|world| world.physics.friction = f64::NAN),
            ["physics.friction"]
        );
        assert_eq!(
            bad(|world| world.agents[0].force_limit = Some(f64::INFINITY)),
            ["agents[0].force_limit"]
        );
        assert_eq!(
            bad(|world| world.physics.gravity = Some(vec![0.0])),
            ["physics.gravity"]
        );
        assert_eq!(bad(|world| world.record.every = 0.015), ["record.every"]);
    }
}
