//! Validation: bodies against points, and what worlds expect.

mod common;

use common::{from_json, order};
use volary::claim::{MovedBy, Run};
use volary::dynamics::{Accuracy, Dynamics};
use volary::metric::relative_kinetic_energy;
use volary::trace::record::Partner;
use volary::validate::report::{ContactOutcome, WorldReport};
use volary::validate::{Wanted, course, problems, validate};
use volary::world::{AnyWorld, Document, World, shipped};

fn plane(name: &str, set: &[&str]) -> World<2> {
    let text = shipped::get(name).expect("the world is shipped");
    let set = set.iter().map(|it| it.parse().expect("it can be set"));
    match Document::new(name, text).with(set).world(name) {
        Ok(AnyWorld::Plane(world)) => world,
        other => panic!("{name}: {other:?}"),
    }
}

fn both(world: &World<2>) -> WorldReport {
    let wanted = Wanted {
        points: Some(Accuracy::default()),
        bodies: true,
    };
    validate(world, wanted).expect("it can run")
}

/// A world of each paper, at a radius below theory's where there is one. Without contacts
/// bodies are as far from points as their method's error, which falls with the square of the
/// step.
#[test]
fn bodies_that_touch_nothing_are_points_to_second_order() {
    for (name, set) in [
        ("song-2013/example-18", vec!["time.end=3.2"]),
        ("song-2013/example-19", vec!["time.end=3.2"]),
        ("shi-wang-chu/ideal", vec!["time.end=3.2"]),
        ("li-liu-wu/figure-1", vec!["time.end=3.2"]),
        (
            "djokam-rathinam/friction",
            vec!["time.end=3.2", "laws[0].alignment.gain=1"],
        ),
        (
            "olfati-saber-2003/structural-net",
            vec![
                "time.end=3.2",
                "laws[0].alpha_interaction.protocol=smooth_weighted_damping",
            ],
        ),
    ] {
        let steps = [0.01, 0.005, 0.0025];
        let departures: Vec<f64> = steps
            .iter()
            .map(|step| {
                let step = format!("time.step={step}");
                let set: Vec<&str> = set
                    .iter()
                    .copied()
                    .chain([&*step, "record.every=0.2"])
                    .collect();
                let report = both(&plane(name, &set));
                let contact = report.contact.expect("bodies ran");
                assert!(contact.first.is_none(), "{name}: {:?}", contact.first);
                for exclusion in &contact.exclusions {
                    assert_eq!(
                        exclusion.outcome,
                        ContactOutcome::ExcludedAndNoneSeen,
                        "{name}"
                    );
                }
                contact.departure.expect("points ran").before_contact
            })
            .collect();
        let order = order(&steps, &departures);
        assert!(
            order > 1.8,
            "{name}: {departures:?} fall with order {order}"
        );
        assert!(departures[2] < 2e-3, "{name}: {departures:?}");
    }
}

/// Bodies under forces that conserve the energy seem to gain some in between, but no more than
/// is allowed them, and less and less as the step shrinks.
#[test]
fn energies_of_bodies_rise_no_more_than_the_step_accounts_for() {
    let rises = |step: &str| {
        let mut world = plane(
            "song-2013/example-18",
            &["time.end=4", "record.every=0.1", step],
        );
        // Without alignment.
        world.spec.laws.remove(0);
        let run = course(&world, Dynamics::Bodies).expect("it can run");
        assert!(run.first_contact.is_none());
        let energy = |k: usize| {
            let seen = &run.observations[k];
            relative_kinetic_energy(&seen.velocities) + seen.laws.potential.expect("it is finite")
        };
        let start = energy(0);
        let mut largest: f64 = 0.0;
        for k in 1..run.observations.len() {
            let rise = energy(k) - energy(k - 1);
            let slack = |k: usize| {
                let seen = &run.observations[k];
                let center = volary::math::mean(&seen.velocities);
                run.energy_slack(seen, start, &center, |_| 1.0)
            };
            assert!(rise <= slack(k) + slack(k - 1), "{rise} at frame {k}");
            largest = largest.max(rise);
        }
        largest
    };
    let steps = [0.01, 0.005, 0.0025];
    let rises = ["time.step=0.01", "time.step=0.005", "time.step=0.0025"].map(rises);
    assert!(rises[2] > 0.0);
    let order = order(&steps, &rises);
    assert!(order > 1.7, "{rises:?} fall with order {order}");
}

