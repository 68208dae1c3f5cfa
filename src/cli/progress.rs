//! A progress bar for when a person watches.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// How far a run has come; draws nothing where no person watches.
pub(super) struct Progress {
    bar: ProgressBar,
    total: u64,
}

/// Steps between updates of the bar, so that drawing never holds up the run.
const STRIDE: u64 = 64;

impl Progress {
    /// A bar for this many steps, on standard error; hidden where that is no terminal.
    pub(super) fn new(steps: u64, quiet: bool) -> Self {
        let bar = if quiet {
            ProgressBar::hidden()
        } else {
            ProgressBar::new(steps)
        };
        let style = ProgressStyle::with_template("{bar:40} t = {msg}  {per_sec} steps, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar, total: steps }
    }

    /// Shows the state after a step.
    pub(super) fn show(&self, step: u64, time: f64) {
        if step.is_multiple_of(STRIDE) || step == self.total {
            self.bar.set_position(step);
            self.bar.set_message(format!("{time:.2}"));
        }
    }

    /// Removes the bar.
    pub(super) fn finish(self) {
        self.bar.finish_and_clear();
    }
}
