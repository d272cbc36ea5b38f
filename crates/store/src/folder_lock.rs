//! One server for one data directory.

use crate::{StoreError, disk};
use std::fs::{File, TryLockError};
use std::io;
use std::path::Path;

const LOCK: &str = "rrp.lock";

/// A data directory that every other server is kept out of for as long as this is held.
#[derive(Debug)]
pub struct FolderLock {
    _held: Vec<File>,
}

/// Makes the directory if need be, closes it to other users and keeps every other server out of it. Locked are a file in
/// it and, where the system can, the directory itself: it counts also if somebody deletes the file.
///
/// # Errors
/// [`StoreError::Busy`] if another server uses it, [`StoreError::Unavailable`] if it cannot be used.
pub fn lock_folder(folder: &Path) -> Result<FolderLock, StoreError> {
    let unusable = |error: io::Error| StoreError::Unavailable(format!("{}: {error}", folder.display()).into());
    disk::make_folder(folder).map_err(unusable)?;
    let itself = File::open(folder).and_then(|itself| Ok(locked(&itself)?.then_some(itself)));
    if matches!(itself, Ok(None)) {
        return Err(StoreError::Busy(folder.to_owned()));
    }
    // Somebody else's directory can be used too, but not be closed.
    let _not_ours = disk::close_to_others(folder);
    let file = disk::private().create(true).truncate(false).open(folder.join(LOCK));
    let file = file.and_then(|file| Ok(locked(&file)?.then_some(file)));
    match (itself, file) {
        (_, Ok(None)) => Err(StoreError::Busy(folder.to_owned())),
        (itself, Ok(Some(file))) => Ok(FolderLock { _held: itself.ok().flatten().into_iter().chain([file]).collect() }),
        // On a full disk there is no new file, and everything can still be read.
        (Ok(Some(itself)), Err(_)) => Ok(FolderLock { _held: vec![itself] }),
        (_, Err(error)) => Err(unusable(error)),
    }
}

/// Locks a file or directory; false if somebody else has.
fn locked(file: &File) -> io::Result<bool> {
    match file.try_lock() {
        Ok(()) => Ok(true),
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(error)) => Err(error),
    }
}

#[cfg(test)]
mod tests {
    use super::{LOCK, lock_folder};
    use crate::StoreError;

    #[cfg(unix)]
    #[test]
    fn a_folder_stays_locked_when_its_lock_file_is_deleted() {
        let folder = tempfile::tempdir().expect("a folder");
        let first = lock_folder(folder.path()).expect("it is free");
        std::fs::remove_file(folder.path().join(LOCK)).expect("to delete it");
        assert_eq!(lock_folder(folder.path()).err(), Some(StoreError::Busy(folder.path().to_owned())));
        drop(first);
        lock_folder(folder.path()).expect("it is free again");
    }

    #[test]
    fn a_server_that_knows_only_the_file_keeps_others_out() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = std::fs::File::create(folder.path().join(LOCK)).expect("a file");
        file.try_lock().expect("to lock it");
        assert_eq!(lock_folder(folder.path()).err(), Some(StoreError::Busy(folder.path().to_owned())));
    }
}
