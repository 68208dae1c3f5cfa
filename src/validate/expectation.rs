//! What worlds expect of claims.

use crate::claim::{Verdict, abouts};
use crate::world::spec::{ClaimSpec, DynamicsName, WorldSpec};
use crate::world::{Problem, nearest_path};

/// What is wrong with what a world expects: claims that do not exist, or are to come to two
/// different verdicts.
pub fn problems(world: &WorldSpec) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (index, expected) in world.claims.iter().enumerate() {
        let path = |field: &str| format!("claims[{index}].{field}");
        let names: Vec<_> = abouts().into_iter().map(|about| about.name).collect();
        if !names.contains(&expected.claim.as_str()) {
            let problem = Problem::new(path("claim"), "is not the name of a claim");
            let hint = match nearest_path(&expected.claim, &names) {
                Some(name) => format!("did you mean {name}?"),
                None => "`volary claims` lists them".to_owned(),
            };
            problems.push(problem.hint(hint));
            continue;
        }
        let before = world.claims[..index].iter();
        let mut contradicting =
            before.filter(|it| it.claim == expected.claim && meet(it, expected));
        if contradicting.next().is_some() {
            let what = "is said before of the same claim and dynamics";
            problems.push(Problem::new(path("expect"), what));
        }
    }
    problems
}

/// Whether two entries speak of the same dynamics.
fn meet(one: &ClaimSpec, other: &ClaimSpec) -> bool {
    match (one.dynamics, other.dynamics) {
        (Some(one), Some(other)) => one == other,
        _ => true,
    }
}

/// The verdict that a world expects of a claim.
pub fn expected(world: &WorldSpec, claim: &str, dynamics: DynamicsName) -> Option<Verdict> {
    let about = |it: &&ClaimSpec| {
        it.claim == claim && it.dynamics.is_none_or(|expected| expected == dynamics)
    };
    world.claims.iter().find(about).map(|it| it.expect)
}
