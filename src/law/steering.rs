//! Steering given in advance.
//!
//! a_i = β_i(t), the open loop of Djokam & Rathinam, "A generalized model of flocking with
//! steering", (2.14).
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `acceleration`, `accelerations` | β(t), β_i(t) | acceleration |

use crate::law::Law;
use crate::law::targets::own;
use crate::math::{TimeFunction, Vector};
use crate::sense::Scene;
use crate::world::World;
use crate::world::spec::{ScopeSpec, SteeringSpec, TimeFunctionSpec, spread};

/// Steering given in advance; see the module.
#[derive(Debug, Clone)]
pub struct Steering<const D: usize> {
    courses: Courses<D>,
    now: Vec<Vector<D>>,
}

/// β(t), a function of time along each axis.
type Course<const D: usize> = [TimeFunction; D];

/// Who gets which.
#[derive(Debug, Clone)]
enum Courses<const D: usize> {
    Shared(Course<D>),
    Each(Vec<Course<D>>),
}

impl<const D: usize> Steering<D> {
    /// The law with the parameters of a checked world file.
    pub fn new(spec: &SteeringSpec, scope: Option<&ScopeSpec>, world: &World<D>) -> Self {
        let course = |axes: &Vec<TimeFunctionSpec>| {
            std::array::from_fn(|k| axes.get(k).map_or(0.0.into(), TimeFunctionSpec::function))
        };
        match (&spec.acceleration, &spec.accelerations) {
            (Some(shared), _) => Self::shared(course(shared)),
            (None, each) => {
                let each = each.iter().flatten().map(course);
                let rest = std::array::from_fn(|_| 0.0.into());
                Self::each(spread(each, rest, &world.acted_on(scope)))
            }
        }
    }

    /// The law with functions of one's own, the same for all agents: one along each axis.
    pub fn shared(course: [TimeFunction; D]) -> Self {
        Self {
            courses: Courses::Shared(course),
            now: Vec::new(),
        }
    }

    /// The law with functions of one's own for each agent of the world, in its order.
    pub fn each(courses: Vec<[TimeFunction; D]>) -> Self {
        Self {
            courses: Courses::Each(courses),
            now: Vec::new(),
        }
    }
}

impl<const D: usize> Law<D> for Steering<D> {
    fn name(&self) -> &str {
        "steering"
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        let value = |course: &Course<D>| Vector::from_fn(|k, _| course[k].value(scene.time));
        self.now = match &self.courses {
            Courses::Shared(course) => vec![value(course)],
            Courses::Each(courses) => courses.iter().map(value).collect(),
        };
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (acceleration, i) in out.iter_mut().zip(first..) {
            *acceleration += own(&self.now, scene.agents[i]);
        }
    }
}
