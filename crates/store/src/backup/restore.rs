//! From a backup into a store: first the whole file is read, then the first change is made.

use super::copy::{Copying, Heads, finished, heads};
use super::lines::{self, BackupListener, BackupRest};
use super::{BackedUpBehaviour, BackedUpRobot, BackupError, BackupFlaw, Counted, Progress};
use crate::{Filling, FillingSource, LIBRARY, Store, StoreError, filling};
use behaviour::{Checkpoint, Committed, History, Id, Refusal, check_person};
use std::collections::BTreeSet;
use std::io::{BufRead, Seek};
use tokio::sync::mpsc;
use tokio::task::JoinSet;

/// Behaviours that are filled at the same time.
const AT_ONCE: usize = 16;

/// A behaviour with its history and its named versions.
type RestoredBehaviour = (BackedUpBehaviour, Vec<Committed>, Vec<Checkpoint>);

/// A backup that was read to its end, found whole, and fits the store that it is for.
#[derive(Debug)]
pub struct Backup<R> {
    from: R,
    whole: BackupRest,
}

impl<R> Backup<R> {
    /// The robots that are in it; none in one of an older rrp.
    #[must_use]
    pub fn robots(&self) -> &[BackedUpRobot] {
        &self.whole.robots
    }

    /// Returns the mark of a store that is filled from it, `again` being the command for that. The same backup under
    /// another name is the same source.
    #[must_use]
    pub fn source(&self, again: &str) -> FillingSource {
        let Counted { behaviours, changes } = self.whole.counted;
        FillingSource { key: format!("backup {} {behaviours} {changes}", self.whole.sum), again: again.to_owned() }
    }
}

/// Reads a whole backup for a store that is empty or holds a part of the same backup. Changes nothing.
///
/// # Errors
/// [`BackupError::Broken`] for a file that is not whole or whose behaviours do not keep the rules,
/// [`BackupError::NotEmpty`], and [`StoreError::Unfinished`] for a store that is being filled from elsewhere.
pub async fn read<R>(mut from: R, to: &dyn Store) -> Result<Backup<R>, BackupError>
where
    R: BufRead + Seek + Send + 'static,
{
    let heads = heads(to).await?;
    let looking = tokio::task::spawn_blocking(move || -> Result<_, BackupError> {
        let mut look = RestoreLook::at(heads);
        let whole = lines::read(&mut from, &mut look)?;
        from.rewind()?;
        Ok((Backup { from, whole }, look.all_found()))
    });
    let (backup, fits) = looking.await.map_err(|error| stopped(&error))??;
    filling::check(to, &backup.source("")).await?;
    fits.map(|()| backup)
}

