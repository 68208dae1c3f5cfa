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
        [begin, end]: [f64; 2],
    ) {
        self.agents.follow_bounces([from, to], self.smallest());
        self.walls.follow_bounces(to, obstacles);
        self.closest_agents([from, to], poses, [begin, end]);
        if !obstacles.is_empty() {
            self.closest_walls([from, to], obstacles, poses, [begin, end]);
        }
    }

    fn closest_agents(
        &mut self,
        [from, to]: [&[Vector<D>]; 2],
        poses: &dyn Fn(usize) -> Pose<D>,
        [begin, end]: [f64; 2],
    ) {
        let roster = &self.roster;
        loop {
            let mut best = self.state.gaps.agents;
            let gap = best.map_or(self.agents.reach(), |it| it.gap);
            let mut least = gap;
            self.agents.below(gap, |one, other| {
                let between = roster.outer[one] + roster.outer[other];
                let (before, after) = (from[other] - from[one], to[other] - to[one]);
                let (distance, mut share) = nearest_on_way(&before, &after);
                let mut found = distance - between;
                if found < least && !(roster.is_ball(one) && roster.is_ball(other)) {
                    let solids = [roster.solid(one), roster.solid(other)];
                    let (here, there) = (poses(one), poses(other));
                    let way = before - after;
                    let stand = |share: f64| {
                        let back = here.at(here.translation - way * (1.0 - share));
                        solids[0].separation(&back, solids[1], &there)
                    };
                    (found, share) = least_on_way(&way, &stand).unwrap_or((stand(1.0).gap, 1.0));
                }
                if found < least {
                    least = found;
                    best = Some(Closest {
                        gap: found,
                        agent: one,
                        to: Touched::Agent(other),
                        time: begin + share * (end - begin),
                    });
                }
            });
            self.state.gaps.agents = best;
            // Nobody is within reach yet: look farther, where there is anybody.
            if best.is_some() || roster.len() < 2 || self.agents.reach() > f64::MAX / 4.0 {
                return;
            }
            self.agents.widen();
            self.agents.follow_bounces([from, to], f64::INFINITY);
        }
    }

    fn closest_walls(
        &mut self,
        [from, to]: [&[Vector<D>]; 2],
        obstacles: &[Obstacle<D>],
        poses: &dyn Fn(usize) -> Pose<D>,
        [begin, end]: [f64; 2],
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
            let mut found = (least, usize::MAX, 1.0);
            let way = place - from[agent];
            let mut pass = |k: usize, part: usize| {
                // Past a corner within the step. Where the obstacle moves, ends of steps must do.
                let obstacle = &obstacles[k];
                let stand = |share: f64| {
                    let there = pose.at(place - way * (1.0 - share));
                    obstacle.parts()[part].separation(&obstacle.pose, solid, &there)
                };
                if obstacle.motion().is_none()
                    && let Some((gap, share)) = least_on_way(&way, &stand)
                    && gap < found.0
                {
                    found = (gap, k, share);
                }
            };
            if way.amax() > 0.0 {
                let range = least.max(0.0) + self.roster.outer[agent] + way.norm();
                self.walls.parts_around(place, range, obstacles, &mut pass);
            }
            if ball.is_none_or(|gap| gap >= least) && found.1 == usize::MAX {
                continue;
            }
            for (k, obstacle) in obstacles.iter().enumerate() {
                if obstacle.may_reach(place, found.0.min(f64::MAX) + self.roster.outer[agent]) {
                    let exact = obstacle.gap(solid, &pose);
                    if exact < found.0 {
                        found = (exact, k, 1.0);
                    }
                }
            }
            if found.1 < usize::MAX {
                self.state.gaps.obstacles = Some(Closest {
                    gap: found.0,
                    agent,
                    to: Touched::Obstacle(found.1),
                    time: begin + found.2 * (end - begin),
                });
            }
        }
    }
}

/// The least gap on a straight way of the first against the second, and the share of the way
/// where it is, if that is between the ends; `stand` tells how they stand to each other at a share of the way.
fn least_on_way<const D: usize>(
    way: &Vector<D>,
    stand: &dyn Fn(f64) -> Separation<D>,
) -> Option<(f64, f64)> {
    if way.dot(&stand(1.0).normal) >= 0.0 || way.dot(&stand(0.0).normal) <= 0.0 {
        return None;
    }
    // Along a straight way the gap of convex things is convex.
    let (mut low, mut high, mut least) = (0.0, 1.0, (f64::INFINITY, 1.0));
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let found = stand(middle);
        if found.gap < least.0 {
            least = (found.gap, middle);
        }
        match way.dot(&found.normal) > 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    Some(least)
}

/// The least distance on the straight way from one place to another, and the share of the way
/// where it is.
fn nearest_on_way<const D: usize>(from: &Vector<D>, to: &Vector<D>) -> (f64, f64) {
    let way = to - from;
    let squared = way.norm_squared();
    let share = match squared > 0.0 {
        true => (-from.dot(&way) / squared).clamp(0.0, 1.0),
        false => 1.0,
    };
    let end = to.norm();
    match (from + way * share).norm() {
        within if within < end => (within, share),
        _ => (end, 1.0),
    }
}
