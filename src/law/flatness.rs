//! Steering along given trajectories, by differential flatness.
//!
//! β_i = ÿ_i − Σ(what all other laws give agent i on the reference) − g
//! + γ1 (ẏ_i − v_i) + γ2 (y_i − x_i)
//!
//! Djokam & Rathinam, "A generalized model of flocking with steering", section 2.6: agents that
//! start on their trajectories stay on them. On the reference every agent that this law acts on
//! is where its trajectory has it, at the trajectory's velocity, and all others are as they are.
//!
//! The other laws are those of the world file, in their scopes, but for other flatness laws,
//! which act on other agents. They are asked without senses, so what agents do not perceive, or
//! perceive wrongly, counts as a disturbance, as contacts and actuator limits do. Where gains are
//! 0 nothing but the laws themselves brings back agents that a disturbance has taken off.
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `trajectories` | y_i(t) | length |
//! | `velocity_gain` | γ1 | 1/time |
//! | `position_gain` | γ2 | 1/time² |

use crate::law::targets::{Targets, own};
use crate::law::{Flock, Law, State, build_where};
use crate::math::{Moment, Vector, direction};
use crate::sense::Scene;
use crate::world::World;
use crate::world::spec::{FlatnessSpec, LawSpec, ScopeSpec};

/// Steering along given trajectories; see the module.
pub struct Flatness<const D: usize> {
    targets: Targets<D>,
    velocity_gain: f64,
    position_gain: f64,
    gravity: Vector<D>,
    /// For each agent, whether its trajectory is given.
    given: Vec<bool>,
    groups: Vec<usize>,
    others: Flock<D>,
    now: Vec<Moment<D>>,
    /// For each agent, what the other laws give it on the reference.
    missing: Vec<Vector<D>>,
    reference: Reference<D>,
}

/// The agents as the trajectories have them, in the order of the world.
#[derive(Default)]
struct Reference<const D: usize> {
    positions: Vec<Vector<D>>,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
}

impl<const D: usize> Flatness<D> {
    /// The law with the parameters of a checked world file.
    pub fn new(spec: &FlatnessSpec, scope: Option<&ScopeSpec>, world: &World<D>) -> Self {
        let targets = Targets::of_agents(&spec.trajectories, scope, world);
        let others = build_where(world, |law| !matches!(law, LawSpec::Flatness(_)));
        let gains = [spec.velocity_gain, spec.position_gain];
        Self::along(targets, gains, others, world.acted_on(scope), world)
    }

    /// The law with trajectories of one's own for the agents of a world that are `given` one,
    /// the gains γ1 and γ2, and what are to be taken for all other laws.
    pub fn along(
        targets: Targets<D>,
        [velocity_gain, position_gain]: [f64; 2],
        others: Vec<Box<dyn Law<D>>>,
        given: Vec<bool>,
        world: &World<D>,
    ) -> Self {
        Self {
            targets,
            velocity_gain,
            position_gain,
            gravity: world.gravity,
            given,
            groups: world.agents.group.clone(),
            others: Flock::new(others),
            now: Vec::new(),
            missing: Vec::new(),
            reference: Reference::default(),
        }
    }

    /// Puts the agents where the reference has them.
    fn refer(&mut self, scene: &Scene<'_, D>) {
        let mut reference = std::mem::take(&mut self.reference);
        for list in [
            &mut reference.positions,
            &mut reference.velocities,
            &mut reference.headings,
        ] {
            list.resize(scene.agents.len(), Vector::zeros());
        }
        for (i, &number) in scene.agents.iter().enumerate() {
            let agent = number as usize;
            let mut at = (scene.positions[i], scene.velocities[i], scene.headings[i]);
            if self.given[agent] {
                let target = own(&self.now, number);
                let along = direction(&target.velocity);
                // Who is to rest heads where it does.
                let heading = if along.norm_squared() == 0.0 {
                    at.2
                } else {
                    along
                };
                at = (target.position, target.velocity, heading);
            }
            reference.positions[agent] = at.0;
            reference.velocities[agent] = at.1;
            reference.headings[agent] = at.2;
        }
        self.reference = reference;
    }
}

impl<const D: usize> Law<D> for Flatness<D> {
    fn name(&self) -> &str {
        "flatness"
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        self.now = self.targets.at(scene.time);
        self.refer(scene);
        self.missing.resize(scene.agents.len(), Vector::zeros());
        let state = State {
            time: scene.time,
            positions: &self.reference.positions,
            velocities: &self.reference.velocities,
            headings: &self.reference.headings,
            groups: &self.groups,
            masses: scene.masses,
            rotations: scene.rotations,
            obstacles: scene.obstacles,
        };
        self.others.accelerations(&state, &mut self.missing);
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (acceleration, i) in out.iter_mut().zip(first..) {
            let agent = scene.agents[i];
            let target = own(&self.now, agent);
            *acceleration += target.acceleration - self.missing[agent as usize] - self.gravity;
            *acceleration += (target.velocity - scene.velocities[i]) * self.velocity_gain;
            *acceleration += (target.position - scene.positions[i]) * self.position_gain;
        }
    }
}
