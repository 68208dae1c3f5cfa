//! The ledger, on touches made up.

use super::*;
use crate::math::Vector;

const FAR: f64 = 0.1;

fn touch(agent: usize, touched: Touched, gap: f64, press: f64) -> Touch<2> {
    Touch {
        agent,
        touched,
        time: 0.0,
        gap,
        blow: 0.0,
        press,
        friction: 0.0,
        approach_speed: 2.0,
        push_speed: 0.0,
        normal: Vector::<2>::new(1.0, 0.0),
        point: Vector::<2>::new(3.5, 4.0),
        position: Vector::<2>::new(3.0, 4.0),
    }
}

/// Bodies that meet at a time with a blow.
fn blow(time: f64, impulse: f64) -> Touch<2> {
    Touch {
        time,
        blow: impulse,
        ..touch(2, Touched::Agent(5), 0.0, 0.0)
    }
}

/// Enters a step that ends at `end`, of size 0.1, after which all pairs are this far apart.
fn enter(ledger: &mut Ledger, end: f64, touches: &[Touch<2>], apart: f64) -> Vec<Contact> {
    ledger.enter(end - 0.1, end, touches, |_, _| apart)
}

#[test]
fn an_episode_lasts_from_first_to_last_touch() {
    let mut ledger = Ledger::default();
    let pair = Touched::Agent(5);
    let begun = Touch {
        time: 0.03,
        ..touch(2, pair, 0.01, 1.0)
    };
    assert!(enter(&mut ledger, 0.1, &[begun], 0.01).is_empty());
    assert!(enter(&mut ledger, 0.2, &[touch(2, pair, -0.03, 4.0)], 0.0).is_empty());
    let over = enter(&mut ledger, 0.3, &[], FAR);
    assert_eq!(over.len(), 1);
    let contact = &over[0];
    assert_eq!((contact.begin, contact.end, contact.steps), (0.03, 0.2, 2));
    assert_eq!(
        (contact.largest_impulse, contact.deepest_penetration),
        (4.0, 0.03)
    );
    assert_eq!(
        (contact.impulse, contact.blow, contact.blows),
        (5.0, 0.0, 0)
    );
    assert_eq!(contact.mean_force, Some(5.0 / (0.2 - 0.03)));
    assert!(!contact.open);
    // The same pair again is another episode, but not another pair.
    enter(&mut ledger, 0.4, &[touch(2, pair, -0.01, 0.0)], -0.01);
    assert_eq!(ledger.agent_contacts().episodes, 2);
    assert_eq!(ledger.agent_contacts().pairs, 1);
    assert_eq!(ledger.smallest_agent_gap(), Some(-0.03));
    assert_eq!(ledger.first_contact(), Some(0.03));
    let rest = ledger.close::<2>(0.4, &[touch(2, pair, -0.02, 0.0)]);
    assert!(
        rest.len() == 1 && rest[0].open && rest[0].steps == 1,
        "{rest:?}"
    );
    let durations = ledger.agent_contacts();
    let (first, second) = (0.2 - 0.03, rest[0].end - rest[0].begin);
    assert_eq!(durations.longest_duration, first);
    assert_eq!(durations.mean_duration, first + (second - first) / 2.0);
}

#[test]
fn a_blow_after_which_bodies_part_is_over_in_its_step() {
    let mut ledger = Ledger::default();
    let over = enter(&mut ledger, 0.1, &[blow(0.06, 3.0)], FAR);
    assert_eq!(over.len(), 1, "{over:?}");
    let contact = &over[0];
    assert_eq!((contact.begin, contact.end, contact.steps), (0.06, 0.06, 1));
    assert_eq!((contact.blow, contact.blows), (3.0, 1));
    assert_eq!((contact.impulse, contact.mean_force), (3.0, None));
    assert!(ledger.close::<2>(0.1, &[]).is_empty());
    assert_eq!(ledger.agent_contacts().largest_blow, 3.0);
}

#[test]
fn impulses_of_rounding_are_neither_blows_nor_lasting_contact() {
    let mut ledger = Ledger::default();
    let noisy = Touch {
        press: 1e-17,
        ..blow(0.05, 1.0)
    };
    assert!(enter(&mut ledger, 0.1, &[noisy], 0.0).is_empty());
    assert!(enter(&mut ledger, 0.2, &[blow(0.15, 1e-17)], 0.0).is_empty());
    let parting = Touch {
        press: 1e-17,
        ..blow(0.25, 2.0)
    };
    let over = enter(&mut ledger, 0.3, &[parting], FAR);
    assert_eq!((over[0].blows, over[0].blow, over[0].end), (2, 2.0, 0.25));
}

