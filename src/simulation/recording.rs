//! What a simulation says of itself: the header, frames and the summary of its trace.

use super::{Pause, Simulation, keep_least};
use crate::dynamics::{Closest, Snapshot, Strain, Touched};
use crate::math::Vector;
use crate::metric::{Terms, laws_record};
use crate::net::Net;
use crate::sense::Surroundings;
use crate::shape::Obstacle;
use crate::trace::record::{
    Approach, BetaAgent, Bodies as BodyProperties, FORMAT, Frame, Header, LawAccelerations,
    ObstaclePose, Outcome, SolverRecord, StrainRecord, Summary, VERSION,
};
use crate::world::spec::Rotation;

impl<const D: usize> Simulation<D> {
    pub(super) fn header(&self) -> Header {
        let agents = &self.world.agents;
        let solver = self.solver().map(|solver| SolverRecord {
            method: solver.method.to_owned(),
            order: solver.order,
            relative: solver.relative,
        });
        Header {
            format: FORMAT.to_owned(),
            version: VERSION,
            program: format!("volary {}", env!("CARGO_PKG_VERSION")),
            dynamics: match solver {
                None => "bodies".to_owned(),
                Some(_) => "points".to_owned(),
            },
            solver,
            name: self.world.name.clone(),
            world: self.world.spec.clone(),
            bodies: BodyProperties {
                group: agents.group.clone(),
                radius: agents.radius.clone(),
                mass: agents.mass.clone(),
                force_limit: agents
                    .force_limit
                    .iter()
                    .map(|limit| limit.is_finite().then_some(*limit))
                    .collect(),
            },
        }
    }

    /// The state as it is recorded; without what takes long where it is to be brief.
    pub(super) fn frame(&mut self, brief: bool) -> Frame {
        let begin = self.watches.frames.begin();
        // What frames ask the laws is no part of the steps.
        self.flock.measure(false);
        let frame = self.new_frame(brief);
        self.flock.measure(begin.is_some());
        self.watches.frames.end(begin);
        frame
    }

    fn new_frame(&mut self, brief: bool) -> Frame {
        // Measured whether recorded or not: the smallest gaps so far are kept.
        let metrics = self.metrics();
        keep_least(&mut self.smallest_agent_gap, metrics.agent_gap);
        keep_least(&mut self.smallest_obstacle_gap, metrics.obstacle_gap);
        let state = self.agents.snapshot();
        let world = &self.world;
        Frame {
            step: state.step,
            time: state.time,
            positions: lists(state.positions),
            velocities: lists(state.velocities),
            rotations: state
                .rotations
                .map(|rotations| rotations.iter().map(Rotation::of).collect()),
            metrics: world.spec.record.metrics.then_some(metrics),
            accelerations: world.spec.record.accelerations.then(|| {
                self.flock
                    .by_law(&self.agents.state())
                    .into_iter()
                    .map(|(law, values)| LawAccelerations {
                        law,
                        values: lists(&values),
                    })
                    .collect()
            }),
            beta_agents: world
                .beta_range()
                .filter(|_| world.spec.record.beta_agents)
                .map(|range| beta_agents(&state, range)),
            edges: world
                .alpha_interaction()
                .filter(|_| world.spec.record.edges)
                .map(|alpha| Net::new(state.positions, alpha.range).edges().to_vec()),
            net: (world.spec.record.net && !brief)
                .then(|| self.net_analysis.record(world, &state))
                .flatten()
                .map(Box::new),
            links: (world.spec.record.links).then(|| self.flock.links(&self.agents.state())),
            laws: (world.spec.record.laws && !brief)
                .then(|| {
                    let state = self.agents.state();
                    laws_record(world, &Terms::new(&mut self.flock, &state), &state)
                })
                .map(Box::new),
            blocked: (world.spec.record.blocked).then(|| self.flock.blocked(&self.agents.state())),
            obstacles: obstacle_poses(state.obstacles),
        }
    }

    pub(super) fn summary(&mut self, pause: Pause) -> Summary {
        let (outcome, error) = match pause {
            Pause::Failed(failure) => (Outcome::Failed, Some(failure.to_string())),
            _ if self.snapshot().step < self.world.steps() => (Outcome::Interrupted, None),
            _ => (Outcome::Completed, None),
        };
        let cuts = self.agents.cuts();
        let state = self.agents.snapshot();
        let last = self.metrics();
        let gaps = self.agents.gaps();
        Summary {
            name: self.world.name.clone(),
            seed: self.world.spec.seed,
            outcome,
            error,
            agents: self.world.agents.len(),
            steps: state.step,
            time: state.time,
            agent_contacts: self.ledger.agent_contacts().clone(),
            obstacle_contacts: self.ledger.obstacle_contacts().clone(),
            force_cuts: cuts.force,
            rate_cuts: cuts.rate,
            speed_cuts: cuts.speed,
            smallest_agent_gap: last.smallest_agent_gap,
            closest_agents: gaps.agents.map(approach),
            smallest_obstacle_gap: last.smallest_obstacle_gap,
            closest_obstacle: gaps.obstacles.map(approach),
            strain: strain(self.agents.strain()),
            last,
        }
    }
}

fn approach(closest: Closest) -> Approach {
    let (Touched::Agent(other) | Touched::Obstacle(other)) = closest.to;
    Approach {
        agent: closest.agent,
        other,
        time: closest.time,
    }
}

fn strain(strain: Strain) -> StrainRecord {
    let Strain {
        travel,
        overlap,
        unordered,
    } = strain;
    StrainRecord {
        travel,
        overlap,
        unordered,
    }
}

fn beta_agents<const D: usize>(state: &Snapshot<'_, D>, range: f64) -> Vec<BetaAgent> {
    let surroundings = Surroundings::new(state.obstacles);
    let of_agent = |agent: usize| {
        let active = surroundings.active(state.obstacles, &state.positions[agent], range);
        active.map(move |active| BetaAgent {
            agent,
            obstacle: active.obstacle,
            part: (state.obstacles[active.obstacle].parts().len() > 1).then_some(active.part),
            position: list(&active.projection.point),
            velocity: list(&active.projection.velocity(&state.velocities[agent])),
            distance: active.projection.distance,
        })
    };
    (0..state.positions.len()).flat_map(of_agent).collect()
}

/// Where the obstacles are that move; nothing where none does.
fn obstacle_poses<const D: usize>(obstacles: &[Obstacle<D>]) -> Option<Vec<ObstaclePose>> {
    let moving = obstacles.iter().enumerate();
    let moving = moving.filter(|(_, obstacle)| obstacle.motion().is_some());
    let poses: Vec<_> = moving
        .map(|(index, obstacle)| ObstaclePose {
            obstacle: index,
            position: list(&obstacle.pose.translation),
            rotation: Rotation::of(obstacle.pose.rotation()),
        })
        .collect();
    (!poses.is_empty()).then_some(poses)
}

fn list<const D: usize>(vector: &Vector<D>) -> Vec<f64> {
    vector.iter().copied().collect()
}

fn lists<const D: usize>(vectors: &[Vector<D>]) -> Vec<Vec<f64>> {
    vectors.iter().map(list).collect()
}
