//! A few connections that read, each in a thread that may block.

use super::connect;
use super::fault::SqliteFault;
use crate::StoreError;
use rusqlite::Connection;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

/// Connections that read at the same time.
const READERS: usize = 4;
/// The longest time of a read, waiting for a free connection included.
const ANSWER_MAX: Duration = Duration::from_secs(30);

/// The reading connections.
pub(super) struct Readers {
    file: PathBuf,
    free: Mutex<Free>,
    places: Arc<Semaphore>,
}

struct Free {
    /// True if one connection has the database for itself, as the disk is full.
    alone: bool,
    connections: Vec<Connection>,
}

impl Free {
    /// All connections, beside one that writes.
    fn beside_a_writer(file: &Path) -> Result<Self, SqliteFault> {
        let connections = (0..READERS).map(|_| connect::reader(file)).collect::<Result<_, _>>()?;
        Ok(Self { alone: false, connections })
    }
}

impl Readers {
    /// Opens them all.
    pub(super) fn open(file: PathBuf) -> Result<Self, SqliteFault> {
        let free = Mutex::new(Free::beside_a_writer(&file)?);
        Ok(Self { file, free, places: Arc::new(Semaphore::new(READERS)) })
    }

    /// Opens the one that can read on a full disk.
    pub(super) fn alone(file: PathBuf) -> Result<Self, SqliteFault> {
        let free = Mutex::new(Free { alone: true, connections: vec![connect::alone(&file)?] });
        Ok(Self { file, free, places: Arc::new(Semaphore::new(1)) })
    }

    /// Gives the one connection up for a writer, which `start` starts, and those that read beside it; does nothing if
    /// that was done before. If it cannot be, everything is as it was. It comes to its end though nobody waits for it.
    pub(super) async fn open_up<F>(self: &Arc<Self>, start: F) -> Result<(), StoreError>
    where
        F: FnOnce(Connection) -> Result<(), StoreError> + Send + 'static,
    {
        let (readers, place) = (Arc::clone(self), self.place().await?);
        let opened = tokio::task::spawn_blocking(move || {
            let opened = readers.open_up_now(start);
            drop(place);
            opened
        });
        opened.await.map_err(|error| failed(&error))?
    }

    fn open_up_now(&self, start: impl FnOnce(Connection) -> Result<(), StoreError>) -> Result<(), StoreError> {
        if !self.free().alone {
            return Ok(());
        }
        self.free().connections.clear();
        let both = connect::writer(&self.file).and_then(|at| Ok((at, Free::beside_a_writer(&self.file)?)));
        let both = both.map_err(|fault| fault.told(&self.file));
        match both.and_then(|(at, free)| start(at).map(|()| free)) {
            Ok(free) => {
                *self.free() = free;
                self.places.add_permits(READERS - 1);
                Ok(())
            }
            Err(error) => {
                // If this one does not open now, the next read tries again.
                self.free().connections.extend(connect::alone(&self.file));
                Err(error)
            }
        }
    }

    /// Reads within one transaction, so that everything seen is of one moment.
    pub(super) async fn ask<T, F>(self: &Arc<Self>, work: F) -> Result<T, StoreError>
    where
        T: Send + 'static,
        F: FnOnce(&Connection) -> Result<T, SqliteFault> + Send + 'static,
    {
        let readers = Arc::clone(self);
        let asked = async {
            let place = self.place().await?;
            let read = tokio::task::spawn_blocking(move || {
                let found = readers.read(work);
                drop(place);
                found
            });
            read.await.map_err(|error| failed(&error))?
        };
        tokio::time::timeout(ANSWER_MAX, asked).await.map_err(|_| StoreError::Timeout)?
    }

    async fn place(&self) -> Result<OwnedSemaphorePermit, StoreError> {
        Arc::clone(&self.places).acquire_owned().await.map_err(|error| failed(&error))
    }

    fn read<T>(&self, work: impl FnOnce(&Connection) -> Result<T, SqliteFault>) -> Result<T, StoreError> {
        let at = self.take().map_err(|fault| fault.told(&self.file))?;
        let found = at.unchecked_transaction().map_err(SqliteFault::from).and_then(|moment| work(&moment));
        self.free().connections.push(at);
        found.map_err(|fault| fault.told(&self.file))
    }

    fn take(&self) -> Result<Connection, SqliteFault> {
        let (alone, free) = {
            let mut free = self.free();
            (free.alone, free.connections.pop())
        };
        let open = if alone { connect::alone } else { connect::reader };
        free.map_or_else(|| open(&self.file), Ok)
    }

    fn free(&self) -> MutexGuard<'_, Free> {
        self.free.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn failed(error: &dyn std::fmt::Display) -> StoreError {
    StoreError::Unavailable(format!("reading stopped: {error}").into())
}
