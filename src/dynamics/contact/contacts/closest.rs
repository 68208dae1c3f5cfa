//! Who came closest so far.

use super::Contacts;
use crate::dynamics::contact::{Closest, Touched};
use crate::math::Vector;
use crate::shape::{Obstacle, Pose, Separation};

impl<const D: usize> Contacts<D> {
    /// Looks who came closest in a step from some places to others; `poses` tells how bodies
    /// stand at its end.
    pub(crate) fn closest(
        &mut self,
        [from, to]: [&[Vector<D>]; 2],
        obstacles: &[Obstacle<D>],
        poses: &dyn Fn(usize) -> Pose<D>,
        time: f64,
    ) {
        self.closest_agents([from, to], poses, time);
        if !obstacles.is_empty() {
            self.closest_walls([from, to], obstacles, poses, time);
        }
    }

    fn closest_agents(
        &mut self,
        [from, to]: [&[Vector<D>]; 2],
        poses: &dyn Fn(usize) -> Pose<D>,
        time: f64,
    ) {
        let roster = &self.roster;
        loop {
            let mut best = self.state.gaps.agents;
            let gap = best.map_or(self.agents.reach(), |it| it.gap);
            let mut least = gap;
            self.agents.below(gap, |one, other| {
                let between = roster.outer[one] + roster.outer[other];
                let (before, after) = (from[other] - from[one], to[other] - to[one]);
                let mut found = nearest_on_way(&before, &after) - between;
                if found < least && !(roster.is_ball(one) && roster.is_ball(other)) {
                    let solids = [roster.solid(one), roster.solid(other)];
                    let (here, there) = (poses(one), poses(other));
                    let way = before - after;
                    let stand = |share: f64| {
                        let back = here.at(here.translation - way * (1.0 - share));
                        solids[0].separation(&back, solids[1], &there)
                    };
                    let within = least_on_way(&way, &stand).unwrap_or(f64::INFINITY);
                    found = stand(1.0).gap.min(within);
                }
                if found < least {
                    least = found;
                    best = Some(Closest {
                        gap: found,
                        agent: one,
                        to: Touched::Agent(other),
                        time,
                    });
                }
            });
            self.state.gaps.agents = best;
            // Nobody is within reach yet: look farther, where there is anybody.
            if best.is_some() || roster.len() < 2 || self.agents.reach() > f64::MAX / 4.0 {
                return;
            }
            self.agents.widen();
            self.agents.follow([to, to], &|_| 0.0, f64::INFINITY);
        }
    }

    fn closest_walls(
        &mut self,
        [from, to]: [&[Vector<D>]; 2],
        obstacles: &[Obstacle<D>],
        poses: &dyn Fn(usize) -> Pose<D>,
        time: f64,
    ) {
        for (agent, place) in to.iter().enumerate() {
            let gone = self.walls.gone(agent);
            if gone <= self.clear[agent] {
                continue;
            }
            let least = self.state.gaps.obstacles.map_or(f64::INFINITY, |it| it.gap);
            // Somewhat farther than asked for, so that the answer serves for a while.
            let reach = 2.0 * least.max(0.0) + self.roster.outer[agent];
            let ball = self.walls.nearest(agent, place, obstacles, reach);
            self.clear[agent] = gone + ball.unwrap_or(reach) - least.min(f64::MAX);
            let solid = self.roster.solid(agent);
            let pose = poses(agent);
            let mut found = (least, usize::MAX);
            let way = place - from[agent];
            self.walls.of(agent, least, |k, part| {
                // Past a corner within the step. Where the obstacle moves, ends of steps must do.
                let obstacle = &obstacles[k];
                let stand = |share: f64| {
                    let there = pose.at(place - way * (1.0 - share));
                    obstacle.parts()[part].separation(&obstacle.pose, solid, &there)
                };
                if obstacle.motion().is_none()
                    && let Some(gap) = least_on_way(&way, &stand)
                    && gap < found.0
                {
                    found = (gap, k);
                }
            });
            if ball.is_none_or(|gap| gap >= least) && found.1 == usize::MAX {
                continue;
            }
            for (k, obstacle) in obstacles.iter().enumerate() {
                if obstacle.may_reach(place, found.0.min(f64::MAX) + self.roster.outer[agent]) {
                    let exact = obstacle.gap(solid, &pose);
                    if exact < found.0 {
                        found = (exact, k);
                    }
                }
            }
            if found.1 < usize::MAX {
                self.state.gaps.obstacles = Some(Closest {
                    gap: found.0,
                    agent,
                    to: Touched::Obstacle(found.1),
                    time,
                });
            }
        }
    }
}

/// The least gap on a straight way of the first against the second, where it is least between the
/// ends; `stand` tells how they stand to each other at a share of the way.
fn least_on_way<const D: usize>(
    way: &Vector<D>,
    stand: &dyn Fn(f64) -> Separation<D>,
) -> Option<f64> {
    if way.dot(&stand(1.0).normal) >= 0.0 || way.dot(&stand(0.0).normal) <= 0.0 {
        return None;
    }
    // Along a straight way the gap of convex things is convex.
    let (mut low, mut high, mut least) = (0.0, 1.0, f64::INFINITY);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let found = stand(middle);
        least = least.min(found.gap);
        match way.dot(&found.normal) > 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    Some(least)
}

/// The least distance on the straight way from one place to another.
fn nearest_on_way<const D: usize>(from: &Vector<D>, to: &Vector<D>) -> f64 {
    let way = to - from;
    let squared = way.norm_squared();
    let share = match squared > 0.0 {
        true => (-from.dot(&way) / squared).clamp(0.0, 1.0),
        false => 1.0,
    };
    (from + way * share).norm().min(to.norm())
}
