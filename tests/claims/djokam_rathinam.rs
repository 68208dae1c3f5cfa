//! The claims of Djokam & Rathinam.

use crate::runs::{holds, plane, points, unmet, violated};
use volary::claim::Run;

#[test]
fn accelerations_keep_their_bound() {
    let world = plane("djokam-rathinam/fast-0.1", &["time.end=2"]);
    let run = points(&world);
    let finding = holds("djokam-rathinam/acceleration-bound", &run);
    // The law comes near its bound: at the start it stands at 0.97 of it.
    assert!(
        finding.margin.is_some_and(|margin| margin < 0.2),
        "{finding:?}"
    );

    let tighter = plane(
        "djokam-rathinam/fast-0.1",
        &["laws[0].alignment.gain.bounded.bound=5"],
    );
    let run = Run {
        world: &tighter,
        ..run
    };
    violated("djokam-rathinam/acceleration-bound", &run);

    let unbounded = plane(
        "djokam-rathinam/fast-0.1",
        &["time.end=1", "laws[0].alignment.gain=10"],
    );
    unmet("djokam-rathinam/acceleration-bound", &points(&unbounded));
}
