//! A request to stop, which whoever does long work looks at on the way.

mod loose;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

pub use loose::{Loose, tie_up};

/// A request to stop. Copies share it: one asks, the others see it.
#[derive(Debug, Clone, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Asks everybody who has a copy to stop as soon as they can.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether someone asked.
    pub fn asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
