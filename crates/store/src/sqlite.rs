//! The embedded store: one SQLite database in the data directory.

mod checkpoints;
mod connect;
mod fault;
mod filling;
mod insight;
mod list;
mod read;
mod readers;
mod schema;
#[cfg(test)]
mod tests;
mod write;
mod writer;

use crate::{
    ActionDriver, Append, Contested, FillingSource, FolderLock, HelperUse, Listing, Loaded, Query, Similar, Store,
    StoreError, disk, lock_folder,
};
use async_trait::async_trait;
use behaviour::{Behaviour, Checkpoint, Committed, Id};
use fault::SqliteFault;
use readers::Readers;
use rusqlite::Connection;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};
use write::PreparedChange;
use writer::SqliteWriter;

/// Room for the pages around a change, in bytes; while the disk is full, less room than that is none.
const ROOM_MIN_BYTES: usize = 1 << 20;
/// The most times its own size that a change takes on the disk, in the log and in the database.
const ROOM_TIMES: usize = 8;

/// Keeps behaviours in a data directory. Dropping it waits for the write under way and frees the directory.
///
/// On a full disk it opens for reading alone: what would be saved is refused with [`StoreError::Full`], and
/// [`Store::healthy`] lets it save again as soon as there is room.
pub struct SqliteStore {
    file: PathBuf,
    // Dropped before the writer, which then is the last to close the database and folds its log into it.
    readers: Arc<Readers>,
    /// None while the disk has been full since the start.
    writer: Arc<OnceLock<SqliteWriter>>,
    /// The free space in bytes that ends a full disk; 0 while nothing was refused.
    wants_bytes: AtomicUsize,
    lock: Arc<FolderLock>,
}

/// Opens the data directory, making it if need be; for reading alone if the disk is full.
///
/// # Errors
/// [`StoreError::Busy`] if another server uses it, [`StoreError::Damaged`] or [`StoreError::Newer`] if its database
/// cannot be used, [`StoreError::Full`] or [`StoreError::Unavailable`] if the disk cannot.
pub async fn open(data_dir: &Path) -> Result<SqliteStore, StoreError> {
    let data_dir = data_dir.to_owned();
    let opened = tokio::task::spawn_blocking(move || open_now(&data_dir)).await;
    opened.map_err(|error| StoreError::Unavailable(format!("opening stopped: {error}").into()))?
}

fn open_now(data_dir: &Path) -> Result<SqliteStore, StoreError> {
    let lock = Arc::new(lock_folder(data_dir)?);
    let file = connect::database(data_dir);
    let told = |fault: SqliteFault| fault.told(&file);
    let (readers, writer, wants_bytes) = match connect::writer(&file).map_err(told) {
        Ok(at) => {
            let readers = Readers::open(file.clone()).map_err(told)?;
            (readers, SqliteWriter::start(at, file.clone(), Arc::clone(&lock))?.into(), 0)
        }
        Err(error) if is_full(&error, data_dir) => {
            let readers = Readers::alone(file.clone()).map_err(|fault| at_least_full(fault.told(&file)))?;
            (readers, OnceLock::new(), ROOM_MIN_BYTES)
        }
        Err(error) => return Err(error),
    };
    Ok(SqliteStore {
        file,
        readers: Arc::new(readers),
        writer: Arc::new(writer),
        wants_bytes: wants_bytes.into(),
        lock,
    })
}

/// True if nothing could be opened because the disk is full, whatever SQLite calls it.
fn is_full(error: &StoreError, data_dir: &Path) -> bool {
    let room = || disk::has_room(data_dir, ROOM_MIN_BYTES);
    let has_none = || room().is_err_and(|error| error.kind() == std::io::ErrorKind::StorageFull);
    *error == StoreError::Full || matches!(error, StoreError::Unavailable(_)) && has_none()
}

/// Takes an unknown failure for a full disk, as people can do something about that.
fn at_least_full(error: StoreError) -> StoreError {
    if matches!(error, StoreError::Unavailable(_)) { StoreError::Full } else { error }
}

impl SqliteStore {
    fn writer(&self) -> Result<&SqliteWriter, StoreError> {
        self.writer.get().ok_or(StoreError::Full)
    }

    /// Writes so many bytes. If there is no room, the disk is full until there is room for more than that.
    async fn write<T, F>(&self, bytes: usize, work: F) -> Result<T, StoreError>
    where
        T: Send + 'static,
        F: FnOnce(&Connection) -> Result<T, SqliteFault> + Send + 'static,
    {
        let written = self.writer()?.ask(work).await;
        if matches!(written, Err(StoreError::Full)) {
            let wants_bytes = bytes.saturating_mul(ROOM_TIMES).saturating_add(ROOM_MIN_BYTES);
            self.wants_bytes.fetch_max(wants_bytes, Ordering::Relaxed);
        }
        written
    }

    /// Looks whether there is room again for what was refused.
    async fn check_room(&self) -> Result<(), StoreError> {
        let wants_bytes = self.wants_bytes.load(Ordering::Relaxed);
        let Some(folder) = self.file.parent().filter(|_| wants_bytes > 0).map(Path::to_owned) else { return Ok(()) };
        let looked = tokio::task::spawn_blocking(move || disk::has_room(&folder, wants_bytes)).await;
        let looked = looked.map_err(|error| StoreError::Unavailable(format!("looking stopped: {error}").into()))?;
        looked.map_err(|error| disk::told(&self.file, &error))
    }

