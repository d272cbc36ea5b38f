//! A few connections that read, each in a thread that may block.

use super::door;
use super::fault::Fault;
use crate::StoreError;
use rusqlite::Connection;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::sync::Semaphore;

/// Connections that read at the same time.
const READERS: usize = 4;
/// How long a read may take, waiting for a free connection included.
const ANSWER_MAX: Duration = Duration::from_secs(30);

/// The reading connections.
pub(super) struct Readers {
    file: PathBuf,
    free: Mutex<Vec<Connection>>,
    places: Arc<Semaphore>,
}

impl Readers {
    /// Opens them all.
    pub(super) fn open(file: PathBuf) -> Result<Self, Fault> {
        let free = (0..READERS).map(|_| door::reader(&file)).collect::<Result<_, _>>()?;
        Ok(Self { file, free: Mutex::new(free), places: Arc::new(Semaphore::new(READERS)) })
    }

    /// Reads within one transaction, so that everything seen is of one moment.
    pub(super) async fn ask<T, F>(self: &Arc<Self>, work: F) -> Result<T, StoreError>
    where
        T: Send + 'static,
        F: FnOnce(&Connection) -> Result<T, Fault> + Send + 'static,
    {
        let failed = |error: &dyn std::fmt::Display| StoreError::Unavailable(format!("reading stopped: {error}"));
        let readers = Arc::clone(self);
        let asked = async {
            let place = Arc::clone(&self.places).acquire_owned().await.map_err(|error| failed(&error))?;
            let read = tokio::task::spawn_blocking(move || {
                let found = readers.read(work);
                drop(place);
                found
            });
            read.await.map_err(|error| failed(&error))?
        };
        tokio::time::timeout(ANSWER_MAX, asked).await.map_err(|_| StoreError::Timeout)?
    }

    fn read<T>(&self, work: impl FnOnce(&Connection) -> Result<T, Fault>) -> Result<T, StoreError> {
        let free = self.free.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let at = free.map_or_else(|| door::reader(&self.file), Ok).map_err(|fault| fault.told(&self.file))?;
        let found = at.unchecked_transaction().map_err(Fault::from).and_then(|moment| work(&moment));
        self.free.lock().unwrap_or_else(PoisonError::into_inner).push(at);
        found.map_err(|fault| fault.told(&self.file))
    }
}
