//! Claims: each is seen to hold, and to fail where it should.

#[path = "../common/mod.rs"]
mod common;
mod djokam_rathinam;
mod li_liu_wu;
mod olfati_saber_2003;
mod runs;
mod shi_wang_chu;
mod song_2013;

use volary::claim::{Reading, Verdict, abouts};

/// The tests of all papers.
const TESTS: [&str; 7] = [
    include_str!("djokam_rathinam.rs"),
    include_str!("li_liu_wu.rs"),
    include_str!("olfati_saber_2003.rs"),
    include_str!("shi_wang_chu.rs"),
    include_str!("song_2013.rs"),
    include_str!("song_2013/distances.rs"),
    include_str!("song_2013/quoted.rs"),
];

/// No claim may be satisfied by doing nothing: a test must see it hold, and one must see it
/// violated, or at least its hypotheses broken.
#[test]
fn every_claim_is_seen_to_hold_and_to_fail() {
    let called = |verb: &str, name: &str| {
        let call = format!("{verb}(\"{name}\"");
        TESTS.iter().any(|text| text.contains(&call))
    };
    for about in abouts() {
        let name = about.name;
        assert!(called("holds", name), "nowhere does {name} hold");
        let fails = called("violated", name) || called("unmet", name);
        assert!(fails, "nowhere does {name} fail");
    }
}

#[test]
fn names_are_unique_and_texts_are_whole() {
    let mut names: Vec<_> = abouts().iter().map(|about| about.name).collect();
    names.sort_unstable();
    let count = names.len();
    names.dedup();
    assert_eq!(names.len(), count);
    for about in abouts() {
        assert_eq!(about.name.split('/').count(), 2, "{}", about.name);
        let texts = [
            about.source,
            about.statement,
            about.hypotheses,
            about.measured,
            about.tolerance,
        ];
        assert!(texts.iter().all(|text| text.len() > 3), "{}", about.name);
    }
}

/// Claims that say nothing of motion: on states, graphs and laws.
const OF_STATES: [&str; 11] = [
    "djokam-rathinam/acceleration-bound",
    "djokam-rathinam/common-influence",
    "djokam-rathinam/velocity-hull",
    "olfati-saber-2003/approximation-error-printed",
    "olfati-saber-2003/approximation-error-corrected",
    "olfati-saber-2003/uniform-nets-are-balanced",
    "olfati-saber-2003/controller-bounds",
    "olfati-saber-2003/locality",
    "olfati-saber-2003/zero-potential",
    "shi-wang-chu/strong-connectivity",
    "song-2013/lemma-9",
];

/// Nothing that is said of motion is seen in one state; what holds there is said of states.
#[test]
fn one_state_satisfies_no_claim_on_motion() {
    for name in [
        "djokam-rathinam/friction",
        "li-liu-wu/theorem-3-1",
        "olfati-saber-2003/smooth-flock",
        "shi-wang-chu/ideal",
        "song-2013/example-18",
        "song-2013/example-19",
    ] {
        let world = runs::plane(name, &["time.end=0"]);
        let run = runs::points(&world);
        assert_eq!(run.observations.len(), 1);
        for claim in volary::claim::claims::<2>() {
            let Some(finding) = claim.judge(&run) else {
                continue;
            };
            let (about, verdict) = (claim.about(), finding.verdict);
            let claim = about.name;
            // Some hold in every state by itself.
            let of_states = OF_STATES.contains(&claim);
            assert!(of_states || verdict != Verdict::Holds, "{claim} in {name}");
            let misprinted = about.reading == Reading::Misprinted;
            assert!(
                misprinted || verdict != Verdict::Violated,
                "{claim} in {name}: {finding:?}"
            );
        }
    }
}
