//! The ledger of contacts: every episode in which two bodies touched.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::dynamics::{Touch, Touched};
use crate::trace::record::{Contact, ContactCount, Partner};

/// Follows contacts from step to step. An episode runs from the first step in which a
/// pair touches to the first in which it does not; every step is looked at, so nothing
/// falls between the frames of a trace.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Ledger {
    open: BTreeMap<(usize, Touched), Contact>,
    pairs: BTreeSet<(usize, Touched)>,
    agents: ContactCount,
    obstacles: ContactCount,
    smallest_agent_gap: Option<f64>,
    smallest_obstacle_gap: Option<f64>,
}

impl Ledger {
    /// Enters the touches of the step from `begin` to `end`, and returns the episodes
    /// that were over before it.
    pub fn enter<const D: usize>(
        &mut self,
        begin: f64,
        end: f64,
        touches: &[Touch<D>],
    ) -> Vec<Contact> {
        if touches.is_empty() && self.open.is_empty() {
            return Vec::new();
        }
        let mut before = std::mem::take(&mut self.open);
        for touch in touches {
            let key = (touch.agent, touch.touched);
            let contact = before.remove(&key);
            let contact = contact.unwrap_or_else(|| self.begin(begin, touch));
            let contact = self.go_on(contact, begin, end, touch);
            self.open.insert(key, contact);
        }
        before.into_values().collect()
    }

    /// Ends the run: returns the episodes that are still open, after entering the
    /// overlaps of the last state.
    pub fn close<const D: usize>(&mut self, end: f64, overlaps: &[Touch<D>]) -> Vec<Contact> {
        let mut over = self.enter(end, end, overlaps);
        over.extend(
            std::mem::take(&mut self.open)
                .into_values()
                .map(|contact| Contact {
                    open: true,
                    ..contact
                }),
        );
        over
    }

    /// Contacts between agents so far.
    pub fn agent_contacts(&self) -> &ContactCount {
        &self.agents
    }

    /// Contacts between agents and obstacles so far.
    pub fn obstacle_contacts(&self) -> &ContactCount {
        &self.obstacles
    }

    /// Smallest gap at the start of a step in which two agents touched.
    pub fn smallest_agent_gap(&self) -> Option<f64> {
        self.smallest_agent_gap
    }

    /// Smallest gap at the start of a step in which an agent touched an obstacle.
    pub fn smallest_obstacle_gap(&self) -> Option<f64> {
        self.smallest_obstacle_gap
    }

    fn begin<const D: usize>(&mut self, time: f64, touch: &Touch<D>) -> Contact {
        let (with, other) = match touch.touched {
            Touched::Agent(other) => (Partner::Agent, other),
            Touched::Obstacle(other) => (Partner::Obstacle, other),
        };
        let new_pair = self.pairs.insert((touch.agent, touch.touched));
        let count = self.count(with);
        count.episodes += 1;
        count.pairs += u64::from(new_pair);
        count.highest_approach_speed = count.highest_approach_speed.max(touch.approach_speed);
        Contact {
            agent: touch.agent,
            with,
            other,
            begin: time,
            end: time,
            open: false,
            steps: 0,
            largest_impulse: 0.0,
            deepest_penetration: 0.0,
            approach_speed: touch.approach_speed,
            push_speed: 0.0,
            position: touch.position.iter().copied().collect(),
        }
    }

    fn go_on<const D: usize>(
        &mut self,
        contact: Contact,
        begin: f64,
        end: f64,
        touch: &Touch<D>,
    ) -> Contact {
        let penetration = (-touch.gap).max(0.0);
        let count = self.count(contact.with);
        count.largest_impulse = count.largest_impulse.max(touch.impulse());
        count.deepest_penetration = count.deepest_penetration.max(penetration);
        count.pushed += u64::from(contact.push_speed == 0.0 && touch.push_speed > 0.0);
        let smallest = match contact.with {
            Partner::Agent => &mut self.smallest_agent_gap,
            Partner::Obstacle => &mut self.smallest_obstacle_gap,
        };
        *smallest = Some(smallest.unwrap_or(f64::INFINITY).min(touch.gap));
        Contact {
            end,
            // An overlap found when the run ends takes no step.
            steps: contact.steps + u64::from(begin < end),
            largest_impulse: contact.largest_impulse.max(touch.impulse()),
            deepest_penetration: contact.deepest_penetration.max(penetration),
            push_speed: contact.push_speed.max(touch.push_speed),
            ..contact
        }
    }

