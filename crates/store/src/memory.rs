//! A store in memory, for tests and for trying things out. Clones share what they keep.

mod checkpoints;

use crate::insight::{devices_of, sensors_of};
use crate::query::name_key;
use crate::usage::{in_order, usage, uses};
use crate::{
    ActionDriver, Append, Contested, FillingSource, HelperUse, LIBRARY, ListedBehaviour, Listing, Loaded, Query,
    SearchPlace, Similar, Sort, Store, StoreError, json, search_text,
};
use async_trait::async_trait;
use behaviour::{Behaviour, Checkpoint, Committed, Id, StreamKind};
use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Keeps behaviours until the last clone is dropped.
#[derive(Clone, Debug, Default)]
pub struct MemoryStore {
    kept: Arc<Mutex<StoredBehaviour>>,
}

#[derive(Debug, Default)]
struct StoredBehaviour {
    behaviours: BTreeMap<Id, MemoryShelf>,
    epoch: u64,
    filling: Option<FillingSource>,
}

#[derive(Debug, Default)]
struct MemoryShelf {
    behaviour: Behaviour,
    history: Vec<Committed>,
    /// Every op id with the revision it made.
    ops: HashMap<Id, u64>,
    removed: Option<(u64, String)>,
    checkpoints: BTreeMap<String, Checkpoint>,
}

impl MemoryStore {
    /// An empty store.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the answer that [`Store::append`] would give, without saving anything.
    pub(crate) fn judge(&self, behaviour: &Id, committed: &Committed) -> Result<Append, StoreError> {
        self.kept().judge(behaviour, committed)
    }

    /// Keeps a change that was judged to be the next one.
    pub(crate) fn put(&self, behaviour: &Id, committed: &Committed) {
        self.kept().put(behaviour, committed);
    }

    /// Tells if a behaviour is in the bin; none if there is no such behaviour.
    pub(crate) fn in_bin(&self, behaviour: &Id) -> Option<bool> {
        Some(self.kept().behaviours.get(behaviour)?.removed.is_some())
    }

    /// Moves a behaviour to the bin. False if it is not there, already in the bin, or the library.
    pub(crate) fn removed(&self, behaviour: &Id, now_ms: u64, by: &str) -> bool {
        let mut kept = self.kept();
        let shelf = kept.behaviours.get_mut(behaviour).filter(|shelf| shelf.removed.is_none());
        let Some(shelf) = shelf.filter(|_| behaviour.as_str() != LIBRARY) else { return false };
        shelf.removed = Some((now_ms, by.to_owned()));
        true
    }

    /// Takes a behaviour out of the bin. False if it is not there.
    pub(crate) fn restored(&self, behaviour: &Id) -> bool {
        self.kept().behaviours.get_mut(behaviour).is_some_and(|shelf| shelf.removed.take().is_some())
    }

    /// Deletes a behaviour for ever.
    pub(crate) fn forget(&self, behaviour: &Id) {
        self.kept().behaviours.remove(behaviour);
    }

    /// The number of the last server start.
    pub(crate) fn epoch(&self) -> u64 {
        self.kept().epoch
    }

    /// Says which was the number of the last server start.
    pub(crate) fn set_epoch(&self, epoch: u64) {
        self.kept().epoch = epoch;
    }

    /// The behaviours that went to the bin before that time.
    pub(crate) fn removed_before(&self, removed_before_ms: u64) -> Vec<Id> {
        let kept = self.kept();
        let old = kept.behaviours.iter().filter(|(_, shelf)| shelf.removed_before(removed_before_ms));
        old.map(|(id, _)| id.clone()).collect()
    }

    fn kept(&self) -> MutexGuard<'_, StoredBehaviour> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[async_trait]
impl Store for MemoryStore {
    async fn append(&self, behaviour: &Id, committed: &Committed, _after: &Behaviour) -> Result<Append, StoreError> {
        json::checked(committed)?;
        let mut kept = self.kept();
        let verdict = kept.judge(behaviour, committed)?;
        if verdict == Append::Applied {
            kept.put(behaviour, committed);
        }
        Ok(verdict)
    }

    async fn load(&self, behaviour: &Id) -> Result<Option<Loaded>, StoreError> {
        Ok(self.kept().behaviours.get(behaviour).map(MemoryShelf::loaded))
    }

    async fn list(&self, query: &Query) -> Result<Listing, StoreError> {
        Ok(self.kept().listing(query))
    }

    async fn history(&self, behaviour: &Id, since: u64, most: u32) -> Result<Vec<Committed>, StoreError> {
        let kept = self.kept();
        let changes = kept.behaviours.get(behaviour).map_or(&[][..], |shelf| &shelf.history);
        Ok(changes.iter().filter(|made| made.revision > since).take(most as usize).cloned().collect())
    }

