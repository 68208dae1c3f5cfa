//! Ctrl-C, and what else asks the program to end.
//!
//! What a command does may be long, and much of it is a single call that nothing can stop. So
//! every signal ends the program within a fifth of a second, in one of three ways:
//!
//! - A command that has nothing to lose ends at once.
//! - One that looks at its [`Stop`] has a moment to come to an end by itself; then it is ended.
//! - One that did so and writes down what it has done gets some seconds for it.
//!
//! Whoever ends it removes files that are not whole and lets the trace be written up to where it
//! is. A second signal ends it at once.

use std::io::Write;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::{Duration, Instant};

use volary::stop::{Stop, tie_up};

/// For a command that looks at its [`Stop`].
const MOMENT: Duration = Duration::from_millis(100);

/// For one that writes down what it has done.
const MOST: Duration = Duration::from_secs(5);

/// Between two looks at how far the command is.
const TICK: Duration = Duration::from_millis(10);

/// What the command makes of a signal.
static MANNER: AtomicU8 = AtomicU8::new(ENDS);
const ENDS: u8 = 0;
const LOOKS: u8 = 1;
const SAVES: u8 = 2;

/// Heeds signals from now on; the stop is asked for by the first one.
pub(super) fn heed_signals() -> Stop {
    let stop = Stop::default();
    let asked = stop.clone();
    // Without a handler a signal ends the program at once, which leaves files that are not whole.
    let _ = ctrlc::set_handler(move || {
        let again = asked.asked();
        asked.ask();
        if again || MANNER.load(Ordering::Relaxed) == ENDS {
            end();
        }
        // Without a thread to wait on, there is no waiting.
        if std::thread::Builder::new().spawn(wait).is_err() {
            end();
        }
    });
    stop
}

/// Says that the command looks at its stop from now on, some ten times a second.
pub(super) fn looks() {
    MANNER.store(LOOKS, Ordering::Relaxed);
}

/// Says that the command has stopped and writes down what it has done.
pub(super) fn saves() {
    MANNER.store(SAVES, Ordering::Relaxed);
}

/// Waits for the command to end by itself, but not for long.
fn wait() {
    let begin = Instant::now();
    // Ticks are counted, for where the machine is too busy for them the command waits as well.
    let moment = MOMENT.div_duration_f64(TICK) as u32;
    for _ in 0..moment {
        std::thread::sleep(TICK);
    }
    while MANNER.load(Ordering::Relaxed) == SAVES && begin.elapsed() < MOST {
        std::thread::sleep(TICK);
    }
    end();
}

/// Ends the program in good order.
fn end() -> ! {
    tie_up();
    // Nobody is left to tell where standard error is gone.
    let _ = writeln!(std::io::stderr(), "Stopped.");
    std::process::exit(1)
}
