//! What only the fields of a world together can tell: lengths of vectors and
//! lists, order of limits, contradictions. What one field alone can tell, the
//! schema checks.

use super::overlap;
use super::problem::Problem;
use super::spec::*;
use super::words::number;

/// The most agents that a world may have.
pub const MOST_AGENTS: usize = 10_000_000;

/// The most steps that a run may take.
pub const MOST_STEPS: u64 = 10_000_000_000;

/// Everything wrong with a world that agrees with the schema.
pub fn problems(world: &WorldSpec) -> Vec<Problem> {
    let mut check = Check {
        dimension: world.dimension,
        problems: Vec::new(),
    };
    check.time(&world.time, &world.record);
    if let Some(gravity) = &world.physics.gravity {
        check.vector("physics.gravity", gravity);
    }
    for (index, group) in world.agents.iter().enumerate() {
        check.group(&format!("agents[{index}]"), group);
    }
    check.number_of_agents(&world.agents);
    for (index, obstacle) in world.obstacles.iter().enumerate() {
        check.obstacle(&format!("obstacles[{index}]"), obstacle);
    }
    for (index, law) in world.laws.iter().enumerate() {
        check.law(&format!("laws[{index}]"), law, &world.laws);
    }
    check.problems.extend(overlap::problems(world));
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

/// The number of agents of a group: as given, or as many as it lists positions.
pub fn size(group: &GroupSpec) -> Option<usize> {
    match &group.positions {
        PlacementSpec::Explicit(positions) => Some(positions.len()),
        PlacementSpec::Box(_) | PlacementSpec::Ball(_) => group.count,
    }
}

/// Whether a navigation law names a velocity other than rest.
pub fn moves(navigation: &NavigationSpec) -> bool {
    navigation.velocity.as_deref().is_some_and(is_nonzero)
}

struct Check {
    dimension: usize,
    problems: Vec<Problem>,
}

impl Check {
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
        } else if !vector.iter().all(|x| x.is_finite()) {
            self.add(path, "must hold finite numbers");
        }
        fits
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
        let wanted = format!("must be a whole number of steps of {}", number(step));
        match whole_steps(time.end, step) {
            None => self.problems.push(
                Problem::new("time.end", wanted.as_str()).hint(nearest_times(time.end, step)),
            ),
            Some(steps) if steps > MOST_STEPS => {
                let what = format!("makes {} steps", number(steps as f64));
                let most = format!("at most {}", number(MOST_STEPS as f64));
                self.problems
                    .push(Problem::new("time.end", what).allowed(most));
            }
            Some(_) => {}
        }
        if whole_steps(record.every, step).is_none_or(|steps| steps == 0) {
            let problem = Problem::new("record.every", wanted);
            self.problems
                .push(problem.hint(nearest_times(record.every, step)));
        }
    }

    fn group(&mut self, path: &str, group: &GroupSpec) {
        let positions = format!("{path}.positions");
        match &group.positions {
            PlacementSpec::Explicit(listed) => self.listed(path, listed, group.count),
            PlacementSpec::Box(place) => {
                self.corners(&format!("{positions}.box"), &place.min, &place.max, false);
            }
            PlacementSpec::Ball(place) => {
                self.vector(&format!("{positions}.ball.center"), &place.center);
            }
        }
        let Some(count) = size(group) else {
            self.add(path, "missing field `count`, which random positions need");
            return;
        };
        if let PerAgent::Each(masses) = &group.mass
            && masses.len() != count
        {
            let what = format!(
                "must list {count} masses, one for each agent, not {}",
                masses.len()
            );
            self.add(format!("{path}.mass"), what);
        }
        let path = format!("{path}.velocities");
        match &group.velocities {
            VelocitySpec::Rest => {}
            VelocitySpec::Common(velocity) => {
                self.vector(&format!("{path}.common"), velocity);
            }
            VelocitySpec::Uniform(place) => {
                self.corners(&format!("{path}.uniform"), &place.min, &place.max, true);
            }
            VelocitySpec::Explicit(listed) => {
                let path = format!("{path}.explicit");
                self.vectors(&path, listed);
                if listed.len() != count {
                    let found = listed.len();
                    let what =
                        format!("must list {count} velocities, one for each agent, not {found}");
                    self.add(path, what);
                }
            }
        }
    }

    fn listed(&mut self, group: &str, positions: &[Vec<f64>], count: Option<usize>) {
        let path = format!("{group}.positions.explicit");
        if positions.is_empty() {
            self.add(path, "must list at least one position");
            return;
        }
        self.vectors(&path, positions);
        if count.is_some_and(|count| count != positions.len()) {
            let what = format!(
                "must be {}, the number of positions listed",
                positions.len()
            );
            let problem = Problem::new(format!("{group}.count"), what);
            self.problems.push(problem.hint("it may be left out"));
        }
    }

    fn number_of_agents(&mut self, groups: &[GroupSpec]) {
        let total = groups
            .iter()
            .filter_map(size)
            .fold(0, usize::saturating_add);
        if total > MOST_AGENTS {
            let problem = Problem::new("agents", format!("makes {total} agents in all"));
            self.problems
                .push(problem.allowed(format!("at most {MOST_AGENTS}")));
        }
    }

    fn obstacle(&mut self, path: &str, obstacle: &ObstacleSpec) {
        if let Some(position) = &obstacle.position {
            self.vector(&format!("{path}.position"), position);
        }
        let rotation = format!("{path}.rotation");
        match &obstacle.rotation {
            Some(Rotation::Vector(vector)) if self.dimension == 3 => {
                self.vector(&rotation, vector);
            }
            Some(Rotation::Vector(_)) => {
                self.add(rotation, "must be one number in 2-D, the angle in radians");
            }
            Some(Rotation::Angle(_)) if self.dimension == 3 => {
                self.add(
                    rotation,
                    "must be 3 numbers in 3-D, the axis times the angle in radians",
                );
            }
            Some(Rotation::Angle(_)) | None => {}
        }
        self.shape(&format!("{path}.shape"), &obstacle.shape);
    }

    fn shape(&mut self, path: &str, shape: &ShapeSpec) {
        match shape {
            ShapeSpec::Ball { .. } => {}
            ShapeSpec::Cuboid { half_extents } => {
                self.vector(&format!("{path}.cuboid.half_extents"), half_extents);
            }
            ShapeSpec::Capsule { from, to, .. } => {
                let (start, end) = (format!("{path}.capsule.from"), format!("{path}.capsule.to"));
                let fits = self.vector(&start, from);
                if self.vector(&end, to) && fits && from == to {
                    let problem = Problem::new(end, "must differ from `from`");
                    self.problems
                        .push(problem.hint("a capsule without length is a ball"));
                }
            }
            ShapeSpec::HalfSpace { normal } => {
                self.direction(&format!("{path}.half_space.normal"), normal);
            }
            ShapeSpec::Convex { points } => self.hull(&format!("{path}.convex.points"), points),
        }
    }

    fn hull(&mut self, path: &str, points: &[Vec<f64>]) {
        self.vectors(path, points);
        if points.iter().any(|point| point.len() != self.dimension) {
            return;
        }
        if points.len() <= self.dimension {
            let what = format!("must have at least {} points", self.dimension + 1);
            self.add(path, what);
        } else if rank(points) < self.dimension {
            let flat = if self.dimension == 2 { "line" } else { "plane" };
            self.add(path, format!("must not all lie on one {flat}"));
        }
    }

    fn law(&mut self, path: &str, law: &LawSpec, laws: &[LawSpec]) {
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
                if let Some(gamma) = &law.gamma {
                    self.gamma(&format!("{path}.gamma"), gamma, laws);
                }
            }
            LawSpec::Navigation(law) => self.navigation(&format!("{path}.navigation"), law),
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