    fn count(&mut self, with: Partner) -> &mut ContactCount {
        match with {
            Partner::Agent => &mut self.agents,
            Partner::Obstacle => &mut self.obstacles,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vector;

    fn touch(agent: usize, touched: Touched, gap: f64, impulse: f64) -> Touch<2> {
        Touch {
            agent,
            touched,
            time: 0.0,
            gap,
            blow: impulse,
            press: 0.0,
            friction: 0.0,
            approach_speed: 2.0,
            push_speed: 0.0,
            normal: Vector::<2>::new(1.0, 0.0),
            point: Vector::<2>::new(3.5, 4.0),
            position: Vector::<2>::new(3.0, 4.0),
        }
    }

    #[test]
    fn an_episode_lasts_from_first_to_last_touch() {
        let mut ledger = Ledger::default();
        let pair = Touched::Agent(5);
        assert!(
            ledger
                .enter(0.0, 0.1, &[touch(2, pair, 0.01, 1.0)])
                .is_empty()
        );
        assert!(
            ledger
                .enter(0.1, 0.2, &[touch(2, pair, -0.03, 4.0)])
                .is_empty()
        );
        let over = ledger.enter::<2>(0.2, 0.3, &[]);
        assert_eq!(over.len(), 1);
        let contact = &over[0];
        assert_eq!((contact.begin, contact.end, contact.steps), (0.0, 0.2, 2));
        assert_eq!(
            (contact.largest_impulse, contact.deepest_penetration),
            (4.0, 0.03)
        );
        assert!(!contact.open);
        // The same pair again is another episode, but not another pair.
        ledger.enter(0.3, 0.4, &[touch(2, pair, -0.01, 0.0)]);
        assert_eq!(ledger.agent_contacts().episodes, 2);
        assert_eq!(ledger.agent_contacts().pairs, 1);
        assert_eq!(ledger.smallest_agent_gap(), Some(-0.03));
        let rest = ledger.close::<2>(0.4, &[touch(2, pair, -0.02, 0.0)]);
        assert!(rest.len() == 1 && rest[0].open && rest[0].steps == 1);
    }

    #[test]
    fn obstacles_are_counted_apart() {
        let mut ledger = Ledger::default();
        ledger.enter(0.0, 0.1, &[touch(2, Touched::Obstacle(0), 0.0, 1.0)]);
        assert_eq!(ledger.obstacle_contacts().episodes, 1);
        assert_eq!(ledger.agent_contacts().episodes, 0);
    }

    #[test]
    fn an_episode_counts_once_as_pushed() {
        let mut ledger = Ledger::default();
        let pushing = |push_speed| Touch {
            push_speed,
            ..touch(2, Touched::Obstacle(0), 0.0, 1.0)
        };
        for (step, push_speed) in [0.0, 0.5, 2.0, 1.0].into_iter().enumerate() {
            let begin = 0.1 * step as f64;
            ledger.enter(begin, begin + 0.1, &[pushing(push_speed)]);
        }
        assert_eq!(ledger.obstacle_contacts().pushed, 1);
        let over = ledger.enter::<2>(0.4, 0.5, &[]);
        assert_eq!(over[0].push_speed, 2.0);
        ledger.enter(0.5, 0.6, &[pushing(0.0)]);
        let counted = ledger.obstacle_contacts();
        assert_eq!((counted.episodes, counted.pushed), (2, 1));
    }
}
