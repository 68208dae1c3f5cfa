//! When a pair meets within a step, how it stands then, and where it touches.

use super::super::meet::{Pair as Meeting, balls, slowest};
use super::super::pair::{Other, Pair};
use super::super::way::Way;
use super::Sweep;
use crate::math::Vector;
use crate::shape::{Separation, is_exposed};

impl<const D: usize> Sweep<'_, D> {
    /// When a pair meets, from a time on, on the ways that it has, and how fast it approaches then;
    /// a touch at this very time is passed over where it was `answered`.
    pub(super) fn meet(&self, pair: Pair, from: f64, answered: bool) -> Option<(f64, f64)> {
        let (roster, end) = (self.roster, self.flight.step);
        let is_new = |time: f64| !answered || time > from;
        let agent = pair.agent as usize;
        let one = self.way(agent);
        let speeds = |agent: usize| self.flight.velocities[agent].amax();
        let speeds: f64 = pair.members().map(speeds).sum();
        let reach = |agent: usize| match roster.is_ball(agent) {
            true => 0.0,
            false => roster.outer[agent],
        };
        match pair.other {
            Other::Agent(other) => {
                let other_agent = other as usize;
                let other = self.way(other_agent);
                // Too far from each other to meet in what is left of the step.
                let left = end - from;
                let way = (one.velocity_at(from) - other.velocity_at(from)).norm() * left
                    + 0.5 * (one.acceleration - other.acceleration).norm() * left * left;
                let outer = roster.outer[agent] + roster.outer[other_agent];
                let apart = (one.position_at(from) - other.position_at(from)).norm();
                if apart > outer + way * (1.0 + 1e-9) {
                    return None;
                }
                let round = roster.is_ball(agent) && roster.is_ball(other_agent);
                if round && one.acceleration == other.acceleration {
                    let apart = other.position_at(from) - one.position_at(from);
                    let velocity = one.velocity_at(from) - other.velocity_at(from);
                    let touching = roster.outer[agent] + roster.outer[other_agent];
                    let time = from + balls(&apart, &velocity, touching)?;
                    let now = one.velocity.amax() + other.velocity.amax();
                    let least = slowest(now.max(speeds));
                    let there = apart - velocity * (time - from);
                    let approach = velocity.dot(&there) / there.norm();
                    let counts = time <= end && approach > least && is_new(time);
                    return counts.then_some((time, approach));
                }
                let meeting = Meeting {
                    ways: [&one, &other],
                    reaches: [reach(agent), reach(other_agent)],
                    size: roster.smaller(pair),
                    speeds,
                    bounces: roster.surfaces(pair).0 > 0.0,
                };
                let found = meeting.meet(
                    from,
                    end,
                    |t| self.stand(pair, [&one, &other], t),
                    |time, _| is_new(time),
                );
                found.map(|(time, found)| (time, meeting.approach(&found, time)))
            }
            Other::Part(obstacle, _) => {
                let obstacle = obstacle as usize;
                let other = &self.flight.wall(obstacle);
                let meeting = Meeting {
                    ways: [&one, other],
                    reaches: [
                        reach(agent),
                        match other.turns() {
                            true => self.flight.obstacles[obstacle].reach(),
                            false => 0.0,
                        },
                    ],
                    size: roster.smaller(pair),
                    speeds,
                    bounces: roster.surfaces(pair).0 > 0.0,
                };
                let counts = |time: f64, found: &Separation<D>| {
                    is_new(time) && self.is_exposed(pair, found, time)
                };
                let found = meeting.meet(from, end, |t| self.stand(pair, [&one, other], t), counts);
                found.map(|(time, found)| (time, meeting.approach(&found, time)))
            }
        }
    }

    /// How a pair stands to each other on its ways at a time.
    pub(super) fn stand(&self, pair: Pair, ways: [&Way<D>; 2], time: f64) -> Separation<D> {
        let [one, other] = ways.map(|way| way.pose_at(time));
        let solid = self.roster.solid(pair.agent as usize);
        match pair.other {
            Other::Agent(agent) => {
                solid.separation(&one, self.roster.solid(agent as usize), &other)
            }
            Other::Part(obstacle, part) => {
                let part = &self.flight.obstacles[obstacle as usize].parts()[part as usize];
                part.separation(&other, solid, &one)
            }
        }
    }

    /// Visits the spots where a pair touches.
    pub(super) fn spots(
        &self,
        pair: Pair,
        ways: [&Way<D>; 2],
        time: f64,
        found: &Separation<D>,
        visit: &mut dyn FnMut(Vector<D>),
    ) {
        let [one, other] = ways.map(|way| way.pose_at(time));
        let solid = self.roster.solid(pair.agent as usize);
        match pair.other {
            Other::Agent(agent) => {
                let other = (self.roster.solid(agent as usize), &other);
                solid.spots(&one, other, found, visit);
            }
            Other::Part(obstacle, part) => {
                let part = &self.flight.obstacles[obstacle as usize].parts()[part as usize];
                part.spots(&other, (solid, &one), found, visit);
            }
        }
    }

    /// Whether a touch is one of the wall that all parts form together.
    pub(super) fn is_exposed(&self, pair: Pair, found: &Separation<D>, time: f64) -> bool {
        let Other::Part(obstacle, part) = pair.other else {
            return true;
        };
        let (obstacle, part) = (obstacle as usize, part as usize);
        let (mut point, mut normal) = (found.points[1], -found.normal);
        let obstacles = self.flight.obstacles;
        if obstacles[obstacle].motion().is_some() {
            // Told where the obstacle is when the others are looked at: at the end of the step.
            let then = self.flight.wall(obstacle).pose_at(time);
            let now = &obstacles[obstacle].pose;
            point = now.point_to_world(&then.point_to_local(&point));
            normal = now.vector_to_world(&then.vector_to_local(&normal));
        }
        let size = self.roster.size(pair.agent as usize);
        let boxes = &self.walls.boxes;
        is_exposed(obstacles, boxes, (obstacle, part), &point, &normal, size)
    }
}