/// Bodies larger than theory keeps apart touch, and the report says when, why, and what is
/// claimed from then on.
#[test]
fn bodies_too_large_touch_where_points_do_not() {
    let world = plane(
        "song-2013/example-18",
        &["time.end=1", "agents[0].radius=0.6"],
    );
    let report = both(&world);
    let contact = report.contact.as_ref().expect("bodies ran");
    assert_eq!(contact.radius, 0.6);
    // The points keep 0.78 apart, which is room for bodies of half that radius.
    let points = contact.points_radius.expect("points ran");
    assert!((points - 0.39).abs() < 0.01, "{points}");
    // What touched was kept apart by its size, which says nothing of other radii.
    assert_eq!(contact.bodies_radius, None);
    let first = contact.first.as_ref().expect("they touch");
    let other = first.other_agent.expect("it is an agent");
    assert!(first.agent < other && first.approach_speed > 0.0);
    assert!(first.cause.contains("it is their size"), "{}", first.cause);
    let departure = contact.departure.as_ref().expect("points ran");
    assert!(departure.before_contact < 1e-2);
    assert!(departure.at_end > 10.0 * departure.before_contact);
    // The run's own numbers agree with the report's.
    let run: Run<'_, 2> = course(&world, Dynamics::Bodies).expect("it can run");
    assert_eq!(run.first_contact, Some(first.time));
    assert!(run.observations.iter().all(|seen| seen.time <= first.time));
    assert!(run.after_contact.iter().all(|seen| seen.time > first.time));
    assert!(run.contacts.iter().all(|it| it.with == Partner::Agent));
    assert_eq!(run.moved_by, MovedBy::Bodies { step: 0.005 });
}

#[test]
fn expectations_must_make_sense() {
    let said = |claims: serde_json::Value| -> Vec<String> {
        let mut world = plane("song-2013/example-18", &[]).spec;
        world.claims = from_json(claims);
        let found = problems(&world).into_iter();
        found
            .map(|it| format!("{} {} {:?}", it.path, it.what, it.hint))
            .collect()
    };
    let bound = "djokam-rathinam/acceleration-bound";
    let fine = serde_json::json!([
        { "claim": bound, "expect": "holds", "dynamics": "points" },
        { "claim": bound, "expect": "violated", "dynamics": "bodies" }
    ]);
    assert_eq!(said(fine), Vec::<String>::new());
    let twice = serde_json::json!([
        { "claim": bound, "expect": "holds" },
        { "claim": bound, "expect": "violated", "dynamics": "bodies" }
    ]);
    assert_eq!(said(twice).len(), 1);
    let unknown =
        serde_json::json!([{ "claim": "djokam-rathinam/acceleration-bond", "expect": "holds" }]);
    let said = said(unknown);
    assert!(
        said[0].starts_with("claims[0].claim is not the name of a claim"),
        "{said:?}"
    );
    assert!(
        said[0].contains("did you mean djokam-rathinam/acceleration-bound?"),
        "{said:?}"
    );
}

/// What a world expects decides, and what it does not mention must not be violated.
#[test]
fn worlds_say_what_is_to_come() {
    let bound = "djokam-rathinam/acceleration-bound";
    let judged = |claims: serde_json::Value| {
        let mut world = plane("djokam-rathinam/fast-0.1", &["time.end=1"]);
        world.spec.claims = from_json(claims);
        let report = both(&world);
        let claim = report.claims.iter().find(|it| it.claim == bound);
        let findings = &claim.expect("it has something to say").findings;
        assert_eq!(findings.len(), 2);
        let as_expected: Vec<bool> = findings.iter().map(|it| it.as_expected).collect();
        as_expected
    };
    assert_eq!(judged(serde_json::json!([])), [true, true]);
    let holds = serde_json::json!([{ "claim": bound, "expect": "holds" }]);
    assert_eq!(judged(holds), [true, true]);
    let violated = serde_json::json!([
        { "claim": bound, "expect": "violated", "dynamics": "bodies" }
    ]);
    assert_eq!(judged(violated), [true, false]);
}
