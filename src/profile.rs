//! Where the time of a run goes.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Instant;

/// Adds up the time that some work takes. It costs next to nothing while it is off, which it is
/// at first.
#[derive(Debug, Default)]
pub struct Stopwatch {
    running: AtomicBool,
    nanoseconds: AtomicU64,
}

impl Stopwatch {
    /// Does some work, and adds the time that it takes. Work on several threads at once adds the
    /// time of each.
    #[inline]
    pub fn time<T>(&self, work: impl FnOnce() -> T) -> T {
        let begin = self.begin();
        let done = work();
        self.end(begin);
        done
    }

    /// The beginning of some work; nothing while the watch is off.
    #[inline]
    pub fn begin(&self) -> Option<Instant> {
        self.running.load(Ordering::Relaxed).then(Instant::now)
    }

    /// Adds the time since the beginning of some work.
    #[inline]
    pub fn end(&self, begin: Option<Instant>) {
        if let Some(begin) = begin {
            let took = u64::try_from(begin.elapsed().as_nanos()).unwrap_or(u64::MAX);
            self.nanoseconds.fetch_add(took, Ordering::Relaxed);
        }
    }

    /// Turns it on or off; what it has added up stays.
    pub fn run(&self, on: bool) {
        self.running.store(on, Ordering::Relaxed);
    }

    /// What it has added up, in seconds.
    pub fn seconds(&self) -> f64 {
        self.nanoseconds.load(Ordering::Relaxed) as f64 * 1e-9
    }
}

/// Where the time of a run went.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// The parts of the work in the order in which a step does them, and the seconds that each
    /// took; what several threads did at once counts once.
    pub parts: Vec<(String, f64)>,
}

impl Profile {
    /// The seconds of all parts.
    pub fn total(&self) -> f64 {
        self.parts.iter().map(|(_, seconds)| seconds).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn it_runs_only_while_it_is_on() {
        let watch = Stopwatch::default();
        let nap = || std::thread::sleep(Duration::from_millis(2));
        watch.time(nap);
        assert_eq!(watch.seconds(), 0.0);
        watch.run(true);
        assert_eq!(watch.time(|| 7), 7);
        watch.time(nap);
        assert!(watch.seconds() >= 0.002);
        watch.run(false);
        let before = watch.seconds();
        watch.time(nap);
        assert_eq!(watch.seconds(), before);
    }
}
