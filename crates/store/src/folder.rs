//! A folder with one file of changes a behaviour, a line a change: readable, comparable, kept well under version
//! control. Everything is held in memory too, so it is for libraries of some hundred behaviours.

mod log;
#[cfg(test)]
mod tests;

use crate::{
    ActionDriver, Append, Contested, FillingSource, FolderLock, HelperUse, LIBRARY, Listing, Loaded, MemoryStore,
    Query, Similar, Store, StoreError, checkpoints, filling, json, lock_folder,
};
use async_trait::async_trait;
use behaviour::{Behaviour, Checkpoint, Committed, Id};
use log::{LogLine, Logs, Strange};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// Keeps behaviours as files. A line is synced to the disk before a change is acknowledged.
pub struct FolderStore {
    kept: MemoryStore,
    writing: Arc<Mutex<Logs>>,
    _lock: FolderLock,
}

impl FolderStore {
    /// Opens a folder, making it if need be. A last line that was not written whole was never acknowledged and goes.
    ///
    /// # Errors
    /// [`StoreError::Busy`] if another server uses it, [`StoreError::Damaged`] with file and line if it cannot be read,
    /// [`StoreError::Unavailable`] if the disk does not let us.
    pub async fn open(folder: &Path) -> Result<Self, StoreError> {
        let folder = folder.to_owned();
        let opened = tokio::task::spawn_blocking(move || Self::open_now(&folder)).await;
        opened.map_err(|error| StoreError::Unavailable(format!("opening stopped: {error}").into()))?
    }

    fn open_now(folder: &Path) -> Result<Self, StoreError> {
        let lock = lock_folder(folder)?;
        let kept = MemoryStore::new();
        let logs = Logs::open(folder, |behaviour, line| take(&kept, behaviour, line))?;
        Ok(Self { kept, writing: Arc::new(Mutex::new(logs)), _lock: lock })
    }

    /// Does a piece of writing in a thread that may block, one at a time.
    async fn write<T: Send + 'static>(
        &self,
        work: impl FnOnce(&MemoryStore, &mut Logs) -> Result<T, StoreError> + Send + 'static,
    ) -> Result<T, StoreError> {
        let (kept, writing) = (self.kept.clone(), Arc::clone(&self.writing));
        let done = tokio::task::spawn_blocking(move || {
            let mut logs = writing.lock().unwrap_or_else(PoisonError::into_inner);
            work(&kept, &mut logs)
        });
        done.await.map_err(|error| StoreError::Unavailable(format!("saving stopped: {error}").into()))?
    }
}

/// Takes a line of a file into memory; else says why it cannot follow the lines before it.
fn take(kept: &MemoryStore, behaviour: &Id, line: LogLine) -> Result<(), Strange> {
    match line {
        LogLine::Change(committed) => match kept.judge(behaviour, &committed)? {
            Append::Applied => kept.put(behaviour, &committed),
            Append::Duplicate { .. } | Append::Reused { .. } | Append::Conflict { .. } => {
                return Err(Strange::Order(committed.revision));
            }
        },
        LogLine::Removed { at_ms, by } => drop(kept.removed(behaviour, at_ms, &by)),
        LogLine::Restored => drop(kept.restored(behaviour)),
        LogLine::Named(checkpoint) => match kept.judge_checkpoint(behaviour, &checkpoint) {
            (true, true) => kept.put_checkpoint(behaviour, &checkpoint),
            _ => return Err(Strange::Name(checkpoint.name)),
        },
        LogLine::Unnamed { name } if kept.take_checkpoint(behaviour, &name) => {}
        LogLine::Unnamed { name } => return Err(Strange::Name(name)),
        LogLine::Epoch(epoch) => kept.set_epoch(epoch),
    }
    Ok(())
}

#[async_trait]
impl Store for FolderStore {
    async fn append(&self, behaviour: &Id, committed: &Committed, _after: &Behaviour) -> Result<Append, StoreError> {
        let (id, committed) = (behaviour.clone(), committed.clone());
        self.write(move |kept, logs| {
            json::checked(&committed)?;
            let verdict = kept.judge(&id, &committed)?;
            if verdict == Append::Applied {
                logs.add(&id, &LogLine::Change(committed.clone()))?;
                kept.put(&id, &committed);
            }
            Ok(verdict)
        })
        .await
    }

    async fn load(&self, behaviour: &Id) -> Result<Option<Loaded>, StoreError> {
        self.kept.load(behaviour).await
    }

    async fn list(&self, query: &Query) -> Result<Listing, StoreError> {
        self.kept.list(query).await
    }

