//! Behaviour by behaviour into another store, several at a time, and the proof that both hold the same.

use super::{BackedUpBehaviour, BackupError, Counted, Progress, named, page, shelves};
use crate::{Append, Filling, FillingSource, Store, StoreError, filling};
use behaviour::{Behaviour, Checkpoint, Committed, Id};
use std::collections::BTreeMap;
use std::sync::Arc;
use tokio::task::JoinSet;

/// Behaviours that are written at the same time: enough for a store to gather many changes into one sync.
const AT_ONCE: usize = 16;

/// The last change of each behaviour that a store has.
pub(super) type Heads = BTreeMap<Id, Committed>;

/// A difference between two stores.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoreDifference {
    /// The behaviour.
    pub behaviour: Id,
    /// The difference, in a few words.
    pub what: &'static str,
}

/// Copies everything into a store that is empty or holds a part of the same; then compares both. The second store is a part,
/// which nobody serves, until both hold the same; `source` says what the first one is.
///
/// # Errors
/// Fails if a store does, or with [`BackupError::NotEmpty`] or [`StoreError::Unfinished`]. Done again, it goes on where
/// it ended.
pub async fn migrate(
    from: &Arc<dyn Store>,
    to: &Arc<dyn Store>,
    source: &FillingSource,
    progress: Progress<'_>,
) -> Result<(Counted, Vec<StoreDifference>), BackupError> {
    filling::check(&**to, source).await?;
    let (shelves, heads) = (shelves(&**from).await?, heads(&**to).await?);
    check_heads(&**from, &shelves, &heads).await?;
    let filling = Filling::begin(to, source).await?;
    let (many, mut done, mut copying) = (shelves.len() as u64, Counted::default(), JoinSet::new());
    for shelf in shelves {
        if copying.len() >= AT_ONCE || done.behaviours + copying.len() as u64 == 1 {
            finished(&mut copying, &mut done, many, progress).await?;
        }
        copying.spawn(copy(Arc::clone(from), filling.clone(), shelf));
    }
    while !copying.is_empty() {
        finished(&mut copying, &mut done, many, progress).await?;
    }
    // Locks of the first store must stay void in the second.
    let epoch = from.next_epoch().await?;
    to.raise_epoch(epoch).await?;
    let differences = compare(&**from, &**to).await?;
    // What was served before has all of the first one now, and more of its own.
    let was_whole = !filling.goes_on() && !heads.is_empty();
    if differences.is_empty() || was_whole {
        filling.end().await?;
    }
    Ok((done, differences))
}

/// Waits for one behaviour to be there.
pub(super) async fn finished(
    copying: &mut JoinSet<Result<u64, BackupError>>,
    done: &mut Counted,
    many: u64,
    progress: Progress<'_>,
) -> Result<(), BackupError> {
    if let Some(changes) = copying.join_next().await {
        let stopped = |error| StoreError::Unavailable(format!("copying stopped: {error}").into());
        done.changes += changes.map_err(stopped)??;
        done.behaviours += 1;
        progress(*done, many);
    }
    Ok(())
}

async fn copy(from: Arc<dyn Store>, to: Filling, shelf: BackedUpBehaviour) -> Result<u64, BackupError> {
    let mut copying = Copying::of(&to, &shelf).await?;
    let mut since = 0;
    while since < shelf.revision {
        for change in page(&*from, &shelf, since).await? {
            since = change.revision;
            copying.put(&change).await?;
        }
    }
    copying.end(&named(&*from, &shelf).await?).await
}

/// One behaviour on its way into a store.
pub(super) struct Copying<'s> {
    to: &'s dyn Store,
    goes_on: bool,
    shelf: &'s BackedUpBehaviour,
    /// The revision that is there already.
    head: u64,
    after: Behaviour,
    changes: u64,
}

impl<'s> Copying<'s> {
    pub(super) async fn of(filling: &'s Filling, shelf: &'s BackedUpBehaviour) -> Result<Self, BackupError> {
        let (to, goes_on) = (&**filling.store(), filling.goes_on());
        let there = to.load(&shelf.id).await?;
        let head = there.as_ref().map_or(0, |loaded| loaded.revision);
        if goes_on && head < shelf.revision && there.is_some_and(|loaded| loaded.removed_ms.is_some()) {
            // It came back from the bin after it was copied, and was changed since.
            to.restore(&shelf.id).await?;
        }
        Ok(Self { to, goes_on, shelf, head, after: Behaviour::default(), changes: 0 })
    }

