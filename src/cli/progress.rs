//! A progress bar for when a person watches.

use std::fmt::Write;
use std::ops::ControlFlow;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use volary::world::{Stage, Watch};

/// How far something long has come; draws nothing where no person watches.
pub(super) struct Progress(ProgressBar);

impl Progress {
    /// A bar for this many steps of this size, on standard error; hidden where that is
    /// no terminal.
    pub(super) fn new(steps: u64, step_size: f64, quiet: bool) -> Self {
        let style = style("{bar:40} t = {time}, {speed} steps/s, {eta} left");
        let time = move |state: &ProgressState, out: &mut dyn Write| {
            let _ = write!(out, "{:.2}", state.pos() as f64 * step_size);
        };
        Self::styled(steps, style.with_key("time", time), quiet)
    }

    /// A bar for this many frames, of which something is done.
    pub(super) fn of_frames(frames: u64, what: &str, quiet: bool) -> Self {
        let style = style(&format!(
            "{what} {{bar:40}} {{speed}} frames/s, {{eta}} left"
        ));
        Self::styled(frames, style, quiet)
    }

    /// A bar for this many steps of several runs together.
    pub(super) fn of_runs(steps: u64, quiet: bool) -> Self {
        let style = style("{bar:40} {percent} %, {speed} steps/s, {eta} left");
        Self::styled(steps, style, quiet)
    }

    /// A sign of life while something is prepared of which nobody knows how long it takes.
    pub(super) fn of_preparation(what: String, quiet: bool) -> Self {
        let progress = Self::styled(0, style("{spinner} {msg}"), quiet);
        progress.0.set_message(what);
        progress
    }

    /// Whom to tell how far a world has come.
    pub(super) fn watch(&self, world: &str) -> Watch {
        let (bar, world) = (self.0.clone(), world.to_owned());
        Watch::new(move |stage| {
            bar.set_message(match stage {
                Stage::Reading => format!("reading {world}"),
                Stage::Placing { placed, of } => {
                    format!("{world}: placing agents, {placed} of {of}")
                }
                _ => format!("{world}: building obstacles"),
            });
            ControlFlow::Continue(())
        })
    }

    fn styled(count: u64, style: ProgressStyle, quiet: bool) -> Self {
        let bar = match quiet {
            true => ProgressBar::hidden(),
            false => ProgressBar::new(count),
        };
        bar.set_style(style);
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    /// Counts what is done; drawn a few times a second at most.
    pub(super) fn show(&self, done: u64) {
        self.0.set_position(done);
    }

    /// Counts one more.
    pub(super) fn advance(&self) {
        self.0.inc(1);
    }

    /// Removes the bar.
    pub(super) fn finish(self) {
        self.0.finish_and_clear();
    }
}

/// A style that knows the speed.
fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .with_key("speed", |state: &ProgressState, out: &mut dyn Write| {
            let _ = write!(out, "{:.0}", state.per_sec());
        })
}