/// Restores a backup into the store that it was read for, which is marked with [`Backup::source`]. The caller ends the
/// filling, once what belongs beside the store is there too.
///
/// # Errors
/// Fails if the store does. Done again, it goes on where it ended.
pub async fn restore<R>(backup: Backup<R>, to: &Filling, progress: Progress<'_>) -> Result<Counted, BackupError>
where
    R: BufRead + Seek + Send + 'static,
{
    let Backup { mut from, whole } = backup;
    let (tell, mut told) = mpsc::channel(AT_ONCE);
    let reading = tokio::task::spawn_blocking(move || {
        let mut gather = Gather { tell, whole: None };
        lines::read(&mut from, &mut gather)?;
        gather.pass_on()
    });
    let (mut done, mut filling) = (Counted::default(), JoinSet::new());
    while let Some(filled) = told.recv().await {
        if filling.len() >= AT_ONCE {
            finished(&mut filling, &mut done, whole.counted.behaviours, progress).await?;
        }
        filling.spawn(fill(to.clone(), filled));
    }
    while !filling.is_empty() {
        finished(&mut filling, &mut done, whole.counted.behaviours, progress).await?;
    }
    reading.await.map_err(|error| stopped(&error))??;
    // Locks of the time before the backup must stay void.
    to.store().raise_epoch(whole.epoch).await?;
    Ok(done)
}

/// Reads a whole backup without a store; answers with its counts.
///
/// # Errors
/// [`BackupError::Broken`] if it is not whole, or if its behaviours do not keep the rules.
pub fn verify(from: &mut dyn BufRead) -> Result<Counted, BackupError> {
    lines::read(from, &mut RestoreLook::at(Heads::new())).map(|whole| whole.counted)
}

fn stopped(error: &tokio::task::JoinError) -> StoreError {
    StoreError::Unavailable(format!("restoring stopped: {error}").into())
}

async fn fill(to: Filling, (shelf, changes, named): RestoredBehaviour) -> Result<u64, BackupError> {
    let mut copying = Copying::of(&to, &shelf).await?;
    for change in &changes {
        copying.put(change).await?;
    }
    copying.end(&named).await
}

/// Looks whether what the store has is the beginning of what the backup has, and whether that keeps the rules.
struct RestoreLook {
    heads: Heads,
    /// The behaviours of the backup that were not found yet.
    missing: BTreeSet<Id>,
    /// A behaviour of the store that the backup does not have so.
    other: Option<Id>,
    seen: BTreeSet<Id>,
    now: Option<BackedUpBehaviour>,
    history: History,
}

impl RestoreLook {
    fn at(heads: Heads) -> Self {
        let (missing, history) = (heads.keys().cloned().collect(), History::default());
        Self { heads, missing, other: None, seen: BTreeSet::new(), now: None, history }
    }

    fn all_found(&self) -> Result<(), BackupError> {
        let strange = self.other.as_ref().or_else(|| self.missing.first());
        strange.map_or(Ok(()), |id| Err(BackupError::NotEmpty(id.clone())))
    }
}

impl BackupListener for RestoreLook {
    fn behaviour(&mut self, shelf: BackedUpBehaviour) -> Result<(), BackupError> {
        if !self.seen.insert(shelf.id.clone()) {
            return Err(broken(BackupFlaw::Twice));
        }
        let is_library = shelf.id.as_str() == LIBRARY;
        if let Some((at_ms, by)) = &shelf.removed {
            let no = check_person(by).err().or_else(|| is_library.then_some(Refusal::Gone));
            no.map_or(Ok(()), |no| Err(broken(BackupFlaw::Binned(no))))?;
            check_time(*at_ms)?;
        }
        self.history = if is_library { History::of_the_library() } else { History::default() };
        self.now = Some(shelf);
        Ok(())
    }

    fn change(&mut self, change: Committed) -> Result<(), BackupError> {
        let Some(BackedUpBehaviour { id, revision, .. }) = &self.now else { return Ok(()) };
        check_time(change.change.at_ms)?;
        let mut taken = self.history.take(&change.change);
        if change.revision == *revision {
            taken = taken.and_then(|()| self.history.check_end());
        }
        taken.map_err(|refusal| broken(unruly(refusal)))?;
        if let Some(last) = self.heads.get(id).filter(|last| last.revision == change.revision) {
            self.missing.remove(id);
            if *last != change {
                self.other.get_or_insert_with(|| id.clone());
            }
        }
        Ok(())
    }

    fn named(&mut self, _: Checkpoint) {}
}

fn check_time(at_ms: u64) -> Result<(), BackupError> {
    crate::json::check_time(at_ms).map_err(|_| broken(BackupFlaw::Time))
}

fn unruly(refusal: Refusal) -> BackupFlaw {
    match refusal {
        Refusal::Stale(record) => BackupFlaw::Stale(record.to_string()),
        refusal => BackupFlaw::Refused(refusal),
    }
}

/// The reader of the lines knows which one it is.
fn broken(flaw: BackupFlaw) -> BackupError {
    BackupError::Broken(0, flaw)
}

/// Gathers behaviours and passes each on when it is whole.
struct Gather {
    tell: mpsc::Sender<RestoredBehaviour>,
    whole: Option<RestoredBehaviour>,
}

impl Gather {
    fn pass_on(&mut self) -> Result<(), BackupError> {
        let Some(whole) = self.whole.take() else { return Ok(()) };
        let ended = |_| StoreError::Unavailable("restoring ended early".into()).into();
        self.tell.blocking_send(whole).map_err(ended)
    }
}

impl BackupListener for Gather {
    fn behaviour(&mut self, shelf: BackedUpBehaviour) -> Result<(), BackupError> {
        self.pass_on()?;
        self.whole = Some((shelf, Vec::new(), Vec::new()));
        Ok(())
    }

    fn change(&mut self, change: Committed) -> Result<(), BackupError> {
        if let Some((_, changes, _)) = &mut self.whole {
            changes.push(change);
        }
        Ok(())
    }

    fn named(&mut self, checkpoint: Checkpoint) {
        if let Some((.., named)) = &mut self.whole {
            named.push(checkpoint);
        }
    }
}