    async fn history(&self, behaviour: &Id, since: u64, most: u32) -> Result<Vec<Committed>, StoreError> {
        self.kept.history(behaviour, since, most).await
    }

    async fn checkpoints(&self, behaviour: &Id) -> Result<Vec<Checkpoint>, StoreError> {
        self.kept.checkpoints(behaviour).await
    }

    async fn keep_checkpoint(&self, behaviour: &Id, checkpoint: &Checkpoint) -> Result<bool, StoreError> {
        let (id, checkpoint) = (behaviour.clone(), checkpoint.clone());
        self.write(move |kept, logs| {
            checkpoints::check(&checkpoint)?;
            let (is_kept, is_new) = kept.judge_checkpoint(&id, &checkpoint);
            if is_kept && is_new {
                logs.add(&id, &LogLine::Named(checkpoint.clone()))?;
                kept.put_checkpoint(&id, &checkpoint);
            }
            Ok(is_kept)
        })
        .await
    }

    async fn drop_checkpoint(&self, behaviour: &Id, name: &str) -> Result<(), StoreError> {
        let (id, name) = (behaviour.clone(), name.to_owned());
        self.write(move |kept, logs| {
            if kept.has_checkpoint(&id, &name) {
                logs.add(&id, &LogLine::Unnamed { name: name.clone() })?;
                kept.take_checkpoint(&id, &name);
            }
            Ok(())
        })
        .await
    }

    async fn remove(&self, behaviour: &Id, now_ms: u64, by: &str) -> Result<bool, StoreError> {
        let (id, by) = (behaviour.clone(), by.to_owned());
        self.write(move |kept, logs| {
            let there = id.as_str() != LIBRARY && kept.in_bin(&id) == Some(false);
            if there {
                logs.add(&id, &LogLine::Removed { at_ms: now_ms, by: by.clone() })?;
                kept.removed(&id, now_ms, &by);
            }
            Ok(there)
        })
        .await
    }

    async fn restore(&self, behaviour: &Id) -> Result<bool, StoreError> {
        let id = behaviour.clone();
        self.write(move |kept, logs| {
            let there = kept.in_bin(&id) == Some(true);
            if there {
                logs.add(&id, &LogLine::Restored)?;
                kept.restored(&id);
            }
            Ok(there)
        })
        .await
    }

    async fn purge(&self, removed_before_ms: u64) -> Result<u32, StoreError> {
        self.write(move |kept, logs| {
            let mut gone = 0;
            for id in kept.removed_before(removed_before_ms) {
                logs.delete(&id)?;
                kept.forget(&id);
                gone += 1;
            }
            Ok(gone)
        })
        .await
    }

    async fn users(&self, helper: &str) -> Result<Vec<HelperUse>, StoreError> {
        self.kept.users(helper).await
    }

    async fn drivers(&self, actuator: &str) -> Result<Vec<ActionDriver>, StoreError> {
        self.kept.drivers(actuator).await
    }

    async fn contested(&self) -> Result<Vec<Contested>, StoreError> {
        self.kept.contested().await
    }

    async fn similar(&self, behaviour: &Id, most: u32) -> Result<Vec<Similar>, StoreError> {
        self.kept.similar(behaviour, most).await
    }

    async fn next_epoch(&self) -> Result<u64, StoreError> {
        self.write(|kept, logs| {
            let next = kept.epoch() + 1;
            logs.set_epoch(next)?;
            kept.set_epoch(next);
            Ok(next)
        })
        .await
    }

    async fn raise_epoch(&self, least: u64) -> Result<(), StoreError> {
        self.write(move |kept, logs| {
            if kept.epoch() < least {
                logs.set_epoch(least)?;
                kept.set_epoch(least);
            }
            Ok(())
        })
        .await
    }

    async fn filling(&self) -> Result<Option<FillingSource>, StoreError> {
        self.write(|_, logs| filling::in_folder(logs.folder())).await
    }

    async fn begin_filling(&self, source: &FillingSource) -> Result<FillingSource, StoreError> {
        let source = source.clone();
        self.write(move |_, logs| filling::begin_in_folder(logs.folder(), &source)).await
    }

    async fn end_filling(&self) -> Result<(), StoreError> {
        self.write(|_, logs| filling::end_of_folder(logs.folder())).await
    }

    async fn reachable(&self) -> Result<(), StoreError> {
        Ok(())
    }

    async fn healthy(&self) -> Result<(), StoreError> {
        self.write(|_, logs| logs.probe()).await
    }
}
