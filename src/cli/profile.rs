//! Where the time went, as a run prints it.

use std::fmt::Write;
use std::time::Duration;

use volary::profile::Profile;

/// The parts of a run that took `whole` altogether, with their shares. What no part accounts for
/// is reading the world, placing the agents, checkpoints and printing.
pub(super) fn table(profile: &Profile, whole: Duration) -> String {
    let whole = whole.as_secs_f64();
    let mut text = "\nwhere the time went\n".to_owned();
    let rest = ("the rest".to_owned(), (whole - profile.total()).max(0.0));
    for (name, seconds) in profile.parts.iter().chain([&rest]) {
        let share = 100.0 * seconds / whole.max(f64::MIN_POSITIVE);
        let _ = writeln!(text, "  {name:<24}{seconds:>10.3} s {share:>5.1} %");
    }
    text
}
