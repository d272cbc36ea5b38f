//! Filling a store from a backup or from another store. That this has begun and not ended is marked in the store itself, so
//! that nobody, also no server elsewhere, takes a part of it for the whole.

use crate::{Damage, Store, StoreError, disk};
use serde::{Deserialize, Serialize};
use std::io;
use std::path::Path;
use std::sync::Arc;

/// The mark of a store that is a folder of files.
const FILE: &str = "filling.json";
/// The mark that a restore of an older rrp left in the folder of a store, or beside it.
const OLDER: &str = "rrp.restoring";

/// The source from which a store is filled.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FillingSource {
    /// Tells it from every other one.
    pub key: String,
    /// The command that goes on with it, as somebody types it; it has no password in it.
    pub again: String,
}

impl FillingSource {
    /// True if a store with this mark may be filled from here.
    fn fits(&self, mark: &Self) -> bool {
        self.key == mark.key || mark.key.is_empty()
    }

    fn of_an_older_rrp() -> Self {
        Self { key: String::new(), again: "rrp restore, with the same backup".to_owned() }
    }
}

/// A store on its way: marked before the first change, and no longer when all of it is there. The only way in which a store
/// is filled.
#[derive(Clone)]
pub struct Filling {
    to: Arc<dyn Store>,
    goes_on: bool,
}

impl Filling {
    /// Marks a store as being filled from there, or goes on with what was begun.
    ///
    /// # Errors
    /// [`StoreError::Unfinished`] if it is being filled from elsewhere.
    pub async fn begin(to: &Arc<dyn Store>, source: &FillingSource) -> Result<Self, StoreError> {
        let goes_on = check(&**to, source).await?;
        let mut mark = to.begin_filling(source).await;
        if mark.as_ref().is_err_and(StoreError::is_open) {
            mark = to.begin_filling(source).await;
        }
        let mark = mark?;
        if source.fits(&mark) { Ok(Self { to: Arc::clone(to), goes_on }) } else { Err(unfinished(mark)) }
    }

    /// The store.
    #[must_use]
    pub fn store(&self) -> &Arc<dyn Store> {
        &self.to
    }

    /// True if it had been begun before.
    #[must_use]
    pub fn goes_on(&self) -> bool {
        self.goes_on
    }

    /// Takes the mark away: all of it is there.
    ///
    /// # Errors
    /// Fails if the store does; then it is still marked.
    pub async fn end(self) -> Result<(), StoreError> {
        let mut ended = self.to.end_filling().await;
        if ended.as_ref().is_err_and(StoreError::is_open) {
            ended = self.to.end_filling().await;
        }
        ended
    }
}

/// Looks whether a store may be filled from there, and says whether that was begun before.
///
/// # Errors
/// [`StoreError::Unfinished`] if it is being filled from elsewhere.
pub(crate) async fn check(store: &dyn Store, source: &FillingSource) -> Result<bool, StoreError> {
    match store.filling().await? {
        None => Ok(false),
        Some(mark) if source.fits(&mark) => Ok(true),
        Some(mark) => Err(unfinished(mark)),
    }
}

/// Looks whether all of a store is there, so that it can be served, exported or backed up.
///
/// # Errors
/// [`StoreError::Unfinished`] if it is only a part.
pub async fn check_whole(store: &dyn Store) -> Result<(), StoreError> {
    store.filling().await?.map_or(Ok(()), |mark| Err(unfinished(mark)))
}

fn unfinished(mark: FillingSource) -> StoreError {
    StoreError::Unfinished(mark.again)
}

/// Looks whether a restore of an older rrp left something half done in a folder.
///
/// # Errors
/// [`StoreError::Unfinished`] if it did.
pub fn check_folder(folder: &Path) -> Result<(), StoreError> {
    if folder.join(OLDER).exists() { Err(unfinished(FillingSource::of_an_older_rrp())) } else { Ok(()) }
}

/// Takes away the mark that a restore of an older rrp left in a folder: what it began has come to its end.
///
/// # Errors
/// If it cannot be taken away.
pub fn end_in_folder(folder: &Path) -> io::Result<()> {
    gone(folder, OLDER)
}

/// The mark in a folder of files.
pub(crate) fn in_folder(folder: &Path) -> Result<Option<FillingSource>, StoreError> {
    let file = folder.join(FILE);
    match std::fs::read(&file) {
        Ok(text) => {
            let damaged = |error: serde_json::Error| StoreError::Damaged(Damage::file(&file, &error));
            serde_json::from_slice(&text).map(Some).map_err(damaged)
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(of_older(folder)),
        Err(error) => Err(disk::told(&file, &error)),
    }
}

/// The mark of an older rrp in a folder.
pub(crate) fn of_older(folder: &Path) -> Option<FillingSource> {
    folder.join(OLDER).exists().then(FillingSource::of_an_older_rrp)
}

/// Marks a folder of files, whatever an older rrp left there.
pub(crate) fn begin_in_folder(folder: &Path, source: &FillingSource) -> Result<FillingSource, StoreError> {
    if let Some(mark) = in_folder(folder)?.filter(|mark| !mark.key.is_empty()) {
        return Ok(mark);
    }
    let (file, text) = (folder.join(FILE), crate::json::encode(source).map_err(crate::json::unwritable)?);
    disk::put(&file, text.as_bytes()).map_err(|error| disk::told(&file, &error))?;
    Ok(source.clone())
}

/// Takes every mark out of a folder of files.
pub(crate) fn end_of_folder(folder: &Path) -> Result<(), StoreError> {
    let told = |error: io::Error| disk::told(folder, &error);
    gone(folder, OLDER).and_then(|()| gone(folder, FILE)).map_err(told)
}

fn gone(folder: &Path, file: &str) -> io::Result<()> {
    match std::fs::remove_file(folder.join(file)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => disk::sync_names(folder),
    }
}
