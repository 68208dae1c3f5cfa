//! Checks of trajectories.

use super::Check;
use crate::world::problem::Problem;
use crate::world::spec::{
    FormationSpec, MillRingSpec, NumbersSpec, ScopeSpec, TrajectoriesSpec, TrajectorySpec,
};

impl Check {
    /// Checks the trajectories of the agents that a law acts on.
    pub(super) fn trajectories(
        &mut self,
        path: &str,
        trajectories: &TrajectoriesSpec,
        scope: Option<&ScopeSpec>,
    ) {
        match trajectories {
            TrajectoriesSpec::Each(trajectories) => {
                self.one_for_each(path, trajectories.len(), scope);
                for (index, trajectory) in trajectories.iter().enumerate() {
                    self.trajectory(&format!("{path}[{index}]"), trajectory);
                }
            }
            TrajectoriesSpec::Formation(FormationSpec::MillRing(ring)) => {
                self.mill_ring(&format!("{path}.mill_ring"), ring, scope);
            }
        }
    }

    /// Checks one trajectory.
    pub(super) fn trajectory(&mut self, path: &str, trajectory: &TrajectorySpec) {
        match trajectory {
            TrajectorySpec::Line { start, velocity } => {
                self.vector(&format!("{path}.line.start"), start);
                self.optional_vector(&format!("{path}.line.velocity"), velocity);
            }
            TrajectorySpec::Circle { center, axis, .. } => {
                self.vector(&format!("{path}.circle.center"), center);
                self.axis_in_space(&format!("{path}.circle.axis"), axis);
            }
            TrajectorySpec::Ellipse {
                center,
                first,
                second,
                ..
            } => {
                for (name, numbers) in [("center", center), ("first", first), ("second", second)] {
                    self.vector(&format!("{path}.ellipse.{name}"), numbers);
                }
            }
            TrajectorySpec::Lissajous {
                center,
                amplitudes,
                angular_velocities,
                phases,
            } => {
                let path = format!("{path}.lissajous");
                self.vector(&format!("{path}.center"), center);
                self.vector(&format!("{path}.amplitudes"), amplitudes);
                self.vector(&format!("{path}.angular_velocities"), angular_velocities);
                self.optional_vector(&format!("{path}.phases"), phases);
            }
            TrajectorySpec::Waypoints { times, points } => {
                self.points_in_time(&format!("{path}.waypoints"), times, points);
            }
            TrajectorySpec::Spline {
                times,
                points,
                periodic,
            } => {
                let path = format!("{path}.spline");
                self.points_in_time(&path, times, points);
                if !periodic {
                    return;
                }
                if points.len() < 4 {
                    let what = "must have at least 4 points to be periodic";
                    self.add(format!("{path}.points"), what);
                } else if points.first() != points.last() {
                    let path = format!("{path}.points[{}]", points.len() - 1);
                    let problem = Problem::new(path, "must be the first point again");
                    self.problems.push(problem.hint("or leave out `periodic`"));
                }
            }
            TrajectorySpec::Sum(terms) => {
                for (index, term) in terms.iter().enumerate() {
                    let path = format!("{path}.sum[{index}]");
                    match term {
                        TrajectorySpec::Sum(_) => self.add(path, "is a sum inside a sum"),
                        term => self.trajectory(&path, term),
                    }
                }
            }
        }
    }

    fn mill_ring(&mut self, path: &str, ring: &MillRingSpec, scope: Option<&ScopeSpec>) {
        self.vector(&format!("{path}.center"), &ring.center);
        self.values(&format!("{path}.radius"), &ring.radius, scope);
        let path_of = |name: &str| format!("{path}.{name}");
        let angular_velocity = Some(&ring.angular_velocity);
        for (name, numbers) in [
            ("angular_velocity", angular_velocity),
            ("heights", ring.heights.as_ref()),
        ] {
            if let Some(NumbersSpec::Each(numbers)) = numbers {
                self.numbers(&path_of(name), numbers);
                self.one_for_each(&path_of(name), numbers.len(), scope);
            }
        }
        if let Some(phases) = &ring.phases {
            self.numbers(&path_of("phases"), phases);
            self.one_for_each(&path_of("phases"), phases.len(), scope);
        }
        self.axis_in_space(&path_of("axis"), &ring.axis);
        if ring.heights.is_some() && self.dimension == 2 {
            self.add(path_of("heights"), "has no meaning in 2-D");
        }
    }

    /// The axis of a circle, which only space leaves open.
    fn axis_in_space(&mut self, path: &str, axis: &Option<Vec<f64>>) {
        match axis {
            Some(_) if self.dimension == 2 => self.add(path, "has no meaning in 2-D"),
            Some(axis) => self.direction(path, axis),
            None => {}
        }
    }

    fn points_in_time(&mut self, path: &str, times: &[f64], points: &[Vec<f64>]) {
        self.increasing(&format!("{path}.times"), times);
        self.vectors(&format!("{path}.points"), points);
        if points.len() != times.len() {
            let (needed, found) = (times.len(), points.len());
            let what = format!("must have {needed} points, one for each time, not {found}");
            self.add(format!("{path}.points"), what);
        }
    }
}
