//! From a backup into a store: first the whole file is read, then the first change is made.

use super::copy::{Filling, Heads, finished, heads};
use super::lines::{Listener, read};
use super::{BackupError, Counted, Progress, Shelf};
use crate::{Store, StoreError};
use behaviour::Committed;
use std::io::{BufRead, Seek};
use std::sync::Arc;
use tokio::sync::mpsc;
use tokio::task::JoinSet;

/// Behaviours that are filled at the same time.
const AT_ONCE: usize = 16;

/// A behaviour with its history.
type Whole = (Shelf, Vec<Committed>);

/// Restores a backup into a store that is empty or holds a part of the same backup.
///
/// # Errors
/// [`BackupError::Broken`] for a file that is not whole and [`BackupError::NotEmpty`], both before anything is
/// changed; what the store fails with. Done again, it goes on where it ended.
pub async fn restore<R>(mut from: R, to: &Arc<dyn Store>, progress: Progress<'_>) -> Result<Counted, BackupError>
where
    R: BufRead + Seek + Send + 'static,
{
    let heads = heads(&**to).await?;
    let looking = tokio::task::spawn_blocking(move || {
        let mut look = Look { heads: heads.clone(), revisions: heads, now: None };
        let found = read(&mut from, &mut look)?;
        look.all_found()?;
        from.rewind()?;
        Ok::<_, BackupError>((found, from))
    });
    let ((epoch, counted), mut from) = looking.await.map_err(|error| stopped(&error))??;
    let (tell, mut told) = mpsc::channel(AT_ONCE);
    let reading = tokio::task::spawn_blocking(move || {
        let mut gather = Gather { tell, whole: None };
        read(&mut from, &mut gather)?;
        gather.pass_on()
    });
    let (mut done, mut filling) = (Counted::default(), JoinSet::new());
    while let Some((shelf, changes)) = told.recv().await {
        if filling.len() >= AT_ONCE {
            finished(&mut filling, &mut done, counted.behaviours, progress).await?;
        }
        filling.spawn(fill(Arc::clone(to), shelf, changes));
    }
    while !filling.is_empty() {
        finished(&mut filling, &mut done, counted.behaviours, progress).await?;
    }
    reading.await.map_err(|error| stopped(&error))??;
    // Locks of the time before the backup must stay void.
    while to.next_epoch().await? < epoch {}
    Ok(done)
}

/// Reads a whole backup without a store; answers with its counts.
///
/// # Errors
/// [`BackupError::Broken`] if it is not whole.
pub fn verify(from: &mut dyn BufRead) -> Result<Counted, BackupError> {
    let mut look = Look { heads: Heads::new(), revisions: Heads::new(), now: None };
    read(from, &mut look).map(|(_, counted)| counted)
}

fn stopped(error: &tokio::task::JoinError) -> StoreError {
    StoreError::Unavailable(format!("restoring stopped: {error}"))
}

async fn fill(to: Arc<dyn Store>, shelf: Shelf, changes: Vec<Committed>) -> Result<u64, BackupError> {
    let mut filling = Filling::of(&*to, &shelf).await?;
    for change in &changes {
        filling.put(change).await?;
    }
    filling.end().await
}

/// Looks whether what the store has is the beginning of what the backup has.
struct Look {
    heads: Heads,
    /// What was not found yet.
    revisions: Heads,
    now: Option<Shelf>,
}

impl Look {
    fn all_found(&self) -> Result<(), BackupError> {
        self.revisions.keys().next().map_or(Ok(()), |id| Err(BackupError::NotEmpty(id.clone())))
    }
}

impl Listener for Look {
    fn behaviour(&mut self, shelf: Shelf) -> Result<(), BackupError> {
        self.now = Some(shelf);
        Ok(())
    }

    fn change(&mut self, change: Committed) -> Result<(), BackupError> {
        let Some(shelf) = &self.now else { return Ok(()) };
        match self.heads.get(&shelf.id) {
            Some((revision, op)) if *revision == change.revision => {
                if *op != change.change.op {
                    return Err(BackupError::NotEmpty(shelf.id.clone()));
                }
                self.revisions.remove(&shelf.id);
            }
            _ => {}
        }
        Ok(())
    }
}

/// Gathers behaviours and passes each on when it is whole.
struct Gather {
    tell: mpsc::Sender<Whole>,
    whole: Option<Whole>,
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
        self.whole = Some((shelf, Vec::new()));
        Ok(())
    }

    fn change(&mut self, change: Committed) -> Result<(), BackupError> {
        if let Some((_, changes)) = &mut self.whole {
            changes.push(change);
        }
        Ok(())
    }
}
