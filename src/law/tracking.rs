//! Following a target that moves.
//!
//! a_i = γ1 (ẏ − v_i) + γ2 (y − x_i), and + ÿ where asked for. Djokam & Rathinam, "A generalized
//! model of flocking with steering", section 5. With ÿ the error decays as a damped oscillator
//! does; without, it stays of the size |ÿ|/γ2.
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `target`, `targets` | y(t), y_i(t) | length |
//! | `velocity_gain` | γ1 | 1/time |
//! | `position_gain` | γ2 | 1/time² |
//! | `feedforward` | whether ÿ is added | |

use crate::law::Law;
use crate::law::targets::{Targets, own};
use crate::math::{Moment, Vector};
use crate::sense::Scene;
use crate::world::World;
use crate::world::spec::{ScopeSpec, TrackingSpec, TrajectoriesSpec};

/// Following a target that moves; see the module.
#[derive(Debug, Clone)]
pub struct Tracking<const D: usize> {
    targets: Targets<D>,
    velocity_gain: f64,
    position_gain: f64,
    feedforward: bool,
    now: Vec<Moment<D>>,
}

impl<const D: usize> Tracking<D> {
    /// The law with the parameters of a checked world file.
    pub fn new(spec: &TrackingSpec, scope: Option<&ScopeSpec>, world: &World<D>) -> Self {
        let targets = match &spec.target {
            Some(target) => Targets::Shared(target.trajectory()),
            None => {
                let none = TrajectoriesSpec::Each(Vec::new());
                Targets::of_agents(spec.targets.as_ref().unwrap_or(&none), scope, world)
            }
        };
        let gains = [spec.velocity_gain, spec.position_gain];
        Self::along(targets, gains, spec.feedforward)
    }

    /// The law with targets of one's own, the gains γ1 and γ2, and whether ÿ is added.
    pub fn along(
        targets: Targets<D>,
        [velocity_gain, position_gain]: [f64; 2],
        feedforward: bool,
    ) -> Self {
        Self {
            targets,
            velocity_gain,
            position_gain,
            feedforward,
            now: Vec::new(),
        }
    }
}

impl<const D: usize> Law<D> for Tracking<D> {
    fn name(&self) -> &str {
        "tracking"
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        self.now = self.targets.at(scene.time);
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        for (acceleration, i) in out.iter_mut().zip(first..) {
            let target = own(&self.now, scene.agents[i]);
            *acceleration += (target.velocity - scene.velocities[i]) * self.velocity_gain;
            *acceleration += (target.position - scene.positions[i]) * self.position_gain;
            if self.feedforward {
                *acceleration += target.acceleration;
            }
        }
    }
}