    /// Opens the database for writing too, after a start on a full disk.
    async fn open_up(&self) -> Result<(), StoreError> {
        if self.writer.get().is_some() {
            return Ok(());
        }
        let (file, lock, writer) = (self.file.clone(), Arc::clone(&self.lock), Arc::clone(&self.writer));
        let start = move |at| {
            // Nobody else comes through: there is one place for whoever opens it.
            let _only_once = writer.set(SqliteWriter::start(at, file, lock)?);
            Ok(())
        };
        self.readers.open_up(start).await
    }
}

#[async_trait]
impl Store for SqliteStore {
    async fn append(&self, behaviour: &Id, committed: &Committed, after: &Behaviour) -> Result<Append, StoreError> {
        let (id, committed, after) = (behaviour.clone(), committed.clone(), after.clone());
        let ready = tokio::task::spawn_blocking(move || PreparedChange::new(committed, after)).await;
        let ready = ready.map_err(|error| StoreError::Unavailable(format!("saving stopped: {error}").into()))??;
        self.write(ready.bytes(), move |at| write::append(at, &id, &ready)).await
    }

    async fn append_all(&self, behaviour: &Id, changes: &[(Committed, Behaviour)]) -> Result<Vec<Append>, StoreError> {
        let (id, changes) = (behaviour.clone(), changes.to_vec());
        let prepare =
            move || changes.into_iter().map(|(committed, after)| PreparedChange::new(committed, after)).collect();
        let ready: Result<Result<Vec<PreparedChange>, StoreError>, _> = tokio::task::spawn_blocking(prepare).await;
        let ready = ready.map_err(|error| StoreError::Unavailable(format!("saving stopped: {error}").into()))??;
        let bytes = ready.iter().map(PreparedChange::bytes).sum();
        self.write(bytes, move |at| write::append_all(at, &id, &ready)).await
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

    async fn checkpoints(&self, behaviour: &Id) -> Result<Vec<Checkpoint>, StoreError> {
        let id = behaviour.clone();
        self.readers.ask(move |at| checkpoints::all(at, &id)).await
    }

    async fn keep_checkpoint(&self, behaviour: &Id, checkpoint: &Checkpoint) -> Result<bool, StoreError> {
        crate::checkpoints::check(checkpoint)?;
        let (id, checkpoint) = (behaviour.clone(), checkpoint.clone());
        self.write(0, move |at| checkpoints::keep(at, &id, &checkpoint)).await
    }

    async fn drop_checkpoint(&self, behaviour: &Id, name: &str) -> Result<(), StoreError> {
        let (id, name) = (behaviour.clone(), name.to_owned());
        self.write(0, move |at| checkpoints::drop(at, &id, &name)).await
    }

    async fn remove(&self, behaviour: &Id, now_ms: u64, by: &str) -> Result<bool, StoreError> {
        let (id, by) = (behaviour.clone(), by.to_owned());
        self.write(0, move |at| write::remove(at, &id, now_ms, &by)).await
    }

    async fn restore(&self, behaviour: &Id) -> Result<bool, StoreError> {
        let id = behaviour.clone();
        self.write(0, move |at| write::restore(at, &id)).await
    }

    async fn purge(&self, removed_before_ms: u64) -> Result<u32, StoreError> {
        self.write(0, move |at| write::purge(at, removed_before_ms)).await
    }

    async fn users(&self, helper: &str) -> Result<Vec<HelperUse>, StoreError> {
        let helper = helper.to_owned();
        self.readers.ask(move |at| read::users(at, &helper)).await
    }

    async fn drivers(&self, actuator: &str) -> Result<Vec<ActionDriver>, StoreError> {
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
        self.write(0, write::next_epoch).await
    }

    async fn raise_epoch(&self, least: u64) -> Result<(), StoreError> {
        self.write(0, move |at| write::raise_epoch(at, least)).await
    }

    async fn filling(&self) -> Result<Option<FillingSource>, StoreError> {
        let mark = self.readers.ask(filling::mark).await?;
        Ok(mark.or_else(|| self.file.parent().and_then(crate::filling::of_older)))
    }

    async fn begin_filling(&self, source: &FillingSource) -> Result<FillingSource, StoreError> {
        let source = source.clone();
        self.write(0, move |at| filling::begin(at, &source)).await
    }

    async fn end_filling(&self) -> Result<(), StoreError> {
        let file = self.file.clone();
        self.write(0, filling::end).await?;
        // What an older rrp left counts as long as it is there, so it goes last.
        let gone = tokio::task::spawn_blocking(move || file.parent().map_or(Ok(()), crate::end_in_folder)).await;
        let gone = gone.map_err(|error| StoreError::Unavailable(format!("the end stopped: {error}").into()))?;
        gone.map_err(|error| disk::told(&self.file, &error))
    }

    async fn reachable(&self) -> Result<(), StoreError> {
        if self.file.exists() {
            Ok(())
        } else {
            Err(StoreError::Unavailable(format!("{} is not there any more", self.file.display()).into()))
        }
    }

    async fn healthy(&self) -> Result<(), StoreError> {
        self.reachable().await?;
        self.check_room().await?;
        self.open_up().await?;
        self.write(0, write::probe).await?;
        self.wants_bytes.store(0, Ordering::Relaxed);
        Ok(())
    }
}
