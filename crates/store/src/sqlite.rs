//! The embedded store: one SQLite database in the data directory.

mod door;
mod fault;
mod insight;
mod list;
mod read;
mod readers;
mod schema;
#[cfg(test)]
mod tests;
mod write;
mod writer;

use crate::{Append, Contested, Driver, Listing, Loaded, Query, Similar, Store, StoreError, Used};
use async_trait::async_trait;
use behaviour::{Behaviour, Committed, Id};
use fault::Fault;
use readers::Readers;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use write::Ready;
use writer::Writer;

/// Keeps behaviours in a data directory. Dropping it waits for the write under way and frees the directory.
pub struct SqliteStore {
    file: PathBuf,
    // Dropped before the writer, which then is the last to close the database and folds its log into it.
    readers: Arc<Readers>,
    writer: Writer,
}

/// Opens the data directory, making it if need be.
///
/// # Errors
/// [`StoreError::Busy`] if another server uses it, [`StoreError::Damaged`] or [`StoreError::Newer`] if its database
/// cannot be used, [`StoreError::Full`] or [`StoreError::Unavailable`] if the disk cannot.
pub async fn open(data_dir: &Path) -> Result<SqliteStore, StoreError> {
    let data_dir = data_dir.to_owned();
    let opened = tokio::task::spawn_blocking(move || open_now(&data_dir)).await;
    opened.map_err(|error| StoreError::Unavailable(format!("opening stopped: {error}")))?
}

fn open_now(data_dir: &Path) -> Result<SqliteStore, StoreError> {
    let lock = crate::door::lock(data_dir)?;
    let file = door::database(data_dir);
    let told = |fault: Fault| fault.told(&file);
    let at = door::writer(&file).map_err(told)?;
    let readers = Arc::new(Readers::open(file.clone()).map_err(told)?);
    let writer = Writer::start(at, file.clone(), lock)?;
    Ok(SqliteStore { file, readers, writer })
}

#[async_trait]
impl Store for SqliteStore {
    async fn append(&self, behaviour: &Id, committed: &Committed, after: &Behaviour) -> Result<Append, StoreError> {
        let (id, committed, after) = (behaviour.clone(), committed.clone(), after.clone());
        let ready = tokio::task::spawn_blocking(move || Ready::new(committed, after)).await;
        let ready = ready.map_err(|error| StoreError::Unavailable(format!("saving stopped: {error}")))??;
        self.writer.ask(move |at| write::append(at, &id, &ready)).await
    }

    async fn load(&self, behaviour: &Id) -> Result<Option<Loaded>, StoreError> {
        let id = behaviour.clone();
        self.readers.ask(move |at| read::load(at, &id)).await
    }

    async fn list(&self, query: &Query) -> Result<Listing, StoreError> {
        let query = query.clone();
        self.readers.ask(move |at| list::list(at, &query)).await
    }

    async fn history(&self, behaviour: &Id, since: u64, most: u32) -> Result<Vec<Committed>, StoreError> {
        let id = behaviour.clone();
        self.readers.ask(move |at| read::history(at, &id, since, most)).await
    }

    async fn remove(&self, behaviour: &Id, now_ms: u64, by: &str) -> Result<bool, StoreError> {
        let (id, by) = (behaviour.clone(), by.to_owned());
        self.writer.ask(move |at| write::remove(at, &id, now_ms, &by)).await
    }

    async fn restore(&self, behaviour: &Id) -> Result<bool, StoreError> {
        let id = behaviour.clone();
        self.writer.ask(move |at| write::restore(at, &id)).await
    }

    async fn purge(&self, removed_before_ms: u64) -> Result<u32, StoreError> {
        self.writer.ask(move |at| write::purge(at, removed_before_ms)).await
    }

    async fn users(&self, helper: &str) -> Result<Vec<Used>, StoreError> {
        let helper = helper.to_owned();
        self.readers.ask(move |at| read::users(at, &helper)).await
    }

    async fn drivers(&self, actuator: &str) -> Result<Vec<Driver>, StoreError> {
        let actuator = actuator.to_owned();
        self.readers.ask(move |at| insight::drivers(at, &actuator)).await
    }

    async fn contested(&self) -> Result<Vec<Contested>, StoreError> {
        self.readers.ask(insight::contested).await
    }

    async fn similar(&self, behaviour: &Id, most: u32) -> Result<Vec<Similar>, StoreError> {
        let id = behaviour.clone();
        self.readers.ask(move |at| insight::similar(at, &id, most)).await
    }

    async fn next_epoch(&self) -> Result<u64, StoreError> {
        self.writer.ask(write::next_epoch).await
    }

    async fn reachable(&self) -> Result<(), StoreError> {
        if self.file.exists() {
            Ok(())
        } else {
            Err(StoreError::Unavailable(format!("{} is not there any more", self.file.display())))
        }
    }

    async fn healthy(&self) -> Result<(), StoreError> {
        self.reachable().await?;
        self.writer.ask(write::probe).await
    }
}
