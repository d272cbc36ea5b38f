//! A store in memory, for tests and for trying things out. Clones share what they keep.

use crate::usage::{in_order, usage, uses};
use crate::{Append, LIBRARY, Listed, Loaded, Store, StoreError, Usage, json};
use async_trait::async_trait;
use behaviour::{Behaviour, Committed, Id};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Keeps behaviours until the last clone is dropped.
#[derive(Clone, Debug, Default)]
pub struct MemoryStore {
    kept: Arc<Mutex<Kept>>,
}

#[derive(Debug, Default)]
struct Kept {
    behaviours: BTreeMap<Id, Shelf>,
    epoch: u64,
}

#[derive(Debug, Default)]
struct Shelf {
    behaviour: Behaviour,
    history: Vec<Committed>,
    removed: Option<(u64, String)>,
}

impl MemoryStore {
    /// An empty store.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[async_trait]
impl Store for MemoryStore {
    async fn append(&self, behaviour: &Id, committed: &Committed) -> Result<Append, StoreError> {
        json::checked(committed)?;
        self.kept().append(behaviour, committed)
    }

    async fn load(&self, behaviour: &Id) -> Result<Option<Loaded>, StoreError> {
        Ok(self.kept().behaviours.get(behaviour).map(Shelf::loaded))
    }

    async fn list(&self) -> Result<Vec<Listed>, StoreError> {
        Ok(self.kept().listed(|shelf| shelf.removed.is_none()))
    }

    async fn bin(&self) -> Result<Vec<Listed>, StoreError> {
        Ok(self.kept().listed(|shelf| shelf.removed.is_some()))
    }

    async fn history(&self, behaviour: &Id, since: u64, most: u32) -> Result<Vec<Committed>, StoreError> {
        let kept = self.kept();
        let changes = kept.behaviours.get(behaviour).map_or(&[][..], |shelf| &shelf.history);
        Ok(changes.iter().filter(|made| made.revision > since).take(most as usize).cloned().collect())
    }

    async fn remove(&self, behaviour: &Id, now_ms: u64, by: &str) -> Result<bool, StoreError> {
        let mut kept = self.kept();
        let shelf = kept.behaviours.get_mut(behaviour).filter(|shelf| shelf.removed.is_none());
        let Some(shelf) = shelf.filter(|_| behaviour.as_str() != LIBRARY) else { return Ok(false) };
        shelf.removed = Some((now_ms, by.to_owned()));
        Ok(true)
    }

    async fn restore(&self, behaviour: &Id) -> Result<bool, StoreError> {
        let mut kept = self.kept();
        Ok(kept.behaviours.get_mut(behaviour).is_some_and(|shelf| shelf.removed.take().is_some()))
    }

    async fn purge(&self, removed_before_ms: u64) -> Result<u32, StoreError> {
        let mut kept = self.kept();
        let before = kept.behaviours.len();
        kept.behaviours.retain(|_, shelf| shelf.removed.as_ref().is_none_or(|(at_ms, _)| *at_ms >= removed_before_ms));
        Ok(u32::try_from(before - kept.behaviours.len()).unwrap_or(u32::MAX))
    }

    async fn where_used(&self, helper: &str) -> Result<Vec<Usage>, StoreError> {
        let kept = self.kept();
        let shelves = kept.behaviours.iter().filter(|(_, shelf)| shelf.removed.is_none());
        Ok(in_order(shelves.flat_map(|(id, shelf)| shelf.uses(id, helper)).collect()))
    }

    async fn next_epoch(&self) -> Result<u64, StoreError> {
        let mut kept = self.kept();
        kept.epoch += 1;
        Ok(kept.epoch)
    }

    async fn healthy(&self) -> Result<(), StoreError> {
        Ok(())
    }
}

impl Kept {
    fn append(&mut self, id: &Id, committed: &Committed) -> Result<Append, StoreError> {
        if let Some(revision) = self.behaviours.get(id).and_then(|shelf| shelf.revision_of(&committed.change.op)) {
            return Ok(Append::Duplicate { revision });
        }
        let head = self.behaviours.get(id).map_or(0, Shelf::head);
        if self.behaviours.get(id).is_some_and(|shelf| shelf.removed.is_some()) {
            return Err(StoreError::Gone);
        }
        if head.checked_add(1) != Some(committed.revision) {
            return Ok(Append::Conflict { head });
        }
        let shelf = self.behaviours.entry(id.clone()).or_default();
        shelf.behaviour.apply(&committed.change);
        shelf.history.push(committed.clone());
        Ok(Append::Applied)
    }

    fn listed(&self, wanted: impl Fn(&Shelf) -> bool) -> Vec<Listed> {
        let shelves = self.behaviours.iter().filter(|(_, shelf)| wanted(shelf));
        let mut lines: Vec<_> = shelves.filter_map(|(id, shelf)| shelf.line(id)).collect();
        lines.sort_by_key(|line| std::cmp::Reverse(line.changed_ms));
        lines
    }
}

impl Shelf {
    fn head(&self) -> u64 {
        self.history.last().map_or(0, |last| last.revision)
    }

    fn revision_of(&self, op: &Id) -> Option<u64> {
        self.history.iter().find(|made| made.change.op == *op).map(|made| made.revision)
    }

    fn loaded(&self) -> Loaded {
        let removed_ms = self.removed.as_ref().map(|(at_ms, _)| *at_ms);
        Loaded { behaviour: self.behaviour.clone(), revision: self.head(), removed_ms }
    }

    fn line(&self, id: &Id) -> Option<Listed> {
        let last = &self.history.last()?.change;
        let (changed_ms, by) = self.removed.clone().unwrap_or_else(|| (last.at_ms, last.author.clone()));
        let name = self.behaviour.settings()?.name.clone();
        let streams = u32::try_from(self.behaviour.streams().count()).unwrap_or(u32::MAX);
        Some(Listed { id: id.clone(), name, revision: self.head(), changed_ms, by, streams })
    }

    fn uses(&self, id: &Id, helper: &str) -> Vec<Usage> {
        let records = self.behaviour.records.iter().filter(|(_, record)| uses(record, helper));
        records.map(|(key, record)| usage(id, self.behaviour.name(), key, record)).collect()
    }
}
