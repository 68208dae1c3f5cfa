//! Loose ends: what must not be left behind by a process that ends before it is done.

use std::fmt;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What ties an end.
type Tie = Box<dyn FnOnce() + Send>;

/// All loose ends of the process.
struct Ends {
    ties: Vec<(u64, Tie)>,
    next: u64,
    /// Whether the process is about to end.
    over: bool,
}

static ENDS: Mutex<Ends> = Mutex::new(Ends {
    ties: Vec::new(),
    next: 0,
    over: false,
});

fn ends() -> MutexGuard<'static, Ends> {
    ENDS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A loose end, which [`tie_up`] would tie. Dropped, it is loose no longer.
pub struct Loose(u64);

impl Loose {
    /// Makes something that must not be left as it is: in one with it comes what is to be done
    /// about it if the process ends early. Once that has begun, nothing is made any more.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn end<T, E>(
        make: impl FnOnce() -> Result<T, E>,
        tie: impl FnOnce(&T) -> Tie,
    ) -> Result<(T, Self), E> {
        let mut ends = ends();
        while ends.over {
            drop(ends);
            // The process is gone in a moment.
            std::thread::park();
            ends = self::ends();
        }
        let made = make()?;
        let number = ends.next;
        ends.next += 1;
        ends.ties.push((number, tie(&made)));
        Ok((made, Self(number)))
    }

    /// Does something that leaves it tied, before or after [`tie_up`], never at the same time.
    pub fn settle<T>(self, last: impl FnOnce() -> T) -> T {
        let guard = ends();
        let done = last();
        drop(guard);
        done
    }
}

impl Drop for Loose {
    fn drop(&mut self) {
        ends().ties.retain(|(number, _)| *number != self.0);
    }
}

impl fmt::Debug for Loose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Loose").field(&self.0).finish()
    }
}

/// Ties all loose ends, those last that were first, since the process is about to end: files
/// that are not whole are removed, programs that were started are ended. Nothing that would be
/// one can be begun after this: whoever tries waits for the end.
pub fn tie_up() {
    let mut ends = ends();
    ends.over = true;
    // The lock is held, so that nobody is in the middle of something.
    for (_, tie) in ends.ties.drain(..).rev() {
        tie();
    }
}