fn is_nonzero(vector: &[f64]) -> bool {
    vector.iter().any(|&x| x != 0.0)
}

/// The times on either side that are whole numbers of steps.
fn nearest_times(time: f64, step: f64) -> String {
    let below = (time / step).floor();
    let above = number((below + 1.0) * step);
    if below < 1.0 {
        return format!("{above} would fit");
    }
    format!("{} or {above} would fit", number(below * step))
}

/// Dimension of the smallest flat that holds all points, up to 1e-9 of their
/// spread: each round takes the point farthest from the flat so far into it.
fn rank(points: &[Vec<f64>]) -> usize {
    let Some(origin) = points.first() else {
        return 0;
    };
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let from_origin =
        |point: &Vec<f64>| -> Vec<f64> { point.iter().zip(origin).map(|(x, o)| x - o).collect() };
    let mut rest: Vec<Vec<f64>> = points.iter().map(from_origin).collect();
    let spread = rest.iter().map(|v| length(v)).fold(0.0, f64::max);
    for rank in 0..origin.len() {
        let farthest = rest.iter().max_by(|a, b| length(a).total_cmp(&length(b)));
        let Some(axis) = farthest.filter(|v| length(v) > 1e-9 * spread).cloned() else {
            return rank;
        };
        let square = length(&axis).powi(2);
        for v in &mut rest {
            let share = v.iter().zip(&axis).map(|(x, a)| x * a).sum::<f64>() / square;
            v.iter_mut().zip(&axis).for_each(|(x, a)| *x -= share * a);
        }
    }
    origin.len()
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
    fn rank_counts_directions() {
        let points = |list: &[[f64; 3]]| list.iter().map(|p| p.to_vec()).collect::<Vec<_>>();
        assert_eq!(rank(&points(&[[1.0, 2.0, 3.0]; 4])), 0);
        assert_eq!(rank(&points(&[[0.0; 3], [1.0; 3], [2.0; 3], [-5.0; 3]])), 1);
        let square = [
            [0.0, 0.0, 7.0],
            [1.0, 0.0, 7.0],
            [1.0, 1.0, 7.0],
            [0.0, 1.0, 7.0],
        ];
        assert_eq!(rank(&points(&square)), 2);
        let far = 1e6;
        let corner = [
            [far, far, far],
            [far + 1.0, far, far],
            [far, far + 1.0, far],
            [far, far, far + 1e-3],
        ];
        assert_eq!(rank(&points(&corner)), 3);
        let mut nearly_flat = square;
        nearly_flat[3][2] += 1e-11;
        assert_eq!(rank(&points(&nearly_flat)), 2);
    }
}