    pub(super) async fn put(&mut self, change: &Committed) -> Result<(), BackupError> {
        self.after.apply(&change.change);
        self.changes += 1;
        if change.revision <= self.head {
            return Ok(());
        }
        let mut answer = self.to.append(&self.shelf.id, change, &self.after).await;
        if answer.as_ref().is_err_and(StoreError::is_open) {
            answer = self.to.append(&self.shelf.id, change, &self.after).await;
        }
        match answer? {
            Append::Applied => Ok(()),
            Append::Duplicate { revision } if revision == change.revision => Ok(()),
            Append::Duplicate { .. } | Append::Reused { .. } | Append::Conflict { .. } => {
                Err(BackupError::NotEmpty(self.shelf.id.clone()))
            }
        }
    }

    /// Writes the named versions, and moves it into the bin, if it belongs there; returns the number of changes.
    pub(super) async fn end(self, named: &[Checkpoint]) -> Result<u64, BackupError> {
        if self.goes_on {
            for old in self.to.checkpoints(&self.shelf.id).await?.iter().filter(|old| !named.contains(old)) {
                self.to.drop_checkpoint(&self.shelf.id, &old.name).await?;
            }
        }
        for checkpoint in named {
            let mut kept = self.to.keep_checkpoint(&self.shelf.id, checkpoint).await;
            if kept.as_ref().is_err_and(StoreError::is_open) {
                kept = self.to.keep_checkpoint(&self.shelf.id, checkpoint).await;
            }
            if !kept? {
                return Err(BackupError::NotEmpty(self.shelf.id.clone()));
            }
        }
        if let Some((at_ms, by)) = &self.shelf.removed {
            self.to.remove(&self.shelf.id, *at_ms, by).await?;
        }
        Ok(self.changes)
    }
}

/// Returns the last change of each behaviour that the store to fill has already.
pub(super) async fn heads(store: &dyn Store) -> Result<Heads, BackupError> {
    let mut heads = Heads::new();
    for shelf in shelves(store).await? {
        let last = store.history(&shelf.id, shelf.revision.saturating_sub(1), 1).await?;
        if let Some(last) = last.into_iter().next() {
            heads.insert(shelf.id, last);
        }
    }
    Ok(heads)
}

/// Checks that what is there already is the beginning of what comes.
async fn check_heads(from: &dyn Store, shelves: &[BackedUpBehaviour], heads: &Heads) -> Result<(), BackupError> {
    for (id, last) in heads {
        let known = shelves.iter().any(|shelf| shelf.id == *id);
        let same = if known { from.history(id, last.revision.saturating_sub(1), 1).await? } else { Vec::new() };
        if same.first() != Some(last) {
            return Err(BackupError::NotEmpty(id.clone()));
        }
    }
    Ok(())
}

/// Returns the differences between two stores: in revision, records, history, named versions or bin of a behaviour.
///
/// # Errors
/// Fails if a store does.
pub async fn compare(one: &dyn Store, other: &dyn Store) -> Result<Vec<StoreDifference>, BackupError> {
    let (mut differences, ours) = (Vec::new(), shelves(one).await?);
    for shelf in shelves(other).await? {
        if !ours.iter().any(|known| known.id == shelf.id) {
            differences.push(StoreDifference { behaviour: shelf.id, what: "it is in one store only" });
        }
    }
    for shelf in ours {
        if let Some(what) = difference(one, other, &shelf).await? {
            differences.push(StoreDifference { behaviour: shelf.id, what });
        }
    }
    Ok(differences)
}

async fn difference(
    one: &dyn Store,
    other: &dyn Store,
    shelf: &BackedUpBehaviour,
) -> Result<Option<&'static str>, BackupError> {
    let (Some(ours), Some(theirs)) = (one.load(&shelf.id).await?, other.load(&shelf.id).await?) else {
        return Ok(Some("it is in one store only"));
    };
    if ours.revision != theirs.revision {
        return Ok(Some("its revision"));
    }
    if ours.removed_ms != theirs.removed_ms {
        return Ok(Some("whether it is in the bin"));
    }
    if ours.behaviour != theirs.behaviour {
        return Ok(Some("its records"));
    }
    let mut since = 0;
    while since < shelf.revision {
        let page = page(one, shelf, since).await?;
        if other.history(&shelf.id, since, u32::try_from(page.len()).unwrap_or(u32::MAX)).await? != page {
            return Ok(Some("its history"));
        }
        since = page.last().map_or(shelf.revision, |last| last.revision);
    }
    if named(one, shelf).await? != named(other, shelf).await? {
        return Ok(Some("its named versions"));
    }
    Ok(None)
}
