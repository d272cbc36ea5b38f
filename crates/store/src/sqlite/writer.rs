//! The one thread that writes. It takes everything that waits into one transaction and answers after the commit.

use super::fault::SqliteFault;
use crate::{FolderLock, StoreError};
use phrase::phrase;
use rusqlite::{Connection, Transaction, TransactionBehavior};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::sync::{mpsc, oneshot};

/// Jobs that may wait; whoever comes later waits for room in the queue.
const WAITING_MAX: usize = 1_024;
/// Jobs in one transaction.
const BATCH_MAX: usize = 256;
/// The longest time of a write before its outcome is given up as unknown.
const ANSWER_MAX: Duration = Duration::from_secs(30);

/// The way to the writing thread. Dropping it waits until the thread has finished and the directory is free.
pub(super) struct SqliteWriter {
    queue: Option<mpsc::Sender<Box<dyn QueuedWork>>>,
    thread: Option<JoinHandle<()>>,
}

impl SqliteWriter {
    /// Starts the thread; it holds the directory's lock until it ends.
    pub(super) fn start(at: Connection, file: PathBuf, lock: Arc<FolderLock>) -> Result<Self, StoreError> {
        let (queue, waiting) = mpsc::channel(WAITING_MAX);
        let work = move || {
            write_all(at, &file, waiting);
            drop(lock);
        };
        let thread = std::thread::Builder::new().name("store-writer".to_owned()).spawn(work);
        let thread =
            thread.map_err(|error| StoreError::Unavailable(format!("no thread to write with: {error}").into()))?;
        Ok(Self { queue: Some(queue), thread: Some(thread) })
    }

    /// Does a piece of work in the thread and answers once it is durable.
    pub(super) async fn ask<T, F>(&self, work: F) -> Result<T, StoreError>
    where
        T: Send + 'static,
        F: FnOnce(&Connection) -> Result<T, SqliteFault> + Send + 'static,
    {
        let stopped = || StoreError::Unavailable(phrase!("store.the_store_has_stopped", "the store has stopped"));
        let (reply, answer) = oneshot::channel();
        let queue = self.queue.as_ref().ok_or_else(stopped)?;
        let asked = async {
            queue.send(Box::new(WriteJob { work: Some(work), found: None, reply })).await.map_err(|_| stopped())?;
            answer.await.map_err(|_| stopped())?
        };
        tokio::time::timeout(ANSWER_MAX, asked).await.map_err(|_| StoreError::Timeout)?
    }
}

impl Drop for SqliteWriter {
    fn drop(&mut self) {
        self.queue = None;
        if let Some(thread) = self.thread.take() {
            let _panicked = thread.join();
        }
    }
}

/// A piece of work in the queue, whatever it answers.
trait QueuedWork: Send {
    /// Does the work and keeps what it found.
    fn run(&mut self, at: &Connection, file: &Path) -> Result<(), StoreError>;
    /// Tells what was found, or that it could not be saved after all.
    fn answer(self: Box<Self>, saved: &Result<(), StoreError>);
}

struct WriteJob<T, F> {
    work: Option<F>,
    found: Option<Result<T, StoreError>>,
    reply: oneshot::Sender<Result<T, StoreError>>,
}

impl<T, F> QueuedWork for WriteJob<T, F>
where
    T: Send,
    F: FnOnce(&Connection) -> Result<T, SqliteFault> + Send,
{
    fn run(&mut self, at: &Connection, file: &Path) -> Result<(), StoreError> {
        let Some(work) = self.work.take() else { return Ok(()) };
        let found = work(at).map_err(|fault| fault.told(file));
        let went = found.as_ref().map(|_| ()).map_err(Clone::clone);
        self.found = Some(found);
        went
    }

    fn answer(self: Box<Self>, saved: &Result<(), StoreError>) {
        let lost = || Err(StoreError::Unavailable("nothing was done".into()));
        let found = match (self.found, saved) {
            (Some(Ok(_)) | None, Err(error)) => Err(error.clone()),
            (found, _) => found.unwrap_or_else(lost),
        };
        let _nobody_waits_any_more = self.reply.send(found);
    }
}

fn write_all(mut at: Connection, file: &Path, mut waiting: mpsc::Receiver<Box<dyn QueuedWork>>) {
    while let Some(first) = waiting.blocking_recv() {
        let mut batch = vec![first];
        while batch.len() < BATCH_MAX
            && let Ok(next) = waiting.try_recv()
        {
            batch.push(next);
        }
        let saved = write_batch(&mut at, file, &mut batch);
        for job in batch {
            job.answer(&saved);
        }
    }
}

fn write_batch(at: &mut Connection, file: &Path, batch: &mut [Box<dyn QueuedWork>]) -> Result<(), StoreError> {
    let told = |error| SqliteFault::Sql(error).told(file);
    let mut together = at.transaction_with_behavior(TransactionBehavior::Immediate).map_err(told)?;
    for job in batch {
        write_one(&mut together, file, job.as_mut())?;
    }
    together.commit().map_err(told)
}

/// One job, undone alone if it fails; an error only if SQLite gave up the whole transaction.
fn write_one(together: &mut Transaction, file: &Path, job: &mut dyn QueuedWork) -> Result<(), StoreError> {
    let told = |error| SqliteFault::Sql(error).told(file);
    let alone = together.savepoint().map_err(told)?;
    match job.run(&alone, file) {
        Ok(()) => alone.commit().map_err(told),
        Err(error) if alone.is_autocommit() => Err(error),
        Err(_) => alone.finish().map_err(told),
    }
}
