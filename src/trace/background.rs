//! Writing a trace on a thread of its own.

use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use super::record::Record;
use super::{TraceError, TracePosition, TraceWriter};
use crate::stop::Loose;

/// Records that may wait to be written. More would only take memory: whoever writes for long
/// slower than records come must hold them up.
const WAITING: usize = 64;

/// Agents in the frames that may wait, for the same reason.
const AGENTS_WAITING: usize = 200_000;

/// How long the end of the process waits for what was not written yet.
const PATIENCE: Duration = Duration::from_millis(30);

/// Writes a trace while it happens, on a thread of its own: turning numbers into text,
/// compressing and writing do not hold up the run.
///
/// Records come into the trace in the order in which they are given, all of them, and the same
/// bytes as a [`TraceWriter`] leaves. What went wrong with a record is told with one of the next,
/// or by [`finish`]. One that is dropped writes what it was given, as far as it can.
///
/// [`finish`]: BackgroundWriter::finish
#[derive(Debug)]
pub struct BackgroundWriter {
    /// Gone once the thread is asked to end.
    orders: Option<SyncSender<Order>>,
    thread: Option<JoinHandle<Result<(), TraceError>>>,
    /// Agents in the frames that may still wait.
    agents: usize,
    /// Has what waits written, as far as it may be, if the process ends early. It can give
    /// orders, so it must go before the thread finds that nobody can.
    loose: Option<Loose>,
}

/// What the thread is to do.
enum Order {
    Write(Box<Record>),
    /// Tells where the trace stands, with all that was ordered before in it.
    Position(SyncSender<Result<TracePosition, TraceError>>),
    /// Tells that all that was ordered before is done.
    Done(SyncSender<()>),
    /// The same, with all of it on its way to the disk.
    Flush(SyncSender<()>),
    Finish,
}

impl BackgroundWriter {
    /// Hands a writer to a thread of its own.
    ///
    /// # Errors
    /// Where the system has no thread to give.
    pub fn new(writer: TraceWriter, path: &Path) -> Result<Self, TraceError> {
        let (orders, queue) = sync_channel(WAITING);
        let thread = thread::Builder::new().name("trace".to_owned());
        let begin = || thread.spawn(move || obey(writer, &queue));
        let flush = orders.clone();
        let tie = |_: &JoinHandle<_>| -> Box<dyn FnOnce() + Send> {
            Box::new(move || {
                let (reply, answer) = sync_channel(1);
                // Where the queue is full, or the disk slow, what is written must do.
                if flush.try_send(Order::Flush(reply)).is_ok() {
                    let _ = answer.recv_timeout(PATIENCE);
                }
            })
        };
        let (thread, loose) = Loose::end(begin, tie).map_err(|source| TraceError::Io {
            action: "write",
            name: path.display().to_string(),
            source,
        })?;
        Ok(Self {
            orders: Some(orders),
            thread: Some(thread),
            agents: 0,
            loose: Some(loose),
        })
    }

    /// Gives it one record to write.
    ///
    /// # Errors
    /// Those of an earlier record. Nothing can be written after that.
    pub fn write(&mut self, record: Record) -> Result<(), TraceError> {
        if let Record::Frame(frame) = &record {
            self.agents += frame.positions.len();
            if self.agents > AGENTS_WAITING {
                self.ask(Order::Done)?;
                self.agents = frame.positions.len();
            }
        }
        self.order(Order::Write(Box::new(record)))
    }

    /// As [`TraceWriter::position`], with all records in it that were given before.
    ///
    /// # Errors
    /// Those of [`TraceWriter::position`], and of an earlier record.
    pub fn position(&mut self) -> Result<TracePosition, TraceError> {
        self.ask(Order::Position)?
    }

    /// Waits for the answer to an order.
    fn ask<T>(&mut self, order: impl FnOnce(SyncSender<T>) -> Order) -> Result<T, TraceError> {
        let (reply, answer) = sync_channel(1);
        self.order(order(reply))?;
        // Without an answer, it ended over an earlier record.
        answer
            .recv()
            .map_err(|_| self.end().err().unwrap_or_else(gone))
    }

    /// Writes what waits and closes the trace.
    ///
    /// # Errors
    /// Where something could not be written.
    pub fn finish(mut self) -> Result<(), TraceError> {
        self.order(Order::Finish)?;
        self.end()
    }

    fn order(&mut self, order: Order) -> Result<(), TraceError> {
        let sent = self.orders.as_ref().map(|orders| orders.send(order));
        match sent {
            Some(Ok(())) => Ok(()),
            _ => Err(self.end().err().unwrap_or_else(gone)),
        }
    }

    /// Waits for the thread to end; nothing is left to be said the second time.
    fn end(&mut self) -> Result<(), TraceError> {
        (self.orders, self.loose) = (None, None);
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(done)) => done,
            Some(Err(panic)) => std::panic::resume_unwind(panic),
            None => Ok(()),
        }
    }
}

impl Drop for BackgroundWriter {
    fn drop(&mut self) {
        // There is nobody left to tell.
        (self.orders, self.loose) = (None, None);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// The thread: writes until it is to finish, or nobody is left to give orders.
fn obey(mut writer: TraceWriter, orders: &Receiver<Order>) -> Result<(), TraceError> {
    for order in orders {
        match order {
            Order::Write(record) => writer.write(&record)?,
            Order::Position(reply) => {
                // Who asked waits for the answer.
                let _ = reply.send(writer.position());
            }
            Order::Done(reply) => {
                let _ = reply.send(());
            }
            Order::Flush(reply) => {
                // Who asked ends the process next.
                writer.flush();
                let _ = reply.send(());
            }
            Order::Finish => return writer.finish(),
        }
    }
    Ok(())
}

/// The error where there has been one before, which was told.
fn gone() -> TraceError {
    TraceError::Io {
        action: "write",
        name: "the trace".to_owned(),
        source: std::io::Error::other("nothing more can be written after an error"),
    }
}