    async fn checkpoints(&self, behaviour: &Id) -> Result<Vec<Checkpoint>, StoreError> {
        let kept = self.kept();
        let found = kept.behaviours.get(behaviour).map(|shelf| shelf.checkpoints.values().cloned().collect());
        Ok(crate::checkpoints::in_order(found.unwrap_or_default()))
    }

    async fn keep_checkpoint(&self, behaviour: &Id, checkpoint: &Checkpoint) -> Result<bool, StoreError> {
        crate::checkpoints::check(checkpoint)?;
        let (is_kept, is_new) = self.judge_checkpoint(behaviour, checkpoint);
        if is_kept && is_new {
            self.put_checkpoint(behaviour, checkpoint);
        }
        Ok(is_kept)
    }

    async fn drop_checkpoint(&self, behaviour: &Id, name: &str) -> Result<(), StoreError> {
        self.take_checkpoint(behaviour, name);
        Ok(())
    }

    async fn remove(&self, behaviour: &Id, now_ms: u64, by: &str) -> Result<bool, StoreError> {
        Ok(self.removed(behaviour, now_ms, by))
    }

    async fn restore(&self, behaviour: &Id) -> Result<bool, StoreError> {
        Ok(self.restored(behaviour))
    }

    async fn purge(&self, removed_before_ms: u64) -> Result<u32, StoreError> {
        let mut kept = self.kept();
        let before = kept.behaviours.len();
        kept.behaviours.retain(|_, shelf| !shelf.removed_before(removed_before_ms));
        Ok(u32::try_from(before - kept.behaviours.len()).unwrap_or(u32::MAX))
    }

    async fn users(&self, helper: &str) -> Result<Vec<HelperUse>, StoreError> {
        let kept = self.kept();
        Ok(in_order(kept.open().flat_map(|(id, shelf)| shelf.uses(id, helper)).collect()))
    }

    async fn drivers(&self, actuator: &str) -> Result<Vec<ActionDriver>, StoreError> {
        let kept = self.kept();
        let drivers = kept.open().filter_map(|(id, shelf)| {
            let sensors = sensors_of(&shelf.behaviour, actuator)?;
            Some(ActionDriver { behaviour: id.clone(), name: shelf.behaviour.name().to_owned(), sensors })
        });
        Ok(drivers.collect())
    }

    async fn contested(&self) -> Result<Vec<Contested>, StoreError> {
        Ok(self.kept().contested())
    }

    async fn similar(&self, behaviour: &Id, most: u32) -> Result<Vec<Similar>, StoreError> {
        Ok(self.kept().similar(behaviour, most))
    }

    async fn raise_epoch(&self, least: u64) -> Result<(), StoreError> {
        let mut kept = self.kept();
        kept.epoch = kept.epoch.max(least);
        Ok(())
    }

    async fn next_epoch(&self) -> Result<u64, StoreError> {
        let mut kept = self.kept();
        kept.epoch += 1;
        Ok(kept.epoch)
    }

    async fn filling(&self) -> Result<Option<FillingSource>, StoreError> {
        Ok(self.kept().filling.clone())
    }

    async fn begin_filling(&self, source: &FillingSource) -> Result<FillingSource, StoreError> {
        Ok(self.kept().filling.get_or_insert_with(|| source.clone()).clone())
    }

    async fn end_filling(&self) -> Result<(), StoreError> {
        self.kept().filling = None;
        Ok(())
    }

    async fn healthy(&self) -> Result<(), StoreError> {
        Ok(())
    }
}

impl StoredBehaviour {
    fn judge(&self, id: &Id, committed: &Committed) -> Result<Append, StoreError> {
        let Some(shelf) = self.behaviours.get(id) else {
            return Ok(if committed.revision == 1 { Append::Applied } else { Append::Conflict { head: 0 } });
        };
        if let Some(saved) = shelf.made_by(&committed.change.op) {
            return Ok(Append::again(&committed.change, &saved.change, saved.revision));
        }
        if shelf.removed.is_some() {
            return Err(StoreError::Gone);
        }
        let next = shelf.head().checked_add(1) == Some(committed.revision);
        Ok(if next { Append::Applied } else { Append::Conflict { head: shelf.head() } })
    }

    fn put(&mut self, id: &Id, committed: &Committed) {
        let shelf = self.behaviours.entry(id.clone()).or_default();
        shelf.behaviour.apply(&committed.change);
        shelf.ops.insert(committed.change.op.clone(), committed.revision);
        shelf.history.push(committed.clone());
    }

