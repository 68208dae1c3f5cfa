//! What a flock measures of its own time.

use crate::profile::Stopwatch;

/// The watches of a flock.
#[derive(Default)]
pub(super) struct Watches {
    /// Finding out who perceives whom.
    pub senses: Stopwatch,
    /// Passes in which all laws accelerate all agents, on several threads perhaps.
    pub passes: Stopwatch,
    /// Each law alone: what it prepares, and its share of the passes by the time of each thread.
    pub laws: Vec<[Stopwatch; 2]>,
}

impl Watches {
    /// For so many laws.
    pub fn new(laws: usize) -> Self {
        Self {
            laws: (0..laws).map(|_| Default::default()).collect(),
            ..Self::default()
        }
    }

    /// Turns them on or off.
    pub fn run(&self, on: bool) {
        let laws = self.laws.iter().flatten();
        laws.chain([&self.senses, &self.passes])
            .for_each(|watch| watch.run(on));
    }

    /// The seconds of each law: what it prepared, and its share of the time that passed in the
    /// passes, which is less than that of all threads together.
    pub fn of_laws(&self) -> Vec<f64> {
        let threads: f64 = self.laws.iter().map(|[_, pass]| pass.seconds()).sum();
        let share = match threads > 0.0 {
            true => self.passes.seconds() / threads,
            false => 0.0,
        };
        let seconds = |[own, pass]: &[Stopwatch; 2]| own.seconds() + share * pass.seconds();
        self.laws.iter().map(seconds).collect()
    }
}
