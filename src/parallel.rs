//! Work shared out over threads.
//!
//! Agents are handled in chunks of a fixed size, in each of which the order is fixed: so no
//! result depends on the number of threads.

use rayon::iter::plumbing::{Producer, ProducerCallback};
use rayon::prelude::*;

/// Agents handled in one go; few enough to spread over threads, enough to be worth it.
pub const CHUNK: usize = 128;

/// Below this many agents, handing work to other threads costs more than it saves.
pub const PARALLEL_FROM: usize = 500;

/// Does some work with each item, a chunk of the `agents` in all: on all threads where there
/// are enough of them, here where there are few.
pub fn for_each<I: IndexedParallelIterator>(
    agents: usize,
    chunks: I,
    work: impl Fn(I::Item) + Send + Sync,
) {
    if agents < PARALLEL_FROM {
        chunks.with_producer(Here(work));
    } else {
        chunks.for_each(work);
    }
}

/// Work to be done one item after the other.
struct Here<W>(W);

impl<T, W: Fn(T)> ProducerCallback<T> for Here<W> {
    type Output = ();

    fn callback<P: Producer<Item = T>>(self, producer: P) {
        producer.into_iter().for_each(self.0);
    }
}

/// Writes the value of each of some agents into `out`, in this order of them.
pub fn gather<T: Copy + Send + Sync>(order: &[u32], values: &[T], out: &mut [T]) {
    let chunks = out.par_chunks_mut(CHUNK).zip(order.par_chunks(CHUNK));
    for_each(order.len(), chunks, |(out, order)| {
        for (out, &agent) in out.iter_mut().zip(order) {
            *out = values[agent as usize];
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_and_many_are_all_done() {
        for agents in [0, 1, CHUNK, PARALLEL_FROM - 1, PARALLEL_FROM, 3000] {
            let mut done = vec![0; agents];
            let chunks = done.par_chunks_mut(CHUNK).enumerate();
            for_each(agents, chunks, |(chunk, done)| {
                for (k, done) in done.iter_mut().enumerate() {
                    *done += chunk * CHUNK + k;
                }
            });
            assert!(done.iter().copied().eq(0..agents));
            let back: Vec<u32> = (0..agents as u32).rev().collect();
            let mut gathered = vec![7; agents];
            gather(&back, &done, &mut gathered);
            assert!(gathered.into_iter().rev().eq(0..agents));
        }
    }
}