    /// The behaviours outside the bin.
    fn open(&self) -> impl Iterator<Item = (&Id, &MemoryShelf)> {
        self.behaviours.iter().filter(|(_, shelf)| shelf.removed.is_none())
    }

    fn listing(&self, query: &Query) -> Listing {
        let there =
            self.behaviours.iter().filter(|(_, shelf)| shelf.removed.is_some() == (query.place == SearchPlace::Bin));
        let there: Vec<_> = there.filter_map(|(id, shelf)| Some((shelf, shelf.line(id)?))).collect();
        let (total, needles) = (there.len() as u64, query.needles());
        let found = there.into_iter().filter(|(shelf, line)| {
            let text = if needles.is_empty() { String::new() } else { search_text(&shelf.behaviour) };
            let mine = query.owner.as_ref().is_none_or(|owner| *owner == line.owner);
            let tagged = query.tag.as_ref().is_none_or(|tag| line.tags.contains(tag));
            mine && tagged && needles.iter().all(|word| text.contains(word)) && query.comes_after(line)
        });
        let mut lines: Vec<_> = found.map(|(_, line)| line).collect();
        match query.sort {
            Sort::Changed => lines.sort_by_key(|line| Reverse((line.changed_ms, line.id.clone()))),
            Sort::Name => lines.sort_by_key(|line| (name_key(&line.name), line.id.clone())),
        }
        Listing::of(lines, query, total)
    }

    fn contested(&self) -> Vec<Contested> {
        let mut drivers: BTreeMap<&str, Vec<(Id, String)>> = BTreeMap::new();
        for (id, shelf) in self.open() {
            let devices = devices_of(&shelf.behaviour).into_iter();
            for (_, device) in devices.filter(|(kind, _)| *kind == StreamKind::Actuator) {
                drivers.entry(device).or_default().push((id.clone(), shelf.behaviour.name().to_owned()));
            }
        }
        let contested = drivers.into_iter().filter(|(_, behaviours)| behaviours.len() > 1);
        let one = |(actuator, mut behaviours): (&str, Vec<_>)| {
            let count = behaviours.len() as u64;
            behaviours.truncate(Contested::SHOWN_MAX);
            Contested { actuator: actuator.to_owned(), behaviours, count }
        };
        contested.map(one).collect()
    }

    fn similar(&self, behaviour: &Id, most: u32) -> Vec<Similar> {
        let Some(this) = self.behaviours.get(behaviour) else { return Vec::new() };
        let devices = devices_of(&this.behaviour);
        let others = self.open().filter(|(id, _)| *id != behaviour);
        let mut similar: Vec<_> = others
            .map(|(id, shelf)| {
                let shared = devices_of(&shelf.behaviour).intersection(&devices).count();
                let name = shelf.behaviour.name().to_owned();
                Similar { behaviour: id.clone(), name, shared: u32::try_from(shared).unwrap_or(u32::MAX) }
            })
            .filter(|similar| similar.shared > 0)
            .collect();
        similar.sort_by_key(|similar| (Reverse(similar.shared), similar.behaviour.clone()));
        similar.truncate(most as usize);
        similar
    }
}

impl MemoryShelf {
    fn head(&self) -> u64 {
        self.history.last().map_or(0, |last| last.revision)
    }

    /// The change that has this op id.
    fn made_by(&self, op: &Id) -> Option<&Committed> {
        let revision = self.ops.get(op)?;
        self.history.get(usize::try_from(revision - 1).ok()?)
    }

    fn removed_before(&self, at_ms: u64) -> bool {
        self.removed.as_ref().is_some_and(|(removed_ms, _)| *removed_ms < at_ms)
    }

    fn loaded(&self) -> Loaded {
        let removed_ms = self.removed.as_ref().map(|(at_ms, _)| *at_ms);
        Loaded { behaviour: self.behaviour.clone(), revision: self.head(), removed_ms }
    }

    fn line(&self, id: &Id) -> Option<ListedBehaviour> {
        let last = &self.history.last()?.change;
        let (changed_ms, by) = self.removed.clone().unwrap_or_else(|| (last.at_ms, last.author.clone()));
        let settings = self.behaviour.settings()?;
        let (name, tags) = (settings.name.clone(), settings.tags.clone());
        let streams = u32::try_from(self.behaviour.streams().count()).unwrap_or(u32::MAX);
        let owner = self.history.first()?.change.author.clone();
        Some(ListedBehaviour { id: id.clone(), name, revision: self.head(), changed_ms, by, owner, streams, tags })
    }

    fn uses(&self, id: &Id, helper: &str) -> Vec<HelperUse> {
        let records = self.behaviour.records.iter().filter(|(_, record)| uses(record, helper));
        records.map(|(key, record)| usage(id, self.behaviour.name(), key, record)).collect()
    }
}
