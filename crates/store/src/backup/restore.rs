//! From a backup into a store: first the whole file is read, then the first change is made.

use super::copy::{Filling, Heads, finished, heads};
use super::lines::{self, Listener, Whole};
use super::{BackupError, Counted, Flaw, Progress, Robot, Shelf};
use crate::{Store, StoreError};
use behaviour::{Checkpoint, Committed, History, Id, Refusal};
use std::collections::BTreeSet;
use std::io::{BufRead, Seek};
use std::sync::Arc;
use tokio::sync::mpsc;
use tokio::task::JoinSet;

/// Behaviours that are filled at the same time.
const AT_ONCE: usize = 16;

/// A behaviour with its history and its named versions.
type Filled = (Shelf, Vec<Committed>, Vec<Checkpoint>);

/// A backup that was read to its end, found whole, and fits the store that it is for.
#[derive(Debug)]
pub struct Backup<R> {
    from: R,
    whole: Whole,
}

impl<R> Backup<R> {
    /// The robots that are in it; none in one of an older rrp.
    #[must_use]
    pub fn robots(&self) -> &[Robot] {
        &self.whole.robots
    }
}

/// Reads a whole backup for a store that is empty or holds a part of the same backup. Changes nothing.
///
/// # Errors
/// [`BackupError::Broken`] for a file that is not whole or whose behaviours do not keep the rules, and
/// [`BackupError::NotEmpty`].
pub async fn read<R>(mut from: R, to: &dyn Store) -> Result<Backup<R>, BackupError>
where
    R: BufRead + Seek + Send + 'static,
{
    let heads = heads(to).await?;
    let looking = tokio::task::spawn_blocking(move || {
        let mut look = Look::at(heads);
        let whole = lines::read(&mut from, &mut look)?;
        look.all_found()?;
        from.rewind()?;
        Ok(Backup { from, whole })
    });
    looking.await.map_err(|error| stopped(&error))?
}

/// Restores a backup into the store that it was read for.
///
/// # Errors
/// What the store fails with. Done again, it goes on where it ended.
pub async fn restore<R>(backup: Backup<R>, to: &Arc<dyn Store>, progress: Progress<'_>) -> Result<Counted, BackupError>
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
        filling.spawn(fill(Arc::clone(to), filled));
    }
    while !filling.is_empty() {
        finished(&mut filling, &mut done, whole.counted.behaviours, progress).await?;
    }
    reading.await.map_err(|error| stopped(&error))??;
    // Locks of the time before the backup must stay void.
    to.raise_epoch(whole.epoch).await?;
    Ok(done)
}

/// Reads a whole backup without a store; answers with its counts.
///
/// # Errors
/// [`BackupError::Broken`] if it is not whole, or if its behaviours do not keep the rules.
pub fn verify(from: &mut dyn BufRead) -> Result<Counted, BackupError> {
    lines::read(from, &mut Look::at(Heads::new())).map(|whole| whole.counted)
}

fn stopped(error: &tokio::task::JoinError) -> StoreError {
    StoreError::Unavailable(format!("restoring stopped: {error}"))
}

async fn fill(to: Arc<dyn Store>, (shelf, changes, named): Filled) -> Result<u64, BackupError> {
    let mut filling = Filling::of(&*to, &shelf).await?;
    for change in &changes {
        filling.put(change).await?;
    }
    filling.end(&named).await
}

/// Looks whether what the store has is the beginning of what the backup has, and whether that keeps the rules.
struct Look {
    heads: Heads,
    /// What was not found yet.
    missing: Heads,
    seen: BTreeSet<Id>,
    now: Option<Id>,
    history: History,
}

impl Look {
    fn at(heads: Heads) -> Self {
        let (missing, history) = (heads.clone(), History::default());
        Self { heads, missing, seen: BTreeSet::new(), now: None, history }
    }

    fn all_found(&self) -> Result<(), BackupError> {
        self.missing.keys().next().map_or(Ok(()), |id| Err(BackupError::NotEmpty(id.clone())))
    }
}

impl Listener for Look {
    fn behaviour(&mut self, shelf: Shelf) -> Result<(), BackupError> {
        if !self.seen.insert(shelf.id.clone()) {
            return Err(broken(Flaw::Twice));
        }
        (self.now, self.history) = (Some(shelf.id), History::default());
        Ok(())
    }

    fn change(&mut self, change: Committed) -> Result<(), BackupError> {
        let Some(id) = &self.now else { return Ok(()) };
        let taken = self.history.take(&change.change);
        taken.map_err(|refusal| broken(unruly(refusal)))?;
        match self.heads.get(id) {
            Some((revision, op)) if *revision == change.revision => {
                if *op != change.change.op {
                    return Err(BackupError::NotEmpty(id.clone()));
                }
                self.missing.remove(id);
            }
            _ => {}
        }
        Ok(())
    }

    fn named(&mut self, _: Checkpoint) {}
}

fn unruly(refusal: Refusal) -> Flaw {
    match refusal {
        Refusal::Stale(record) => Flaw::Stale(record),
        refusal => Flaw::Refused(refusal),
    }
}

/// The reader of the lines knows which one it is.
fn broken(flaw: Flaw) -> BackupError {
    BackupError::Broken(0, flaw)
}

/// Gathers behaviours and passes each on when it is whole.
struct Gather {
    tell: mpsc::Sender<Filled>,
    whole: Option<Filled>,
}

impl Gather {
    fn pass_on(&mut self) -> Result<(), BackupError> {
        let Some(whole) = self.whole.take() else { return Ok(()) };
        let ended = |_| StoreError::Unavailable("restoring ended early".to_owned()).into();
        self.tell.blocking_send(whole).map_err(ended)
    }
}

impl Listener for Gather {
    fn behaviour(&mut self, shelf: Shelf) -> Result<(), BackupError> {
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
