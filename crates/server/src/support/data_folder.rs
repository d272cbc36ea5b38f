//! The folder with recordings, robots and orders: one server at a time, and none on what a restore left half done.

use std::path::Path;
use store::{FolderLock, StoreError};

/// Keeps other servers out of the data folder, for as long as what it answers with is held; none is needed where the
/// store, which is in the same folder, keeps them out already.
///
/// # Errors
/// [`StoreError::Busy`] if another server uses it, [`StoreError::Unfinished`] if a restore of an older rrp into it did not end.
pub(crate) fn take(store: &str, data: Option<&Path>) -> Result<Option<FolderLock>, StoreError> {
    let own = store::folder_of(store);
    let Some(data) = data else { return Ok(None) };
    store::check_folder(data)?;
    if own.is_some_and(|own| store::is_same_folder(own, data)) {
        return Ok(None);
    }
    let lock = store::lock_folder(data)?;
    tracing::info!(folder = %data.display(), "recordings, robots and their orders are kept beside the store");
    Ok(Some(lock))
}

#[cfg(test)]
mod tests {
    use super::take;
    use store::StoreError;

    #[test]
    fn two_servers_never_share_the_folder_beside_a_store() {
        let folder = tempfile::tempdir().unwrap();
        let first = || take("bolt://one:7687", Some(folder.path()));
        let held = first().unwrap();
        assert!(held.is_some());
        let second = take("bolt://another:7687", Some(folder.path()));
        assert_eq!(second.err(), Some(StoreError::Busy(folder.path().to_owned())));
        drop(held);
        assert!(first().unwrap().is_some(), "it is free again");
    }

    #[test]
    fn the_folder_of_the_store_is_locked_by_the_store() {
        let folder = tempfile::tempdir().unwrap();
        let url = format!("sqlite:{}/.", folder.path().display());
        assert!(take(&url, Some(folder.path())).unwrap().is_none());
    }
}