#[test]
fn a_touch_lies_within_its_step() {
    let mut ledger = Ledger::default();
    let over = enter(&mut ledger, 0.3, &[blow(0.0, 1.0)], FAR);
    assert_eq!(over[0].begin, 0.3 - 0.1);
    let over = enter(&mut ledger, 0.4, &[blow(9.0, 1.0)], FAR);
    assert_eq!(over[0].begin, 0.4);
}

/// An inelastic hit: rounding makes the gap change its sign, and tiny impulses come and go.
#[test]
fn what_chatters_is_one_episode() {
    let mut ledger = Ledger::default();
    assert!(enter(&mut ledger, 0.1, &[blow(0.05, 0.75)], 1e-16).is_empty());
    for k in 2..50 {
        let end = 0.1 * f64::from(k);
        let (gap, press) = match k % 3 {
            0 => (1e-16, 0.0),
            1 => (-1e-16, 1e-17),
            _ => (-1e-16, 0.0),
        };
        let touches: Vec<_> = (k % 2 == 0 || press > 0.0)
            .then(|| touch(2, Touched::Agent(5), gap, press))
            .into_iter()
            .collect();
        assert!(enter(&mut ledger, end, &touches, gap).is_empty());
    }
    let rest = ledger.close::<2>(4.9, &[]);
    assert_eq!(rest.len(), 1);
    assert_eq!((rest[0].blow, rest[0].blows, rest[0].steps), (0.75, 1, 49));
    assert!(
        rest[0].open && (rest[0].end - 4.9).abs() < 1e-12,
        "{rest:?}"
    );
    assert_eq!(ledger.agent_contacts().episodes, 1);
}

/// Near is not touching: the end waits for the bodies to part, and tells when they touched last.
#[test]
fn an_episode_ends_when_bodies_have_parted_not_when_they_stop_touching() {
    let mut ledger = Ledger::default();
    assert!(enter(&mut ledger, 0.1, &[blow(0.05, 1.0)], 0.9 * PARTED).is_empty());
    assert!(enter(&mut ledger, 0.2, &[], 0.9 * PARTED).is_empty());
    // They come back, and the episode goes on.
    assert!(enter(&mut ledger, 0.3, &[blow(0.25, 2.0)], 0.5 * PARTED).is_empty());
    let over = enter(&mut ledger, 0.4, &[], 1.1 * PARTED);
    assert_eq!(over.len(), 1);
    assert_eq!((over[0].begin, over[0].end), (0.05, 0.25));
    assert_eq!((over[0].steps, over[0].blows, over[0].blow), (2, 2, 2.0));
    assert_eq!(over[0].impulse, 3.0);
}

#[test]
fn pairs_end_each_on_its_own() {
    let mut ledger = Ledger::default();
    let wall = Touched::Obstacle(1);
    let touches = [touch(0, wall, 0.0, 1.0), touch(3, wall, 0.0, 2.0)];
    assert!(enter(&mut ledger, 0.1, &touches, FAR).is_empty());
    let near = |agent, _| if agent == 3 { 0.0 } else { FAR };
    let over = ledger.enter::<2>(0.1, 0.2, &[], near);
    assert_eq!(over.len(), 1);
    assert_eq!((over[0].agent, over[0].end), (0, 0.1));
    assert_eq!(ledger.obstacle_contacts().episodes, 2);
    let rest = ledger.close::<2>(0.2, &[]);
    assert_eq!((rest[0].agent, rest[0].end), (3, 0.2));
}

#[test]
fn friction_is_kept_apart() {
    let mut ledger = Ledger::default();
    let rubbing = |press, friction| Touch {
        friction,
        ..touch(2, Touched::Obstacle(0), 0.0, press)
    };
    enter(&mut ledger, 0.1, &[rubbing(4.0, 0.5)], 0.0);
    enter(&mut ledger, 0.2, &[rubbing(1.0, 0.25)], 0.0);
    let over = enter(&mut ledger, 0.3, &[], FAR);
    assert_eq!((over[0].impulse, over[0].friction), (5.0, 0.75));
    let counted = ledger.obstacle_contacts();
    assert_eq!((counted.impulse, counted.friction), (5.0, 0.75));
}

#[test]
fn obstacles_are_counted_apart() {
    let mut ledger = Ledger::default();
    enter(
        &mut ledger,
        0.1,
        &[touch(2, Touched::Obstacle(0), 0.0, 1.0)],
        FAR,
    );
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
        let end = 0.1 * (step + 1) as f64;
        enter(&mut ledger, end, &[pushing(push_speed)], 0.0);
    }
    assert_eq!(ledger.obstacle_contacts().pushed, 1);
    let over = enter(&mut ledger, 0.5, &[], FAR);
    assert_eq!(over[0].push_speed, 2.0);
    enter(&mut ledger, 0.6, &[pushing(0.0)], 0.0);
    let counted = ledger.obstacle_contacts();
    assert_eq!((counted.episodes, counted.pushed), (2, 1));
}
