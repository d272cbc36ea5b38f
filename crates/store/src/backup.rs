//! A whole store as one file of JSON lines, back again, and from one store into another: every behaviour with its
//! whole history, the bin and the library; and in the file the robots that are kept beside the store.

mod copy;
mod lines;
mod restore;
mod robots;
#[cfg(test)]
mod tests;

pub use copy::{StoreDifference, compare, migrate};
pub use restore::{Backup, read, restore, verify};
pub use robots::{BackedUpBody, BackedUpRobot, Reached};

use crate::{Damage, LIBRARY, Query, SearchPlace, Store, StoreError};
use behaviour::{Checkpoint, Id, Refusal};
use lines::{BackupLine, Sum};
use std::future::Future;
use thiserror::Error;

/// The format's name and version.
pub const BACKUP_FORMAT: &str = "rrp-backup/1";
/// Changes that are fetched at once.
const PAGE_CHANGES: u32 = 256;

/// The reasons why a backup, a restore or a migration did not come to its end. What was done stays; done again, it goes
/// on.
#[derive(Debug, Error)]
pub enum BackupError {
    /// The store could not do it.
    #[error("{0}")]
    Store(#[from] StoreError),
    /// The file could not be read or written.
    #[error("The backup could not be read or written: {0}. Check the disk and try again.")]
    File(#[from] std::io::Error),
    /// The file is no whole backup; with the line and what is wrong there.
    #[error("Line {0} of the backup: {1} Take another backup.")]
    Broken(u64, BackupFlaw),
    /// The store to fill holds something else already; with its id.
    #[error("The store is not empty: it holds “{0}”, which is not from here. Choose an empty one.")]
    NotEmpty(Id),
    /// Both stores are the same.
    #[error("Both addresses are the same store. Choose another one to fill.")]
    Same,
}

/// The flaws of a line of a backup.
#[derive(Debug, Error)]
pub enum BackupFlaw {
    /// It does not begin as a backup does.
    #[error("This is no {BACKUP_FORMAT}.")]
    NoBackup,
    /// It tells of more starts than a server can have had.
    #[error("No server can have started so often.")]
    Starts,
    /// The sum at the end is another one than that of the lines.
    #[error("Something before it was changed.")]
    Changed,
    /// It cannot come after the line before it.
    #[error("It does not follow what is before it.")]
    Order,
    /// It has no end.
    #[error("The file ends too early.")]
    CutOff,
    /// It is no line of a backup.
    #[error("It cannot be read ({0}).")]
    Unreadable(serde_json::Error),
    /// It stands behind the last line.
    #[error("It comes after the end.")]
    AfterEnd,
    /// The behaviour was there before.
    #[error("The same behaviour was there before.")]
    Twice,
    /// The change does not fit what a record, which people call so, was before.
    #[error("It does not fit what {0} was before.")]
    Stale(String),
    /// Nobody can have put it into the bin like that.
    #[error("It cannot have gone to the bin so: {0}")]
    Binned(Refusal),
    /// It was made later than any time that is kept.
    #[error("Its time is too far in the future.")]
    Time,
    /// A revision cannot have got this name.
    #[error("Nobody can have named a version so: {0}")]
    Named(Refusal),
    /// The change breaks a rule.
    #[error("No room would have made this change: {0}")]
    Refused(Refusal),
}

/// The numbers of behaviours and changes that were done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counted {
    /// Behaviours, also those in the bin, and the library.
    pub behaviours: u64,
    /// Changes in their histories.
    pub changes: u64,
}

/// One behaviour, before its history.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct BackedUpBehaviour {
    id: Id,
    revision: u64,
    /// The time when it went to the bin, and the name of the person who put it there.
    removed: Option<(u64, String)>,
}

/// Tells how far it is: what is done, of how many behaviours.
pub type Progress<'p> = &'p (dyn Fn(Counted, u64) + Send + Sync);

/// Writes a whole store and the robots beside it, line by line through `put`. `epoch` is the store's own; see
/// [`Store::next_epoch`].
///
/// # Errors
/// Fails if the store or `put` does.
pub async fn backup<F, W>(
    store: &dyn Store,
    epoch: u64,
    robots: &[BackedUpRobot],
    mut put: F,
    progress: Progress<'_>,
) -> Result<Counted, BackupError>
where
    F: FnMut(String) -> W,
    W: Future<Output = std::io::Result<()>>,
{
    let (shelves, mut sum, mut done) = (shelves(store).await?, Sum::default(), Counted::default());
    put(sum.line(&BackupLine::Start { format: BACKUP_FORMAT.to_owned(), epoch })).await?;
    for robot in robots {
        put(sum.line(&BackupLine::Robot(robot.clone()))).await?;
    }
    for shelf in &shelves {
        put(sum.line(&BackupLine::of(shelf))).await?;
        let mut since = 0;
        while since < shelf.revision {
            for change in page(store, shelf, since).await? {
                since = change.revision;
                done.changes += 1;
                put(sum.line(&BackupLine::Change(change))).await?;
            }
        }
        for checkpoint in named(store, shelf).await? {
            put(sum.line(&BackupLine::Named(checkpoint))).await?;
        }
        done.behaviours += 1;
        progress(done, shelves.len() as u64);
    }
    put(sum.end(done)).await?;
    Ok(done)
}

/// The next changes of a behaviour, up to the revision that it had at first.
async fn page(
    store: &dyn Store,
    shelf: &BackedUpBehaviour,
    since: u64,
) -> Result<Vec<behaviour::Committed>, BackupError> {
    let mut page = store.history(&shelf.id, since, PAGE_CHANGES).await?;
    page.retain(|change| change.revision <= shelf.revision);
    if page.is_empty() {
        let lost = Damage::EndsEarly { id: shelf.id.clone(), since, revision: shelf.revision };
        return Err(StoreError::Damaged(lost).into());
    }
    Ok(page)
}

/// The named versions of a behaviour, up to the revision that it had at first.
async fn named(store: &dyn Store, shelf: &BackedUpBehaviour) -> Result<Vec<Checkpoint>, StoreError> {
    let mut named = store.checkpoints(&shelf.id).await?;
    named.retain(|one| one.revision <= shelf.revision);
    Ok(named)
}

/// Returns everything that the store holds, the library first, then in order of id.
pub(crate) async fn shelves(store: &dyn Store) -> Result<Vec<BackedUpBehaviour>, StoreError> {
    let mut all = Vec::new();
    for place in [SearchPlace::Here, SearchPlace::Bin] {
        let mut query = Query { place, ..Query::default() };
        loop {
            let page = store.list(&query).await?;
            all.extend(page.lines.into_iter().map(|line| BackedUpBehaviour {
                id: line.id,
                revision: line.revision,
                removed: (place == SearchPlace::Bin).then_some((line.changed_ms, line.by)),
            }));
            query.after = page.next;
            if query.after.is_none() {
                break;
            }
        }
    }
    all.sort_by(|a, b| a.id.cmp(&b.id));
    all.dedup_by(|a, b| a.id == b.id);
    let library = Id::new(LIBRARY).map_err(|reason| StoreError::Damaged(Damage::Id(reason)))?;
    if let Some(loaded) = store.load(&library).await? {
        all.insert(0, BackedUpBehaviour { id: library, revision: loaded.revision, removed: None });
    }
    Ok(all)
}
