//! Where the time of a simulation goes.

use super::Simulation;
use crate::profile::{Profile, Stopwatch};

/// What is measured of a simulation besides what its parts measure.
#[derive(Default)]
pub(super) struct Watches {
    /// Whole steps of what moves the agents.
    pub step: Stopwatch,
    pub ledger: Stopwatch,
    pub frames: Stopwatch,
    pub trace: Stopwatch,
}

impl<const D: usize> Simulation<D> {
    /// Measures from now on where the time goes, or does so no longer.
    pub fn measure(&mut self, on: bool) {
        let Watches {
            step,
            ledger,
            frames,
            trace,
        } = &self.watches;
        for watch in [step, ledger, frames, trace] {
            watch.run(on);
        }
        self.flock.measure(on);
        self.agents.measure(on);
    }

    /// Where the time went while it was measured: the senses (neighbours and what agents perceive),
    /// each law, the engine and its contacts, what couples them to the laws (of points the
    /// solver), the ledger of contacts, frames with their metrics, and handing records over. A
    /// law that several threads work out at once has its share of the time that passed.
    pub fn profile(&self) -> Profile {
        let mut parts = self.flock.profile();
        parts.extend(self.agents.profile());
        let inside: f64 = parts.iter().map(|(_, seconds)| seconds).sum();
        let rest = (self.watches.step.seconds() - inside).max(0.0);
        let after = [
            (self.solver().map_or("coupling", |_| "solver"), rest),
            ("ledger", self.watches.ledger.seconds()),
            ("metrics", self.watches.frames.seconds()),
            ("trace", self.watches.trace.seconds()),
        ];
        parts.extend(after.map(|(name, seconds)| (name.to_owned(), seconds)));
        Profile { parts }
    }
}
