//! A progress bar for when a person watches.

use std::fmt::Write;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressState, ProgressStyle};

/// How far a run has come; draws nothing where no person watches.
pub(super) struct Progress(ProgressBar);

impl Progress {
    /// A bar for this many steps of this size, on standard error; hidden where that is
    /// no terminal.
    pub(super) fn new(steps: u64, step_size: f64, quiet: bool) -> Self {
        let bar = if quiet {
            ProgressBar::hidden()
        } else {
            ProgressBar::new(steps)
        };
        let style =
            ProgressStyle::with_template("{bar:40} t = {time}, {speed} steps/s, {eta} left")
                .unwrap_or_else(|_| ProgressStyle::default_bar())
                .with_key("time", move |state: &ProgressState, out: &mut dyn Write| {
                    let _ = write!(out, "{:.2}", state.pos() as f64 * step_size);
                })
                .with_key("speed", |state: &ProgressState, out: &mut dyn Write| {
                    let _ = write!(out, "{:.0}", state.per_sec());
                });
        bar.set_style(style);
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    /// Counts the steps taken; drawn a few times a second at most.
    pub(super) fn show(&self, steps: u64) {
        self.0.set_position(steps);
    }

    /// Removes the bar.
    pub(super) fn finish(self) {
        self.0.finish_and_clear();
    }
}
