//! The ledger of contacts: every episode in which two bodies touched.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::dynamics::{Touch, Touched};
use crate::trace::record::{Contact, ContactCount, Partner};

/// Share of the smaller body's radius by which two bodies must be apart at the end of a step
/// before their contact is over. Far below what anyone could call parting, far above rounding:
/// a gap of 1e-16 that changes its sign ends nothing.
pub const PARTED: f64 = 1e-6;

/// Share of the smaller body's radius up to which a gap is 0 to rounding: bodies that came to
/// rest at each other touch on, whether or not anything presses them.
const TOUCHING: f64 = 1e-9;

/// Share of a blow below which an impulse is rounding.
const NOTHING: f64 = 1e-9;

/// Follows contacts from step to step. An episode runs from the moment at which two bodies touch
/// to the last at which they do before they part; every step is looked at, so nothing falls
/// between the frames of a trace.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Ledger {
    open: BTreeMap<(usize, Touched), Episode>,
    pairs: BTreeSet<(usize, Touched)>,
    agents: Tally,
    obstacles: Tally,
    first: Option<f64>,
}

/// A contact that goes on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Episode {
    contact: Contact,
    /// What happened in the step that was entered last.
    last: Last,
}

/// What two bodies did in a step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Last {
    /// They did not touch.
    Nothing,
    /// They met, and nothing pressed them.
    Meeting,
    /// They pressed each other for a while.
    Lasting,
}

/// All contacts of one kind.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
struct Tally {
    count: ContactCount,
    /// Episodes that are over.
    over: u64,
    smallest_gap: Option<f64>,
}

impl Ledger {
    /// Enters the touches of the step from `begin` to `end`, and returns the episodes that were
    /// over within it. `apart` tells how far two bodies are from each other at the end of the
    /// step, over the radius of the smaller one; it is asked only of those that touched before.
    pub fn enter<const D: usize>(
        &mut self,
        begin: f64,
        end: f64,
        touches: &[Touch<D>],
        apart: impl Fn(usize, Touched) -> f64,
    ) -> Vec<Contact> {
        if touches.is_empty() && self.open.is_empty() {
            return Vec::new();
        }
        for episode in self.open.values_mut() {
            episode.last = Last::Nothing;
        }
        for touch in touches {
            self.take(begin, end, touch);
        }
        let over = self.open.extract_if(.., |(agent, touched), episode| {
            // What pressed up to now may press on; the next step tells.
            if episode.last == Last::Lasting {
                return false;
            }
            let share = apart(*agent, *touched);
            if share <= TOUCHING {
                episode.contact.end = end;
                episode.contact.steps += u64::from(episode.last == Last::Nothing);
            }
            share > PARTED
        });
        let over: Vec<_> = over.map(|(_, episode)| episode.contact).collect();
        over.into_iter()
            .map(|contact| self.end(contact, false))
            .collect()
    }

    /// Ends the run: returns the episodes that are still open, after entering the
    /// overlaps of the last state.
    pub fn close<const D: usize>(&mut self, end: f64, overlaps: &[Touch<D>]) -> Vec<Contact> {
        for touch in overlaps {
            self.take(end, end, touch);
        }
        std::mem::take(&mut self.open)
            .into_values()
            .map(|episode| self.end(episode.contact, true))
            .collect()
    }

    /// Contacts between agents so far. Durations are those of episodes that are over.
    pub fn agent_contacts(&self) -> &ContactCount {
        &self.agents.count
    }

    /// Contacts between agents and obstacles so far. Durations are those of episodes that are
    /// over.
    pub fn obstacle_contacts(&self) -> &ContactCount {
        &self.obstacles.count
    }

    /// Smallest gap in any step in which two agents touched.
    pub fn smallest_agent_gap(&self) -> Option<f64> {
        self.agents.smallest_gap
    }

    /// Smallest gap in any step in which an agent touched an obstacle.
    pub fn smallest_obstacle_gap(&self) -> Option<f64> {
        self.obstacles.smallest_gap
    }

    /// When the first contact began.
    pub fn first_contact(&self) -> Option<f64> {
        self.first
    }

    /// Enters a touch into the episode that it goes on with, or a new one.
    fn take<const D: usize>(&mut self, begin: f64, end: f64, touch: &Touch<D>) {
        let key = (touch.agent, touch.touched);
        let met = touch.time.max(begin).min(end);
        let mut contact = match self.open.remove(&key) {
            Some(episode) => episode.contact,
            None => self.begin(met, touch),
        };
        let last = match touch.press > NOTHING * touch.blow {
            true => Last::Lasting,
            false => Last::Meeting,
        };
        let tally = self.tally(contact.with);
        let penetration = (-touch.gap).max(0.0);
        let smallest = tally.smallest_gap.unwrap_or(f64::INFINITY);
        tally.smallest_gap = Some(smallest.min(touch.gap));
        let count = &mut tally.count;
        count.largest_blow = count.largest_blow.max(touch.blow);
        count.impulse += touch.impulse();
        count.friction += touch.friction;
        count.largest_impulse = count.largest_impulse.max(touch.impulse());
        count.deepest_penetration = count.deepest_penetration.max(penetration);
        count.pushed += u64::from(contact.push_speed == 0.0 && touch.push_speed > 0.0);
        contact.end = match last {
            Last::Lasting => end,
            _ => met,
        };
        // An overlap found when the run ends takes no step.
        contact.steps += u64::from(begin < end);
        contact.blows += u64::from(touch.blow > NOTHING * contact.blow);
        contact.blow = contact.blow.max(touch.blow);
        contact.impulse += touch.impulse();
        contact.friction += touch.friction;
        contact.largest_impulse = contact.largest_impulse.max(touch.impulse());
        contact.deepest_penetration = contact.deepest_penetration.max(penetration);
        contact.push_speed = contact.push_speed.max(touch.push_speed);
        self.open.insert(key, Episode { contact, last });
    }

    fn begin<const D: usize>(&mut self, time: f64, touch: &Touch<D>) -> Contact {
        let (with, other) = match touch.touched {
            Touched::Agent(other) => (Partner::Agent, other),
            Touched::Obstacle(other) => (Partner::Obstacle, other),
        };
        self.first = Some(self.first.unwrap_or(time).min(time));
        let new_pair = self.pairs.insert((touch.agent, touch.touched));
        let count = &mut self.tally(with).count;
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
            blow: 0.0,
            blows: 0,
            impulse: 0.0,
            largest_impulse: 0.0,
            mean_force: None,
            friction: 0.0,
            deepest_penetration: 0.0,
            approach_speed: touch.approach_speed,
            push_speed: 0.0,
            position: touch.position.iter().copied().collect(),
        }
    }

    /// Works out what only a contact that is over has.
    fn end(&mut self, contact: Contact, open: bool) -> Contact {
        let duration = contact.end - contact.begin;
        let tally = self.tally(contact.with);
        tally.over += 1;
        let count = &mut tally.count;
        count.longest_duration = count.longest_duration.max(duration);
        count.mean_duration += (duration - count.mean_duration) / tally.over as f64;
        Contact {
            open,
            // A blow takes no time: its force would be infinite.
            mean_force: Some(contact.impulse / duration).filter(|it| it.is_finite()),
            ..contact
        }
    }

    fn tally(&mut self, with: Partner) -> &mut Tally {
        match with {
            Partner::Agent => &mut self.agents,
            Partner::Obstacle => &mut self.obstacles,
        }
    }
}

#[cfg(test)]
mod tests;
